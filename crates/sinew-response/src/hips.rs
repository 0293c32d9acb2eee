//! What a push does to the hips and the legs (section 4.3).
//!
//! EQ7 as printed divides a moment by a mass and drifts for ever. Here the push accelerates the whole body by its mass and
//! its inertia about the hips, and feet that hold pull the hips back: an implicit, critically damped return. What is
//! shown of it saturates smoothly, and gives way to the legs: a foot that the input has on the ground stays there, so the
//! hips sink and stay within reach of both ankles.

use crate::force::PointForce;
use glam::DVec3;
use sinew_body::humanoid::{Body, Node, Pose, exp};

/// Frequency of the return \[rad/s\].
const RETURN: f64 = 5.0;

/// Where the shown shift saturates \[m for a 1.7 m body\].
const LARGEST_SHIFT_M: f64 = 0.05;

/// Where the shown turn saturates \[rad\]: 15 degrees. Whole-body yaw inertia is only about 1 kg m², so that an unsaturated
/// 400 N on a hand would turn the hips by half a right angle.
const LARGEST_TURN: f64 = 15.0 * std::f64::consts::PI / 180.0;

/// Sweeps over the two legs; each is a projection onto a ball, and two balls that meet need few.
const SWEEPS: usize = 16;

/// How straight a leg may get \[1 of its length\] unless the input's is straighter: knees do not snap.
const STRAIGHTEST: f64 = 0.9995;

/// The hips' departure from the input.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct HipsState {
    shift: DVec3,
    velocity: DVec3,
    turn: DVec3,
    spin: DVec3,
}

/// What is shown of it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct HipsDeviation {
    /// \[m\], world.
    pub shift: DVec3,
    /// Rotation vector \[rad\], world.
    pub turn: DVec3,
}

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
        // What nobody sees any more is forgotten, so that a body at rest is exactly the input.
        if self.shift.length() < 1e-9 && self.velocity.length() < 1e-9 {
            (self.shift, self.velocity) = (DVec3::ZERO, DVec3::ZERO);
        }
        if self.turn.length() < 1e-9 && self.spin.length() < 1e-9 {
            (self.turn, self.spin) = (DVec3::ZERO, DVec3::ZERO);
        }
    }

    /// What is shown on the input's pose: saturated, and within reach of the input's ankles.
    pub(crate) fn shown(&self, body: &Body, input: &Pose) -> HipsDeviation {
        if self.shift == DVec3::ZERO && self.turn == DVec3::ZERO {
            return HipsDeviation::default();
        }
        let saturated = |vector: DVec3, limit: f64| {
            let length = vector.length();
            if length == 0.0 { vector } else { vector * (limit * libm::tanh(length / limit) / length) }
        };
        let turn = saturated(self.turn, LARGEST_TURN);
        let mut shift = saturated(self.shift, LARGEST_SHIFT_M * body.stature_m() / 1.7);
        let positions = input.positions(body);
        let turned = exp(turn);
        let legs = [
            (Node::LeftUpperLeg, Node::LeftLowerLeg, Node::LeftFoot),
            (Node::RightUpperLeg, Node::RightLowerLeg, Node::RightFoot),
        ]
        .map(|(upper, lower, foot)| {
            let [hip, knee, ankle] = [upper, lower, foot].map(|node| positions[node.index()]);
            let length = (knee - hip).length() + (ankle - knee).length();
            let reach = (length * STRAIGHTEST).max((ankle - hip).length());
            (positions[0] + turned * (hip - positions[0]) - ankle, reach)
        });
        for _ in 0..SWEEPS {
            let mut moved = false;
            for (from_ankle, reach) in legs {
                let line = from_ankle + shift;
                let length = line.length();
                if length > reach {
                    shift -= line * (1.0 - reach / length);
                    moved = true;
                }
            }
            if !moved {
                break;
            }
        }
        HipsDeviation { shift, turn }
    }
}
