//! A clip's values as the single-precision keys of glTF.

use super::element;
use crate::{Clip, Error, Transform};
use glam::{DQuat, DVec3};

/// Times of the frames \[s\].
pub(super) fn times(clip: &Clip, start_secs: f64) -> Result<Vec<f32>, Error> {
    let time = |frame: usize| (start_secs + frame as f64 * clip.frame_time_secs()) as f32;
    let times: Vec<f32> = (0..clip.frames()).map(time).collect();
    if times.is_empty() {
        return Err(element("animations[0]", "the clip has no frames", "give it at least one"));
    }
    if times.windows(2).any(|pair| pair[0] >= pair[1]) || !times[times.len() - 1].is_finite() {
        let problem = "the clip is too long for glTF's single-precision times";
        return Err(element("animations[0]", problem, "write it in shorter pieces or at a lower rate"));
    }
    Ok(times)
}

/// Rotations of a joint, each with the sign of the quaternion nearest to the one before, so that viewers interpolate
/// along the shorter arc.
pub(super) fn rotations(clip: &Clip, local: impl Fn(usize) -> DQuat) -> Vec<f32> {
    let mut before = DQuat::IDENTITY;
    let mut values = Vec::with_capacity(clip.frames() * 4);
    for frame in 0..clip.frames() {
        let rotation = local(frame).normalize();
        let rotation = if frame > 0 && rotation.dot(before) < 0.0 { -rotation } else { rotation };
        before = rotation;
        values.extend(rotation.to_array().map(|value| value as f32));
    }
    values
}

/// Translations of a joint.
pub(super) fn translations(clip: &Clip, local: impl Fn(usize) -> DVec3) -> Vec<f32> {
    (0..clip.frames()).flat_map(|frame| local(frame).to_array().map(|value| value as f32)).collect()
}

/// Refuses what single precision cannot hold.
pub(super) fn check(clip: &Clip) -> Result<(), Error> {
    let name = |joint: usize| format!("joint {:?}", clip.skeleton().joints()[joint].name);
    let remedy = "repair the motion before it is written";
    if let Some((frame, joint)) = clip.first_non_finite() {
        return Err(element(name(joint), format!("frame {frame} is not finite"), remedy));
    }
    let fits = |local: Transform| {
        local.translation.abs().max_element() <= f64::from(f32::MAX) && local.rotation.length_squared() > 1e-6
    };
    for (joint, of) in clip.skeleton().joints().iter().enumerate() {
        let rest_is_fine = of.rest.rotation.is_finite() && of.rest.translation.is_finite() && fits(of.rest);
        if !rest_is_fine || of.tip.is_some_and(|tip| !fits(Transform::new(DQuat::IDENTITY, tip))) {
            return Err(element(name(joint), "its rest or tip is out of range", remedy));
        }
        if let Some(frame) = (0..clip.frames()).find(|&frame| !fits(clip.local(frame, joint))) {
            return Err(element(name(joint), format!("frame {frame} is out of range"), remedy));
        }
    }
    Ok(())
}
