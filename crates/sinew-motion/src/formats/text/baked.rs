//! A clip for formats whose joints have no rest rotation.

use crate::{Clip, Transform};
use glam::{DQuat, DVec3};

/// A skeleton whose joint frames are turned so that they all stand parallel to the world in the rest pose.
///
/// With `W` the rest orientation of a joint in the world, its new frame is the old one times `W⁻¹`. In the parent's
/// new frame then stand the translation `W_parent t` and the rotation `W_parent L W⁻¹`, where `t` and `L` were the
/// old ones: every joint keeps its place in the world, and its orientation relative to the rest, in every frame.
pub(crate) struct Baked<'a> {
    clip: &'a Clip,
    world_from_rest: Vec<DQuat>,
    children: Vec<Vec<usize>>,
    roots: Vec<usize>,
}

impl<'a> Baked<'a> {
    /// Turns the frames of the clip's skeleton.
    pub(crate) fn new(clip: &'a Clip) -> Baked<'a> {
        let skeleton = clip.skeleton();
        let world_from_rest = skeleton.rest_world().iter().map(|world| world.rotation.normalize()).collect();
        let mut children = vec![Vec::new(); skeleton.len()];
        let mut roots = Vec::new();
        for (index, joint) in skeleton.joints().iter().enumerate() {
            match joint.parent {
                Some(parent) => children[parent].push(index),
                None => roots.push(index),
            }
        }
        Baked { clip, world_from_rest, children, roots }
    }

    /// The joints without a parent.
    pub(crate) fn roots(&self) -> &[usize] {
        &self.roots
    }

    /// The joints that hang from this one.
    pub(crate) fn children(&self, joint: usize) -> &[usize] {
        &self.children[joint]
    }

    /// Every joint with its depth (a root has 0), depth first: the order in which a nested file writes them.
    pub(crate) fn depth_first(&self) -> Vec<(usize, usize)> {
        let mut order = Vec::with_capacity(self.children.len());
        let mut open: Vec<(usize, usize)> = self.roots.iter().rev().map(|&root| (root, 0)).collect();
        while let Some((joint, depth)) = open.pop() {
            order.push((joint, depth));
            open.extend(self.children[joint].iter().rev().map(|&child| (child, depth + 1)));
        }
        order
    }

    /// Where the joint rests in its parent's frame \[m\].
    pub(crate) fn offset(&self, joint: usize) -> DVec3 {
        self.parent_turn(joint) * self.clip.skeleton().joints()[joint].rest.translation
    }

    /// Where its bone ends in the joint's frame \[m\].
    pub(crate) fn tip(&self, joint: usize) -> Option<DVec3> {
        self.clip.skeleton().joints()[joint].tip.map(|tip| self.world_from_rest[joint] * tip)
    }

    /// `parent_from_joint` in a frame of the clip \[m\].
    pub(crate) fn local(&self, frame: usize, joint: usize) -> Transform {
        let local = self.clip.local(frame, joint);
        let turn = self.parent_turn(joint);
        Transform::new(turn * local.rotation * self.world_from_rest[joint].conjugate(), turn * local.translation)
    }

    fn parent_turn(&self, joint: usize) -> DQuat {
        self.clip.skeleton().joints()[joint].parent.map_or(DQuat::IDENTITY, |parent| self.world_from_rest[parent])
    }
}
