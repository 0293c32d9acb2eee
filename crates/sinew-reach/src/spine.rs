//! The spine controller's rules: twist, swing and the shift of the root.

use crate::Values;
use crate::legs::ground_direction;
use glam::DVec3;

/// EQ5: the shares of a twist θ that the sacral, lumbar and thoracic joint take, a third each.
pub fn twist_shares(twist_rad: f64) -> [f64; 3] {
    [twist_rad / 3.0; 3]
}

/// The shares of a swing of the same three joints, of which the sacral one takes `hips_share`.
pub fn swing_shares(swing: DVec3, hips_share: f64) -> [DVec3; 3] {
    let rest = swing * (0.5 * (1.0 - hips_share));
    [swing * hips_share, rest, rest]
}

/// The reaching angle: direction of a target from the shoulder, from forward towards the arm's own side \[rad\].
pub fn reaching_angle(shoulder_to_target: DVec3, facing_rad: f64, is_right: bool) -> Option<f64> {
    let flat = ground_direction(shoulder_to_target)?;
    let turn = wrapped(libm::atan2(flat.x, flat.z) - facing_rad);
    Some(if is_right { -turn } else { turn })
}

/// An angle from −π to π.
pub(crate) fn wrapped(angle: f64) -> f64 {
    let turn = 2.0 * std::f64::consts::PI;
    angle - turn * (angle / turn).round()
}

/// The total twist θ \[rad, about +Y\] with which the target lies within the comfortable reaching angle: the smallest
/// one, in steps of one degree; the maximum if none suffices. `shoulder_at(twist)` returns the shoulder's position,
/// which moves with the twist.
pub fn search_twist(
    target: DVec3,
    facing_rad: f64,
    is_right: bool,
    values: &Values,
    shoulder_at: impl Fn(f64) -> DVec3,
) -> f64 {
    let angle_at = |twist: f64| reaching_angle(target - shoulder_at(twist), facing_rad + twist, is_right);
    let Some(first) = angle_at(0.0) else { return 0.0 };
    let (low, high) = values.comfortable_rad;
    if (low..=high).contains(&first) {
        return 0.0;
    }
    // Towards the target: a target beyond the arm's own side turns the body to that side.
    let sign = if (first > high) == is_right { -1.0 } else { 1.0 };
    let step = 1.0_f64.to_radians();
    let most = (values.most_twist_rad / step).floor() as u32;
    for index in 1..=most {
        let twist = sign * step * f64::from(index);
        if angle_at(twist).is_none_or(|angle| (low..=high).contains(&angle)) {
            return twist;
        }
    }
    sign * values.most_twist_rad
}

/// EQ7: the swing axis **s** = **d** × **y**, a unit vector, reversed so that a positive angle leans the trunk towards
/// the target (a turn about d × y itself leans away). For a target straight above or below: about the axis that leans
/// forward.
pub fn swing_axis(d: DVec3, facing_rad: f64) -> DVec3 {
    let printed = d.cross(DVec3::Y);
    match printed.try_normalize() {
        Some(axis) if ground_direction(d).is_some() => -axis,
        _ => DVec3::new(libm::cos(facing_rad), 0.0, -libm::sin(facing_rad)),
    }
}

/// EQ8: the root's shift **r** = −k φ **d**_p \[m\] for a swing given as its rotation vector: hips move back as the
/// trunk bends towards the target, and forward as it leans away to reach up.
pub fn root_shift(swing: DVec3, values: &Values) -> DVec3 {
    // φ d_p is the swing's rotation vector turned by a quarter.
    swing.cross(DVec3::Y) * -values.shift_per_swing()
}

/// Stoop range: maximum distance of a target below the shoulder before the legs bend, arm length / F \[m\].
pub fn stoop_range_m(flexibility: f64, values: &Values) -> f64 {
    values.arm_m / flexibility
}

/// Squat depth for a target at a distance below the shoulder \[m\]: the excess over the stoop range, or half as much
/// again (see [`Values::squat_per_excess`]).
pub fn squat_for(below_m: f64, flexibility: f64, values: &Values) -> f64 {
    let excess = below_m - stoop_range_m(flexibility, values);
    (values.squat_per_excess * excess).clamp(0.0, values.most_squat_m)
}
