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

/// The input's thigh and shank turned in the world, `world_from_world` deltas, so that the leg, its hip at `hip`, puts
/// its ankle at `ankle`; the leg stretches as far as it can when the ankle is out of reach.
///
/// The lengths leave the knee free to go round the line from hip to ankle. Where the leg stretches, it stays on its side; where
/// it flexes more, it moves forward, as its hinge bends, from wherever it is: so a nearly straight leg, whose side is noise,
/// does not swing round with that noise. The twists of thigh and shank keep the hinge axis fixed to the leg as a whole.
pub fn solve_leg(input: &LegPose, hip: DVec3, ankle: DVec3) -> (DQuat, DQuat) {
    solve_leg_beside(input, hip, ankle, OffLine::at)
}

/// As [`solve_leg`], where `beside` says where the knee comes from where it was and how far off the line it has to be \[m\].
pub(crate) fn solve_leg_beside(
    input: &LegPose,
    hip: DVec3,
    ankle: DVec3,
    beside: impl Fn(&OffLine, f64) -> OffLine,
) -> (DQuat, DQuat) {
    if hip == input.hip && ankle == input.ankle {
        return (DQuat::IDENTITY, DQuat::IDENTITY);
    }
    place_knee(input, hip, ankle, beside).unwrap_or_default()
}

/// A knee beside the line from hip to ankle \[m\]: forward, as its hinge bends, and to the side.
#[derive(Clone, Copy, Debug)]
pub(crate) struct OffLine {
    pub(crate) front: f64,
    pub(crate) side: f64,
}

/// `None` for a leg without length.
fn place_knee(
    leg: &LegPose,
    hip: DVec3,
    ankle: DVec3,
    beside: impl Fn(&OffLine, f64) -> OffLine,
) -> Option<(DQuat, DQuat)> {
    let (thigh_line, shank_line) = (leg.knee - leg.hip, leg.ankle - leg.knee);
    let (thigh, shank) = (thigh_line.length(), shank_line.length());
    let old_line = (leg.ankle - leg.hip).try_normalize()?;
    let new_line = (ankle - hip).try_normalize()?;
    if thigh < 1e-6 || shank < 1e-6 {
        return None;
    }
    let front = old_line.cross(leg.knee_axis).try_normalize()?;
    let side = old_line.cross(front);
    let off_line = OffLine { front: thigh_line.dot(front), side: thigh_line.dot(side) };

    let turn = DQuat::from_rotation_arc(old_line, new_line);
    let length = (ankle - hip).length();
    let (sin, cos) = libm::sincos(hip_angle(thigh, shank, flexion_for(thigh, shank, length)));
    let off_line = beside(&off_line, thigh * sin);
    let knee = hip + new_line * (thigh * cos) + (turn * front) * off_line.front + (turn * side) * off_line.side;
    let axis = turn * leg.knee_axis;
    let thigh_turn = along(knee - hip, axis)? * along(turn * thigh_line, axis)?.conjugate() * turn;
    let shank_turn = along(ankle - knee, axis)? * along(turn * shank_line, axis)?.conjugate() * turn;
    Some((thigh_turn.normalize(), shank_turn.normalize()))
}

/// How far off the line a knee that is bent backward has to come, squared and relative to how far behind it is, until it is in
/// front: some four times as far as it was.
const ROUND: f64 = 15.0;

impl OffLine {
    /// This knee when it is so far off the line.
    fn at(&self, far: f64) -> OffLine {
        let was = (self.front * self.front + self.side * self.side).sqrt();
        if far <= was {
            let share = if was > 0.0 { far / was } else { 0.0 };
            return OffLine { front: self.front * share, side: self.side * share };
        }
        let further = (far - was) * (far + was);
        let ahead = (self.front * self.front + further).sqrt();
        if self.front >= 0.0 {
            return OffLine { front: ahead, side: self.side };
        }
        // One that the input bends backward goes round, always by the same side.
        let (mut from, to) = (libm::atan2(self.side, self.front), libm::atan2(self.side, ahead));
        if from < -BEHIND {
            from += 2.0 * std::f64::consts::PI;
        }
        let share = smoothstep(0.0, ROUND * self.front * self.front, further);
        let (sin, cos) = libm::sincos(from + (to - from) * share);
        OffLine { front: far * cos, side: far * sin }
    }
}

/// Angle around the leg's line beyond which a knee counts as bent backward rather than aside \[rad\].
const BEHIND: f64 = 2.1;

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
pub(crate) fn smoothstep(from: f64, to: f64, value: f64) -> f64 {
    let share = ((value - from) / (to - from)).clamp(0.0, 1.0);
    share * share * (3.0 - 2.0 * share)
}

/// How much of its flexion a knee may lose, and gain.
const LESS: f64 = 0.15;
const MORE: f64 = 0.25;

/// By how much the line from hip to ankle of an input's leg may change its length.
#[derive(Clone, Copy, Debug)]
pub(super) struct Stretch {
    /// The input's length \[m\].
    pub length_m: f64,
    /// Largest gain and loss \[m\].
    longer_m: f64,
    shorter_m: f64,
}

impl Stretch {
    pub(super) fn of(leg: &LegPose) -> Stretch {
        let (thigh_line, shank_line, line) = (leg.knee - leg.hip, leg.ankle - leg.knee, leg.ankle - leg.hip);
        let (thigh, shank, length) = (thigh_line.length(), shank_line.length(), line.length());
        let flexion = flexion_for(thigh, shank, length);
        // A knee that is bent backward or aside has no flexion of its hinge to change.
        let front = line.cross(leg.knee_axis).normalize_or_zero();
        let off_line = thigh_line - line * (thigh_line.dot(line) / line.length_squared().max(1e-12));
        let hinged = (off_line.dot(front) / off_line.length().max(1e-9)).max(0.0);
        let at = |flexion: f64| {
            let cos = libm::cos(flexion.min(std::f64::consts::PI));
            (thigh * thigh + shank * shank + 2.0 * thigh * shank * cos).max(0.0).sqrt()
        };
        Stretch {
            length_m: length,
            longer_m: (at(flexion * (1.0 - LESS * hinged)) - length).max(0.0),
            shorter_m: (length - at(flexion * (1.0 + MORE * hinged))).max(0.0),
        }
    }

    /// A change of length, saturated.
    pub(super) fn within(&self, change_m: f64) -> f64 {
        let most = if change_m > 0.0 { self.longer_m } else { self.shorter_m };
        let ratio = change_m / most.max(1e-9);
        if most > 1e-9 { change_m / (1.0 + ratio * ratio).sqrt() } else { 0.0 }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn a_nearly_straight_knee_bends_forward_whichever_side_noise_puts_it_on() {
        let bent = |x: f64, z: f64| {
            let input = LegPose { knee: DVec3::new(0.115 + x, 0.49, z), ..leg() };
            let (thigh, _) = solve_leg(&input, input.hip - DVec3::Y * 0.02, input.ankle);
            input.hip - DVec3::Y * 0.02 + thigh * (input.knee - input.hip)
        };
        for (x, z) in [(1e-3, 0.0), (-1e-3, 0.0), (0.0, 1e-3), (7e-4, -7e-4)] {
            // Two millimetres of noise around the leg move the bent knee by no more than that.
            assert!((bent(x, -0.009 + z) - bent(0.0, -0.009)).length() < 2e-3, "{x} {z}");
        }
    }

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
        assert!(bent(0.01).1 > 0.05);
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
