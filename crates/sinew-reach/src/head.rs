//! The head controller: it turns to the target, then tracks it.

use glam::{DQuat, DVec3};
use sinew_body::humanoid::exp;

/// Maximum rotation of the head relative to the chest, neck and head together \[rad\]: sideways, up, down.
const MAX_SIDE_RAD: f64 = 1.15;
const MAX_UP_RAD: f64 = 0.95;
const MAX_DOWN_RAD: f64 = 0.85;

/// Share of the turn that the neck takes.
const NECK_SHARE: f64 = 0.45;

/// The rotations of neck and head, `parent_from_node`, that turn the face from straight ahead a share of the way (0 in
/// the start phase, 1 when tracking) to d_t = p_e − p_n, given in the chest's frame.
///
/// A target behind the body is not looked at over the shoulder: the rotation fades as the target moves behind.
pub fn look(chest_from_target: DVec3, share: f64) -> (DQuat, DQuat) {
    let d = chest_from_target;
    let level = (d.x * d.x + d.z * d.z).sqrt();
    let length = d.length();
    if length < 1e-6 || share <= 0.0 {
        return (DQuat::IDENTITY, DQuat::IDENTITY);
    }
    let side = libm::atan2(d.x, d.z);
    // Straight overhead the side is undefined; straight behind it is ambiguous.
    let meant = smooth(level / length, 0.1, 0.5) * (1.0 - smooth(side.abs(), 1.9, 3.0));
    let up = libm::atan2(d.y, level.max(1e-9)) * (1.0 - 0.7 * smooth(side.abs(), 1.9, 3.0));
    let side = soft(side, MAX_SIDE_RAD) * meant;
    let up = if up > 0.0 { soft(up, MAX_UP_RAD) } else { soft(up, MAX_DOWN_RAD) };
    // Slerp from straight ahead: the rotation vector grows.
    let turn = sinew_body::humanoid::log(exp(DVec3::Y * side) * exp(DVec3::X * -up)) * share;
    (exp(turn * NECK_SHARE), exp(turn * (1.0 - NECK_SHARE)))
}

/// Soft clamp of a value to a limit.
pub(crate) fn soft(value: f64, most: f64) -> f64 {
    let from = 0.6 * most;
    if value.abs() <= from {
        return value;
    }
    let room = most - from;
    (from + room * libm::tanh((value.abs() - from) / room)).copysign(value)
}

/// From 0 at `from` to 1 at `to`, flat to the second derivative at both ends.
pub(crate) fn smooth(value: f64, from: f64, to: f64) -> f64 {
    crate::minimum_jerk::eased((value - from) / (to - from))
}
