//! A skeleton's motion over time.

use crate::{Skeleton, Transform};
use glam::{DQuat, DVec3};

/// Frames of a skeleton at a constant rate: per joint a rotation, and a translation where the joint moves in its
/// parent's frame (roots, and the few joints whose files animate a position).
///
/// ```
/// use glam::DVec3;
/// use sinew_motion::{Clip, Joint, Skeleton, Transform};
///
/// let mut skeleton = Skeleton::new();
/// let hips = skeleton.push(Joint { name: "hips".into(), parent: None, rest: Transform::IDENTITY, tip: None });
/// let mut clip = Clip::new(skeleton, 1.0 / 60.0, vec![hips]);
/// clip.push(&[Transform::new(glam::DQuat::IDENTITY, DVec3::Y)]);
/// assert_eq!(clip.world(0)[hips].translation, DVec3::Y);
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Clip {
    skeleton: Skeleton,
    frame_time_secs: f64,
    frames: usize,
    /// frames × joints, frame-major; `parent_from_joint`.
    rotations: Vec<DQuat>,
    /// Joints with a translation of their own per frame, ascending.
    moving: Vec<usize>,
    /// frames × moving, frame-major \[m\].
    translations: Vec<DVec3>,
}

impl Clip {
    /// A clip without frames. `moving` lists the joints whose translation is animated; all others keep the
    /// translation of their rest.
    ///
    /// # Panics
    /// If the frame time is not positive and finite, or `moving` names a joint that does not exist.
    pub fn new(skeleton: Skeleton, frame_time_secs: f64, mut moving: Vec<usize>) -> Clip {
        assert!(frame_time_secs.is_finite() && frame_time_secs > 0.0, "a frame takes time");
        moving.sort_unstable();
        moving.dedup();
        assert!(moving.last().is_none_or(|&joint| joint < skeleton.len()), "a moving joint is a joint");
        Clip { skeleton, frame_time_secs, frames: 0, rotations: Vec::new(), moving, translations: Vec::new() }
    }

    /// Appends a frame: one `parent_from_joint` per joint. Translations of joints that do not move are ignored.
    ///
    /// # Panics
    /// If there is not one transform per joint.
    pub fn push(&mut self, locals: &[Transform]) {
        assert_eq!(locals.len(), self.skeleton.len(), "one transform per joint");
        self.rotations.extend(locals.iter().map(|local| local.rotation));
        self.translations.extend(self.moving.iter().map(|&joint| locals[joint].translation));
        self.frames += 1;
    }

    /// The skeleton that moves.
    pub fn skeleton(&self) -> &Skeleton {
        &self.skeleton
    }

    /// Edits the skeleton's names, rests and tips in place, see [`Skeleton::edit`].
    pub fn skeleton_mut(&mut self) -> &mut Skeleton {
        &mut self.skeleton
    }

    /// How many frames there are.
    pub fn frames(&self) -> usize {
        self.frames
    }

    /// Time from one frame to the next \[s\].
    pub fn frame_time_secs(&self) -> f64 {
        self.frame_time_secs
    }

    /// Frames per second.
    pub fn fps(&self) -> f64 {
        1.0 / self.frame_time_secs
    }

    /// Time of the last frame when the first is at 0 \[s\].
    pub fn duration_secs(&self) -> f64 {
        self.frames.saturating_sub(1) as f64 * self.frame_time_secs
    }

    /// Joints whose translation is animated, ascending.
    pub fn moving(&self) -> &[usize] {
        &self.moving
    }

    /// `parent_from_joint` rotation.
    pub fn rotation(&self, frame: usize, joint: usize) -> DQuat {
        self.rotations[frame * self.skeleton.len() + joint]
    }

    /// The `parent_from_joint` rotations of one frame, one per joint.
    pub fn rotations(&self, frame: usize) -> &[DQuat] {
        let joints = self.skeleton.len();
        &self.rotations[frame * joints..(frame + 1) * joints]
    }

    /// Sets the `parent_from_joint` rotation of one joint in one frame.
    pub fn set_rotation(&mut self, frame: usize, joint: usize, rotation: DQuat) {
        let joints = self.skeleton.len();
        self.rotations[frame * joints + joint] = rotation;
    }

    /// Position of the joint in its parent's frame \[m\].
    pub fn translation(&self, frame: usize, joint: usize) -> DVec3 {
        match self.moving.binary_search(&joint) {
            Ok(slot) => self.translations[frame * self.moving.len() + slot],
            Err(_) => self.skeleton.joints()[joint].rest.translation,
        }
    }

    /// Moves a joint in one frame \[m\].
    ///
    /// # Panics
    /// If the joint is not one of those that move.
    pub fn set_translation(&mut self, frame: usize, joint: usize, translation: DVec3) {
        let slot = self.moving.binary_search(&joint).expect("a joint that moves");
        let moving = self.moving.len();
        self.translations[frame * moving + slot] = translation;
    }

    /// `parent_from_joint` \[m\].
    pub fn local(&self, frame: usize, joint: usize) -> Transform {
        Transform::new(self.rotation(frame, joint), self.translation(frame, joint))
    }

    /// `world_from_joint` of every joint in one frame \[m\].
    pub fn world(&self, frame: usize) -> Vec<Transform> {
        let mut world = Vec::with_capacity(self.skeleton.len());
        self.world_into(frame, &mut world);
        world
    }

    /// As [`Clip::world`], into an existing vector: no allocation once it has grown.
    pub fn world_into(&self, frame: usize, world: &mut Vec<Transform>) {
        world.clear();
        for (index, joint) in self.skeleton.joints().iter().enumerate() {
            let local = self.local(frame, index);
            world.push(joint.parent.map_or(local, |parent| world[parent] * local));
        }
    }

    /// The first non-finite value (NaN or infinite), as frame and joint; `None` if all are finite.
    pub fn first_non_finite(&self) -> Option<(usize, usize)> {
        let joints = self.skeleton.len();
        let rotation = self.rotations.iter().position(|rotation| !rotation.is_finite());
        let translation = self.translations.iter().position(|translation| !translation.is_finite());
        let rotation = rotation.map(|at| (at / joints, at % joints));
        let translation = translation.map(|at| (at / self.moving.len(), self.moving[at % self.moving.len()]));
        match (rotation, translation) {
            (Some(a), Some(b)) => Some(a.min(b)),
            (a, b) => a.or(b),
        }
    }
}
