//! How a body follows its target.

mod clock;
mod felt;
mod gains;
mod glide;
mod hold;
mod instant;
mod kd;
mod kinematic;
mod pd;
mod response;
mod tasks;

pub use gains::{Gains, JointGain};
pub use hold::Grip;
pub use kd::{KdDamping, KdGains, KdPreset, KdSettings, KdTracker, KdWeight};
pub use kinematic::KinematicTracker;
pub use pd::PdTracker;
pub use response::ResponseTracker;
