//! The skeleton that a character was made from, to give its motion back on.

use crate::motion_source::{Play, Played, played, read, reduction};
use crate::scene::Scene;
use crate::source_context::how;
use crate::{StageError, StageErrorKind};
use sinew_body::humanoid::{Overlay, Pose, Reduction};
use sinew_control::source::{ClipPlay, SourceSpec};
use sinew_motion::Clip;
use sinew_motion::formats::MotionFile;

/// The clip's file that a character's body was measured on. Poses of the body become a clip of the file's own joints, and
/// [`MotionFile::write`] writes that as the file again, with its skeleton, channels and meshes.
#[derive(Clone, Debug)]
pub struct OwnRig {
    file: MotionFile,
    reduction: Reduction,
    base: Clip,
    rows: Vec<usize>,
    /// For each frame of the stage its frame of `base`; the last for all later ones.
    frames: Vec<usize>,
}

impl OwnRig {
    /// That of a scene's character, for so many frames of the stage; `None` for a character without a clip.
    ///
    /// What the body does not tell (fingers, toes, faces) is as in the character's clip at the same time.
    ///
    /// ```
    /// use sinew_stage::{OwnRig, Scene};
    /// let scene = Scene::from_text("format = 1\n[characters.one]\npose = \"stand\"\n")?;
    /// assert!(OwnRig::of(&scene, "one", 60)?.is_none());
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// When the clip cannot be read or holds no body, as when the stage is built.
    pub fn of(scene: &Scene, character: &str, frames: usize) -> Result<Option<OwnRig>, StageError> {
        let Some(spec) = scene.characters.get(character) else { return Ok(None) };
        let plays = spec.source.as_ref().map_or_else(Vec::new, SourceSpec::clips);
        let Some(name) = spec.clip.as_ref().or(plays.first().map(|play| &play.file)) else { return Ok(None) };
        let wrong = |problem: String| StageError {
            kind: StageErrorKind::Clip,
            file: scene.file_name().to_owned(),
            place: format!("characters.{character}"),
            problem,
        };
        let file = read(scene, name).map_err(wrong)?;
        let reduction = reduction(&file, spec).map_err(wrong)?;
        let motion_hz = f64::from(scene.stage.motion_hz);
        let until_secs = frames as f64 / motion_hz;
        let skeleton_alone = ClipPlay { file: name.clone(), start_secs: 0.0, repeats: false };
        let play = plays.iter().find(|play| play.file == *name).unwrap_or(&skeleton_alone);
        let play = Play { until_secs, ..how(scene, spec.tracker, play) };
        let played = played(&file, &play).map_err(wrong)?;
        let frames = (0..frames).map(|frame| played.frame(frame)).collect();
        let Played { clip: base, rows, .. } = played;
        Ok(Some(OwnRig { file, reduction, base, rows, frames }))
    }

    /// Of a file that is left after some time for another motion: `base` is its clip at the motion's rate, `rows` the file's frame for
    /// each of that, and `frames` for each frame of the motion the one of `base` that tells what the body does not.
    pub fn of_file(file: MotionFile, reduction: Reduction, base: Clip, rows: Vec<usize>, frames: Vec<usize>) -> OwnRig {
        OwnRig { file, reduction, base, rows, frames }
    }

    /// The file that the body was measured on.
    pub fn file(&self) -> &MotionFile {
        &self.file
    }

    /// How its skeleton is seen as a body.
    pub fn reduction(&self) -> &Reduction {
        &self.reduction
    }

    /// Poses of the body on the file's own joints, and for each the frame of the file of which all else is.
    pub fn clip(&self, poses: &[Pose]) -> (Clip, Vec<usize>) {
        let skeleton = self.base.skeleton().clone();
        let joints = skeleton.len();
        let mut clip = Clip::new(skeleton, self.base.frame_time_secs(), self.base.moving().to_vec());
        let mut overlay = Overlay::new(&self.reduction, self.base.moving());
        let (mut world, mut locals, mut rows) = (Vec::with_capacity(joints), Vec::with_capacity(joints), Vec::new());
        for (index, pose) in poses.iter().enumerate() {
            let frame = self.frames.get(index).or(self.frames.last()).copied().unwrap_or(0);
            self.base.world_into(frame, &mut world);
            locals.clear();
            locals.extend((0..joints).map(|joint| self.base.local(frame, joint)));
            let mut shifted = None;
            overlay.apply_pose(
                &world,
                pose,
                |joint, rotation| locals[joint].rotation = rotation,
                |joint, translation| shifted = Some((joint, translation)),
            );
            if let Some((joint, translation)) = shifted
                && self.base.moving().contains(&joint)
            {
                locals[joint].translation = translation;
            }
            clip.push(&locals);
            rows.push(self.rows.get(frame).copied().unwrap_or(0));
        }
        (clip, rows)
    }
}
