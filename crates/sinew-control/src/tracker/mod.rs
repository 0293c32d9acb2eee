//! How a body follows its target.

mod gains;
mod pd;

pub use gains::{Gains, JointGain};
pub use pd::PdTracker;
