//! One joint for one step: its spring, and its limits as exponential springs, handed to the solver as implicit motors.
//!
//! The rows of the solver's joint are turned so that the first axis is the swing that is nearest its limit and the second
//! the twist about the bone. So pose spring and limit spring of one direction are one row,
//! and both are taken at the end of the step: no stiffness that a file can state makes them explode.
//!
//! Limits follow Shapiro et al. 2007, EQ4, in a form that does not jump at the limit: −k (e^{c v} − 1) − d θ̇ for a
//! violation v > 0. As printed the torque is k e^{−1} at v = 0.

use crate::Drive;
use glam::{DMat3, DQuat, DVec3};
use rapier3d_f64::prelude::*;
use sinew_body::humanoid::{Limit, log, swing_twist};

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
    /// For a body of this mass and stature: one and a half degrees beyond the limit balance about a fifth of m g h.
    pub fn of(mass_kg: f64, stature_m: f64) -> LimitSpring {
        LimitSpring { strength: 0.05 * mass_kg * 9.81 * stature_m, sharpness: 60.0, damping_secs: 0.02 }
    }

    /// Stiffness \[N m/rad\] whose straight line through the limit has the exponential's torque at this violation \[rad\].
    fn secant(&self, violation: f64) -> f64 {
        // e^8 is 3,000 times k; beyond it the spring goes on straight.
        let exponent = (self.sharpness * violation).min(8.0);
        self.strength * libm::expm1(exponent) / (exponent / self.sharpness).max(1e-9)
    }
}

/// One row of a spring: `error` is the turn from wanted to present \[rad\].
#[derive(Clone, Copy, Default)]
struct Row {
    stiffness: f64,
    damping: f64,
    error: f64,
    velocity: f64,
}

impl Row {
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

/// Writes a ball joint's rows. `local` is the present `parent_from_node`.
pub(crate) fn write_ball(joint: &mut GenericJoint, limit: &Limit, spring: &LimitSpring, drive: &Drive, local: DQuat) {
    let (x, z, twist) = swing_twist(limit.centre.conjugate() * local);
    let swing = (x * x + z * z).sqrt();
    let ratio = limit.swing_ratio(x, z);
    let swing_violation = if ratio > 1.0 { swing * (1.0 - 1.0 / ratio) } else { 0.0 };
    let (twist_violation, twist_sign) = if twist - limit.twist.1 > limit.twist.0 - twist {
        (twist - limit.twist.1, 1.0)
    } else {
        (limit.twist.0 - twist, -1.0)
    };
    // Axes in the parent's frame: about which the swing grows, about which the twist does.
    let twist_axis = local * DVec3::Y * twist_sign;
    let swing_axis = limit.centre * DVec3::new(x, 0.0, z);
    let swing_axis = swing_axis - twist_axis * swing_axis.dot(twist_axis);
    let swing_axis = swing_axis.try_normalize().unwrap_or_else(|| twist_axis.any_orthonormal_vector());
    let axes = DMat3::from_cols(swing_axis, twist_axis, swing_axis.cross(twist_axis));
    let frame = DQuat::from_mat3(&axes).normalize();

    // Turn from wanted to present, in the parent's axes, then in the rows'.
    let error = frame.conjugate() * log(local * drive.rotation.conjugate());
    let velocity = frame.conjugate() * (local * drive.velocity);
    let row = |error: f64, velocity: f64| Row { stiffness: drive.stiffness, damping: drive.damping, error, velocity };
    let rows = [
        row(error.x, velocity.x).with_limit(spring, swing_violation),
        row(error.y, velocity.y).with_limit(spring, twist_violation),
        row(error.z, velocity.z),
    ];
    // With both frames equal now, the solver sees no angle at the step's start, and each row's target is its error.
    joint.local_frame1.rotation = frame;
    joint.local_frame2.rotation = (local.conjugate() * frame).normalize();
    for (axis, row) in [JointAxis::AngX, JointAxis::AngY, JointAxis::AngZ].into_iter().zip(rows) {
        set(joint, axis, -row.error, row);
    }
}

/// Writes a hinge's row, about X of both frames.
pub(crate) fn write_hinge(joint: &mut GenericJoint, limit: &Limit, spring: &LimitSpring, drive: &Drive, local: DQuat) {
    let angle_of = |rotation: DQuat| 2.0 * libm::atan2(rotation.x, rotation.w);
    let wrap = |angle: f64| {
        let turns = libm::round(angle / std::f64::consts::TAU);
        angle - turns * std::f64::consts::TAU
    };
    let centre = angle_of(limit.centre);
    let angle = wrap(angle_of(local) - centre);
    let high = angle - limit.swing.x_positive;
    let low = -limit.swing.x_negative - angle;
    let wanted = wrap(angle_of(drive.rotation) - centre);
    let row =
        Row { stiffness: drive.stiffness, damping: drive.damping, error: angle - wanted, velocity: drive.velocity.x };
    let row = if high > 0.0 {
        row.with_limit(spring, high)
    } else if low > 0.0 {
        let mirrored = Row { error: -row.error, velocity: -row.velocity, ..row }.with_limit(spring, low);
        Row { error: -mirrored.error, velocity: -mirrored.velocity, ..mirrored }
    } else {
        row
    };
    // The solver measures the angle from equal frames.
    set(joint, JointAxis::AngX, angle_of(local) - row.error, row);
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
