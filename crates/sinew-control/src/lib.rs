//! What drives a body in a world.

mod command;
pub mod graph;
pub mod ik;
mod order_error;
pub mod perform;
pub mod pose;
mod reach_order;
pub mod reflex;
mod target;
pub mod tracker;

pub use command::{Action, Command, Layer};
pub use graph::GraphSpec;
pub use order_error::{OrderError, OrderErrorKind};
pub use pose::PoseSpec;
pub use reach_order::{ReachHand, ReachOrder};
pub use target::{JointTarget, Target};
