//! A clip made ready to be pushed.

use crate::basis::Basis;
use crate::motion::Motion;
use crate::prepared::{PrepareError, Prepared};
use crate::settings::{Settings, SettingsError};
use crate::track::Track;
use sinew_body::humanoid::{Overlay, Reduction};
use sinew_motion::{Clip, Humanoid, Repeated, find_cycle, moves_from, repeat};
use std::ops::Range;

/// Which part of a clip is measured, and how often it is played.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Excerpt {
    /// First and last frame of the gait cycle from which the basis is made, from 0, both included. Default `None`: the cycle is
    /// found ([`find_cycle`]); where there is none, the basis is made from the whole clip.
    pub cycle: Option<(usize, usize)>,
    /// How often the cycle is played, without a seam; repetition makes at most [`Excerpt::MAX_FRAMES`]. Default 0: the clip stays as it is.
    pub repeat: usize,
}

impl Excerpt {
    /// Most frames that a repetition may make: half an hour at 120 Hz.
    pub const MAX_FRAMES: usize = 216_000;
}

/// A clip made ready to be pushed: what [`Prepared`] holds, the clip that it was made from, and the way back to its joints.
///
/// ```
/// use sinew_body::humanoid::{Person, Reduction};
/// use sinew_motion::formats::{MotionFile, ReadOptions};
/// use sinew_response::{Disturbances, Excerpt, PreparedClip, Settings};
///
/// # let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../samples/walk.bvh");
/// let file = MotionFile::read(path.as_ref(), &ReadOptions::default())?;
/// let humanoid = file.body_parts()?;
/// let reduction = Reduction::new(&file.clip, humanoid, file.stature_m, Person::default())?;
/// let prepared = PreparedClip::new(&file.clip, humanoid, reduction, Excerpt::default(), Settings::default())?;
/// assert!(prepared.cycle().is_some(), "a walk has a gait cycle");
/// let undisturbed = prepared.motion().run(Disturbances::default());
/// assert_eq!(prepared.applied(&undisturbed), file.clip);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct PreparedClip {
    clip: Clip,
    rows: Vec<usize>,
    first_frame: usize,
    cycle: Option<(usize, usize)>,
    reduction: Reduction,
    motion: Prepared,
}

impl PreparedClip {
    /// Looks for where the motion really begins and for its gait cycle, repeats the cycle if asked to, resamples, filters, and
    /// finds the coordinates of actuation.
    ///
    /// # Errors
    /// When a setting is out of range, the stated cycle is not in the clip, there is none to repeat, the repetition is too long,
    /// or the motion is too short or not finite.
    pub fn new(
        clip: &Clip,
        humanoid: &Humanoid,
        reduction: Reduction,
        excerpt: Excerpt,
        settings: Settings,
    ) -> Result<PreparedClip, PrepareError> {
        settings.check()?;
        let cycle = cycle_of(clip, humanoid, excerpt.cycle)?;
        let played = match excerpt.repeat {
            0 => Played::once(clip, humanoid, cycle),
            times => Played::repeated(clip, humanoid, cycle.ok_or(PrepareError::NoCycle)?, times)?,
        };
        let motion = Motion::of_clip(&played.clip, &reduction, played.first_frame, &settings);
        let measured = played.measured(&motion);
        let motion = Prepared::of_motion(reduction.body().clone(), motion, measured, settings)?;
        let Played { clip, rows, first_frame, .. } = played;
        Ok(PreparedClip { clip, rows, first_frame, cycle, reduction, motion })
    }

    /// The same clip with other settings, see [`Prepared::with_settings`].
    ///
    /// # Errors
    /// When a setting is out of range.
    pub fn with_settings(&self, settings: Settings) -> Result<PreparedClip, SettingsError> {
        Ok(PreparedClip { motion: self.motion.with_settings(settings)?, ..self.clone() })
    }

    /// The same clip with the directions of another motion's basis, see [`Prepared::with_directions_of`].
    #[must_use]
    pub fn with_directions_of(&self, other: &Basis) -> PreparedClip {
        PreparedClip { motion: self.motion.with_directions_of(other), ..self.clone() }
    }

