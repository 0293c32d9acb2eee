//! Segment masses, centres and radii of gyration of an adult, and the proportions of a body without a skeleton.
//!
//! Masses, centres and radii: P. de Leva, *Adjustments to Zatsiorsky-Seluyanov's segment inertia parameters*, Journal
//! of Biomechanics 29 (1996), table 4, men. The trunk's middle and upper parts are one body here, two hundredths of
//! the body's mass go to the shoulders, and a fifth of head-and-neck is the neck. Proportions: the tree of
//! `vectors/humanoid42_random.json`, a 1.70 m body.

use super::Node;
use glam::DVec3;

/// Inertial properties of one segment, relative to the body's mass and the segment's own length.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Segment {
    /// Of the body's mass \[1\].
    pub mass: f64,
    /// Centre of mass along the segment, from its own joint \[1 of the length\].
    pub centre: f64,
    /// Radii of gyration about X (transverse), Y (longitudinal), Z (sagittal) through the centre \[1 of the length\].
    pub gyration: [f64; 3],
}

/// The segment of a node.
pub(super) fn segment(node: Node) -> Segment {
    let (mass, centre, gyration) = match node {
        Node::Hips => (0.1117, 0.0, [0.551, 0.587, 0.615]),
        // Upper and middle trunk together; radii of the pair about their common centre.
        Node::Chest => (0.3029, 0.48, [0.246, 0.278, 0.294]),
        Node::Neck => (0.0140, 0.50, [0.304, 0.202, 0.304]),
        Node::Head => (0.0554, 0.50, [0.315, 0.261, 0.303]),
        Node::LeftShoulder | Node::RightShoulder => (0.0100, 0.60, [0.159, 0.295, 0.286]),
        Node::LeftUpperArm | Node::RightUpperArm => (0.0271, 0.5772, [0.269, 0.158, 0.285]),
        Node::LeftLowerArm | Node::RightLowerArm => (0.0162, 0.4574, [0.265, 0.121, 0.276]),
        Node::LeftHand | Node::RightHand => (0.0061, 0.50, [0.30, 0.22, 0.34]),
        Node::LeftUpperLeg | Node::RightUpperLeg => (0.1416, 0.4095, [0.329, 0.149, 0.329]),
        Node::LeftLowerLeg | Node::RightLowerLeg => (0.0433, 0.4459, [0.249, 0.103, 0.255]),
        Node::LeftFoot | Node::RightFoot => (0.0137, 0.40, [0.245, 0.257, 0.124]),
    };
    Segment { mass, centre, gyration }
}

/// Stature of the body whose proportions [`standard_offset`] and [`standard_tip`] give \[m\].
pub(super) const STANDARD_STATURE_M: f64 = 1.70;

/// From the parent's joint to the node's own in a 1.70 m body, in the parent's frame \[m\].
pub(super) fn standard_offset(node: Node) -> DVec3 {
    let side = if node.is_right() { -1.0 } else { 1.0 };
    let (x, y, z) = match node {
        Node::Hips => (0.0, 0.0, 0.0),
        Node::Chest => (0.0, 0.111, 0.0),
        Node::Neck => (0.0, 0.224, 0.0),
        Node::Head => (0.0, 0.094, 0.0),
        Node::LeftShoulder | Node::RightShoulder => (0.025, 0.194, 0.0),
        Node::LeftUpperArm | Node::RightUpperArm => (0.163, 0.0, 0.0),
        Node::LeftLowerArm | Node::RightLowerArm => (0.0, -0.286, 0.0),
        Node::LeftHand | Node::RightHand => (0.0, -0.254, 0.0),
        Node::LeftUpperLeg | Node::RightUpperLeg => (0.092, -0.104, 0.0),
        Node::LeftLowerLeg | Node::RightLowerLeg => (0.0, -0.412, 0.0),
        Node::LeftFoot | Node::RightFoot => (0.0, -0.436, 0.0),
    };
    DVec3::new(side * x, y, z)
}

/// From the node's joint to the end of its segment in a 1.70 m body, in the node's frame \[m\].
pub(super) fn standard_tip(node: Node) -> DVec3 {
    let side = if node.is_right() { -1.0 } else { 1.0 };
    let (x, y, z) = match node {
        Node::Hips => (0.0, 0.111, 0.0),
        Node::Chest => (0.0, 0.224, 0.0),
        Node::Neck => (0.0, 0.094, 0.0),
        Node::Head => (0.0, 0.200, 0.015),
        Node::LeftShoulder | Node::RightShoulder => (0.163, 0.0, 0.0),
        Node::LeftUpperArm | Node::RightUpperArm => (0.0, -0.286, 0.0),
        Node::LeftLowerArm | Node::RightLowerArm => (0.0, -0.254, 0.0),
        Node::LeftHand | Node::RightHand => (0.0, -0.187, 0.0),
        Node::LeftUpperLeg | Node::RightUpperLeg => (0.0, -0.412, 0.0),
        Node::LeftLowerLeg | Node::RightLowerLeg => (0.0, -0.436, 0.0),
        Node::LeftFoot | Node::RightFoot => (0.0, -0.060, 0.170),
    };
    DVec3::new(side * x, y, z)
}

/// Half the breadth of a segment in a 1.70 m, 80 kg body: the radius of its capsule at its start and its end \[m\].
pub(super) fn standard_radii(node: Node) -> (f64, f64) {
    match node {
        Node::Hips => (0.105, 0.105),
        Node::Chest => (0.115, 0.125),
        Node::Neck => (0.055, 0.055),
        Node::Head => (0.085, 0.095),
        Node::LeftShoulder | Node::RightShoulder => (0.060, 0.060),
        Node::LeftUpperArm | Node::RightUpperArm => (0.052, 0.042),
        Node::LeftLowerArm | Node::RightLowerArm => (0.042, 0.030),
        Node::LeftHand | Node::RightHand => (0.032, 0.026),
        Node::LeftUpperLeg | Node::RightUpperLeg => (0.080, 0.056),
        Node::LeftLowerLeg | Node::RightLowerLeg => (0.056, 0.040),
        Node::LeftFoot | Node::RightFoot => (0.040, 0.030),
    }
}
