//! Where the wanted pose comes from: the [`Source`], its kinds, and [`Sources`], which decides whose word counts.

mod clip;
mod hand_over;
mod key_poses;
mod performer;
mod reach;
mod sources;

pub use clip::ClipSource;
pub use hand_over::{HAND_OVER_SECS, handed_over};
pub use key_poses::{KeyPoses, PoseBook};
pub use performer::{Performer, StreamChange};
pub use reach::{Aimed, HANDS, HandArrival, ReachArrival, ReachSource};
pub use sources::{NO_PERFORMER, Sources};

use crate::graph::Cause;
use crate::{Root, Wanted};
use sinew_body::humanoid::{Body, Pose};
use sinew_world::{CharacterFrame, CharacterId, Frame};
use std::any::Any;
use std::fmt::Debug;

/// A step of physics that begins, as a source sees it.
#[derive(Clone, Copy, Debug)]
pub struct Moment<'a> {
    /// The world after the last step.
    pub frame: &'a Frame,
    /// Which of its characters is meant.
    pub own: CharacterId,
    /// Its body.
    pub body: &'a Body,
    /// Length of the step \[s\].
    pub step_secs: f64,
    /// Whether the layer of key poses is on: else pose graphs stay in their states.
    pub has_poses_layer: bool,
}

/// Something that a source has to tell.
#[derive(Clone, Debug, PartialEq)]
pub enum SourceEvent {
    /// A pose graph changed its state.
    Graph {
        /// What made it so.
        cause: Cause,
        /// The graph.
        graph: String,
        /// The state that was left.
        from: String,
        /// The state that begins.
        to: String,
    },
    /// A live performer came or went.
    Stream(StreamChange),
    /// The hands of a reach should be there.
    Reach(ReachArrival),
}

/// Gives the wanted pose of one character.
///
/// Each step of physics: [`advance`](Source::advance) once, then [`wanted`](Source::wanted) and [`firmness`](Source::firmness) as
/// often as the tracker asks ([`Wants`](crate::tracker::Wants)). None of them panics; asked again for the same time they give the same.
///
/// ```
/// use sinew_body::humanoid::Pose;
/// use sinew_control::source::{ClipSource, Source};
/// use sinew_control::{Root, Wanted};
/// let mut ahead = Pose::STANDING;
/// ahead.hips_position.z = 0.1;
/// let clip: Box<dyn Source> = Box::new(ClipSource::of_poses(vec![Pose::STANDING, ahead], 60.0, 0.0));
/// let mut wanted = Wanted::STANDING;
/// clip.wanted(0.5 / 60.0, &mut wanted);
/// assert_eq!(wanted.root, Root::Placed);
/// assert!((wanted.pose.hips_position.z - 0.05).abs() < 1e-12);
/// ```
pub trait Source: Any + Debug + Send + Sync {
    /// Goes on by a step of physics. What is to be told is put behind `events`.
    fn advance(&mut self, moment: &Moment, events: &mut Vec<SourceEvent>) {
        let _ = (moment, events);
    }

    /// A word for pose graphs that wait for it.
    fn signal(&mut self, word: &str) {
        let _ = word;
    }

    /// Whether it says where the hips are.
    fn root(&self) -> Root;

    /// Writes what is wanted at a time of the stage at or soon after the end of the step \[s\]: the joints' rotations and velocities,
    /// the root, and where that is placed the pose. Gains, damping and torques are left alone.
    fn wanted(&self, at_secs: f64, wanted: &mut Wanted);

    /// Writes how firmly each joint is to be held: gains and damping. The joints' own, unless the source says otherwise.
    fn firmness(&self, wanted: &mut Wanted) {
        for joint in &mut wanted.joints {
            (joint.gain, joint.damping) = (1.0, 1.0);
        }
    }

    /// All poses of a motion that is known beforehand, at its own constant rate. Such a source can be asked for any time.
    fn motion(&self) -> Option<&[Pose]> {
        None
    }

    /// Acts again after another source did: it was left at one time of the stage and goes on at another \[s\], where a pose stands.
    fn resume(&mut self, body: &Body, left_secs: f64, now_secs: f64, at: &Pose) {
        let _ = (body, left_secs, now_secs, at);
    }

    /// Sets out from where the body is: something else has moved it until now.
    fn take_over(&mut self, character: &CharacterFrame) {
        let _ = character;
    }
}
