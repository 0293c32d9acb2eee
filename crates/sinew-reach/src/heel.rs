//! Heels that rise: in a deep squat, behind a long step, and to reach up.
//!
//! The print's feet stay flat. A person's ankle bends some 40°, then the heel comes up; before it does, the weight goes over the
//! balls of the feet. Our foot is one piece: it turns about the front edge of its sole, which stays where it is, and counts as bearing
//! from the ball to that edge, as far as a foot with toes that bend would.

use crate::head::smooth;
use glam::{DQuat, DVec3};
use sinew_body::humanoid::exp;

/// Bend of the ankle from which the heel rises \[rad\], how softly, and how much it rises for what is beyond.
const ANKLE_RAD: f64 = 0.6;
const SOFTLY_RAD: f64 = 0.16;
const RISES: f64 = 1.4;

/// Bend of the ankle before that at which the weight begins to go forward \[rad\].
const LEANS_RAD: f64 = 0.45;

/// First part of a rise on the toes, in which only the weight goes forward \[rad\].
pub(crate) const LEAN_FIRST_RAD: f64 = 0.15;

/// How far a foot rises on its toes \[rad\].
pub(crate) const MAX_RAD: f64 = 0.6;

/// A heel at an instant.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Heel {
    /// How far the foot is turned up about its toes \[rad\].
    pub pitch_rad: f64,
    /// How far the weight is over the ball of the foot \[1\].
    pub forward: f64,
}

impl Heel {
    /// The heel of an ankle that would be bent so far on a flat foot \[rad\], obeying that so far \[1\], of a body that rises so far
    /// on its toes \[rad\].
    pub fn of(bend_rad: f64, obeys: f64, tiptoe_rad: f64) -> Heel {
        let squats = obeys * smooth(bend_rad, ANKLE_RAD - LEANS_RAD, ANKLE_RAD + 0.5 * SOFTLY_RAD);
        let stretches = smooth(tiptoe_rad, 0.0, LEAN_FIRST_RAD);
        let pitch = obeys * RISES * ramp(bend_rad - ANKLE_RAD, SOFTLY_RAD) + Heel::tiptoe(tiptoe_rad);
        Heel { pitch_rad: crate::head::soft(pitch, 1.25 * MAX_RAD), forward: 1.0 - (1.0 - squats) * (1.0 - stretches) }
    }

    /// What of it is meant to lift the body \[rad\].
    pub fn tiptoe(tiptoe_rad: f64) -> f64 {
        ramp(tiptoe_rad - 0.7 * LEAN_FIRST_RAD, 0.6 * LEAN_FIRST_RAD)
    }
}

/// 0 up to 0, a line of slope 1 from `width` on; between, without a kink in its third derivative.
fn ramp(value: f64, width: f64) -> f64 {
    let share = value / width;
    if share <= 0.0 {
        0.0
    } else if share >= 1.0 {
        value - 0.5 * width
    } else {
        let square = share * share;
        width * square * square * (2.5 - 3.0 * share + square)
    }
}

/// A foot (ankle, `world_from_foot`) whose heel has come up.
pub(crate) fn raised(foot: (DVec3, DQuat), toe: DVec3, pitch_rad: f64) -> (DVec3, DQuat) {
    if pitch_rad <= 0.0 {
        return foot;
    }
    let turn = exp(DVec3::X * pitch_rad);
    (foot.0 + foot.1 * (toe - turn * toe), (foot.1 * turn).normalize())
}
