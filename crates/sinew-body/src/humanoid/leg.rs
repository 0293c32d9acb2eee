//! Two-bone inverse kinematics of a leg, as a deviation from the input's own leg.
//!
//! The input's leg is turned as a whole so that it points at the wanted ankle, then its knee is opened or closed about
//! the input's own bending axis. Without a change of hip or ankle the result is the input's, exactly.

use super::rotation::exp;
use glam::{DQuat, DVec3};

/// A leg in the world: where its joints are and which way its knee bends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LegPose {
    /// Hip joint \[m\].
    pub hip: DVec3,
    /// Knee joint \[m\].
    pub knee: DVec3,
    /// Ankle joint \[m\].
    pub ankle: DVec3,
    /// Axis about which the knee flexes, a unit vector; used where the leg is too straight to tell.
    pub knee_axis: DVec3,
}

/// Displacement of hip and ankle over which a knee that the input bends backward comes round to bend forward \[m\].
const ROUND_M: f64 = 2e-3;

/// How much the hinge axis counts against the plane that the leg is in \[sine of the flexion\]: below a degree or two of
/// flexion the plane is noise.
const HINGE_SHARE: f64 = 0.03;

/// Each round corrects what the one before left, which shrinks with its square.
const ROUNDS: usize = 3;

/// The input's thigh and shank turned in the world, `world_from_world` deltas, so that the leg, its hip at `hip`, puts
/// its ankle at `ankle`; the leg stretches as far as it can when the ankle is out of reach.
pub fn solve_leg(input: &LegPose, hip: DVec3, ankle: DVec3) -> (DQuat, DQuat) {
    let moved = (hip - input.hip).length() + (ankle - input.ankle).length();
    if moved == 0.0 {
        return (DQuat::IDENTITY, DQuat::IDENTITY);
    }
    if flexion(input) < 0.0 {
        return come_round(input, hip, ankle, (moved / ROUND_M).min(1.0)).unwrap_or_default();
    }
    let (mut thigh, mut shank) = (DQuat::IDENTITY, DQuat::IDENTITY);
    let mut leg = *input;
    for _ in 0..ROUNDS {
        let Some((thigh_turn, shank_turn)) = bend(&leg, hip, ankle) else { break };
        thigh = (thigh_turn * thigh).normalize();
        shank = (shank_turn * shank).normalize();
        let knee = hip + thigh * (input.knee - input.hip);
        let ankle = knee + shank * (input.ankle - input.knee);
        leg = LegPose { hip, knee, ankle, knee_axis: (shank * input.knee_axis).normalize() };
    }
    (thigh, shank)
}

/// How straight a leg may get \[1 of its length\] unless the input's is straighter: knees do not snap.
const STRAIGHTEST: f64 = 0.9995;

/// Sweeps over the two legs; each is a projection onto a ball, and two balls that meet need few.
const SWEEPS: usize = 16;

/// The shift of the hips \[m\] closest to `shift` at which both legs of the input still reach their ankles from hip joints
/// at `hips`, which are then shifted: as a rule they sink a little.
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

/// The knee's flexion \[rad\], negative when it is bent backward.
fn flexion(leg: &LegPose) -> f64 {
    let (thigh, shank) = (leg.knee - leg.hip, leg.ankle - leg.knee);
    let normal = thigh.cross(shank);
    let angle = libm::atan2(normal.length(), thigh.dot(shank));
    if normal.dot(leg.knee_axis) < 0.0 { -angle } else { angle }
}

/// The flexion \[rad\] at which a leg is so long.
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

/// A leg that the input bends backward: with a growing `share` of displacement its knee goes half around the line from hip to
/// ankle, so that it ends up in front without ever stretching the leg.
fn come_round(leg: &LegPose, hip: DVec3, ankle: DVec3, share: f64) -> Option<(DQuat, DQuat)> {
    let (thigh_line, shank_line) = (leg.knee - leg.hip, leg.ankle - leg.knee);
    let (thigh, shank) = (thigh_line.length(), shank_line.length());
    let old_line = (leg.ankle - leg.hip).try_normalize()?;
    let new_line = (ankle - hip).try_normalize()?;
    let turn = DQuat::from_rotation_arc(old_line, new_line);
    let behind = turn * (thigh_line - old_line * thigh_line.dot(old_line)).try_normalize()?;
    let aside = new_line.cross(behind);
    let angle = hip_angle(thigh, shank, flexion_for(thigh, shank, (ankle - hip).length()));
    let (sin, cos) = libm::sincos(angle);
    let (across, back) = libm::sincos(std::f64::consts::PI * share * share * (3.0 - 2.0 * share));
    let knee = hip + new_line * (thigh * cos) + (behind * back + aside * across) * (thigh * sin);
    let arc = |from: DVec3, to: DVec3| Some(DQuat::from_rotation_arc(from.try_normalize()?, to.try_normalize()?));
    let reached = knee + (ankle - knee).try_normalize()? * shank;
    Some((arc(turn * thigh_line, knee - hip)? * turn, arc(turn * shank_line, reached - knee)? * turn))
}

/// One round: turns the leg towards the ankle as a whole, then bends it. `None` for a leg without length.
fn bend(leg: &LegPose, hip: DVec3, ankle: DVec3) -> Option<(DQuat, DQuat)> {
    let (thigh_line, shank_line) = (leg.knee - leg.hip, leg.ankle - leg.knee);
    let (thigh, shank) = (thigh_line.length(), shank_line.length());
    let (old_line, new_line) = (leg.ankle - leg.hip, ankle - hip);
    let (old_length, new_length) = (old_line.length(), new_line.length());
    if thigh < 1e-6 || shank < 1e-6 || old_length < 1e-6 || new_length < 1e-6 {
        return None;
    }
    let turn = DQuat::from_rotation_arc(old_line / old_length, new_line / new_length);
    let old_flexion = flexion(leg);
    let new_flexion = flexion_for(thigh, shank, new_length);
    let at_hip = |flexion: f64| hip_angle(thigh, shank, flexion);
    let normal = thigh_line.cross(shank_line) / (thigh * shank);
    let axis = turn * (normal + leg.knee_axis * HINGE_SHARE).try_normalize()?;
    let hip_turn = at_hip(old_flexion) - at_hip(new_flexion);
    let shank_turn = exp(axis * (hip_turn + new_flexion - old_flexion)) * turn;
    Some((exp(axis * hip_turn) * turn, shank_turn))
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

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
        let knees: Vec<DVec3> = (0..=200).map(|step| bent(f64::from(step) * 1e-5).0).collect();
        // Ten micrometres of hip never move the knee by more than two millimetres.
        assert!(knees.windows(2).all(|pair| (pair[1] - pair[0]).length() < 2e-3));
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
