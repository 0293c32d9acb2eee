//! How the left foot rolls over heel, sole and ball while it stands.

use super::measured::measured_leg;
use super::series::smooth_step;
use super::skeleton::WalkSkeleton;
use crate::humanoid::exp;
use glam::{DQuat, DVec3};

/// Phase at which the left heel lands: feet land a few hundredths of a stride after they are farthest ahead.
pub(super) const LANDS: f64 = 0.055;
/// Phase at which the sole is flat.
const FLAT: f64 = 0.15;
/// Phases between which the heel begins to rise.
const RISES: [f64; 2] = [0.30, 0.48];
/// Phase at which the tip of the toes leaves the floor; the other foot has landed at 0.555.
pub(super) const LEAVES: f64 = 0.63;
/// Phases between which the foot would roll over the tip of its toes, and how far \[rad\], if it did not leave before: the
/// measured feet rise by 3 cm more than a foot that turns about its ball.
const OVER_TOES: ([f64; 2], f64) = ([0.51, 0.70], 0.6);
/// How far the foot turns out while it stands \[rad\]: 6°, usual for adults.
const TOE_OUT_RAD: f64 = 0.105;
/// The toes are bent up by this share of the foot's own angle when it lands on the heel.
const TOES_UP: f64 = 0.4;

/// How a foot stands: how far it points down, and how far its toes do \[rad\].
#[derive(Clone, Copy)]
pub(super) struct Roll {
    foot: f64,
    /// While the foot stands on its heel, they are bent up and this is not used.
    toes: f64,
}

impl Roll {
    /// Turn of the toes against the foot.
    pub fn bend(self) -> f64 {
        if self.foot < 0.0 { TOES_UP * self.foot } else { self.toes - self.foot }
    }
}

/// How the left foot rolls while it stands.
pub(super) fn roll(skeleton: &WalkSkeleton, phase: f64, gain: f64) -> Roll {
    let forward = measured_leg(skeleton, phase, gain).foot * DVec3::Z;
    let down = libm::atan2(-forward.y, (forward.x * forward.x + forward.z * forward.z).sqrt());
    let toes = OVER_TOES.1 * smooth_step(OVER_TOES.0[0], OVER_TOES.0[1], phase);
    if phase < 0.5 * (FLAT + RISES[0]) {
        Roll { foot: down * (1.0 - smooth_step(LANDS, FLAT, phase)), toes }
    } else {
        Roll { foot: down * smooth_step(RISES[0], RISES[1], phase), toes }
    }
}

/// The standing left foot's turn, and its ankle relative to where it is while flat.
pub(super) fn standing(skeleton: &WalkSkeleton, roll: Roll) -> (DQuat, DVec3) {
    let heading = exp(DVec3::Y * TOE_OUT_RAD);
    let turn = heading * exp(DVec3::X * roll.foot);
    let foot = &skeleton.foot;
    // The heel rolls as a ball does; then the toes turn about their tip, and the foot about its ball.
    let (pivot, moved) = if roll.foot < 0.0 {
        (foot.heel, DVec3::Z * (foot.heel_radius_m * roll.foot))
    } else {
        (foot.ball, foot.toe_tip - exp(DVec3::X * roll.toes) * foot.toe_tip)
    };
    (turn, heading * (pivot + moved) - turn * pivot)
}

/// How much of the weight the left foot carries.
pub(super) fn weight(phase: f64) -> f64 {
    let phase = phase - (phase - LANDS).floor();
    smooth_step(LANDS, LEAVES - 0.5, phase) - smooth_step(LANDS + 0.5, LEAVES, phase)
}
