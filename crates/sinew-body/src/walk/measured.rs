//! The mean walk's measured angles as turns of nodes, and the left leg that they make.

use super::series::{Series, Waves};
use super::skeleton::WalkSkeleton;
use super::walk_table::MEAN_WALK_DEG;
use crate::humanoid::{Node, exp};
use glam::{DQuat, DVec3};

/// The measured left leg from the hips' origin, axes of the world.
pub(super) struct MeasuredLeg {
    pub thigh: DQuat,
    pub shank: DQuat,
    pub foot: DQuat,
    pub hip: DVec3,
    pub knee: DVec3,
    pub ankle: DVec3,
}

/// The mirror image of a turn, left for right.
pub(super) fn mirrored(rotation: DQuat) -> DQuat {
    DQuat::from_xyzw(rotation.x, -rotation.y, -rotation.z, rotation.w)
}

/// How much a node's swing grows with the stride. A longer stride opens the hips and swings the arms; knees and ankles must
/// clear the floor in any stride and change half as much.
fn node_gain(node: Node, gain: f64) -> f64 {
    match node {
        Node::LeftLowerLeg | Node::LeftFoot => 0.5 + 0.5 * gain,
        Node::Neck | Node::Head | Node::LeftShoulder | Node::LeftHand => 1.0,
        _ => gain,
    }
}

/// The node's row in the table.
fn row(node: Node) -> &'static [Series; 3] {
    let at = match node {
        Node::LeftUpperLeg => 8,
        Node::LeftLowerLeg => 9,
        Node::LeftFoot => 10,
        other => other.index().min(7),
    };
    &MEAN_WALK_DEG[at]
}

/// `parent_from_node` of a midline or left node.
pub(super) fn measured(node: Node, waves: &Waves, gain: f64) -> DQuat {
    let gain = node_gain(node, gain);
    exp(DVec3::from_array(row(node).each_ref().map(|series| waves.value(series, gain).to_radians())))
}

/// The left leg at a phase, as measured.
pub(super) fn measured_leg(skeleton: &WalkSkeleton, phase: f64, gain: f64) -> MeasuredLeg {
    let waves = Waves::at(phase);
    let hips = measured(Node::Hips, &waves, gain);
    let thigh = hips * measured(Node::LeftUpperLeg, &waves, gain);
    let shank = thigh * measured(Node::LeftLowerLeg, &waves, gain);
    let foot = shank * measured(Node::LeftFoot, &waves, gain);
    let offset = |node: Node| skeleton.body.link(node).offset;
    let hip = hips * offset(Node::LeftUpperLeg);
    let knee = hip + thigh * offset(Node::LeftLowerLeg);
    MeasuredLeg { thigh, shank, foot, hip, knee, ankle: knee + shank * offset(Node::LeftFoot) }
}
