//! What drives a body in a world.

mod command;
mod target;

pub use command::{Action, Command, Layer};
pub use target::{JointTarget, Target};
