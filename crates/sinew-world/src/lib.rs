//! The rigid-body world in our words.

mod frame;

pub use frame::{BodyState, CharacterFrame, Contact, Entity, Frame};
