//! `sinew serve` and `sinew join` as library calls: one stage, actors on several machines.
//!
//! The protocol is in [`sinew_live::session`], which is re-exported here.

mod join;
mod reach;
mod serve;

pub use join::{JoinReport, View};
pub use reach::reached;
pub use serve::{ServeJob, ServeReport, Served, serve};
pub use sinew_live::session::*;
