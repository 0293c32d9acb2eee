//! From where a body is to where it is wanted, without a jump.

use super::ramp::smooth;
use glam::{DQuat, DVec3};
use sinew_body::humanoid::{Node, Pose, exp, log};

/// What lies between the pose that a body has and the one that is wanted, and dies out: added to the wanted pose, it begins where
/// the body is and ends where it is wanted, however that moves meanwhile.
#[derive(Clone, Debug)]
pub(super) struct Slide {
    shift: DVec3,
    /// How fast the shift grows at first \[m/s\].
    drift: DVec3,
    /// World axes \[rad\].
    turn: DVec3,
    /// Of each joint, in the node's frame \[rad\].
    bends: [DVec3; Node::COUNT],
    gone_secs: f64,
    over_secs: f64,
}

/// A drift dies out within this time \[s\]: a body that falls at 4 m/s is caught over 0.2 m, with six times its weight.
const DRIFT_SECS: f64 = 0.4;

impl Slide {
    /// From one pose to another, with the velocity of one's hips against the other's \[m/s\].
    pub(super) fn between(from: &Pose, to: &Pose, drift: DVec3, over_secs: f64) -> Slide {
        let mut bends = [DVec3::ZERO; Node::COUNT];
        for node in Node::ALL.into_iter().skip(1) {
            bends[node.index()] = log((to.local(node).conjugate() * from.local(node)).normalize());
        }
        Slide {
            shift: from.hips_position - to.hips_position,
            drift,
            turn: log((from.world[0] * to.world[0].conjugate()).normalize()),
            bends,
            gone_secs: 0.0,
            over_secs,
        }
    }

    pub(super) fn advance(&mut self, step_secs: f64) {
        self.gone_secs += step_secs;
    }

    pub(super) fn is_over(&self) -> bool {
        self.gone_secs >= self.over_secs
    }

    /// The wanted pose with what is left of the way.
    pub(super) fn added_to(&self, pose: &Pose) -> Pose {
        let left = 1.0 - smooth(self.gone_secs / self.over_secs.max(1e-9));
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
