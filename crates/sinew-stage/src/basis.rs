//! The near-unactuated coordinates of a responding character: of its own clip, or the shipped walk's.

use crate::motion_source::reduction;
use crate::scene::CharacterSpec;
use sinew_body::humanoid::{Body, Pose};
use sinew_motion::formats::{MotionFile, ReadOptions};
use sinew_response::{Basis, Motion, Settings, stable_compliance};

/// The walk that lends its coordinates to characters without a clip of their own.
const SAMPLE_WALK: &[u8] = include_bytes!("../../../samples/walk.bvh");

/// Longest stretch of a clip that is looked at, in frames: ten seconds at 60 Hz show any style.
const MAX_FRAMES: usize = 600;

pub(crate) fn basis_for(
    spec: &CharacterSpec,
    body: &Body,
    motion: Option<&[Pose]>,
    frame_secs: f64,
) -> Result<(Basis, Settings), String> {
    let settings = Settings { time_step_secs: frame_secs, compliance: spec.response.compliance, ..Settings::default() };
    let (sample, poses);
    let poses = match motion {
        Some(motion) => &motion[..motion.len().min(MAX_FRAMES)],
        None => {
            sample = MotionFile::from_bvh(SAMPLE_WALK, &ReadOptions::default()).map_err(|error| error.to_string())?;
            let reduction = reduction(&sample, spec)?;
            poses = Motion::of_clip(&sample.clip, &reduction, 0, &settings);
            poses.poses()
        }
    };
    let basis = Basis::of_motion(body, poses, &settings).map_err(|error| error.to_string())?;
    let compliance = stable_compliance(body, &basis, &settings, poses);
    Ok((basis, Settings { compliance, ..settings }))
}
