//! Skeletons, clips and motion files: everything about *how a body moves* that can be said without masses.
//!
//! Inside Sinew a clip is in metres, right-handed, Y up, whatever its file said ([`SourceSpace`] remembers the
//! difference). Body parts are named as VRM 1.0 humanoid bones ([`Part`]).
//!
//! This crate knows nothing of masses, forces or time stepping.

mod clip;
mod error;
mod humanoid;
mod limits;
mod note;
mod part;
mod pose;
mod skeleton;
mod space;
mod space_guess;
mod stature;
mod transform;

#[cfg(feature = "formats")]
pub mod formats;

pub use clip::Clip;
pub use error::{Error, Place};
pub use humanoid::{Humanoid, Origin};
pub use limits::Limits;
pub use note::Note;
pub use part::{Part, Side};
pub use skeleton::{Joint, Skeleton};
pub use space::SourceSpace;
pub use space_guess::{SpaceGuess, UnitCandidate, guess_space};
pub use stature::stature;
pub use transform::Transform;
