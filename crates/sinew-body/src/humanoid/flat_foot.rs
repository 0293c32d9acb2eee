//! The frame of a foot from the motion: level while it stands; and both on one floor.
//!
//! A rest pose says nothing about how a foot stands: files exported from another frame of the time line rest on bent ankles.
//! The motion does: where ankle and toes are both as low as they ever come, the foot stands flat.
//!
//! A skeleton's toes say little about how high its ankles are: in captures those of one foot are up to 3 cm nearer to the floor
//! than the other's. Its ankles do: at their lowest they are as high above the floor as feet are.

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
    let lowest = |part| lowest(samples, clip, humanoid, part);
    let leg = leg_length(samples, clip, humanoid, [hip, knee, foot])?;
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

/// The tips of the left and the right foot, each in its frame \[m\], of soles that stand on one floor: as far apart in depth as the ankles at their
/// lowest, as deep as before on the whole. Unchanged where a foot never stands on the floor of the other.
pub(super) fn on_one_floor(
    samples: &Samples,
    clip: &Clip,
    humanoid: &Humanoid,
    tips: [DVec3; 2],
) -> Option<[DVec3; 2]> {
    let [[left, _, hip, knee, right], _] = FEET;
    let ankles = [lowest(samples, clip, humanoid, left)?, lowest(samples, clip, humanoid, right)?];
    let leg = leg_length(samples, clip, humanoid, [hip, knee, left])?;
    if (ankles[0] - ankles[1]).abs() > SAME_FLOOR * leg {
        return None;
    }
    let floor = 0.5 * (ankles[0] + tips[0].y + ankles[1] + tips[1].y);
    Some([tips[0].with_y(floor - ankles[0]), tips[1].with_y(floor - ankles[1])])
}

/// Height of a part at its lowest, but for the single dips of noise \[m\].
fn lowest(samples: &Samples, clip: &Clip, humanoid: &Humanoid, part: Part) -> Option<f64> {
    let height = |world: &[Transform]| Some(position(world, clip, humanoid, part)?.y);
    let mut heights: Vec<f64> = samples.frames().map(height).collect::<Option<_>>()?;
    heights.sort_by(f64::total_cmp);
    heights.get(heights.len() / LOWEST).copied()
}

/// From hip over knee to ankle \[m\].
fn leg_length(samples: &Samples, clip: &Clip, humanoid: &Humanoid, [hip, knee, foot]: [Part; 3]) -> Option<f64> {
    let at = |part| position(&samples.reference, clip, humanoid, part);
    Some((at(knee)? - at(hip)?).length() + (at(foot)? - at(knee)?).length())
}
