//! Two-bone inverse kinematics of a leg, as a deviation from the input's own leg.
//!
//! The input's leg is rotated as a whole to point at the wanted ankle, then its knee is extended or flexed. Without a
//! change of hip or ankle the result is the input's, exactly.

use glam::{DMat3, DQuat, DVec3};

/// A leg in the world: positions of its joints and flexion axis of its knee.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LegPose {
    /// Hip joint \[m\].
    pub hip: DVec3,
    /// Knee joint \[m\].
    pub knee: DVec3,
    /// Ankle joint \[m\].
    pub ankle: DVec3,
    /// Axis about which the knee flexes, a unit vector; used where the leg is too straight to define it.
    pub knee_axis: DVec3,
}

/// Displacement of hip and ankle over which a knee that the input bends backward, or hardly at all, comes to bend about its
/// hinge \[m\].
const ROUND_M: f64 = 5e-4;

/// Sines of the angle between thigh and line to the ankle up to which, and from which on, the input's leg has a plane of its
/// own: in a straighter leg the knee's side is noise.
const STRAIGHT: (f64, f64) = (0.005, 0.015);
const BENT: (f64, f64) = (0.04, 0.17);

/// The input's thigh and shank turned in the world, `world_from_world` deltas, so that the leg, its hip at `hip`, puts
/// its ankle at `ankle`; the leg stretches as far as it can when the ankle is out of reach.
///
/// The knee's position follows from the lengths except for a rotation about the line from hip to ankle: a bent knee
/// keeps the input's, one that is straight or bent backward turns to the front as hip or ankle move. The twists of
/// thigh and shank keep the hinge axis fixed to the leg as a whole.
pub fn solve_leg(input: &LegPose, hip: DVec3, ankle: DVec3) -> (DQuat, DQuat) {
    let moved = (hip - input.hip).length() + (ankle - input.ankle).length();
    if moved == 0.0 {
        return (DQuat::IDENTITY, DQuat::IDENTITY);
    }
    place_knee(input, hip, ankle, smoothstep(0.0, ROUND_M, moved)).unwrap_or_default()
}

/// `None` for a leg without length.
fn place_knee(leg: &LegPose, hip: DVec3, ankle: DVec3, share: f64) -> Option<(DQuat, DQuat)> {
    let (thigh_line, shank_line) = (leg.knee - leg.hip, leg.ankle - leg.knee);
    let (thigh, shank) = (thigh_line.length(), shank_line.length());
    let old_line = (leg.ankle - leg.hip).try_normalize()?;
    let new_line = (ankle - hip).try_normalize()?;
    if thigh < 1e-6 || shank < 1e-6 {
        return None;
    }
    // Where the input's knee is around its line: 0 in front, as the hinge would have it.
    let front = old_line.cross(leg.knee_axis).try_normalize()?;
    let side = old_line.cross(front);
    let off_line = thigh_line - old_line * thigh_line.dot(old_line);
    let sine = off_line.length() / thigh;
    let mut around = libm::atan2(off_line.dot(side), off_line.dot(front)) * smoothstep(STRAIGHT.0, STRAIGHT.1, sine);
    if around < -BEHIND.1 {
        around += 2.0 * std::f64::consts::PI;
    }
    let unsure = (1.0 - smoothstep(BENT.0, BENT.1, sine)).max(smoothstep(BEHIND.0, BEHIND.1, around.abs()));
    let (sin_around, cos_around) = libm::sincos(around * (1.0 - share * unsure));

    let turn = DQuat::from_rotation_arc(old_line, new_line);
    let length = (ankle - hip).length();
    let (sin, cos) = libm::sincos(hip_angle(thigh, shank, flexion_for(thigh, shank, length)));
    let out = (turn * front) * cos_around + (turn * side) * sin_around;
    let knee = hip + new_line * (thigh * cos) + out * (thigh * sin);
    let axis = turn * leg.knee_axis;
    let thigh_turn = along(knee - hip, axis)? * along(turn * thigh_line, axis)?.conjugate() * turn;
    let shank_turn = along(ankle - knee, axis)? * along(turn * shank_line, axis)?.conjugate() * turn;
    Some((thigh_turn.normalize(), shank_turn.normalize()))
}

/// Angles around the leg's line between which a knee counts as bent aside rather than backward \[rad\].
const BEHIND: (f64, f64) = (1.0, 2.1);

/// The frame of a bone with this hinge axis: its −Y along the bone, its X as close to the axis as that allows.
fn along(bone: DVec3, axis: DVec3) -> Option<DQuat> {
    let y = -bone.try_normalize()?;
    let x = (axis - y * axis.dot(y)).try_normalize()?;
    Some(DQuat::from_mat3(&DMat3::from_cols(x, y, x.cross(y))).normalize())
}

/// The flexion \[rad\] at which a leg has the length `long`.
fn flexion_for(thigh: f64, shank: f64, length: f64) -> f64 {
    let length = length.clamp((thigh - shank).abs() + 1e-9, thigh + shank);
    let at_knee = (thigh * thigh + shank * shank - length * length) / (2.0 * thigh * shank);
    std::f64::consts::PI - libm::acos(at_knee.clamp(-1.0, 1.0))
}

/// The angle at the hip from the line to the ankle to the thigh \[rad\].
fn hip_angle(thigh: f64, shank: f64, flexion: f64) -> f64 {
    let (sin, cos) = libm::sincos(flexion);
    libm::atan2(shank * sin, thigh + shank * cos)
}

