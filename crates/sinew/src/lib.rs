//! Sinew makes animated characters answer to physics.
//!
//! This crate is the façade: it re-exports the rooms of the library and holds the jobs that the command line runs.
//!
//! | module | is the place for |
//! |---|---|
//! | [`motion`] | skeletons, clips, motion files |
//! | [`body`] | masses, limits, kinematics and dynamics |
//! | [`response`] | a motion answers to pushes |
//! | [`world`] | rigid bodies, ragdolls, props, contacts |
//! | [`control`] | key poses, pose graphs, reflexes, trackers |
//! | [`script`] | controllers in Python |
//! | [`stage`] | scenes that run, takes |
//! | [`live`] | performers and sessions over a network |
//! | [`picture`] | filmstrips and plots |
//! | [`respond`] | the whole job of `sinew respond`: a file in, an answered file out |
//! | [`reaching`] | somebody reaches a target: a source of poses |
//! | [`reach`] | the whole job of `sinew reach`: a target in, a motion out |
//! | [`run`] | the whole job of `sinew run`: a scene in, motion, picture and report out |
//! | `session` | `sinew serve` and `sinew join`: one stage, actors on several machines (feature `session`) |
//! | [`sample`] | a walk that Sinew makes itself |
//! | [`inspect`] | what a motion file is and what Sinew makes of it |

pub use sinew_body as body;
pub use sinew_control as control;
pub use sinew_live as live;
pub use sinew_motion as motion;
pub use sinew_picture as picture;
pub use sinew_reach as reaching;
pub use sinew_response as response;
pub use sinew_script as script;
pub use sinew_stage as stage;
pub use sinew_world as world;

pub mod figure;
pub mod inspect;
pub mod reach;
pub mod respond;
pub mod run;
pub mod sample;
#[cfg(feature = "session")]
pub mod session;

/// The README's Rust examples compile.
#[cfg(doctest)]
#[doc = include_str!("../../../README.md")]
struct Readme;
