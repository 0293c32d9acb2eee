//! A tree of joints.

use crate::Transform;
use glam::DVec3;

/// One joint of a skeleton: a frame that turns (and for a root, moves) relative to its parent's.
#[derive(Clone, Debug, PartialEq)]
pub struct Joint {
    /// The file's own name; not necessarily unique, never empty.
    pub name: String,
    /// Index of the parent, smaller than this joint's own; `None` for a root (a file may hold several).
    pub parent: Option<usize>,
    /// `parent_from_joint` when no motion is applied \[m\].
    pub rest: Transform,
    /// Where the bone of a leaf joint ends (a BVH `End Site`, the end of an ASF bone) in the joint's frame \[m\].
    pub tip: Option<DVec3>,
}

/// A tree of joints, parents before children.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Skeleton {
    joints: Vec<Joint>,
}

impl Skeleton {
    /// An empty skeleton.
    pub fn new() -> Skeleton {
        Skeleton::default()
    }

    /// Appends a joint and returns its index.
    ///
    /// # Panics
    /// If the parent does not stand before it: readers check their files before they build.
    pub fn push(&mut self, joint: Joint) -> usize {
        let index = self.joints.len();
        assert!(joint.parent.is_none_or(|parent| parent < index), "a parent stands before its children");
        self.joints.push(joint);
        index
    }

    /// The joints, parents before children.
    pub fn joints(&self) -> &[Joint] {
        &self.joints
    }

    /// The joints, to edit names, rests and tips in place; parents cannot be changed.
    pub fn edit(&mut self, mut edit: impl FnMut(usize, &mut String, &mut Transform, &mut Option<DVec3>)) {
        for (index, joint) in self.joints.iter_mut().enumerate() {
            edit(index, &mut joint.name, &mut joint.rest, &mut joint.tip);
        }
    }

    /// How many joints there are.
    pub fn len(&self) -> usize {
        self.joints.len()
    }

    /// Whether there is no joint.
    pub fn is_empty(&self) -> bool {
        self.joints.is_empty()
    }

    /// Index of the first joint with this name.
    pub fn find(&self, name: &str) -> Option<usize> {
        self.joints.iter().position(|joint| joint.name == name)
    }

    /// Indices of the direct children of a joint, in file order.
    pub fn children(&self, joint: usize) -> impl Iterator<Item = usize> + '_ {
        self.joints.iter().enumerate().filter(move |(_, child)| child.parent == Some(joint)).map(|(index, _)| index)
    }

    /// Whether `ancestor` is `joint` itself or stands above it.
    pub fn is_ancestor(&self, ancestor: usize, joint: usize) -> bool {
        let mut at = Some(joint);
        while let Some(index) = at {
            if index == ancestor {
                return true;
            }
            at = self.joints[index].parent;
        }
        false
    }

    /// `world_from_joint` of every joint in the rest pose \[m\].
    pub fn rest_world(&self) -> Vec<Transform> {
        let mut world: Vec<Transform> = Vec::with_capacity(self.joints.len());
        for joint in &self.joints {
            world.push(joint.parent.map_or(joint.rest, |parent| world[parent] * joint.rest));
        }
        world
    }
}
