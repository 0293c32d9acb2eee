//! The job of `sinew ground`: a clip that floats, drifts or shakes in; the clip on its floor, a report and a picture out.

mod draw;
mod job;
mod report;

pub use draw::{movie, sheet};
pub use job::{GroundError, GroundJob, Grounded, ground};
pub use report::GroundReport;
