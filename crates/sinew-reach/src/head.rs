//! The head controller: it turns to the target at once, and keeps facing it while the trunk turns.

use glam::{DQuat, DVec3};
use sinew_body::humanoid::exp;

/// Share of a gaze shift that neck and head take \[1\]. Of the whole shift the eyes take a third and the chest, which the trunk's
/// twist turns, a sixth (Freedman and Sparks 1997; Land 2004): three fifths of what is left to head and eyes are the head's.
const HEAD_SHARE: f64 = 0.6;

/// Maximum rotation of the head relative to the chest, neck and head together \[rad\]: 43°. The eyes take the rest.
const MAX_RAD: f64 = 0.75;

/// Share of the turn that the neck takes \[1\].
const NECK_SHARE: f64 = 0.45;

/// The rotation of the head relative to the chest with which it faces a target at d_t = p_e − p_n, given in the chest's
/// frame \[m\]: a rotation vector \[rad\], at most 43° long.
///
/// A target behind the body is not looked at over the shoulder: the rotation fades as the target moves behind.
///
/// ```
/// use glam::DVec3;
/// use sinew_reach::gaze_rotation;
/// assert_eq!(gaze_rotation(DVec3::Z), DVec3::ZERO);
/// let aside = gaze_rotation(DVec3::X).length().to_degrees();
/// assert!(aside > 38.0 && aside < 45.0, "the eyes do the rest");
/// ```
pub fn gaze_rotation(chest_from_target: DVec3) -> DVec3 {
    let d = chest_from_target;
    let level = (d.x * d.x + d.z * d.z).sqrt();
    let length = d.length();
    if length < 1e-6 {
        return DVec3::ZERO;
    }
    let side = libm::atan2(d.x, d.z);
    // Straight overhead the side is undefined; straight behind it is ambiguous.
    let behind = smooth(side.abs(), 1.9, 3.0);
    let side = side * smooth(level / length, 0.1, 0.5) * (1.0 - behind);
    let up = libm::atan2(d.y, level.max(1e-9)) * (1.0 - 0.7 * behind);
    let turn = sinew_body::humanoid::log(exp(DVec3::Y * side) * exp(DVec3::X * -up)) * HEAD_SHARE;
    let angle = turn.length();
    if angle > 0.0 { turn * (soft(angle, MAX_RAD) / angle) } else { turn }
}

/// The rotations of neck and head, `parent_from_node`, that make up a turn of the head relative to the chest.
pub(crate) fn shared(turn: DVec3) -> (DQuat, DQuat) {
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
