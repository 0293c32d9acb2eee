//! The frame of a foot from the motion: level while it stands.
//!
//! A rest pose says nothing about how a foot stands: files exported from another frame of the time line rest on bent ankles.
//! The motion does: where ankle and toes are both as low as they ever come, the foot stands flat.

use super::calibration::{Samples, from_x_and_down, position};
use glam::{DQuat, DVec3};
use sinew_motion::{Clip, Humanoid, Part, Transform};

/// Height above their own lowest \[1 of the leg's length\] up to which ankle and toes count as down: 12 mm of an adult's.
const DOWN: f64 = 0.015;

/// Height of the lower foot's lowest ankle above which another is never down \[1 of the leg's length\].
const SAME_FLOOR: f64 = 0.06;

/// Share of the samples from whose low end the lowest is taken: single dips are noise.
const LOWEST: usize = 50;

/// Minimum cosine between the mean and each single direction: what stands flat is level within some 25 degrees.
const LEVEL: f64 = 0.9;

/// Ankle, toes, hip, knee and the other ankle of both sides.
const FEET: [[Part; 5]; 2] = [
    [Part::LeftFoot, Part::LeftToes, Part::LeftUpperLeg, Part::LeftLowerLeg, Part::RightFoot],
    [Part::RightFoot, Part::RightToes, Part::RightUpperLeg, Part::RightLowerLeg, Part::LeftFoot],
];

/// `joint_from_anatomical` of a foot that stands in the motion: while it stands, its Y is up; its heading is that of `rest`, a
/// frame that need not be level. `None` for a foot that never stands, or whose toes the skeleton does not know.
pub(super) fn flat_foot(samples: &Samples, clip: &Clip, humanoid: &Humanoid, foot: Part, rest: DQuat) -> Option<DQuat> {
    let [foot, toes, hip, knee, other] = FEET.into_iter().find(|parts| parts[0] == foot)?;
    let joint = humanoid.joint(foot)?;
    let at = |world: &[Transform], part| position(world, clip, humanoid, part);
    let heights = |part: Part| -> Option<Vec<f64>> {
        let mut heights: Vec<f64> = samples.frames().map(|world| Some(at(world, part)?.y)).collect::<Option<_>>()?;
        heights.sort_by(f64::total_cmp);
        Some(heights)
    };
    let lowest = |part: Part| heights(part).and_then(|heights| heights.get(heights.len() / LOWEST).copied());
    let bone = |from, to| Some((at(&samples.reference, to)? - at(&samples.reference, from)?).length());
    let leg = bone(hip, knee)? + bone(knee, foot)?;
    let (ankle, toe) = (lowest(foot)?, lowest(toes)?);
    if ankle > lowest(other)? + SAME_FLOOR * leg {
        return None;
    }
    let stands = |world: &[Transform]| {
        let is_down = |part, lowest| Some(at(world, part)?.y < lowest + DOWN * leg);
        (is_down(foot, ankle)? && is_down(toes, toe)?).then_some(())
    };
    let up = samples.mean(|world| {
        stands(world)?;
        Some(world[joint].rotation.conjugate() * DVec3::Y)
    })?;
    if up.length() < LEVEL { None } else { from_x_and_down(up.cross(rest * DVec3::Z), -up) }
}
