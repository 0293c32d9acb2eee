//! Positions of a body's parts in a pose.

use glam::{DQuat, DVec3};
use sinew_body::humanoid::{Body, Node, Pose, log};

/// A pose at one instant, as the pins need it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Instant {
    pub joints: [DVec3; Node::COUNT],
    pub centres: [DVec3; Node::COUNT],
    pub rotations: [DQuat; Node::COUNT],
}

sinew_snapshot::snapshot!(Instant { joints, centres, rotations });

impl Instant {
    pub(crate) fn of(body: &Body, pose: &Pose) -> Instant {
        let joints = pose.positions(body);
        let centre = |node: Node| joints[node.index()] + pose.world[node.index()] * body.link(node).centre;
        Instant { joints, centres: Node::ALL.map(centre), rotations: pose.world }
    }

    /// The rotation of a part from this instant to another, world \[rad\].
    pub(crate) fn turn(&self, to: &Instant, at: usize) -> DVec3 {
        log(to.rotations[at] * self.rotations[at].conjugate())
    }
}
