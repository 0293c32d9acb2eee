//! `sinew run` and `sinew replay` as library calls: a stage runs, and what it showed goes into files and pictures.

mod actors;
mod draw;
mod export;
mod job;
mod reaches;
mod report;
mod spent;

pub use actors::{ActorReport, LatencyReport};
pub(crate) use draw::custom;
pub use draw::{figure, sheet};
pub use export::{body_shapes, character_clip, csv, scene_clip};
#[cfg(feature = "session")]
pub(crate) use job::{MOST_SECS, TRACE_STEPS};
pub use job::{Ran, RunError, RunJob, replay, run};
pub use report::RunReport;
pub use spent::SpentReport;
