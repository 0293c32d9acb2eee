//! One joint for one step: its spring, and its limits as exponential springs, passed to the solver as implicit motors.
//!
//! The rows of the solver's joint are turned so that the first axis is the one about which the swing comes to its limit
//! soonest and the second the same for the twist. So pose spring and limit spring of one direction are one row, and
//! both are evaluated at the end of the step (implicit): no stiffness that a file can state makes them unstable.
//!
//! Limits follow Shapiro et al. 2007, EQ4, in a form that does not jump at the limit: −k (e^{c v} − 1) − d θ̇ for a
//! violation v > 0. As printed the torque is k e^{−1} at v = 0.

use crate::Drive;
use crate::ragdoll::is_hinge;
use glam::{DMat3, DQuat, DVec3};
use rapier3d_f64::prelude::*;
use sinew_body::humanoid::{Limit, Node, exp, log, swing_twist};

/// The exponential spring of a limit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct LimitSpring {
    /// k \[N m\].
    pub strength: f64,
    /// c \[1/rad\].
    pub sharpness: f64,
    /// Time constant of the damping while beyond the limit \[s\]: d is the secant stiffness times this.
    pub damping_secs: f64,
}

impl LimitSpring {
    /// For a body of this mass and stature in a world of this gravity: one and a half degrees beyond the limit balance about a
    /// fifth of m g h.
    pub fn of(mass_kg: f64, gravity_m_s2: f64, stature_m: f64) -> LimitSpring {
        LimitSpring { strength: 0.05 * mass_kg * gravity_m_s2 * stature_m, sharpness: 60.0, damping_secs: 0.01 }
    }

    /// Stiffness \[N m/rad\] whose straight line through the limit has the exponential's torque at this violation \[rad\].
    fn secant(&self, violation: f64) -> f64 {
        // e^8 is 3,000 times k; beyond it the spring is linear.
        let exponent = (self.sharpness * violation).min(8.0);
        self.strength * libm::expm1(exponent) / (exponent / self.sharpness).max(1e-9)
    }
}

/// Warm start of a joint's rows.
#[derive(Clone, Copy)]
pub(crate) struct Start {
    pub step_secs: f64,
    pub sub_step_secs: f64,
    /// Torque of the joint on its parent that acts already, in the parent's axes \[N m\].
    pub torque: DVec3,
}

impl Start {
    /// The warm start torque of a drive's joint: none for springs too stiff for the step, whose torque of one step does
    /// not predict that of the next.
    fn torque_for(&self, drive: &Drive) -> DVec3 {
        if drive.damping < drive.stiffness * self.step_secs { DVec3::ZERO } else { self.torque }
    }
}

/// Maximum velocity by which a row's target is shifted \[rad/s\].
const MAX_SHIFT_RAD_S: f64 = 100.0;

/// One row of a spring: `error` is the turn from wanted to present \[rad\].
#[derive(Clone, Copy, Default)]
struct Row {
    stiffness: f64,
    damping: f64,
    error: f64,
    velocity: f64,
}

impl Row {
    /// The drive's row. Its spring takes at least a step to close its error: an undamped one of any stiffness would be
    /// there within a sub-step otherwise, with limbs at hundreds of metres a second. It has no effect on springs that a
    /// step can resolve.
    fn of(drive: &Drive, error: f64, velocity: f64, step_secs: f64) -> Row {
        let damping = drive.damping.max(drive.stiffness * step_secs);
        Row { stiffness: drive.stiffness, damping, error, velocity: velocity * drive.damping / damping.max(1e-12) }
    }

    /// The row with a warm start torque of the joint on its parent \[N m\], and the part of that torque that may act:
    /// the row adds what is missing for the torque of its law, λ (h k + d) = v + …, by an equally shifted velocity.
    fn begun_with(self, torque: f64, sub_step_secs: f64) -> (Row, f64) {
        let stiff = self.stiffness * sub_step_secs + self.damping;
        let most = MAX_SHIFT_RAD_S * stiff;
        let torque = torque.clamp(-most, most);
        if stiff <= 0.0 {
            return (self, 0.0);
        }
        (Row { velocity: self.velocity + torque / stiff, ..self }, torque)
    }

