//! The effect of a push on the hips and the legs (section 4.3).
//!
//! EQ7 as printed divides a moment by a mass and drifts for ever. Here the push accelerates the whole body by its mass
//! and its inertia about the hips, and the held feet pull the hips back: an implicit, critically damped return. The
//! shown deviation saturates smoothly and is what the legs allow: feet stay where the input has them, so the hips go round
//! them ([`HipsDeviation::held_by`]).

use crate::force::PointForce;
use glam::DVec3;
use sinew_body::humanoid::{Body, HipsDeviation, Pose};
use sinew_snapshot::snapshot;

/// Frequency of the return \[rad/s\].
const RETURN: f64 = 5.0;

/// Saturation of the shown shift \[m for a 1.7 m body\].
const MAX_SHIFT_M: f64 = 0.036;

/// Saturation of the shown rotation \[rad\]: 15 degrees. Whole-body yaw inertia is only about 1 kg m², so that an
/// unsaturated 400 N on a hand would turn the hips by half a right angle.
const MAX_TURN: f64 = 15.0 * std::f64::consts::PI / 180.0;

/// The hips' deviation from the input.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct HipsState {
    shift: DVec3,
    velocity: DVec3,
    turn: DVec3,
    spin: DVec3,
}

snapshot!(HipsState { shift, velocity, turn, spin });

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

    /// The deviation applied to the input's pose: saturated, and as far as the input's legs allow.
    pub(crate) fn shown(&self, body: &Body, input: &Pose) -> HipsDeviation {
        let saturated = |vector: DVec3, limit: f64| {
            let length = vector.length();
            if length == 0.0 { vector } else { vector * (limit * libm::tanh(length / limit) / length) }
        };
        let whole = HipsDeviation {
            turn: saturated(self.turn, MAX_TURN),
            shift: saturated(self.shift, MAX_SHIFT_M * body.stature_m() / 1.7),
        };
        if whole.is_none() { whole } else { whole.held_by(&input.legs(body), input.hips_position) }
    }
}
