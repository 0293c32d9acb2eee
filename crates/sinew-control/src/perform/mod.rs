//! A live performer as the source of the wanted pose.
//!
//! A capture stream, whatever its protocol, becomes [`PerformerSample`]s; each reaches the stage as a command, so that a take of
//! a live session replays to the same bits. [`LiveSource`] does everything else, step by step and without a clock of its own:
//!
//! ```text
//! sample ─▶ outlier_filter ─▶ alignment ─▶ buffer ─▶ playhead ─▶ blend ─▶ One-Euro filter ─▶ Wanted
//!           counters   performer    by time    clock of    hold,
//!                      to body                 the sender  relax, return
//! ```
//!
//! Nguyen et al. 2010, section 3.1, took their capture system's poses as they came; over a network they arrive late,
//! twice, out of order or not at all.

mod align;
mod blend;
mod buffer;
mod clock;
mod counters;
mod live_spec;
mod numbers;
mod one_euro;
mod outlier_filter;
mod sample;
mod settings;
mod source;
mod tpose;

pub use counters::PerformCounters;
pub use live_spec::LiveSpec;
pub use sample::{BodyProportions, PerformerSample, SampleStatus};
pub use settings::LiveSettings;
pub use source::{LiveSource, Presence};
pub use tpose::{TPose, pose_of, turns_of};