    /// Both springs as one.
    fn with_limit(self, limit: &LimitSpring, violation: f64) -> Row {
        if violation <= 0.0 {
            return self;
        }
        let stiffness = limit.secant(violation);
        let (total, damping) = (self.stiffness + stiffness, self.damping + stiffness * limit.damping_secs);
        Row {
            stiffness: total,
            error: (self.stiffness * self.error + stiffness * violation) / total,
            velocity: self.velocity * self.damping / damping.max(1e-12),
            damping,
        }
    }
}

/// Where a joint is within its range: the axes, in the parent's frame, about which turning brings it to the edge of its
/// swing and of its twist soonest, and how far it is beyond them \[rad, about those axes\].
struct Reach {
    swing_axis: DVec3,
    swing_violation: f64,
    twist_axis: DVec3,
    twist_violation: f64,
}

impl Reach {
    fn of(limit: &Limit, local: DQuat) -> Reach {
        let (x, z, twist) = swing_twist(limit.centre.conjugate() * local);
        let (swing, ratio) = ((x * x + z * z).sqrt(), limit.swing_ratio(x, z));
        let (upright, bone) = (limit.centre * DVec3::Y, local * DVec3::Y);
        // With a swing θ from the middle of the range (y) to the bone (b), the twist changes by ω·(y + b) / (1 + y·b), that is
        // by the turn about their bisector over cos(θ/2). The bone's own axis is not it: a bone on its way round the
        // cone turns about itself and keeps its twist.
        let bisector = (upright + bone).try_normalize().unwrap_or_else(|| upright.any_orthonormal_vector());
        let (violation, sign) = if twist - limit.twist.1 > limit.twist.0 - twist {
            (twist - limit.twist.1, 1.0)
        } else {
            (limit.twist.0 - twist, -1.0)
        };
        let twist_violation = violation * bisector.dot(bone);
        let twist_axis = bisector * sign;

        // The swing grows about s = (x, 0, z) / θ; along the ellipse it goes by t = s × bisector, θ/2 / sin(θ/2) for each
        // radian about -t. So the gradient of the ratio to the ellipse is an axis in their plane.
        let outward = limit.centre * DVec3::new(x, 0.0, z);
        let outward = outward - bisector * outward.dot(bisector);
        let Some(outward) = outward.try_normalize().filter(|_| swing > 1e-6) else {
            let swing_axis = bisector.any_orthonormal_vector();
            return Reach { swing_axis, swing_violation: 0.0, twist_axis, twist_violation };
        };
        let (gradient_x, gradient_z) = swing_gradient(limit, x, z, ratio);
        let radial = (gradient_x * x + gradient_z * z) / swing;
        let tangential = (gradient_x * z - gradient_z * x) / swing;
        let half = swing / 2.0;
        let axis = outward * radial - outward.cross(bisector) * (tangential * half / libm::sin(half).max(1e-3));
        let steepness = axis.length().max(1e-9);
        Reach { swing_axis: axis / steepness, swing_violation: (ratio - 1.0) / steepness, twist_axis, twist_violation }
    }
}

/// Excess of a joint over its nearest limit, about the axis that leads there \[rad\]; negative inside.
pub(crate) fn violation(node: Node, limit: &Limit, local: DQuat) -> f64 {
    if is_hinge(node) {
        let angle = hinge_angle(limit.centre.conjugate() * local);
        return (angle - limit.swing.x_positive).max(-limit.swing.x_negative - angle);
    }
    let reach = Reach::of(limit, local);
    // In the middle of its range the swing has no direction, and is far from any limit.
    let swing = if reach.swing_violation == 0.0 { f64::NEG_INFINITY } else { reach.swing_violation };
    swing.max(reach.twist_violation)
}

/// The turn about X.
fn hinge_angle(rotation: DQuat) -> f64 {
    wrap(2.0 * libm::atan2(rotation.x, rotation.w))
}

