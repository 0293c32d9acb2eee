//! A clip as a performer: the datagrams that a performer of the clip would send, and when they arrive.

use crate::PlayerError;
use crate::impairment::Impairment;
use crate::vmc::VmcFrame;
use sinew_body::humanoid::{Body, Person, Pose, Reduction};
use sinew_control::perform::PerformerSample;
use sinew_motion::formats::MotionFile;
use sinew_motion::{moves_from, resample};

/// A motion file, ready to be performed.
#[derive(Clone, Debug)]
pub struct ClipPlayer {
    body: Body,
    poses: Vec<Pose>,
    interval_secs: f64,
}

/// Maximum number of frames: an hour at 60 Hz.
const MAX_FRAMES: usize = 216_000;

impl ClipPlayer {
    /// Reads a performer from a motion file and resamples it at `hz`, 1 to 1000 Hz. A still pose at the beginning is
    /// skipped.
    ///
    /// # Errors
    /// A rate out of range, or a file without a human body.
    pub fn new(file: &MotionFile, hz: f64) -> Result<ClipPlayer, PlayerError> {
        if !(1.0..=1000.0).contains(&hz) {
            return Err(PlayerError::Rate(hz));
        }
        let humanoid = file.body_parts().map_err(|error| PlayerError::Body(error.to_string()))?;
        let reduction = Reduction::new(&file.clip, humanoid, file.stature_m, Person::default());
        let reduction = reduction.map_err(|error| PlayerError::Body(error.to_string()))?;
        let skipped_secs = moves_from(&file.clip, humanoid) as f64 * file.clip.frame_time_secs();
        let clip = resample(&file.clip, hz);
        let first = ((skipped_secs * hz).ceil() as usize).min(clip.frames().saturating_sub(1));
        let frames = (first..clip.frames()).take(MAX_FRAMES);
        let poses: Vec<Pose> = frames.map(|frame| reduction.pose(&clip.world(frame))).collect();
        ClipPlayer::of_poses(reduction.body().clone(), poses, hz)
    }

    /// A performer with this body and these poses, `hz` of them a second.
    ///
    /// # Errors
    /// No poses.
    pub fn of_poses(body: Body, poses: Vec<Pose>, hz: f64) -> Result<ClipPlayer, PlayerError> {
        if poses.is_empty() {
            return Err(PlayerError::NoFrames);
        }
        Ok(ClipPlayer { body, poses, interval_secs: 1.0 / hz })
    }

    /// The performer's body.
    pub fn body(&self) -> &Body {
        &self.body
    }

    /// Frames of the clip.
    pub fn frames(&self) -> usize {
        self.poses.len()
    }

    /// Time from frame to frame \[s\].
    pub fn interval_secs(&self) -> f64 {
        self.interval_secs
    }

    /// The pose of a frame. The clip plays forwards and backwards in turn, without a jump.
    pub fn pose(&self, number: u64) -> &Pose {
        &self.poses[ping_pong(number, self.poses.len())]
    }

    /// The sample that the performer sends as the frame of this number.
    pub fn sample(&self, number: u64) -> PerformerSample {
        let time_secs = number as f64 * self.interval_secs;
        let sample = PerformerSample::of_pose(time_secs, self.pose(number), &self.body);
        PerformerSample { number: Some(number), ..sample }
    }

    /// The datagrams of a frame, each with its arrival time from the start of the performance \[s\].
    pub fn datagrams(&self, number: u64, impairment: &Impairment) -> impl Iterator<Item = (f64, Vec<u8>)> + use<> {
        let sample = self.sample(number);
        let frame = VmcFrame::of(&sample, &self.body);
        let delivery = impairment.delivery(number, self.interval_secs);
        let bytes = match delivery.corruption {
            Some(corruption) => corruption.apply(&frame),
            None => frame.to_bytes(),
        };
        let sent_secs = sample.time_secs;
        delivery.arrivals_secs.into_iter().flatten().map(move |after| (sent_secs + after, bytes.clone()))
    }
}

/// Index of the frame to show, when `count` frames are played forwards and backwards in turn.
pub(crate) fn ping_pong(number: u64, count: usize) -> usize {
    let last = count.saturating_sub(1) as u64;
    let at = if last == 0 { 0 } else { number % (2 * last) };
    at.min(2 * last - at) as usize
}
