//! What drives a body in a world: [`source`]s say what is wanted, [`tracker`]s make the body follow it.
//!
//! ```
//! use glam::DVec3;
//! use sinew_body::humanoid::{Body, Pose};
//! use sinew_control::perform::{LiveSettings, LiveSource, PerformerSample};
//!
//! // A live performer as a source of poses: samples in as they come, a pose out whenever one is wanted.
//! let body = Body::standard(80.0, 1.7);
//! let performer = Body::standard(60.0, 1.5);
//! let mut source = LiveSource::new(&body, DVec3::ZERO, 0.0, &Pose::STANDING, LiveSettings::default());
//! for step in 0..240u32 {
//!     let now_secs = f64::from(step) / 240.0;
//!     if step % 4 == 0 {
//!         source.receive(&PerformerSample::of_pose(now_secs, &Pose::STANDING, &performer), now_secs);
//!     }
//!     source.advance(now_secs, 1.0 / 240.0);
//! }
//! assert_eq!(source.counters().received, 60);
//! ```
//!
//! It has no feature, and brings along fewer than 85 crates.
//!
//! What it does not do: scenes, sockets, running Python.

mod command;
mod free_root;
pub mod graph;
pub mod ik;
mod order_error;
pub mod perform;
pub mod pose;
pub mod range;
mod reach_order;
pub mod reflex;
pub mod source;
mod text_snapshot;
pub mod tracker;
mod wanted;

pub use command::{Action, Command, Layer};
pub use free_root::FreeRoot;
pub use graph::GraphSpec;
pub use order_error::{OrderError, OrderErrorKind};
pub use pose::PoseSpec;
pub use reach_order::{ReachHand, ReachOrder};
pub use wanted::{JointTarget, Root, Wanted};
