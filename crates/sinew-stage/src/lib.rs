//! A scene file becomes a running stage.
//!
//! [`scene`] reads the file, [`Stage`] runs it, [`Runner`] drives its steps: the pace of real time, observers, the
//! [`Recording`] of its motion, the [`take`] of its commands.
//!
//! ```
//! use sinew_control::{Action, Command};
//! use sinew_stage::{Runner, Scene, Stage};
//!
//! let scene = Scene::from_text("format = 1\n[characters.one]\npose = \"stand\"\n")?;
//! let mut runner = Runner::new(Stage::new(scene, None)?).with_motion().with_take();
//! let force_n = [0.0, 0.0, 60.0];
//! let push = Action::Push { on: "chest".into(), force_n, for_secs: 0.1, facing: false, at_m: None };
//! runner.stage_mut().command(Command::to("one", push));
//! runner.run(60, &mut []);
//! let done = runner.finish();
//! assert_eq!(done.recording.map(|recording| recording.frames), Some(16));
//! assert_eq!(done.take.map(|take| take.commands.len()), Some(1));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! | feature | gives |
//! |---|---|
//! | `threads` | `Stage::set_threads` may use more than one thread; same bits |
//!
//! Brings along fewer than 100 crates.
//!
//! What it does not do: pictures, sockets, the command line. Python runs in another process, whose program the caller names.

mod actor;
mod actor_snapshot;
mod apply;
mod apply_reach;
mod basis;
mod build;
mod cast;
mod edit;
mod event;
mod fade;
mod heading;
mod motion_source;
pub mod order;
mod own_rig;
mod pacer;
mod packed;
mod populate;
mod reach_aim;
mod reach_through;
mod reaction;
mod recording;
mod run_hash;
mod runner;
mod sample_walk;
pub mod scene;
mod script_snapshot;
mod scripts;
mod snapshot;
mod snapshot_bytes;
mod snapshots;
mod source_context;
mod stage;
mod step;
mod step_actors;
pub mod take;
mod timed_effect;
mod timeline;

pub use actor::Actor;
pub use apply_reach::ReachNow;
pub use build::{StageError, StageErrorKind};
pub use cast::Cast;
pub use edit::{EditError, EditOutcome, Edited, RestartReason};
pub use event::{Cause, CharacterEffect, Effect, Event, Events, ReachTarget};
pub use order::Order;
pub use own_rig::OwnRig;
pub use pacer::Pacer;
pub use recording::{RecordedCharacter, RecordedProp, Recording};
pub use runner::{Finished, Observer, Runner};
pub use sample_walk::{SampleWalkError, sample_walk_bvh};
pub use scene::{Scene, SceneError, SceneErrorKind, scene_schema};
pub use snapshot::{RestoreError, StageSnapshot};
pub use snapshot_bytes::{SNAPSHOT_VERSION, SnapshotBytesError};
pub use stage::Stage;
pub use take::{Take, TakeError, TakeErrorKind};
pub use timeline::{KnownTake, SeekError, Timeline};
