//! `sinew serve` and `sinew join` as library calls: one stage, actors on several machines. The protocol is in
//! [`sinew_live::session`].

mod first_effect;
mod join;
mod serve;

pub use first_effect::first_effect;
pub use join::{JoinReport, View};
pub use serve::{ServeJob, ServeReport, Served, serve};
