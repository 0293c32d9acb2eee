//! Where a body goes whose key poses say angles and no place: the foot that stands stays where it is.

use glam::DVec3;
use sinew_body::humanoid::{Body, Node, Pose};

/// The feet of the wanted pose a step ago, against the hips.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct FootLock {
    feet: Option<[DVec3; 2]>,
}

/// A foot so much higher than the other does not stand \[m\].
const LIFTED_M: f64 = 0.04;

impl FootLock {
    /// How far the hips go over the ground, so that the standing foot of this pose is where it was in the last.
    pub fn step(&mut self, body: &Body, pose: &Pose) -> DVec3 {
        let places = pose.positions(body);
        let feet = [Node::LeftFoot, Node::RightFoot].map(|foot| places[foot.index()] - pose.hips_position);
        let Some(before) = self.feet.replace(feet) else { return DVec3::ZERO };
        let lowest = feet[0].y.min(feet[1].y);
        let weights = feet.map(|foot| (1.0 - (foot.y - lowest) / LIFTED_M).max(0.0));
        let back = (before[0] - feet[0]) * weights[0] + (before[1] - feet[1]) * weights[1];
        DVec3::new(back.x, 0.0, back.z) / (weights[0] + weights[1])
    }

    /// The next pose begins anew.
    pub fn forget(&mut self) {
        self.feet = None;
    }
}
