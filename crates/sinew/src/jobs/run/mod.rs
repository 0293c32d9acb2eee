//! `sinew run` and `sinew replay` as library calls: a stage runs, and its motion goes into files and pictures.

mod actors;
mod draw;
mod export;
mod external_force;
mod job;
mod reaches;
mod report;

pub use actors::{ActorReport, LatencyReport};
pub(crate) use draw::custom;
pub use draw::{figure, sheet};
pub use export::{body_shapes, character_clip, csv, scene_clip};
pub use external_force::ExternalForceReport;
pub use job::{Ran, RunError, RunJob, replay, run};
pub use report::RunReport;
