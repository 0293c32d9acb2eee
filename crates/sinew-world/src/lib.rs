//! The rigid-body world: characters (ragdolls), props, joints, contacts, attachments, modified physics.
//!
//! The rigid-body library (Rapier) is an implementation detail of this crate: none of its types is public, so that
//! another solver could replace it. This crate does not know where poses come from.
//!
//! ```
//! use glam::DVec3;
//! use sinew_world::{Form, Motion, PropSpec, Solid, World, WorldSettings};
//!
//! let mut world = World::new(WorldSettings::default());
//! let ball = Solid::new(Form::Ball { radius_m: 0.1 });
//! world.add_prop(PropSpec::new(ball, Motion::Dynamic { mass_kg: 1.0 }, DVec3::new(0.0, 1.0, 0.0)))?;
//! for _ in 0..240 {
//!     world.step();
//! }
//! // It has fallen on the ground.
//! assert!(world.frame().props[0].position.y < 0.11);
//! # Ok::<(), sinew_world::SpecError>(())
//! ```
//!
//! | feature | gives |
//! |---|---|
//! | `threads` | `World::set_threads` may use more than one thread; same bits |
//!
//! Brings along fewer than 65 crates.
//!
//! What it does not do: where poses come from, files.

mod attachment;
mod character;
mod character_snapshot;
mod check;
mod clone;
mod collision_filter;
mod drive;
mod engine;
mod external_force;
mod extra_shape;
mod frame;
pub mod frame_bytes;
mod id;
mod joint;
mod library_bytes;
mod nearest;
mod pin;
mod plane;
mod prop;
mod prop_joint;
mod ragdoll;
mod reaction_body;
mod readback;
mod remove;
mod rows;
mod sanitize;
mod settings;
mod sliding;
mod slots;
mod snapshot;
mod solid;
mod spec;
mod warm_start;
mod world;

pub use attachment::Held;
pub use check::{CHECKED_SECS, RagdollReport, check_ragdoll};
pub use drive::Drive;
pub use external_force::{ExternalForce, ExternalForces};
pub use frame::{BodyState, CharacterFrame, Contact, Entity, Frame};
pub use id::{CharacterId, PropId, PropJointId, SlotId};
pub use nearest::Nearest;
pub use pin::Pin;
pub use prop_joint::{Aim, Motor, PropJointKind, PropJointSpec, PropJointState};
pub use ragdoll::{hips_over_soles_m, never_collide, outboard_inertias, part_solid, sole_m};
pub use settings::{Surface, WorldSettings};
pub use slots::Slots;
pub use solid::{Form, RING_PIECES, Solid, ring_corners};
pub use spec::{CharacterSpec, Motion, PropSpec, SpecError};
pub use world::{MAX_FORCE_N, PartShape, World};