/// The same angle within half a turn.
fn wrap(angle: f64) -> f64 {
    angle - libm::round(angle / std::f64::consts::TAU) * std::f64::consts::TAU
}

/// How the length of a swing relative to the ellipse's radius changes with its x and z.
fn swing_gradient(limit: &Limit, x: f64, z: f64, ratio: f64) -> (f64, f64) {
    let swing = &limit.swing;
    let across = if x < 0.0 { swing.x_negative } else { swing.x_positive };
    let along = if z < 0.0 { swing.z_negative } else { swing.z_positive };
    let ratio = ratio.max(1e-9);
    (x / (across * across * ratio), z / (along * along * ratio))
}

/// Writes a ball joint's rows. `local` is the present `parent_from_node`. Returns the part of the warm start torque
/// that may act.
pub(crate) fn write_ball(
    joint: &mut GenericJoint,
    limit: &Limit,
    spring: &LimitSpring,
    drive: &Drive,
    local: DQuat,
    start: Start,
) -> DVec3 {
    let reach = Reach::of(limit, local);
    let axes = DMat3::from_cols(reach.swing_axis, reach.twist_axis, reach.swing_axis.cross(reach.twist_axis));
    let frame = DQuat::from_mat3(&axes).normalize();

    // Turn from wanted to present, in the parent's axes, then in the rows'.
    let error = frame.conjugate() * log(local * drive.rotation.conjugate());
    let velocity = frame.conjugate() * (local * drive.velocity);
    let row = |error: f64, velocity: f64| Row::of(drive, error, velocity, start.step_secs);
    let rows = [
        row(error.x, velocity.x).with_limit(spring, reach.swing_violation),
        row(error.y, velocity.y).with_limit(spring, reach.twist_violation),
        row(error.z, velocity.z),
    ];
    // With both frames equal now, the solver sees no angle at the step's start, and each row's target is its error.
    joint.local_frame1.rotation = frame;
    joint.local_frame2.rotation = (local.conjugate() * frame).normalize();
    let mut begun = (frame.conjugate() * start.torque_for(drive)).to_array();
    for (at, axis) in [JointAxis::AngX, JointAxis::AngY, JointAxis::AngZ].into_iter().enumerate() {
        let (row, torque) = rows[at].begun_with(begun[at], start.sub_step_secs);
        begun[at] = torque;
        set(joint, axis, -row.error, row);
    }
    stop(joint, JointAxis::AngX, reach.swing_violation, 1.0);
    stop(joint, JointAxis::AngY, reach.twist_violation, 1.0);
    frame * DVec3::from_array(begun)
}

/// Writes a hinge's row, about X of both frames; otherwise as [`write_ball`]. Captured knees do not turn about their X alone: the axis
/// goes along with what the drive wants beside that turn.
pub(crate) fn write_hinge(
    joint: &mut GenericJoint,
    limit: &Limit,
    spring: &LimitSpring,
    drive: &Drive,
    local: DQuat,
    start: Start,
) -> DVec3 {
    let angle_of = |rotation: DQuat| 2.0 * libm::atan2(rotation.x, rotation.w);
    let beside = beside_hinge(drive.rotation);
    let local = beside.conjugate() * local;
    let centre = angle_of(limit.centre);
    let angle = wrap(angle_of(local) - centre);
    let high = angle - limit.swing.x_positive;
    let low = -limit.swing.x_negative - angle;
    let wanted = wrap(angle_of(drive.rotation) - centre);
    let row = Row::of(drive, angle - wanted, drive.velocity.x, start.step_secs);
    let (sign, violation) = if high > low { (1.0, high) } else { (-1.0, low) };
    let mirrored = Row { error: sign * row.error, velocity: sign * row.velocity, ..row }.with_limit(spring, violation);
    let row = Row { error: sign * mirrored.error, velocity: sign * mirrored.velocity, ..mirrored };
    // As with ball joints, the solver sees no angle at the step's start; errors about the locked axes stay.
    let (sin, cos) = libm::sincos(angle_of(local) / 2.0);
    joint.local_frame1.rotation = beside;
    joint.local_frame2.rotation = DQuat::from_xyzw(-sin, 0.0, 0.0, cos);
    let axis = beside * DVec3::X;
    let (row, torque) = row.begun_with(start.torque_for(drive).dot(axis), start.sub_step_secs);
    set(joint, JointAxis::AngX, -row.error, row);
    stop(joint, JointAxis::AngX, violation, sign);
    axis * torque
}

