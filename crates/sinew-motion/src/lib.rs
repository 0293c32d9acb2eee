//! Skeletons, clips and motion files: kinematics, without masses.
//!
//! Inside Sinew a clip is in metres, right-handed, Y up, whatever its file said ([`SourceSpace`] remembers the
//! difference). Body parts are named as VRM 1.0 humanoid bones ([`Part`]).
//!
//! ```
//! # #[cfg(feature = "formats")] {
//! use sinew_motion::formats::{MotionFile, ReadOptions};
//!
//! let text = "HIERARCHY\nROOT Hips\n{\nOFFSET 0 0 0\n\
//!             CHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation\n\
//!             End Site\n{\nOFFSET 0 10 0\n}\n}\n\
//!             MOTION\nFrames: 2\nFrame Time: 0.02\n0 90 0 0 0 0\n0 90 5 0 0 0\n";
//! let file = MotionFile::from_bvh(text.as_bytes(), &ReadOptions::default())?;
//! assert_eq!(file.clip.frames(), 2);
//! // One joint is no human body, and the error says so.
//! assert!(file.humanoid.is_err());
//! # }
//! # Ok::<(), sinew_motion::Error>(())
//! ```
//!
//! | feature | gives |
//! |---|---|
//! | `formats` (default) | BVH, ASF/AMC and glTF in and out, FBX in; brings base64, serde, serde_json and ufbx along, which needs a C compiler |
//!
//! Brings along fewer than 30 crates; without `formats` nine.
//!
//! What it does not do: masses, forces, time stepping.

mod choice;
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

pub use choice::nearest_name;
pub use clip::Clip;
pub use defects::{Defect, DefectKind, find_defects, moves_from};
pub use error::{Error, Place};
pub use facing::{facing, facings, heading};
pub use filter::{DEFAULT_CUTOFF_HZ, LowPass, LowPassStream, PoseStream, filter};
pub use floor::{Contacts, contacts, floor_height_m};
pub use gait::{Cycle, find_cycle};
pub use humanoid::{BodyHints, Humanoid, Origin};
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
