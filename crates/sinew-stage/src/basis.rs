//! What a responding character responds by: the near-unactuated coordinates of its own clip, or the shipped walk's.

use crate::motion_source::reduction;
use crate::sample_walk_bvh;
use crate::scene::CharacterSpec;
use sinew_body::humanoid::{Body, Pose};
use sinew_motion::formats::{MotionFile, ReadOptions};
use sinew_response::{Motion, Prepared, Settings};

/// Longest stretch of a clip that is looked at, in frames: ten seconds at 60 Hz show any style.
const MAX_FRAMES: usize = 600;

/// Prepares a body for the tracker `response`. `settings` state the time step and the world's gravity.
pub(crate) fn prepared(
    spec: &CharacterSpec,
    body: &Body,
    motion: Option<&[Pose]>,
    settings: Settings,
) -> Result<Prepared, String> {
    let settings = Settings { compliance: spec.response.compliance, ..settings };
    let poses = match motion {
        Some(motion) => motion[..motion.len().min(MAX_FRAMES)].to_vec(),
        None => {
            // The sample walk lends its coordinates to characters without a clip of their own.
            let bytes = sample_walk_bvh().map_err(|error| error.to_string())?;
            let sample = MotionFile::from_bvh(&bytes, &ReadOptions::default()).map_err(|error| error.to_string())?;
            Motion::of_clip(&sample.clip, &reduction(&sample, spec)?, 0, &settings).poses().to_vec()
        }
    };
    Prepared::of_poses(body.clone(), poses, settings).map_err(|error| error.to_string())
}
