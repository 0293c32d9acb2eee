//! The 18 bodies and their degrees of freedom.
//!
//! The tree is the one of `vectors/humanoid42_random.json` (Ye and Liu 2008 give only the counts, section 4): six root
//! coordinates, 24 of the upper body, 12 of the legs. Node frames are *anatomical*: with the body standing, arms
//! hanging, palms to the thighs, every frame is +X to the character's left, +Y up, +Z forward, its origin at the
//! joint to the parent.

use sinew_motion::Part;
use sinew_snapshot::{Reader, Snapshot, SnapshotError, Writer};

/// One of the 18 bodies.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[allow(missing_docs, reason = "the names are the VRM parts")]
#[repr(u8)]
pub enum Node {
    #[default]
    Hips,
    Chest,
    Neck,
    Head,
    LeftShoulder,
    LeftUpperArm,
    LeftLowerArm,
    LeftHand,
    RightShoulder,
    RightUpperArm,
    RightLowerArm,
    RightHand,
    LeftUpperLeg,
    LeftLowerLeg,
    LeftFoot,
    RightUpperLeg,
    RightLowerLeg,
    RightFoot,
}

/// Its [`Node::index`] in one byte.
impl Snapshot for Node {
    fn save(&self, to: &mut Writer) {
        to.byte(*self as u8);
    }
    fn restore(&mut self, from: &mut Reader<'_>) -> Result<(), SnapshotError> {
        let index = usize::from(from.byte()?);
        *self = *Node::ALL.get(index).ok_or(SnapshotError::invalid("node"))?;
        Ok(())
    }
}

/// A coordinate axis of a node's own anatomical frame: X to the left, Y up (along the bone), Z forward.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[allow(missing_docs, reason = "an axis")]
#[repr(u8)]
pub enum Axis {
    X,
    Y,
    Z,
}

/// One degree of freedom of the upper body: a turn of `node` about `axis` of its own frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Dof {
    /// The body that turns.
    pub node: Node,
    /// About which axis of its own anatomical frame.
    pub axis: Axis,
}

/// How many of the nodes belong to the upper body, hips included: the first twelve.
pub const UPPER_NODES: usize = 12;

/// Degrees of freedom of the upper body without the root.
pub const UPPER_DOFS: usize = 24;

/// Upper leg, lower leg and foot of both sides.
pub const LEGS: [(Node, Node, Node); 2] = [
    (Node::LeftUpperLeg, Node::LeftLowerLeg, Node::LeftFoot),
    (Node::RightUpperLeg, Node::RightLowerLeg, Node::RightFoot),
];

impl Node {
    /// Number of nodes.
    pub const COUNT: usize = 18;

    /// Every node, parents before children, the upper body first.
    pub const ALL: [Node; Node::COUNT] = [
        Node::Hips,
        Node::Chest,
        Node::Neck,
        Node::Head,
        Node::LeftShoulder,
        Node::LeftUpperArm,
        Node::LeftLowerArm,
        Node::LeftHand,
        Node::RightShoulder,
        Node::RightUpperArm,
        Node::RightLowerArm,
        Node::RightHand,
        Node::LeftUpperLeg,
        Node::LeftLowerLeg,
        Node::LeftFoot,
        Node::RightUpperLeg,
        Node::RightLowerLeg,
        Node::RightFoot,
    ];

    /// Position in [`Node::ALL`].
    pub const fn index(self) -> usize {
        self as usize
    }

    /// The parent of this node; `None` for the hips.
    pub const fn parent(self) -> Option<Node> {
        Some(match self {
            Node::Hips => return None,
            Node::Chest | Node::LeftUpperLeg | Node::RightUpperLeg => Node::Hips,
            Node::Neck | Node::LeftShoulder | Node::RightShoulder => Node::Chest,
            Node::Head => Node::Neck,
            Node::LeftUpperArm => Node::LeftShoulder,
            Node::LeftLowerArm => Node::LeftUpperArm,
            Node::LeftHand => Node::LeftLowerArm,
            Node::RightUpperArm => Node::RightShoulder,
            Node::RightLowerArm => Node::RightUpperArm,
            Node::RightHand => Node::RightLowerArm,
            Node::LeftLowerLeg => Node::LeftUpperLeg,
            Node::LeftFoot => Node::LeftLowerLeg,
            Node::RightLowerLeg => Node::RightUpperLeg,
            Node::RightFoot => Node::RightLowerLeg,
        })
    }