/// From 0 at `from` to 1 at `to`, with flat ends.
fn smoothstep(from: f64, to: f64, value: f64) -> f64 {
    let share = ((value - from) / (to - from)).clamp(0.0, 1.0);
    share * share * (3.0 - 2.0 * share)
}

/// Maximum extension of a leg \[1 of its length\] unless the input's is straighter: knees do not snap.
const STRAIGHTEST: f64 = 0.9995;

/// Iterations over the two legs; each is a projection onto a ball, and two intersecting balls need few.
const SWEEPS: usize = 16;

/// The shift of the hips \[m\] closest to `shift` at which both legs of the input still reach their ankles; `hips` are
/// the unshifted hip joints. As a rule the hips sink a little.
pub fn shift_within_reach(legs: &[LegPose; 2], hips: [DVec3; 2], shift: DVec3) -> DVec3 {
    let legs = [0, 1].map(|side| {
        let leg = &legs[side];
        let length = (leg.knee - leg.hip).length() + (leg.ankle - leg.knee).length();
        let reach = (length * STRAIGHTEST).max((leg.ankle - leg.hip).length());
        (hips[side] - leg.ankle, reach)
    });
    let mut shift = shift;
    for _ in 0..SWEEPS {
        let mut moved = false;
        for (from_ankle, reach) in legs {
            let line = from_ankle + shift;
            let length = line.length();
            if length > reach {
                shift -= line * (1.0 - reach / length);
                moved = true;
            }
        }
        if !moved {
            break;
        }
    }
    shift
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// The knee's flexion \[rad\], negative when it is bent backward.
    fn flexion(leg: &LegPose) -> f64 {
        let (thigh, shank) = (leg.knee - leg.hip, leg.ankle - leg.knee);
        let normal = thigh.cross(shank);
        let angle = libm::atan2(normal.length(), thigh.dot(shank));
        if normal.dot(leg.knee_axis) < 0.0 { -angle } else { angle }
    }

    fn leg() -> LegPose {
        LegPose {
            hip: DVec3::new(0.1, 0.9, 0.0),
            knee: DVec3::new(0.11, 0.48, 0.1),
            ankle: DVec3::new(0.12, 0.08, -0.02),
            knee_axis: DVec3::X,
        }
    }

    proptest! {
        #[test]
        fn the_ankle_arrives_wherever_it_is_in_reach(
            dx in -0.1..0.1f64, dy in -0.15..0.0f64, dz in -0.1..0.1f64,
            ax in -0.1..0.1f64, ay in 0.0..0.2f64, az in -0.1..0.1f64,
        ) {
            let input = leg();
            let (hip, ankle) = (input.hip + DVec3::new(dx, dy, dz), input.ankle + DVec3::new(ax, ay, az));
            let (thigh, shank) = solve_leg(&input, hip, ankle);
            let knee = hip + thigh * (input.knee - input.hip);
            let arrived = knee + shank * (input.ankle - input.knee);
            prop_assert!((arrived - ankle).length() < 1e-9, "{}", (arrived - ankle).length());
        }
    }

    #[test]
    fn an_unmoved_leg_stays_as_it_is_bit_for_bit() {
        let input = leg();
        assert_eq!(solve_leg(&input, input.hip, input.ankle), (DQuat::IDENTITY, DQuat::IDENTITY));
    }

    #[test]
    fn a_knee_never_bends_backward() {
        let input = leg();
        let (thigh, shank) = solve_leg(&input, input.hip - DVec3::Y * 0.1, input.ankle);
        let (thigh, shank) = (thigh * (input.knee - input.hip), shank * (input.ankle - input.knee));
        assert!(thigh.cross(shank).dot(DVec3::X) > 0.0);
    }

    #[test]
    fn a_leg_that_the_input_bends_backward_comes_round_smoothly() {
        let mut input = leg();
        input.knee = DVec3::new(0.1, 0.49, -0.01);
        input.ankle = DVec3::new(0.1, 0.08, 0.0);
        assert!(flexion(&input) < 0.0);
        let bent = |drop: f64| {
            let hip = input.hip - DVec3::Y * drop;
            let (thigh, shank) = solve_leg(&input, hip, input.ankle);
            let knee = hip + thigh * (input.knee - input.hip);
            let ankle = knee + shank * (input.ankle - input.knee);
            assert!((ankle - input.ankle).length() < 1e-9, "{drop}: {}", (ankle - input.ankle).length());
            (knee, flexion(&LegPose { hip, knee, ankle, knee_axis: shank * input.knee_axis }))
        };
        assert!(bent(ROUND_M).1 > 0.05);
        let knees: Vec<DVec3> = (0..=500).map(|step| bent(f64::from(step) * 1e-6).0).collect();
        // A micrometre of hip never moves the knee by more than half a millimetre.
        assert!(knees.windows(2).all(|pair| (pair[1] - pair[0]).length() < 5e-4));
        assert!((knees[0] - input.knee).length() < 1e-9);
    }

    #[test]
    fn an_ankle_out_of_reach_stretches_the_leg_towards_it() {
        let input = leg();
        let hip = input.hip + DVec3::Y;
        let (thigh, shank) = solve_leg(&input, hip, input.ankle);
        let arrived = hip + thigh * (input.knee - input.hip) + shank * (input.ankle - input.knee);
        let along = (input.ankle - hip).normalize();
        let reach = (input.knee - input.hip).length() + (input.ankle - input.knee).length();
        assert!((arrived - (hip + along * reach)).length() < 1e-6);
    }
}
