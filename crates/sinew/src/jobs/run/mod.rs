//! `sinew run` and `sinew replay` as library calls: a stage runs, and its motion goes into files and pictures.

mod actors;
mod draw;
mod export;
mod external_force;
mod footage;
mod job;
mod marks;
mod reaches;
mod report;
mod shapes;

pub use actors::{ActorReport, LatencyReport};
pub use draw::{movie, sheet};
pub use export::{character_clip, character_scene, csv, scene_file};
pub use external_force::ExternalForceReport;
pub use footage::Footage;
pub use job::{Ran, RunError, RunJob, replay, run};
pub use marks::{FrameMarks, HitMark, Marks, PushMark};
pub use report::RunReport;
pub use shapes::body_figure;
pub(crate) use shapes::custom;
