//! Takes: a scene's files, and every command with its step. Replayed it gives the same bits.
//!
//! A take is a text file of JSON lines: a header, the files, the commands, and an end with the hash that the replay must
//! reach.

mod error;
mod line;
mod read;
mod record;
mod scene;
mod write;

pub use error::{TakeError, TakeErrorKind};
pub use record::{HashTrace, Stamped, TAKE_FORMAT, Take, TakeFile, due};
