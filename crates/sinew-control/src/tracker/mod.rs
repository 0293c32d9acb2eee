//! How a body follows its target.

mod clock;
mod contact_forces;
mod gains;
mod hold;
mod instant;
mod kd;
mod kinematic;
mod pd;
mod pose_interpolator;
mod response;
mod tasks;

pub use gains::{Gains, JointGain};
pub use hold::Grip;
pub use kd::{KdDamping, KdGains, KdPreset, KdSettings, KdTracker, KdWeight};
pub use kinematic::KinematicTracker;
pub use pd::PdTracker;
pub use response::ResponseTracker;
