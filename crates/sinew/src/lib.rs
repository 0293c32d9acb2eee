//! Sinew makes animated characters respond to physics: pushed, they yield and recover in their own style; in a physical
//! world they follow key poses, clips, scripts or a live performer, and reach for things.
//!
//! This crate is the library in one: it re-exports the rooms, and [`jobs`] ties them together as the program `sinew` does.
//!
//! ```
//! use sinew::jobs::run::{RunJob, run};
//! use sinew::stage::Scene;
//!
//! // A scene as text; what it showed as a report, a recording and a take that runs again to the same bits.
//! let scene = Scene::from_text("format = 1\n[characters.one]\npose = \"stand\"\nreflexes = [\"balance\"]\n")?;
//! let ran = run(scene, &RunJob { for_secs: Some(0.25), ..RunJob::default() }, &mut [])?;
//! assert_eq!((ran.report.steps, ran.recording.frames), (60, 16));
//! # Ok::<(), sinew::jobs::run::RunError>(())
//! ```
//!
//! | module | is the place for |
//! |---|---|
//! | [`motion`] | skeletons, clips, motion files |
//! | [`body`] | masses, limits, kinematics and dynamics |
//! | [`response`] | the response of a motion to pushes |
//! | [`reach`] | reaching for targets: a source of poses |
//! | [`world`] | rigid bodies, ragdolls, props, contacts |
//! | [`control`] | key poses, pose graphs, reflexes, trackers |
//! | [`script`] | controllers in Python, in another process |
//! | [`stage`] | scenes that run, takes |
//! | [`live`] | performers and sessions over a network |
//! | [`picture`] | filmstrips and plots |
//! | [`snapshot`] | state as bytes |
//! | [`jobs`] | what the program `sinew` does, as library calls |
//!
//! | feature | gives |
//! |---|---|
//! | `session` | one stage for actors on several machines; brings QUIC and tokio along |
//! | `threads` | crowds step on several threads; same bits |
//!
//! Brings along fewer than 130 crates; with `session` about 40 more. Each room is a crate of its own, for smaller
//! dependencies: `sinew-response` alone, pose in and pose out, brings fewer than 30.
//!
//! What it does not do: arguments, terminals, running Python in your process.

pub use sinew_body as body;
pub use sinew_control as control;
pub use sinew_live as live;
pub use sinew_motion as motion;
pub use sinew_picture as picture;
pub use sinew_reach as reach;
pub use sinew_response as response;
pub use sinew_script as script;
pub use sinew_snapshot as snapshot;
pub use sinew_stage as stage;
pub use sinew_world as world;

pub mod figure;
pub mod jobs;

/// The README's Rust examples compile.
#[cfg(doctest)]
#[doc = include_str!("../../../README.md")]
struct Readme;
