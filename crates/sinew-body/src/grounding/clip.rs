//! Grounding of a clip: poses out of it, shifts back onto its own joints.

use super::{GroundSettings, Grounding, Quality, ground};
use crate::humanoid::{Overlay, Pose, Reduction};
use sinew_motion::Clip;

impl Grounding {
    /// Grounding of a clip in metres, Y up. `first_frame` is its first real one: frames before it stay as they are.
    pub fn of_clip(clip: &Clip, reduction: &Reduction, first_frame: usize, settings: &GroundSettings) -> Grounding {
        ground(reduction.body(), &poses(clip, reduction, first_frame), clip.fps(), settings)
    }

    /// The clip that [`Grounding::of_clip`] was made for, with the shifts on its own joints: the hips or the root above them move, and
    /// the legs turn.
    pub fn applied(&self, clip: &Clip, reduction: &Reduction, first_frame: usize) -> Clip {
        let mut grounded = clip.clone();
        let mut overlay = Overlay::new(reduction, clip.moving());
        let mut world = Vec::with_capacity(clip.skeleton().len());
        for (at, frame) in (first_frame..clip.frames()).enumerate().take(self.body_shifts.len()) {
            clip.world_into(frame, &mut world);
            let mut moved = None;
            overlay.apply(
                &world,
                &self.deviation(at).with_shifts_scaled(1.0 / reduction.scale()),
                |joint, rotation| grounded.set_rotation(frame, joint, rotation),
                |joint, translation| moved = Some((joint, translation)),
            );
            if let Some((joint, translation)) = moved.filter(|(joint, _)| clip.moving().contains(joint)) {
                grounded.set_translation(frame, joint, translation);
            }
        }
        grounded
    }

    /// How well a clip stands on the floor, judged by the contacts of this grounding: its own clip before, or the clip that
    /// [`Grounding::applied`] gave.
    pub fn quality(&self, clip: &Clip, reduction: &Reduction, first_frame: usize) -> Quality {
        let poses = poses(clip, reduction, first_frame);
        Quality::of(reduction.body(), &poses, clip.fps(), &self.stands, self.standing_m)
    }
}

fn poses(clip: &Clip, reduction: &Reduction, first_frame: usize) -> Vec<Pose> {
    let mut world = Vec::with_capacity(clip.skeleton().len());
    (first_frame..clip.frames())
        .map(|frame| {
            clip.world_into(frame, &mut world);
            reduction.pose(&world)
        })
        .collect()
}