/// What a rotation is beside its turn about X, which comes first: at most [`MAX_BESIDE`].
fn beside_hinge(rotation: DQuat) -> DQuat {
    let turn = DQuat::from_xyzw(rotation.x, 0.0, 0.0, rotation.w);
    if rotation.y == 0.0 && rotation.z == 0.0 || turn.length_squared() < 1e-6 {
        return DQuat::IDENTITY;
    }
    let beside = log((rotation * turn.conjugate()).normalize());
    exp(beside.clamp_length_max(MAX_BESIDE))
}

/// Largest turn of a hinge's axis \[rad\]: what captured shanks turn beside the knee's bending, and some more.
const MAX_BESIDE: f64 = 0.7;

/// The stop behind a limit's spring, which ends what an impact drives through it within one step \[rad beyond the
/// limit\]: a degree and a half, about where the spring carries a fifth of m g h.
const STOP: f64 = 0.026;

/// A stop is a row of the solver only when it is so near that a step can reach it \[rad\]: at 80 rad/s.
const STOP_NEAR: f64 = 0.35;

/// Half the range that a stop leaves, reached from no limit within a step \[rad\]. The solver takes the sine and cosine of half
/// of it; here they lie so near to a float that every mathematics library gives the same bits.
const STOP_RANGE: f64 = 1.46875;

/// Adds a hard stop in the direction of `sign` behind the limit's spring.
fn stop(joint: &mut GenericJoint, axis: JointAxis, violation: f64, sign: f64) {
    stop_at(joint, axis, STOP - violation, sign);
}

/// Stops a row's turn in the direction of `sign` after so much more of it \[rad\].
pub(crate) fn stop_at(joint: &mut GenericJoint, axis: JointAxis, room: f64, sign: f64) {
    if room > STOP_NEAR {
        joint.limit_axes.remove(JointAxesMask::from(axis));
        return;
    }
    // In steps that add up without rounding, so that the middle of the range is the constant.
    let room = libm::round(room.max(-1.0) * 1048576.0) / 1048576.0;
    let (near, far) = (sign * room, sign * (-2.0 * STOP_RANGE - room));
    joint.set_limits(axis, [near.min(far), near.max(far)]);
}

fn set(joint: &mut GenericJoint, axis: JointAxis, target: f64, row: Row) {
    // The library takes a motor without stiffness and damping for a rigid one.
    if row.stiffness + row.damping <= 0.0 {
        joint.motor_axes.remove(JointAxesMask::from(axis));
        return;
    }
    joint.set_motor_model(axis, MotorModel::ForceBased);
    joint.set_motor(axis, target, row.velocity, row.stiffness, row.damping);
}

#[cfg(test)]
mod tests {
    use super::*;
    use sinew_body::{STANDARD_GRAVITY_M_S2, strength_gravity_m_s2};

    #[test]
    fn on_the_moon_a_limit_gives_way_as_far_to_the_weight_of_the_same_body() {
        const MOON_M_S2: f64 = 1.62;
        let of = |gravity_m_s2| LimitSpring::of(80.0, strength_gravity_m_s2(gravity_m_s2), 1.7);
        let (earth, moon) = (of(STANDARD_GRAVITY_M_S2), of(MOON_M_S2));
        for degrees in [0.1_f64, 0.5, 1.0, 1.5, 5.0] {
            let violation = degrees.to_radians();
            let ratio = moon.secant(violation) / earth.secant(violation);
            // Rounding of three products.
            assert!((ratio - MOON_M_S2 / STANDARD_GRAVITY_M_S2).abs() < 1e-12, "{degrees} degrees: {ratio}");
        }
        assert!(of(0.0).secant(0.02) > 0.0, "what weighs nothing has limits too");
    }
}
