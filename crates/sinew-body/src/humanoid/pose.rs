//! A pose of the 18 bodies.

use super::{Body, Node};
use glam::{DQuat, DVec3};

/// Where every body is: the hips' position and all world orientations.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pose {
    /// The hips' origin in the world \[m\].
    pub hips_position: DVec3,
    /// `world_from_node` of the anatomical frames, by [`Node::index`].
    pub world: [DQuat; Node::COUNT],
}

impl Pose {
    /// Standing upright, arms hanging, facing +Z, hips at the origin.
    pub const STANDING: Pose = Pose { hips_position: DVec3::ZERO, world: [DQuat::IDENTITY; Node::COUNT] };

    /// `parent_from_node` of a node; for the hips `world_from_hips`.
    pub fn local(&self, node: Node) -> DQuat {
        match node.parent() {
            Some(parent) => self.world[parent.index()].conjugate() * self.world[node.index()],
            None => self.world[node.index()],
        }
    }

    /// The pose with these `parent_from_node` rotations (the hips': `world_from_hips`).
    pub fn from_locals(hips_position: DVec3, locals: &[DQuat; Node::COUNT]) -> Pose {
        let mut world = *locals;
        for node in Node::ALL {
            if let Some(parent) = node.parent() {
                world[node.index()] = (world[parent.index()] * locals[node.index()]).normalize();
            }
        }
        Pose { hips_position, world }
    }

    /// Where every node's joint is in the world \[m\].
    pub fn positions(&self, body: &Body) -> [DVec3; Node::COUNT] {
        let mut positions = [self.hips_position; Node::COUNT];
        for node in Node::ALL {
            if let Some(parent) = node.parent() {
                let offset = body.link(node).offset;
                positions[node.index()] = positions[parent.index()] + self.world[parent.index()] * offset;
            }
        }
        positions
    }

    /// Whether every number is finite.
    pub fn is_finite(&self) -> bool {
        self.hips_position.is_finite() && self.world.iter().all(|rotation| rotation.is_finite())
    }
}
