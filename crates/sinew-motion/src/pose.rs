//! Sample poses of a clip, and statistics over them.

use crate::{Clip, Transform};
use glam::DVec3;

/// `world_from_joint` of every joint in up to `max` frames spread evenly over the clip; the rest pose when the clip has
/// no frames.
pub(crate) fn sample_poses(clip: &Clip, max: usize) -> Vec<Vec<Transform>> {
    let frames = clip.frames();
    if frames == 0 {
        return vec![clip.skeleton().rest_world()];
    }
    let count = frames.min(max);
    (0..count).map(|sample| clip.world(if count < 2 { 0 } else { sample * (frames - 1) / (count - 1) })).collect()
}

/// The axis (±X, ±Y, ±Z) along which the vectors point most, each counted by its direction only.
pub(crate) fn leading_axis(vectors: impl Iterator<Item = DVec3>) -> DVec3 {
    let sum: DVec3 = vectors.map(|vector| vector.normalize_or_zero()).sum();
    let mut best = DVec3::Y;
    for axis in [DVec3::Y, DVec3::Z, DVec3::X] {
        if sum.dot(axis).abs() > sum.dot(best).abs() {
            best = axis;
        }
    }
    if sum.dot(best) < 0.0 { -best } else { best }
}

/// The value below which the given share (0 to 1) of the values lies; `None` if there are no values.
pub(crate) fn quantile(mut values: Vec<f64>, share: f64) -> Option<f64> {
    values.retain(|value| value.is_finite());
    if values.is_empty() {
        return None;
    }
    values.sort_unstable_by(f64::total_cmp);
    let at = share.clamp(0.0, 1.0) * (values.len() - 1) as f64;
    let below = at.floor() as usize;
    let above = (below + 1).min(values.len() - 1);
    Some(values[below] + (at - below as f64) * (values[above] - values[below]))
}
