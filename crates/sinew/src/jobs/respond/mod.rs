//! A clip answers to pushes: the whole job.

mod answer;
mod draw;
mod job;
mod report;

pub use answer::Answer;
pub use draw::sheet;
pub use job::{RespondError, RespondJob, respond};
pub use report::{PushReport, RespondReport};
