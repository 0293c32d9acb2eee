//! Sinew makes animated characters answer to physics.
//!
//! This crate is the façade: it re-exports the rooms of the library and holds the jobs that the command line runs.
//!
//! | module | is the place for |
//! |---|---|
//! | [`motion`] | skeletons, clips, motion files |
//! | [`body`] | masses, limits, kinematics and dynamics |
//! | [`response`] | a motion answers to pushes |
//! | [`reach`] | somebody reaches a target: a source of poses |
//! | [`world`] | rigid bodies, ragdolls, props, contacts |
//! | [`control`] | key poses, pose graphs, reflexes, trackers |
//! | [`script`] | controllers in Python |
//! | [`stage`] | scenes that run, takes |
//! | [`live`] | performers and sessions over a network |
//! | [`picture`] | filmstrips and plots |
//! | [`jobs`] | what the program `sinew` does, as library calls |
//! | [`sample`] | a walk that Sinew makes itself |

pub use sinew_body as body;
pub use sinew_control as control;
pub use sinew_live as live;
pub use sinew_motion as motion;
pub use sinew_picture as picture;
pub use sinew_reach as reach;
pub use sinew_response as response;
pub use sinew_script as script;
pub use sinew_stage as stage;
pub use sinew_world as world;

pub mod figure;
pub mod jobs;
pub mod sample;

/// The README's Rust examples compile.
#[cfg(doctest)]
#[doc = include_str!("../../../README.md")]
struct Readme;
