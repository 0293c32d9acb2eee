//! What the claims share: captured clips, ready to be pushed, and what a push does to them.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

mod case;
mod push;
mod sweep;

pub use case::{Case, PERSON};
pub use push::{DIRECTIONS, PARTS, PHASES, push, starts};
pub use sweep::{Kind, Run, adults, every_adult, every_child, mean, sweep};
