//! The walk that stands in where no motion is at hand.

use sinew_body::walk::{Walk, WalkError};
use sinew_motion::formats::{WriteJob, bvh};

/// Why the sample walk cannot be had.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum SampleWalkError {
    /// It cannot be made.
    #[error(transparent)]
    Walk(#[from] WalkError),
    /// It cannot be written.
    #[error(transparent)]
    File(#[from] sinew_motion::Error),
}

/// [`Walk::default`] as a BVH file in centimetres: the bytes of `samples/walk.bvh`, made anew, so that no file has to come along.
/// It takes a few milliseconds.
///
/// # Errors
/// None that is known: the default walk is within its ranges.
pub fn sample_walk_bvh() -> Result<Vec<u8>, SampleWalkError> {
    let clip = Walk::default().clip()?;
    let mut bytes = Vec::new();
    bvh::write(&mut bytes, &WriteJob { clip: &clip, source: None })?;
    Ok(bytes)
}
