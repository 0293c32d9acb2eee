//! An elbow or a knee: limb length as a function of flexion, and its inverse.

use super::super::Limit;
use super::super::rotation::exp;
use super::Limb;
use glam::{DQuat, DVec3};
use std::f64::consts::TAU;

/// Share of the full reach up to which the target is met exactly; from there on the limb nears its full length smoothly. A limb
/// that is followed all the way out straightens at infinite speed.
pub(super) const EXACT_REACH: f64 = 0.99;

/// The two flexions that bring the effector to the same distance, on either side of where the limb is longest.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Side {
    /// The way the joint bends.
    Bent,
    /// The other, which lies in the joint's range only if the effector is off the lower bone's line.
    Back,
}

impl Side {
    pub fn other(self) -> Side {
        match self {
            Side::Bent => Side::Back,
            Side::Back => Side::Bent,
        }
    }
}

/// The joint.
pub(super) struct Hinge {
    /// Turn of the lower bone about itself, before the flexion.
    pub twist: DQuat,
    /// Squared length = `mean` + 2 `swing` cos(flexion − `straight`).
    mean: f64,
    swing: f64,
    straight: f64,
    /// Range of the flexion about X \[rad\].
    range: (f64, f64),
    /// -1 for elbows, 1 for knees: the sign of their flexion.
    sign: f64,
}

impl Hinge {
    /// `near`: the lower bone's turn, whose turn about itself is kept; `elbow`: the joint in the upper bone's frame; `in_lower`:
    /// the effector in the lower bone's \[m\].
    pub fn new(limit: &Limit, limb: Limb, near: DQuat, elbow: DVec3, in_lower: DVec3) -> Hinge {
        let twist = if limb.is_leg() { DQuat::IDENTITY } else { kept_twist(near, limit.twist) };
        let end = twist * in_lower;
        let (along, across) = (elbow.y * end.y + elbow.z * end.z, elbow.z * end.y - elbow.y * end.z);
        let centre = 2.0 * libm::asin(limit.centre.x.clamp(-1.0, 1.0));
        Hinge {
            twist,
            mean: elbow.length_squared() + end.length_squared() + 2.0 * elbow.x * end.x,
            swing: (along * along + across * across).sqrt(),
            straight: libm::atan2(across, along),
            range: (centre - limit.swing.x_negative, centre + limit.swing.x_positive),
            sign: if limb.is_leg() { 1.0 } else { -1.0 },
        }
    }

    /// Whether it is valid: bones with a length, a range that is not empty.
    pub fn is_sound(&self) -> bool {
        self.swing >= 1e-9 && self.range.0 <= self.range.1
    }

    /// How far the effector is from the limb's first joint when the limb is as long as its range lets it be \[m\].
    pub fn longest(&self) -> f64 {
        let off = self.straight.clamp(self.range.0, self.range.1) - self.straight;
        (self.mean + 2.0 * self.swing * cos(off)).max(0.0).sqrt()
    }

    /// The flexion, a turn about X within the range, that brings the effector nearest to a point seen from this joint in the
    /// upper bone's frame \[m\].
    pub fn nearest_to(&self, seen: DVec3, in_lower: DVec3) -> DQuat {
        let end = self.twist * in_lower;
        let middle = 0.5 * (self.range.0 + self.range.1);
        let off = libm::atan2(seen.z, seen.y) - libm::atan2(end.z, end.y) - middle;
        let off = off - TAU * (off / TAU).round();
        exp(DVec3::X * (middle + off).clamp(self.range.0, self.range.1))
    }

    /// On which side a turn of the lower bone is.
    pub fn side_of(&self, lower: DQuat) -> Side {
        let flexion = 2.0 * libm::atan2(lower.x, lower.w);
        let off = flexion - self.straight;
        if self.sign * (off - TAU * (off / TAU).round()) < 0.0 { Side::Back } else { Side::Bent }
    }

    /// Soft clamp of a wanted distance: exact up to [`EXACT_REACH`] of the limb, then approaching the maximum smoothly.
    pub fn softened(&self, distance: f64) -> f64 {
        soft_minimum(distance, self.longest())
    }

    /// The lower bone's flexion, a turn about X that comes after `twist`, at which the effector is so far from the limb's first
    /// joint \[m\], or as near to that as the range lets it; [`Side::Back`] only where the range has it.
    pub fn at_distance(&self, distance: f64, side: Side) -> Option<DQuat> {
        let cosine = (distance * distance - self.mean) / (2.0 * self.swing);
        let bend = self.sign * libm::acos(cosine.clamp(-1.0, 1.0));
        let flexion = match side {
            Side::Bent => (self.straight + bend).clamp(self.range.0, self.range.1),
            Side::Back => {
                let flexion = self.straight - bend;
                if flexion < self.range.0 || flexion > self.range.1 {
                    return None;
                }
                flexion
            }
        };
        Some(exp(DVec3::X * flexion))
    }
}

/// Shortcut: the angle is 0 in most calls.
fn cos(angle: f64) -> f64 {
    if angle == 0.0 { 1.0 } else { libm::cos(angle) }
}

/// The twist of a joint's rotation, clamped to its range.
fn kept_twist(turn: DQuat, range: (f64, f64)) -> DQuat {
    let bare = DQuat::from_xyzw(0.0, turn.y, 0.0, turn.w);
    let bare = if turn.w < 0.0 { -bare } else { bare };
    let angle = 2.0 * libm::atan2(bare.y, bare.w);
    let norm = bare.length();
    if norm > 1e-9 && angle >= range.0 && angle <= range.1 {
        return bare / norm;
    }
    exp(DVec3::Y * if norm > 1e-9 { angle } else { 0.0 }.clamp(range.0, range.1))
}

/// Soft clamp: exact up to [`EXACT_REACH`] of the limit, then approaching the limit smoothly.
fn soft_minimum(value: f64, limit: f64) -> f64 {
    let from = EXACT_REACH * limit;
    let room = limit - from;
    if value <= from || room <= 0.0 { value.min(limit) } else { from - room * libm::expm1(-(value - from) / room) }
}
