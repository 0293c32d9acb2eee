//! Skeletons, clips and motion files: kinematics, without masses.
//!
//! Inside Sinew a clip is in metres, right-handed, Y up, whatever its file said ([`SourceSpace`] remembers the
//! difference). Body parts are named as VRM 1.0 humanoid bones ([`Part`]).
//!
//! This crate does not know masses, forces or time stepping.

mod clip;
mod defects;
mod error;
mod facing;
mod filter;
mod floor;
mod gait;
mod humanoid;
mod limits;
mod note;
mod part;
mod pose;
mod repeat;
mod resample;
mod skeleton;
mod space;
mod space_guess;
mod stature;
mod transform;

#[cfg(feature = "formats")]
pub mod formats;

pub use clip::Clip;
pub use defects::{Defect, DefectKind, find_defects, moves_from};
pub use error::{Error, Place};
pub use facing::{facing, facings, heading};
pub use filter::{DEFAULT_CUTOFF_HZ, LowPass, LowPassStream, PoseStream, filter};
pub use floor::{Contacts, contacts, floor_height_m};
pub use gait::{Cycle, find_cycle};
pub use humanoid::{Humanoid, Origin};
pub use limits::Limits;
pub use note::Note;
pub use part::{Part, Side, UnknownPart};
pub use repeat::{Repeated, repeat};
pub use resample::resample;
pub use skeleton::{Joint, Skeleton};
pub use space::SourceSpace;
pub use space_guess::{SpaceGuess, UnitCandidate, guess_space};
pub use stature::stature;
pub use transform::Transform;
