//! The job of `sinew reach`: a target in; motion, report and picture out.

mod draw;
mod job;
mod report;

pub use draw::{contact_sheet, movie, sheet};
pub use job::{Ball, Hand, MovingPoint, ReachError, ReachJob, Reached, reach};
pub use report::{ReachReport, StepReport};
