//! Key poses: their file format, their resolution on a body, and the player that blends from one to the next.

mod error;
mod file;
mod key_pose;
pub(crate) mod number;
mod part_name;
mod player;
mod resolve;
mod spec;

pub use error::{PoseError, PoseFileError};
pub use file::{MAX_FILE_BYTES, PoseFile, read_poses};
pub use key_pose::{BLEND_SECS, KeyPose, angles_deg, rotation_of};
pub use part_name::{PartName, UnknownPartName};
pub use player::PosePlayer;
pub use resolve::{MAX_POSES, STAND, resolve_poses};
pub use spec::{FullJointSpec, IkSpec, JointSpec, PoseSpec};

/// A list of names for a message, shortened.
pub(crate) fn list(names: &[&str]) -> String {
    const MAX_NAMES: usize = 40;
    let shown: Vec<String> = names.iter().take(MAX_NAMES).map(|name| name.chars().take(60).collect()).collect();
    let more = if names.len() > MAX_NAMES { ", ..." } else { "" };
    format!("{}{more}", shown.join(", "))
}
