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

/// The input's thigh and shank turned in the world, `world_from_world` deltas, so that the leg, its hip at `hip`, puts
/// its ankle at `ankle`; the leg stretches as far as it can when the ankle is out of reach.
pub fn solve_leg(input: &LegPose, hip: DVec3, ankle: DVec3) -> (DQuat, DQuat) {
    if hip == input.hip && ankle == input.ankle {
        return (DQuat::IDENTITY, DQuat::IDENTITY);
    }
    let (thigh, shank) = ((input.knee - input.hip).length(), (input.ankle - input.knee).length());
    let (old_line, new_line) = (input.ankle - input.hip, ankle - hip);
    let (old_length, new_length) = (old_line.length(), new_line.length());
    if thigh < 1e-6 || shank < 1e-6 || old_length < 1e-6 || new_length < 1e-6 {
        return (DQuat::IDENTITY, DQuat::IDENTITY);
    }
    let turn = DQuat::from_rotation_arc(old_line / old_length, new_line / new_length);
    let wanted = new_length.clamp((thigh - shank).abs() + 1e-9, thigh + shank);
    // Angle at the hip between the thigh and the line to the ankle, and the knee's flexion.
    let angles = |length: f64| {
        let at_hip = (thigh * thigh + length * length - shank * shank) / (2.0 * thigh * length);
        let at_knee = (thigh * thigh + shank * shank - length * length) / (2.0 * thigh * shank);
        (libm::acos(at_hip.clamp(-1.0, 1.0)), std::f64::consts::PI - libm::acos(at_knee.clamp(-1.0, 1.0)))
    };
    let (old_hip_angle, old_flexion) = angles(old_length);
    let (new_hip_angle, new_flexion) = angles(wanted);
    let normal = (input.knee - input.hip).cross(input.ankle - input.knee);
    // Below half a degree of flexion the plane of the leg is noise.
    let axis = if normal.length() > 0.009 * thigh * shank { normal.normalize() } else { input.knee_axis };
    let axis = turn * axis;
    let thigh_turn = exp(axis * (old_hip_angle - new_hip_angle)) * turn;
    let shank_turn = exp(axis * ((new_flexion - new_hip_angle) - (old_flexion - old_hip_angle))) * turn;
    (thigh_turn, shank_turn)
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
