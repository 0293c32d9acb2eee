//! What the tests of the claims share: the captured clips, ready to be pushed, and what a push does to them.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]
#![allow(dead_code, unused_imports, reason = "each test file uses a part")]

mod case;
mod files;
mod push;
mod sweep;

pub use case::{Case, PERSON};
pub use files::{EVERY_CLIP, WALKS, every_bvh, mocap, read, work};
pub use push::{DIRECTIONS, Outcome, PARTS, PHASES, Start, push, starts};
pub use sweep::{Kind, Run, every_walk, mean, none_of, sweep, walks};
