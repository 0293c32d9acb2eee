//! Physical response of a motion to pushes: dynamics in near-unactuated coordinates.
//!
//! The method of Y. Ye and C. K. Liu, *Animating Responsive Characters with Dynamic Constraints in Near-Unactuated
//! Coordinates* (2008), made robust on captured motion. Once per clip, inverse dynamics finds the torques that the
//! motion uses ([`torques`]); the directions in which it uses least are its near-unactuated coordinates ([`Basis`]).
//! Per frame, one small optimisation ([`Response::step`]) finds the next pose of the upper body: it satisfies the
//! equations of motion in those coordinates and follows the motion in all others. So a pushed character is compliant
//! where its own motion uses little torque, and recovers in its own style; there are no gains to tune and no simulator.
//!
//! ```
//! use sinew_body::humanoid::{Body, Node, Pose};
//! use sinew_response::{PointForce, Prepared, Settings};
//! use glam::DVec3;
//!
//! // A body that stands still; an engine hands over the pose of its animation each frame.
//! let standing = vec![Pose::STANDING; 60];
//! let prepared = Prepared::of_poses(Body::standard(80.0, 1.7), standing, Settings::default())?;
//! let mut response = prepared.response(&Pose::STANDING);
//!
//! let push = PointForce::at_centre(Node::LeftHand, DVec3::new(0.0, 0.0, -100.0));
//! for frame in 0..10 {
//!     let forces = if frame < 6 { &[push][..] } else { &[] };
//!     let pose = response.step(&Pose::STANDING, forces);
//!     assert!(pose.is_finite());
//! }
//! assert!(response.deviation().turns[Node::LeftUpperArm.index()].length() > 0.05);
//! # Ok::<(), sinew_response::PrepareError>(())
//! ```
//!
//! It has no feature, and brings along fewer than 30 crates.
//!
//! What it does not do: worlds, engines, files; steps, stumbles and falls.

mod basis;
mod clearance;
mod deflection;
mod force;
mod grip;
mod head;
mod hips;
mod input;
mod limits;
mod live;
mod motion;
mod objective;
#[cfg(test)]
mod objective_tests;
#[cfg(test)]
mod oracle;
mod prepared;
mod prepared_clip;
mod push;
mod response;
mod settings;
mod solve;
mod stability;
mod task;
mod torque;
mod track;
mod upper_body;

pub use basis::{Basis, BasisError};
pub use deflection::{Deflection, StanceDeviation};
pub use force::PointForce;
pub use live::Live;
pub use motion::Motion;
pub use prepared::{PrepareError, Prepared};
pub use prepared_clip::{Excerpt, PreparedClip};
pub use push::{GroundJerk, Push, PushFrame};
pub use response::{Report, Response};
pub use settings::{Coordinates, Preset, Settings, SettingsError};
pub use task::Task;
pub use torque::torques;
pub use track::{Disturbances, Track};

/// The optimisation of one frame by itself, for benchmarks on other bodies.
#[doc(hidden)]
pub mod bench {
    pub use crate::objective::{Frame, Objective, Row, Weighing};
}
