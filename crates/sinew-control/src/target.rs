//! The wanted pose, with how firmly each joint is to hold it.

use glam::{DQuat, DVec3};
use sinew_body::humanoid::Node;

/// What one joint is to do.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct JointTarget {
    /// Wanted `parent_from_node`.
    pub rotation: DQuat,
    /// Wanted angular velocity against the parent, in the node's frame \[rad/s\].
    pub velocity: DVec3,
    /// Factor on the joint's own stiffness, the pose's gain k_sp (Shapiro et al. 2007, EQ3); 0 leaves it limp.
    pub gain: f64,
    /// Factor on the joint's own damping.
    pub damping: f64,
    /// Torque on the node against its parent on top, in world axes \[N m\].
    pub torque: DVec3,
}

/// What the whole body is to do: the wanted pose of a key pose, a clip or a performer.
#[derive(Clone, Debug, PartialEq)]
pub struct Target {
    /// By [`Node::index`]; the hips' entry is unused.
    pub joints: [JointTarget; Node::COUNT],
    /// Where the hips are to be, for sources that know: position \[m\] and `world_from_hips`.
    pub root: Option<(DVec3, DQuat)>,
}

impl JointTarget {
    /// Straight, with the joint's own gains.
    pub const REST: JointTarget =
        JointTarget { rotation: DQuat::IDENTITY, velocity: DVec3::ZERO, gain: 1.0, damping: 1.0, torque: DVec3::ZERO };
}

impl Target {
    /// Standing, arms hanging.
    pub const STANDING: Target = Target { joints: [JointTarget::REST; Node::COUNT], root: None };

    /// One joint.
    pub fn joint(&self, node: Node) -> &JointTarget {
        &self.joints[node.index()]
    }

    /// One joint, to change it.
    pub fn joint_mut(&mut self, node: Node) -> &mut JointTarget {
        &mut self.joints[node.index()]
    }
}
