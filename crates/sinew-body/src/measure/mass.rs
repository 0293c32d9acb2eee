//! The centre of mass by shares that no method here computes with.

use crate::humanoid::{Body, Node, Pose};
use glam::DVec3;

/// Share of the body's mass, and where along the segment its centre lies, from the first point to the second: D. A. Winter,
/// *Biomechanics and Motor Control of Human Movement*, table 4.1. Head and neck are a segment from the neck's joint to the head's
/// end, the trunk one from the hips' joints' middle to the neck's joint.
const LIMBS: [(Node, f64, f64); 12] = [
    (Node::LeftUpperArm, 0.028, 0.436),
    (Node::RightUpperArm, 0.028, 0.436),
    (Node::LeftLowerArm, 0.016, 0.430),
    (Node::RightLowerArm, 0.016, 0.430),
    (Node::LeftHand, 0.006, 0.506),
    (Node::RightHand, 0.006, 0.506),
    (Node::LeftUpperLeg, 0.100, 0.433),
    (Node::RightUpperLeg, 0.100, 0.433),
    (Node::LeftLowerLeg, 0.0465, 0.433),
    (Node::RightLowerLeg, 0.0465, 0.433),
    (Node::LeftFoot, 0.0145, 0.5),
    (Node::RightFoot, 0.0145, 0.5),
];
const HEAD_AND_NECK: f64 = 0.081;
const TRUNK: f64 = 0.497;

/// The centre of mass of a pose \[m\] by Winter's shares of the body's mass.
///
/// ```
/// use sinew_body::humanoid::{Body, Pose};
/// let body = Body::standard(80.0, 1.7);
/// let gap = sinew_body::measure::centre_of_mass(&body, &Pose::STANDING) - body.centre_of_mass(&Pose::STANDING);
/// assert!(gap.length() < 0.05, "two tables agree within some centimetres");
/// ```
pub fn centre_of_mass(body: &Body, pose: &Pose) -> DVec3 {
    let joints = pose.positions(body);
    let at = |node: Node| joints[node.index()];
    let end = |node: Node| at(node) + pose.world[node.index()] * body.link(node).tip;
    let limbs: DVec3 = LIMBS.iter().map(|&(node, share, along)| at(node).lerp(end(node), along) * share).sum();
    let hips = (at(Node::LeftUpperLeg) + at(Node::RightUpperLeg)) * 0.5;
    limbs + (at(Node::Neck) + end(Node::Head)) * (0.5 * HEAD_AND_NECK) + (hips + at(Node::Neck)) * (0.5 * TRUNK)
}
