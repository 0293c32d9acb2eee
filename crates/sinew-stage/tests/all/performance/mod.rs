//! The scenes of a performer in a physical world show what Nguyen et al. 2010, section 6, say of them.

#![allow(clippy::unwrap_used, clippy::disallowed_methods, reason = "tests")]

mod balloon;
mod car;
mod giant;
mod sit_on_box;
mod stage;
mod tetherball;
mod tug_of_war;
