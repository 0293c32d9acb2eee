//! From where a body is to where it is wanted, without a jump.

use super::ramp::smooth;
use glam::{DQuat, DVec3};
use sinew_body::humanoid::{Body, Node, Pose, exp, log};
use sinew_world::hips_over_soles_m;

/// What lies between the pose that a body has and the one that is wanted, and dies out: added to the wanted pose, it begins where
/// the body is and ends where it is wanted, however that moves meanwhile.
#[derive(Clone, Debug, Default)]
pub(super) struct InertialBlend {
    shift: DVec3,
    /// How fast the shift grows at first \[m/s\].
    drift: DVec3,
    /// World axes \[rad\].
    turn: DVec3,
    /// Of each joint, in the node's frame \[rad\].
    bends: [DVec3; Node::COUNT],
    /// Height of the lower sole at the start \[m\].
    sole_m: f64,
    lift_m: f64,
    gone_secs: f64,
    over_secs: f64,
}

/// A drift dies out within this time \[s\]: a body that falls at 4 m/s is caught over 0.2 m, with six times its weight.
const DRIFT_SECS: f64 = 0.4;

/// A body is moved no faster than this; a longer way takes longer \[m/s\].
const MAX_M_S: f64 = 2.0;

/// The steepest slope of what fades.
const STEEPEST: f64 = 1.875;

/// A body is lifted off the floor this smoothly \[s\].
const LIFT_SECS: f64 = 0.03;

sinew_snapshot::snapshot!(InertialBlend { shift, drift, turn, bends, sole_m, lift_m, gone_secs, over_secs });

impl InertialBlend {
    /// From one pose to another, with the velocity of one's hips against the other's \[m/s\].
    pub(super) fn between(body: &Body, from: &Pose, to: &Pose, drift: DVec3, over_secs: f64) -> InertialBlend {
        let mut bends = [DVec3::ZERO; Node::COUNT];
        for node in Node::ALL.into_iter().skip(1) {
            bends[node.index()] = log((to.local(node).conjugate() * from.local(node)).normalize());
        }
        let shift = from.hips_position - to.hips_position;
        let turn = log((from.world[0] * to.world[0].conjugate()).normalize());
        // Head and feet go about as far as the body turns, times its half.
        let way_m = shift.length() + turn.length() * body.stature_m() / 2.0;
        let over_secs = over_secs.max(STEEPEST * way_m / MAX_M_S);
        InertialBlend { shift, drift, turn, bends, sole_m: sole_m(body, from), lift_m: 0.0, gone_secs: 0.0, over_secs }
    }

    /// A step goes by; the wanted pose with what is left of the way at its end.
    pub(super) fn step(&mut self, body: &Body, pose: &Pose, step_secs: f64) -> Pose {
        self.gone_secs += step_secs;
        let mut added = self.added_to(pose);
        // Half way up from lying, straight legs reach below the floor. Which point of the soles is lowest changes at once; how far
        // the body is lifted does not.
        let lowest = self.sole_m.min(sole_m(body, pose));
        let lift_m = (lowest - sole_m(body, &added)).max(0.0);
        self.lift_m += (lift_m - self.lift_m) * (step_secs / LIFT_SECS).min(1.0);
        added.hips_position.y += self.lift_m * (1.0 - self.progress());
        added
    }

    /// How far it has come, 0 to 1.
    pub(super) fn progress(&self) -> f64 {
        smooth(self.gone_secs / self.over_secs.max(1e-9))
    }

    pub(super) fn is_over(&self) -> bool {
        self.gone_secs >= self.over_secs
    }

    fn added_to(&self, pose: &Pose) -> Pose {
        let left = 1.0 - self.progress();
        let drift_secs = self.over_secs.min(DRIFT_SECS);
        let drifting = (1.0 - self.gone_secs / drift_secs.max(1e-9)).max(0.0);
        let mut locals = [DQuat::IDENTITY; Node::COUNT];
        locals[0] = (exp(self.turn * left) * pose.world[0]).normalize();
        for node in Node::ALL.into_iter().skip(1) {
            locals[node.index()] = (pose.local(node) * exp(self.bends[node.index()] * left)).normalize();
        }
        let shift = self.shift * left + self.drift * (self.gone_secs * drifting * drifting);
        Pose::from_locals(pose.hips_position + shift, &locals)
    }
}

/// Height of the lowest point of the soles \[m\].
pub(super) fn sole_m(body: &Body, pose: &Pose) -> f64 {
    pose.hips_position.y - hips_over_soles_m(body, pose)
}
