//! The stature of a body.

use crate::pose::{leading_axis, quantile, sample_poses};
use crate::{Clip, Humanoid, Side};
use glam::DVec3;

/// Height of the head joint (the top of the neck) above the sole, as a share of stature.
///
/// Chin and neck to vertex are 0.182 of the stature, and the head's joint sits about at the ears (Drillis and Contini
/// 1966, as in Winter, *Biomechanics and Motor Control of Human Movement*).
const HEAD_JOINT_SHARE: f64 = 0.88;
/// The same for the lowest joint of the neck.
const NECK_JOINT_SHARE: f64 = 0.82;
/// Height of the ankle above the sole, as a share of stature (Winter, the same table).
const ANKLE_SHARE: f64 = 0.039;

/// Stature of the standing body in the clip's own unit: sole, ankle, knee, hip, then from the middle between the hip
/// joints through the spine chain and neck chain to the head's tip. Each length is the median over the clip, so no frame
/// needs to stand straight. The curve of a spine counts in full, which adds one or two per cent.
///
/// Where the head has no tip, its joint is taken to be at 88 % of the stature. The sole is as far below the ankle as
/// the lowest point of toes or foot tip usually is; 3.9 % of the stature where the foot has neither.
pub fn stature(clip: &Clip, humanoid: &Humanoid) -> f64 {
    let poses = sample_poses(clip, 64);
    let median = |length: &dyn Fn(&Vec<crate::Transform>) -> f64| {
        quantile(poses.iter().map(length).collect(), 0.5).unwrap_or(0.0)
    };
    let sides = [Side::Left, Side::Right];
    let legs = sides.map(|side| humanoid.leg(side));
    let mut length = 0.0;
    for leg in legs {
        for bone in leg.windows(2) {
            length += 0.5 * median(&|pose| pose[bone[0]].translation.distance(pose[bone[1]].translation));
        }
    }
    let mut trunk: Vec<usize> = humanoid.spine_chain().to_vec();
    trunk.extend(humanoid.neck_chain());
    length += median(&|pose| {
        let mut at = 0.5 * (pose[legs[0][0]].translation + pose[legs[1][0]].translation);
        let mut sum = 0.0;
        for &joint in &trunk {
            sum += at.distance(pose[joint].translation);
            at = pose[joint].translation;
        }
        sum
    });
    let top = humanoid.neck_chain().last().copied().unwrap_or(humanoid.head());
    let tip = clip.skeleton().end(top).map_or(0.0, |tip| tip.length());
    let sole = sole_below_ankle(clip, humanoid, &poses);
    // A share of the whole that is not measured is solved for.
    let mut measured = 1.0;
    match sole {
        Some(sole) => length += sole.clamp(0.0, 0.08 * length),
        None => measured -= ANKLE_SHARE,
    }
    if tip > 0.02 * length {
        length += tip;
    } else {
        let share = if humanoid.joint(crate::Part::Head).is_some() { HEAD_JOINT_SHARE } else { NECK_JOINT_SHARE };
        measured -= 1.0 - share;
    }
    length / measured
}

/// How far the lowest point of the foot is below the ankle, in a low third of both feet over the clip.
fn sole_below_ankle(clip: &Clip, humanoid: &Humanoid, poses: &[Vec<crate::Transform>]) -> Option<f64> {
    let up = up_axis(clip, humanoid);
    let mut drops = Vec::new();
    for pose in poses {
        for side in [Side::Left, Side::Right] {
            let ankle = pose[humanoid.leg(side)[2]].translation;
            let lowest = foot_points(clip, humanoid, side)
                .iter()
                .map(|&(joint, point)| (pose[joint].point(point) - ankle).dot(up))
                .fold(f64::INFINITY, f64::min);
            drops.push(-lowest);
        }
    }
    // Tiptoe and swing, where it hangs lower, take up the upper half in every gait.
    quantile(drops, 0.3).filter(|&drop| drop > 0.0)
}

/// Points of a foot beyond the ankle: toes, their tip, the tip of a foot without toes; each as joint and point in it.
pub(crate) fn foot_points(clip: &Clip, humanoid: &Humanoid, side: Side) -> Vec<(usize, DVec3)> {
    let last = humanoid.toes(side).unwrap_or(humanoid.leg(side)[2]);
    let mut points = Vec::new();
    if let Some(toes) = humanoid.toes(side) {
        points.push((toes, DVec3::ZERO));
    }
    if let Some(tip) = clip.skeleton().end(last) {
        points.push((last, tip));
    }
    points
}

/// The axis of the clip that points up: from feet to head on the mean of the clip.
pub(crate) fn up_axis(clip: &Clip, humanoid: &Humanoid) -> DVec3 {
    let feet = [Side::Left, Side::Right].map(|side| humanoid.leg(side)[2]);
    let head = humanoid.head();
    leading_axis(
        sample_poses(clip, 64)
            .iter()
            .map(|pose| pose[head].translation - 0.5 * (pose[feet[0]].translation + pose[feet[1]].translation)),
    )
}