    /// The axes about which the node turns, in its own frame, in the order of the coordinates. The hips' six root
    /// coordinates are not listed.
    pub const fn axes(self) -> &'static [Axis] {
        match self {
            Node::Hips => &[],
            Node::Chest | Node::LeftUpperArm | Node::RightUpperArm | Node::LeftUpperLeg | Node::RightUpperLeg => {
                &[Axis::X, Axis::Z, Axis::Y]
            }
            Node::Neck | Node::LeftFoot | Node::RightFoot => &[Axis::X, Axis::Z],
            Node::Head => &[Axis::Y],
            Node::LeftShoulder | Node::RightShoulder => &[Axis::Y, Axis::Z],
            Node::LeftLowerArm | Node::RightLowerArm => &[Axis::X, Axis::Y],
            Node::LeftHand | Node::RightHand => &[Axis::Z, Axis::X],
            Node::LeftLowerLeg | Node::RightLowerLeg => &[Axis::X],
        }
    }

    /// The body part of this name.
    pub const fn part(self) -> Part {
        match self {
            Node::Hips => Part::Hips,
            Node::Chest => Part::Chest,
            Node::Neck => Part::Neck,
            Node::Head => Part::Head,
            Node::LeftShoulder => Part::LeftShoulder,
            Node::LeftUpperArm => Part::LeftUpperArm,
            Node::LeftLowerArm => Part::LeftLowerArm,
            Node::LeftHand => Part::LeftHand,
            Node::RightShoulder => Part::RightShoulder,
            Node::RightUpperArm => Part::RightUpperArm,
            Node::RightLowerArm => Part::RightLowerArm,
            Node::RightHand => Part::RightHand,
            Node::LeftUpperLeg => Part::LeftUpperLeg,
            Node::LeftLowerLeg => Part::LeftLowerLeg,
            Node::LeftFoot => Part::LeftFoot,
            Node::RightUpperLeg => Part::RightUpperLeg,
            Node::RightLowerLeg => Part::RightLowerLeg,
            Node::RightFoot => Part::RightFoot,
        }
    }

    /// The body that a part belongs to: the spine's parts to the chest, toes to the foot.
    pub const fn of(part: Part) -> Node {
        match part {
            Part::Hips => Node::Hips,
            Part::Spine | Part::Chest | Part::UpperChest => Node::Chest,
            Part::Neck => Node::Neck,
            Part::Head => Node::Head,
            Part::LeftShoulder => Node::LeftShoulder,
            Part::LeftUpperArm => Node::LeftUpperArm,
            Part::LeftLowerArm => Node::LeftLowerArm,
            Part::LeftHand => Node::LeftHand,
            Part::RightShoulder => Node::RightShoulder,
            Part::RightUpperArm => Node::RightUpperArm,
            Part::RightLowerArm => Node::RightLowerArm,
            Part::RightHand => Node::RightHand,
            Part::LeftUpperLeg => Node::LeftUpperLeg,
            Part::LeftLowerLeg => Node::LeftLowerLeg,
            Part::LeftFoot | Part::LeftToes => Node::LeftFoot,
            Part::RightUpperLeg => Node::RightUpperLeg,
            Part::RightLowerLeg => Node::RightLowerLeg,
            Part::RightFoot | Part::RightToes => Node::RightFoot,
        }
    }

    /// Whether the node lies on the character's right.
    pub const fn is_right(self) -> bool {
        matches!(self.part().side(), Some(sinew_motion::Side::Right))
    }

    /// Whether the node is a leg's.
    pub const fn is_leg(self) -> bool {
        self.index() >= UPPER_NODES
    }
}

/// The 24 degrees of freedom of the upper body, in the order of every vector over them.
pub const fn upper_dofs() -> [Dof; UPPER_DOFS] {
    let mut dofs = [Dof { node: Node::Hips, axis: Axis::X }; UPPER_DOFS];
    let (mut node, mut at) = (0, 0);
    while node < UPPER_NODES {
        let axes = Node::ALL[node].axes();
        let mut axis = 0;
        while axis < axes.len() {
            dofs[at] = Dof { node: Node::ALL[node], axis: axes[axis] };
            at += 1;
            axis += 1;
        }
        node += 1;
    }
    assert!(at == UPPER_DOFS);
    dofs
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_body_has_24_upper_and_12_lower_degrees_of_freedom() {
        let count = |nodes: &[Node]| nodes.iter().map(|node| node.axes().len()).sum::<usize>();
        assert_eq!(count(&Node::ALL[..UPPER_NODES]), 24);
        assert_eq!(count(&Node::ALL[UPPER_NODES..]), 12);
        assert_eq!(upper_dofs()[23], Dof { node: Node::RightHand, axis: Axis::X });
    }

    #[test]
    fn parents_stand_before_children_and_carry_their_own_index() {
        for (index, node) in Node::ALL.into_iter().enumerate() {
            assert_eq!(node.index(), index);
            assert!(node.parent().is_none_or(|parent| parent.index() < index));
            assert_eq!(Node::of(node.part()), node);
        }
    }
}
