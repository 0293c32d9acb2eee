//! The job of `sinew respond`: a clip and pushes in; motion, report and picture out.

mod answer;
mod draw;
mod job;
mod panels;
mod report;

pub use answer::Answer;
pub use draw::{movie, sheet};
pub use job::{RespondError, RespondJob, respond};
pub use report::{PushReport, RespondReport};