    /// The clip that is pushed: the source's, or its cycle repeated.
    pub fn clip(&self) -> &Clip {
        &self.clip
    }

    /// For each frame of [`PreparedClip::clip`] the frame of the source that it came from.
    pub fn rows(&self) -> &[usize] {
        &self.rows
    }

    /// Frames of [`PreparedClip::clip`] before this one are a rest pose and stay as they are.
    pub fn first_frame(&self) -> usize {
        self.first_frame
    }

    /// The gait cycle in frames of the source, both ends included, where there is one.
    pub fn cycle(&self) -> Option<(usize, usize)> {
        self.cycle
    }

    /// How the skeleton is seen as a body.
    pub fn reduction(&self) -> &Reduction {
        &self.reduction
    }

    /// What the response needs.
    pub fn motion(&self) -> &Prepared {
        &self.motion
    }

    /// The clip with a run's deviations on its own joints, at its own rate. Where nothing deviates, it is the clip bit for bit.
    pub fn applied(&self, track: &Track) -> Clip {
        let mut clip = self.clip.clone();
        let mut overlay = Overlay::new(&self.reduction, clip.moving());
        let mut world = Vec::with_capacity(clip.skeleton().len());
        let moving = clip.moving().to_vec();
        for frame in self.first_frame..clip.frames() {
            let secs = frame as f64 * clip.frame_time_secs();
            let deviation = track.deviation_at(secs).with_shifts_scaled(1.0 / self.reduction.scale());
            self.clip.world_into(frame, &mut world);
            let mut moved = None;
            overlay.apply(
                &world,
                &deviation,
                |joint, rotation| clip.set_rotation(frame, joint, rotation),
                |joint, translation| moved = Some((joint, translation)),
            );
            if let Some((joint, translation)) = moved
                && moving.contains(&joint)
            {
                clip.set_translation(frame, joint, translation);
            }
        }
        clip
    }
}

/// The clip after repetition.
struct Played {
    clip: Clip,
    rows: Vec<usize>,
    first_frame: usize,
    /// In frames of `clip`, both ends included.
    cycle: Option<(usize, usize)>,
}

impl Played {
    fn once(clip: &Clip, humanoid: &Humanoid, cycle: Option<(usize, usize)>) -> Played {
        let first_frame = moves_from(clip, humanoid);
        Played {
            clip: clip.clone(),
            rows: (0..clip.frames()).collect(),
            first_frame,
            cycle: cycle.map(|(first, last)| (first.max(first_frame), last)),
        }
    }

    fn repeated(
        clip: &Clip,
        humanoid: &Humanoid,
        (first, last): (usize, usize),
        times: usize,
    ) -> Result<Played, PrepareError> {
        let length = last - first;
        if length.saturating_mul(times) > Excerpt::MAX_FRAMES {
            return Err(PrepareError::TooLong(times, length));
        }
        let Repeated { clip, rows } = repeat(clip, humanoid, (first, last), times);
        // A round in the middle: at the ends the filter has less to go by.
        let first = times / 2 * length;
        Ok(Played { clip, rows, first_frame: 0, cycle: Some((first, first + length)) })
    }

    /// The poses of the cycle; the whole motion when there is none or it is too short to tell.
    fn measured(&self, motion: &Motion) -> Range<usize> {
        let all = 0..motion.poses().len();
        let Some((first, last)) = self.cycle else { return all };
        let secs = |frame: usize| frame as f64 * self.clip.frame_time_secs();
        let poses = motion.range_secs(secs(first), secs(last));
        if poses.len() < 3 { all } else { poses }
    }
}

fn cycle_of(
    clip: &Clip,
    humanoid: &Humanoid,
    stated: Option<(usize, usize)>,
) -> Result<Option<(usize, usize)>, PrepareError> {
    let Some((first, last)) = stated else {
        return Ok(find_cycle(clip, humanoid).map(|cycle| (cycle.first, cycle.last)));
    };
    if first >= last || last >= clip.frames() {
        return Err(PrepareError::Cycle(first, last, clip.frames().saturating_sub(1)));
    }
    Ok(Some((first, last)))
}
