//! Search for the swivel of a limb that keeps its joints inside their limits.

use super::sweep::Sweep;
use std::f64::consts::PI;

/// Maximum number of steps of a search; three or four are usual.
const MAX_STEPS: usize = 64;

/// Cost of a swivel of one radian against excess, if no swivel is inside the limits: the limb does not flip for a small
/// gain.
const PRICE: f64 = 0.03;

/// Number of swivels, over the full circle, at which the excess is sampled first.
const COARSE: usize = 16;

/// Sine and cosine of half the angle between them.
const HALF_STEP: (f64, f64) = (0.195_090_322_016_128_27, 0.980_785_280_403_230_4);

/// Points of the bracket about the best of them that are looked at, and its width at which it is narrow enough \[rad\].
const POINTS: usize = 10;
const NARROW: f64 = 1e-7;

/// The smallest swivel, either way, at which all the joints are inside; `None` if there is none.
pub(super) fn nearest(sweeps: &[Sweep]) -> Option<f64> {
    let ahead = first(sweeps, 1.0, PI);
    // The other direction is searched only up to this one.
    match first(sweeps, -1.0, ahead.unwrap_or(PI)) {
        Some(back) => Some(-back),
        None => ahead,
    }
}

/// The first swivel inside for angles of this sign, up to `max`.
fn first(sweeps: &[Sweep], sign: f64, max: f64) -> Option<f64> {
    let round = sweeps.iter().all(Sweep::is_round);
    let mut at = 0.0;
    for _ in 0..MAX_STEPS {
        let mut next = at;
        for sweep in sweeps {
            next = sweep.next(sign, next)?;
        }
        if next >= max {
            return None;
        }
        if next == at {
            if round {
                return Some(at);
            }
            let (sin, cos) = libm::sincos(at);
            let step = sweeps.iter().map(|sweep| sweep.ahead(sign, (sign * sin, cos))).fold(0.0, f64::max);
            if step == 0.0 {
                return Some(at);
            }
            next = at + step;
        }
        at = next;
    }
    None
}

/// The objective at one swivel.
#[derive(Clone, Copy)]
struct Cost {
    angle: f64,
    value: f64,
    slope: f64,
    /// Which of the formulas it is by.
    which: u32,
}

impl Cost {
    fn at(sweeps: &[(Sweep, f64)], angle: f64) -> Cost {
        Cost::with(sweeps, angle, libm::sincos(0.5 * angle))
    }

    /// `half`: sine and cosine of half the angle.
    #[inline(always)]
    fn with(sweeps: &[(Sweep, f64)], angle: f64, half: (f64, f64)) -> Cost {
        let (sin, cos) = half;
        let turn = (2.0 * sin * cos, cos * cos - sin * sin);
        let sign = if angle < 0.0 { -1.0 } else { 1.0 };
        let mut cost = Cost { angle, value: PRICE * angle.abs(), slope: PRICE * sign, which: u32::from(angle < 0.0) };
        for (sweep, weight) in sweeps {
            let excess = sweep.excess(half, turn);
            cost.value += weight * excess.rad;
            cost.slope += weight * excess.slope;
            cost.which = 4 * cost.which + u32::from(excess.which);
        }
        cost
    }
}

/// The swivel at which the joints are least outside, each by its weight, with a small preference for small ones.
///
/// The best of sixteen all round, then a bracket that is narrowed: where one formula holds at both ends, to where its slope would
/// be zero; where the formula changes between them, to where the tangents meet.
pub(super) fn least(sweeps: &[(Sweep, f64)]) -> f64 {
    let step = 2.0 * PI / COARSE as f64;
    let (mut angle, mut value, mut half) = (0.0, f64::INFINITY, (0.0, 1.0));
    for index in 0..COARSE {
        let turns = if index <= COARSE / 2 { index as f64 } else { index as f64 - COARSE as f64 };
        let there = Cost::with(sweeps, turns * step, half).value;
        if there < value {
            (angle, value) = (turns * step, there);
        }
        // On by a step. The sign of both after half a turn does not matter.
        half = (half.0 * HALF_STEP.1 + half.1 * HALF_STEP.0, half.1 * HALF_STEP.1 - half.0 * HALF_STEP.0);
    }
    let mut best = Cost::at(sweeps, angle);
    let (mut low, mut high) = if best.slope > 0.0 {
        (Cost::at(sweeps, best.angle - step), best)
    } else {
        (best, Cost::at(sweeps, best.angle + step))
    };
    for point in 0..POINTS {
        let width = high.angle - low.angle;
        if width < NARROW {
            break;
        }
        let meeting = if point % 3 == 2 {
            0.5
        } else if low.which == high.which {
            low.slope / (low.slope - high.slope)
        } else {
            (high.value - low.value - high.slope * width) / ((low.slope - high.slope) * width)
        };
        let share = if meeting.is_finite() { meeting.clamp(0.01, 0.99) } else { 0.5 };
        let there = Cost::at(sweeps, low.angle + share * width);
        if there.value < best.value {
            best = there;
        }
        if there.slope > 0.0 {
            high = there;
        } else {
            low = there;
        }
    }
    best.angle
}

#[cfg(test)]
#[path = "swivel_tests.rs"]
mod tests;
