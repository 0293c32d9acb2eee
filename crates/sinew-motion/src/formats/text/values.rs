//! Limits of both text formats.

use crate::{Error, Limits, Place};

/// An error when `frames` frames of so many channels and joints are more than the limits allow.
///
/// A joint counts as three values even without channels: it costs a rotation in every frame of the clip.
pub(crate) fn too_many_frames(limits: &Limits, frames: usize, channels: usize, joints: usize) -> Result<(), Error> {
    let values = frames.saturating_mul(channels.max(joints.saturating_mul(3)));
    let (count, limit, name) = if frames > limits.frames {
        (format!("{frames} frames or more"), limits.frames, "frames")
    } else if values > limits.values {
        (
            format!("{values} values or more (frames times channels, at least three for a joint)"),
            limits.values,
            "values",
        )
    } else {
        return Ok(());
    };
    let problem = format!("the motion has {count}, the limit is {limit}");
    Err(Error::new(Place::File, problem, format!("cut the motion into shorter files or raise the limit `{name}`")))
}

/// The problem if a skeleton has more joints than the limits allow, or nests them deeper.
pub(crate) fn too_many_joints(limits: &Limits, joints: usize, depth: usize) -> Option<(String, &'static str)> {
    if joints > limits.joints {
        let problem = format!("the skeleton has more than {} joints", limits.joints);
        Some((problem, "remove unused joints or raise the limit `joints`"))
    } else if depth > limits.depth {
        let problem = format!("joints are nested more than {} deep", limits.depth);
        Some((problem, "check for missing closing braces, or raise the limit `depth`"))
    } else {
        None
    }
}
