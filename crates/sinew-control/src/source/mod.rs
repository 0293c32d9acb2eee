//! Sources of the wanted pose: the [`Source`], its kinds, and [`Sources`], which decides their precedence.

mod blend;
mod clip;
mod hand_over;
mod key_poses;
mod kinds;
mod performer;
mod reach;
mod sources;
mod sources_snapshot;
mod spec;

pub use clip::ClipSource;
pub use hand_over::{HAND_OVER_SECS, handed_over};
pub use key_poses::{KeyPoses, PoseBook};
pub use kinds::{ClipFile, ClipPlay, GraphName, PoseName};
pub use performer::{Performer, StreamChange};
pub use reach::{Aimed, HANDS, HandArrival, ReachArrival, ReachSource};
pub use sources::{Sources, no_performer};
pub use spec::{Named, SOURCE_KINDS, SourceContext, SourceFault, SourceKind, SourceSpec};

use crate::graph::Cause;
use crate::{Root, Wanted};
use sinew_body::humanoid::{Body, Pose};
use sinew_snapshot::Snapshot;
use sinew_world::{CharacterFrame, CharacterId, Frame};
use std::any::Any;
use std::fmt::Debug;
use std::sync::Arc;

/// The input of a source for a physics step.
#[derive(Clone, Copy, Debug)]
pub struct Moment<'a> {
    /// The world after the last step.
    pub frame: &'a Frame,
    /// The character.
    pub own: CharacterId,
    /// Its body.
    pub body: &'a Body,
    /// Length of the step \[s\].
    pub step_secs: f64,
    /// Whether the layer of key poses is on: else pose graphs stay in their states.
    pub has_poses_layer: bool,
}

/// An event of a source.
#[derive(Clone, Debug, PartialEq)]
pub enum SourceEvent {
    /// A pose graph changed its state.
    Graph {
        /// Its cause.
        cause: Cause,
        /// The graph.
        graph: String,
        /// The state that was left.
        from: String,
        /// The state that begins.
        to: String,
    },
    /// The state of a live performer's stream changed.
    Stream(StreamChange),
    /// The hands of a reach should be there.
    Reach(ReachArrival),
}

/// Gives the wanted pose of one character.
///
/// What it remembers is kept by [`Snapshot`], and restored into a source that was built in the same way.
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
pub trait Source: Snapshot + Any + Debug + Send + Sync {
    /// A copy of it with all its state, which goes on to the same bits: a snapshot of a stage holds one. Motions that do not change are
    /// shared (`Arc`), not copied.
    fn cloned(&self) -> Box<dyn Source>;

    /// Advances by a physics step. Events are appended to `events`.
    fn advance(&mut self, moment: &Moment, events: &mut Vec<SourceEvent>) {
        let _ = (moment, events);
    }

    /// Key poses and graphs were read anew. What has none does nothing.
    fn set_book(&mut self, book: &Arc<PoseBook>) {
        let _ = book;
    }

    /// A signal for pose graphs.
    fn signal(&mut self, word: &str) {
        let _ = word;
    }

    /// Whether it has root motion: it places the hips.
    fn root(&self) -> Root;

    /// Writes the wanted pose at a time of the stage at or soon after the end of the step \[s\]: the joints' rotations
    /// and velocities, the root, and the pose if the root is placed. Gains, damping and torques do not change.
    fn wanted(&self, at_secs: f64, wanted: &mut Wanted);

    /// Writes the gains and damping of each joint. Default: the joints' own.
    fn firmness(&self, wanted: &mut Wanted) {
        for joint in &mut wanted.joints {
            (joint.gain, joint.damping) = (1.0, 1.0);
        }
    }

    /// All poses of a motion that is known beforehand, at its own constant rate, low-passed where it knows them so. Such a source can be asked for any time.
    fn motion(&self) -> Option<&[Pose]> {
        None
    }

    /// Resumes after another source: it was left at one time of the stage and continues at another \[s\], at the
    /// position of a pose.
    fn resume(&mut self, body: &Body, left_secs: f64, now_secs: f64, at: &Pose) {
        let _ = (body, left_secs, now_secs, at);
    }

    /// Starts at the body's present pose: something else has moved it until now.
    fn match_body(&mut self, character: &CharacterFrame) {
        let _ = character;
    }
}

impl Clone for Box<dyn Source> {
    fn clone(&self) -> Box<dyn Source> {
        self.as_ref().cloned()
    }
}
