//! Heel rise: in a deep squat, behind a long step, and to reach up.
//!
//! Under `print` feet stay flat. A person's ankle flexes by some 40°, then the heel rises; before it does, the weight
//! shifts over the balls of the feet. Our foot is one piece: it rotates about the front edge of its sole, which stays
//! in place, and gives support from the ball to that edge, as a foot with toes would.

use crate::head::smooth;
use glam::{DQuat, DVec3};
use sinew_body::humanoid::exp;

/// Ankle flexion from which the heel rises \[rad\], the width of the transition, and the rise per flexion beyond it.
const ANKLE_RAD: f64 = 0.6;
const SOFTLY_RAD: f64 = 0.16;
const RISES: f64 = 1.4;

/// Ankle flexion, relative to that one, at which the weight begins to shift forward \[rad\].
const LEANS_RAD: f64 = 0.45;

/// First part of a rise on the toes, in which only the weight shifts forward \[rad\].
pub(crate) const LEAN_FIRST_RAD: f64 = 0.15;

/// Maximum heel rise on the toes \[rad\].
pub(crate) const MAX_RAD: f64 = 0.6;

/// A heel at an instant.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Heel {
    /// Rotation of the foot about its toes \[rad\].
    pub pitch_rad: f64,
    /// Shift of the weight to the ball of the foot \[1\].
    pub forward: f64,
}

impl Heel {
    /// The heel for an ankle flexion on a flat foot \[rad\], weighted by a blend \[1\], of a body that rises on its
    /// toes by an angle \[rad\].
    pub fn of(bend_rad: f64, obeys: f64, tiptoe_rad: f64) -> Heel {
        let squats = obeys * smooth(bend_rad, ANKLE_RAD - LEANS_RAD, ANKLE_RAD + 0.5 * SOFTLY_RAD);
        let stretches = smooth(tiptoe_rad, 0.0, LEAN_FIRST_RAD);
        let pitch = obeys * RISES * ramp(bend_rad - ANKLE_RAD, SOFTLY_RAD) + Heel::tiptoe(tiptoe_rad);
        Heel { pitch_rad: crate::head::soft(pitch, 1.25 * MAX_RAD), forward: 1.0 - (1.0 - squats) * (1.0 - stretches) }
    }

    /// The same in a walk, in which the heel rises by an angle more \[rad\].
    pub fn and(self, heel_off_rad: f64) -> Heel {
        Heel { pitch_rad: self.pitch_rad + heel_off_rad, ..self }
    }

    /// The part of it that lifts the body \[rad\].
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

/// A foot (ankle, `world_from_foot`) with its heel raised.
pub(crate) fn raised(foot: (DVec3, DQuat), toe: DVec3, pitch_rad: f64) -> (DVec3, DQuat) {
    if pitch_rad <= 0.0 {
        return foot;
    }
    let turn = exp(DVec3::X * pitch_rad);
    (foot.0 + foot.1 * (toe - turn * toe), (foot.1 * turn).normalize())
}
