//! The effect of a push on the hips and the legs (section 4.3).
//!
//! EQ7 as printed divides a moment by a mass and drifts for ever. Here the push accelerates the whole body by its mass
//! and its inertia about the hips, and the held feet pull the hips back: an implicit, critically damped return. The
//! shown deviation saturates smoothly and is limited by the legs: feet stay where the input has them, so the hips sink
//! and stay within reach of both ankles.

use crate::force::PointForce;
use glam::{DQuat, DVec3};
use sinew_body::humanoid::{Body, LEGS, LegPose, Pose, exp, shift_within_reach, solve_leg};
use sinew_snapshot::snapshot;

/// Frequency of the return \[rad/s\].
const RETURN: f64 = 5.0;

/// Saturation of the shown shift \[m for a 1.7 m body\].
const MAX_SHIFT_M: f64 = 0.05;

/// Saturation of the shown rotation \[rad\]: 15 degrees. Whole-body yaw inertia is only about 1 kg m², so that an
/// unsaturated 400 N on a hand would turn the hips by half a right angle.
const MAX_TURN: f64 = 15.0 * std::f64::consts::PI / 180.0;

/// Bisections to find the largest deviation that the legs' joints allow: to a thousandth.
const LIMIT_HALVINGS: usize = 10;

/// The hips' deviation from the input.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct HipsState {
    shift: DVec3,
    velocity: DVec3,
    turn: DVec3,
    spin: DVec3,
}

/// The shown part of it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct HipsDeviation {
    /// \[m\], world.
    pub shift: DVec3,
    /// Rotation vector \[rad\], world.
    pub turn: DVec3,
}

snapshot!(HipsState { shift, velocity, turn, spin });
snapshot!(HipsDeviation { shift, turn });

impl HipsState {
    /// Advances by a time step under forces that act on `pose`.
    pub(crate) fn advance(&mut self, body: &Body, pose: &Pose, forces: &[PointForce], time_step_secs: f64) {
        let (mut acceleration, mut gain) = (DVec3::ZERO, DVec3::ZERO);
        if !forces.is_empty() {
            let positions = pose.positions(body);
            let (mut force, mut moment) = (DVec3::ZERO, DVec3::ZERO);
            for push in forces.iter().map(PointForce::tamed) {
                let at = push.node.index();
                let point = push.point.unwrap_or(body.link(push.node).centre);
                let arm = positions[at] + pose.world[at] * point - pose.hips_position;
                force += push.force_n;
                moment += arm.cross(push.force_n);
            }
            acceleration = force / body.mass_kg();
            gain = body.inertia_about(pose, pose.hips_position).inverse() * moment;
        }
        let dt = time_step_secs;
        let implicit = 1.0 / (1.0 + 2.0 * RETURN * dt + RETURN * RETURN * dt * dt);
        self.velocity = (self.velocity + (acceleration - self.shift * (RETURN * RETURN)) * dt) * implicit;
        self.spin = (self.spin + (gain - self.turn * (RETURN * RETURN)) * dt) * implicit;
        self.shift += self.velocity * dt;
        self.turn += self.spin * dt;
        // An invisibly small deviation is set to zero, so that a body at rest is exactly the input.
        if self.shift.length() < 1e-9 && self.velocity.length() < 1e-9 {
            (self.shift, self.velocity) = (DVec3::ZERO, DVec3::ZERO);
        }
        if self.turn.length() < 1e-9 && self.spin.length() < 1e-9 {
            (self.turn, self.spin) = (DVec3::ZERO, DVec3::ZERO);
        }
    }

    /// Whether the hips deviate from the input.
    pub(crate) fn departs(&self) -> bool {
        self.shift != DVec3::ZERO || self.turn != DVec3::ZERO
    }

    /// The deviation applied to the input's pose: saturated, and within reach of the input's ankles.
    pub(crate) fn shown(&self, body: &Body, input: &Pose) -> HipsDeviation {
        if !self.departs() {
            return HipsDeviation::default();
        }
        let saturated = |vector: DVec3, limit: f64| {
            let length = vector.length();
            if length == 0.0 { vector } else { vector * (limit * libm::tanh(length / limit) / length) }
        };
        let whole = HipsDeviation {
            turn: saturated(self.turn, MAX_TURN),
            shift: saturated(self.shift, MAX_SHIFT_M * body.stature_m() / 1.7),
        };
        let legs = Legs::of(body, input);
        let mut shown = legs.reached(whole);
        if legs.are_within_limits(body, input, &shown) {
            return shown;
        }
        // The input's own legs are within their limits, so a part of the deviation is too.
        let (mut inside, mut outside) = (0.0, 1.0);
        for _ in 0..LIMIT_HALVINGS {
            let middle = 0.5 * (inside + outside);
            let part = legs.reached(HipsDeviation { turn: whole.turn * middle, shift: whole.shift * middle });
            if legs.are_within_limits(body, input, &part) { inside = middle } else { outside = middle }
        }
        shown = legs.reached(HipsDeviation { turn: whole.turn * inside, shift: whole.shift * inside });
        shown
    }
}

/// The input's legs, which bound the hips' deviation.
struct Legs {
    hips: DVec3,
    legs: [LegPose; 2],
}

impl Legs {
    fn of(body: &Body, input: &Pose) -> Legs {
        let positions = input.positions(body);
        let legs = LEGS.map(|(upper, lower, foot)| {
            let [hip, knee, ankle] = [upper, lower, foot].map(|node| positions[node.index()]);
            LegPose { hip, knee, ankle, knee_axis: input.world[lower.index()] * DVec3::X }
        });
        Legs { hips: positions[0], legs }
    }

    /// Positions of both hip joints for rotated hips \[m\].
    fn carried(&self, turn: DQuat) -> [DVec3; 2] {
        self.legs.map(|leg| self.hips + turn * (leg.hip - self.hips))
    }

    /// The deviation with its shift limited to the reach of both ankles.
    fn reached(&self, wanted: HipsDeviation) -> HipsDeviation {
        let shift = shift_within_reach(&self.legs, self.carried(exp(wanted.turn)), wanted.shift);
        HipsDeviation { shift, ..wanted }
    }

    /// Whether hip, knee and ankle joints are within their limits with the feet where the input has them.
    fn are_within_limits(&self, body: &Body, input: &Pose, shown: &HipsDeviation) -> bool {
        let turn = exp(shown.turn);
        let hips = turn * input.world[0];
        self.legs.iter().zip(self.carried(turn)).zip(LEGS).all(|((leg, hip), (upper, lower, foot))| {
            let (thigh_turn, shank_turn) = solve_leg(leg, hip + shown.shift, leg.ankle);
            let thigh = thigh_turn * input.world[upper.index()];
            let shank = shank_turn * input.world[lower.index()];
            body.link(upper).limit.contains(hips.conjugate() * thigh)
                && body.link(lower).limit.contains(thigh.conjugate() * shank)
                && body.link(foot).limit.contains(shank.conjugate() * input.world[foot.index()])
        })
    }
}
