//! Motion files, read and written.
//!
//! A reader turns bytes into a [`Parsed`]: the motion in the file's own units and axes, and a [`Document`] that
//! remembers the file well enough to write it again with nothing changed but what the user asked for.

pub mod amc;
pub mod bvh;
mod document;
mod text;

pub use document::{Document, Format, Parsed, Source, WriteJob};
