//! How a file's numbers relate to metres with Y up.

use crate::{Clip, Transform};
use glam::DQuat;

/// Unit and axes of a file, both right-handed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SourceSpace {
    /// Length of one file unit \[m\].
    pub unit_m: f64,
    /// Turns the file's axes into ours (Y up); the identity for a file that is Y up.
    pub world_from_source: DQuat,
}

impl SourceSpace {
    /// Metres, Y up: nothing to convert.
    pub const SINEW: SourceSpace = SourceSpace { unit_m: 1.0, world_from_source: DQuat::IDENTITY };

    /// `parent_from_joint` in file units and axes, in metres and Y up. Only roots turn; every length scales.
    pub fn to_world(&self, local: Transform, is_root: bool) -> Transform {
        let translation = local.translation * self.unit_m;
        if is_root {
            Transform::new(self.world_from_source * local.rotation, self.world_from_source * translation)
        } else {
            Transform::new(local.rotation, translation)
        }
    }

    /// The inverse of [`SourceSpace::to_world`].
    pub fn to_source(&self, local: Transform, is_root: bool) -> Transform {
        let translation = local.translation / self.unit_m;
        if is_root {
            let source_from_world = self.world_from_source.conjugate();
            Transform::new(source_from_world * local.rotation, source_from_world * translation)
        } else {
            Transform::new(local.rotation, translation)
        }
    }

    /// A clip in file units and axes, in metres and Y up.
    pub fn clip_to_world(&self, source: &Clip) -> Clip {
        let mut skeleton = source.skeleton().clone();
        let is_root: Vec<bool> = skeleton.joints().iter().map(|joint| joint.parent.is_none()).collect();
        skeleton.edit(|index, _, rest, tip| {
            *rest = self.to_world(*rest, is_root[index]);
            *tip = tip.map(|tip| tip * self.unit_m);
        });
        let mut clip = Clip::new(skeleton, source.frame_time_secs(), source.moving().to_vec());
        let mut locals = Vec::with_capacity(is_root.len());
        for frame in 0..source.frames() {
            locals.clear();
            locals.extend(
                is_root.iter().enumerate().map(|(joint, &root)| self.to_world(source.local(frame, joint), root)),
            );
            clip.push(&locals);
        }
        clip
    }
}
