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

/// Displacement of hip and ankle over which a knee that the input bends backward comes round to bend forward \[m\]. Straight
/// legs are so long that the ankle is then off by less than this.
const ROUND_M: f64 = 3e-4;

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
    let share = (moved / ROUND_M).min(1.0);
    // From -1, bent backward as the input is, to 1.
    let forward = 2.0 * share * share * (3.0 - 2.0 * share) - 1.0;
    let forward = if flexion(input) < 0.0 { forward } else { 1.0 };
    let (mut thigh, mut shank) = (DQuat::IDENTITY, DQuat::IDENTITY);
    let mut leg = *input;
    for _ in 0..ROUNDS {
        let Some((thigh_turn, shank_turn)) = bend(&leg, hip, ankle, forward) else { break };
        thigh = (thigh_turn * thigh).normalize();
        shank = (shank_turn * shank).normalize();
        let knee = hip + thigh * (input.knee - input.hip);
        let ankle = knee + shank * (input.ankle - input.knee);
        leg = LegPose { hip, knee, ankle, knee_axis: (shank * input.knee_axis).normalize() };
    }
    (thigh, shank)
}

/// The knee's flexion \[rad\], negative when it is bent backward.
fn flexion(leg: &LegPose) -> f64 {
    let (thigh, shank) = (leg.knee - leg.hip, leg.ankle - leg.knee);
    let normal = thigh.cross(shank);
    let angle = libm::atan2(normal.length(), thigh.dot(shank));
    if normal.dot(leg.knee_axis) < 0.0 { -angle } else { angle }
}

/// One round: turns the leg towards the ankle as a whole, then bends it. `None` for a leg without length.
fn bend(leg: &LegPose, hip: DVec3, ankle: DVec3, forward: f64) -> Option<(DQuat, DQuat)> {
    let (thigh_line, shank_line) = (leg.knee - leg.hip, leg.ankle - leg.knee);
    let (thigh, shank) = (thigh_line.length(), shank_line.length());
    let (old_line, new_line) = (leg.ankle - leg.hip, ankle - hip);
    let (old_length, new_length) = (old_line.length(), new_line.length());
    if thigh < 1e-6 || shank < 1e-6 || old_length < 1e-6 || new_length < 1e-6 {
        return None;
    }
    let turn = DQuat::from_rotation_arc(old_line / old_length, new_line / new_length);
    let wanted = new_length.clamp((thigh - shank).abs() + 1e-9, thigh + shank);
    let at_knee = (thigh * thigh + shank * shank - wanted * wanted) / (2.0 * thigh * shank);
    let old_flexion = flexion(leg);
    let new_flexion = forward * (std::f64::consts::PI - libm::acos(at_knee.clamp(-1.0, 1.0)));
    // Angle at the hip from the line to the ankle to the thigh.
    let at_hip = |flexion: f64| {
        let (sin, cos) = libm::sincos(flexion);
        libm::atan2(shank * sin, thigh + shank * cos)
    };
    let normal = thigh_line.cross(shank_line) / (thigh * shank);
    let normal = if old_flexion < 0.0 { -normal } else { normal };
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
            // See ROUND_M; and a leg bent backward by 3 degrees is 0.3 mm shorter than straight.
            assert!((ankle - input.ankle).length() < 1e-3, "{drop}: {}", (ankle - input.ankle).length());
            flexion(&LegPose { hip, knee, ankle, knee_axis: shank * input.knee_axis })
        };
        let angles: Vec<f64> = (0..=1000).map(|step| bent(f64::from(step) * 1e-6)).collect();
        assert!(angles[1000] > 0.05);
        // Ten micrometres of hip never turn the knee by more than a degree.
        assert!(angles.windows(2).all(|pair| (pair[1] - pair[0]).abs() < 0.1f64.to_radians()));
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
