//! Conversion between VRM parts, whose zero pose is the T-pose, and our nodes, whose zero pose has hanging arms.

use glam::{DQuat, DVec3};
use sinew_body::humanoid::{Node, Pose};
use sinew_motion::Part;
use std::f64::consts::FRAC_1_SQRT_2;

/// The T-pose: standing, arms to the sides, palms down.
pub struct TPose;

impl TPose {
    /// `part_from_node`: how a node's frame stands in the frame of its part. In the T-pose all frames of the parts are parallel
    /// to the space, and a hanging arm is turned by a right angle about the forward axis to get there.
    pub const fn part_from_node(node: Node) -> DQuat {
        match node {
            Node::LeftUpperArm | Node::LeftLowerArm | Node::LeftHand => {
                DQuat::from_xyzw(0.0, 0.0, FRAC_1_SQRT_2, FRAC_1_SQRT_2)
            }
            Node::RightUpperArm | Node::RightLowerArm | Node::RightHand => {
                DQuat::from_xyzw(0.0, 0.0, -FRAC_1_SQRT_2, FRAC_1_SQRT_2)
            }
            _ => DQuat::IDENTITY,
        }
    }
}

/// The part whose rotation a node has: the chest ends the spine.
const fn carrier(node: Node) -> Part {
    match node {
        Node::Chest => Part::UpperChest,
        other => other.part(),
    }
}

/// The pose of the 18 bodies from the hips' place \[m\] and the `parent_from_part` turns of all parts in the order of
/// [`Part::ALL`].
pub fn pose_of(hips_m: DVec3, turns: &[DQuat; Part::COUNT]) -> Pose {
    let mut space_from_part = *turns;
    for &part in Part::ALL {
        if let Some(parent) = part.parent() {
            space_from_part[part as usize] = (space_from_part[parent as usize] * turns[part as usize]).normalize();
        }
    }
    let world =
        Node::ALL.map(|node| (space_from_part[carrier(node) as usize] * TPose::part_from_node(node)).normalize());
    Pose { hips_position: hips_m, world }
}

/// The `parent_from_part` turns of a pose: the other way round. Spine and chest share the chest's turn, toes are straight.
pub fn turns_of(pose: &Pose) -> [DQuat; Part::COUNT] {
    let space_from_part = |node: Node| pose.world[node.index()] * TPose::part_from_node(node).conjugate();
    let hips = space_from_part(Node::Hips);
    let half = DQuat::IDENTITY.slerp((hips.conjugate() * space_from_part(Node::Chest)).normalize(), 0.5);
    let mut turns = [DQuat::IDENTITY; Part::COUNT];
    turns[Part::Hips as usize] = hips;
    turns[Part::Spine as usize] = half;
    turns[Part::Chest as usize] = half;
    for node in Node::ALL.into_iter().skip(1).filter(|node| *node != Node::Chest) {
        let Some(parent) = node.parent() else { continue };
        turns[node.part() as usize] = (space_from_part(parent).conjugate() * space_from_part(node)).normalize();
    }
    turns
}

#[cfg(test)]
mod tests {
    use super::*;
    use sinew_body::humanoid::{Body, exp, log};

    #[test]
    fn a_t_pose_of_parts_holds_the_arms_of_the_body_to_the_sides() {
        let pose = pose_of(DVec3::ZERO, &[DQuat::IDENTITY; Part::COUNT]);
        let places = pose.positions(&Body::standard(80.0, 1.7));
        let arm = |from: Node, to: Node| (places[to.index()] - places[from.index()]).normalize();
        // A hundredth for the standard body's own hands, which hang a little forward.
        assert!((arm(Node::LeftUpperArm, Node::LeftLowerArm) - DVec3::X).length() < 0.01);
        assert!((arm(Node::RightLowerArm, Node::RightHand) + DVec3::X).length() < 0.01);
        assert!((pose.world[Node::LeftHand.index()] * DVec3::NEG_X + DVec3::Y).length() < 1e-12, "the palm is down");
    }

    #[test]
    fn a_pose_as_parts_and_back_is_the_pose() {
        let locals = Node::ALL.map(|node| {
            let at = node.index() as f64;
            exp(DVec3::new(0.3 * libm::sin(at), 0.2 * libm::cos(2.0 * at), 0.4 * libm::sin(3.0 * at)))
        });
        let pose = Pose::from_locals(DVec3::new(1.0, 0.9, -2.0), &locals);
        let again = pose_of(pose.hips_position, &turns_of(&pose));
        for node in Node::ALL {
            let apart = pose.world[node.index()].conjugate() * again.world[node.index()];
            // Rounding of a handful of products.
            assert!(log(apart).length() < 1e-12, "{node:?}");
        }
    }
}
