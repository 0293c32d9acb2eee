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

/// Whether a joint's name says that it only marks an end.
fn is_end(name: &str) -> bool {
    let name = name.rsplit([':', '|']).next().unwrap_or(name);
    let name = name.trim_end_matches(|end: char| end.is_ascii_digit() || !end.is_alphanumeric());
    let lower = name.to_lowercase();
    ["end", "nub", "tip", "endsite", "end site"].iter().any(|word| {
        let Some(before) = lower.strip_suffix(word) else { return false };
        let is_word = |at: usize| name.get(at..).is_some_and(|end| end.starts_with(|first: char| first.is_uppercase()));
        // `bend` and `Hand_tip` differ by what stands before.
        before.is_empty() || !before.ends_with(char::is_alphanumeric) || is_word(before.len()) || *word == "nub"
    })
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

    /// Where a joint's bone ends, in its own frame \[file units or m\]: at its tip or, where that is not stated, at a leaf below it that exists
    /// only to say so: Blender's `head_end`, Mixamo's `HeadTop_End`, 3ds Max's `Bip01 HeadNub`.
    ///
    /// ```
    /// use glam::{DQuat, DVec3};
    /// use sinew_motion::{Joint, Skeleton, Transform};
    /// let mut skeleton = Skeleton::new();
    /// let head = skeleton.push(Joint { name: "head".into(), parent: None, rest: Transform::IDENTITY, tip: None });
    /// let rest = Transform::new(DQuat::IDENTITY, DVec3::Y * 0.2);
    /// skeleton.push(Joint { name: "head_end".into(), parent: Some(head), rest, tip: None });
    /// assert_eq!(skeleton.end(head), Some(DVec3::Y * 0.2));
    /// ```
    pub fn end(&self, joint: usize) -> Option<DVec3> {
        let own = self.joints[joint].tip.filter(|tip| *tip != DVec3::ZERO);
        let is_parent = |index: usize| self.joints.iter().any(|joint| joint.parent == Some(index));
        own.or_else(|| {
            let below = self.joints.iter().enumerate().filter(|(_, below)| below.parent == Some(joint));
            let mut ends = below.filter(|(index, below)| is_end(&below.name) && !is_parent(*index));
            ends.next().map(|(_, end)| end.rest.translation).filter(|end| *end != DVec3::ZERO)
        })
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
