//! Meeting what flies: where a thrown thing will be, and where and when a hand is there before it.

use crate::Style;
use crate::reacher::{Goal, Reacher};
use glam::DVec3;

/// The flight of a thing under gravity and a drag in proportion to its speed, as a damped rigid body has it.
///
/// ```
/// use glam::DVec3;
/// use sinew_reach::Flight;
///
/// let flight = Flight { at: DVec3::Y, velocity: DVec3::Z * 6.0, gravity_m_s2: 9.81, drag_per_s: 0.0 };
/// let there = flight.after(0.3);
/// assert!((there.z - 1.8).abs() < 1e-12 && (there.y - (1.0 - 0.5 * 9.81 * 0.09)).abs() < 1e-12);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Flight {
    /// Where it is \[m\], world.
    pub at: DVec3,
    /// Its velocity \[m/s\].
    pub velocity: DVec3,
    /// Gravity that acts on it, downwards \[m/s²\].
    pub gravity_m_s2: f64,
    /// Its drag \[1/s\]: deceleration per speed.
    pub drag_per_s: f64,
}

/// Where and when a hand meets what flies.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Meeting {
    /// The place \[m\], world.
    pub at: DVec3,
    /// How long from now \[s\].
    pub in_secs: f64,
}

/// Times at which a meeting is tried \[s\]: the first, how far apart, and how many.
const FIRST_SECS: f64 = 0.2;
const EVERY_SECS: f64 = 0.06;
const TRIES: usize = 40;

/// A thing lower than this is on the floor, and one farther from the hips than this is not run after \[1 of the stature\].
const LOWEST: f64 = 0.05;
const FARTHEST: f64 = 1.4;

/// Cost of a second in which nothing has happened yet, of a step, and of a radian or metre of bending.
const WAITS: f64 = 0.5;
const STEPS: f64 = 0.4;

impl Flight {
    /// Where it is after a time \[s\], if nothing is in its way \[m\].
    pub fn after(&self, secs: f64) -> DVec3 {
        let gravity = DVec3::NEG_Y * self.gravity_m_s2;
        let k = self.drag_per_s;
        if k < 1e-6 {
            return self.at + self.velocity * secs + gravity * (0.5 * secs * secs);
        }
        let gone = (1.0 - libm::exp(-k * secs)) / k;
        self.at + (self.velocity - gravity / k) * gone + gravity * (secs / k)
    }
}

impl Reacher {
    /// Reaches with one hand, 0 left and 1 right, for where a flying thing will be, `offset` away from its middle \[m\], and sets the
    /// style's time to when it will be there: the place that costs the body least of those where the hand is in time. `None` when it is
    /// in time nowhere; nothing has changed then.
    pub fn meet(&mut self, side: usize, flight: &Flight, offset: DVec3) -> Option<Meeting> {
        let now = self.now_secs;
        let hips = self.composed_at(now).pose.hips_position;
        let stature = self.frame.body.stature_m();
        let floor = self.feet.planted[0].ankle.y - self.frame.ankle_m;
        let usual = self.style;
        let mut best: Option<(f64, Reacher, Meeting)> = None;
        for index in 0..TRIES {
            let in_secs = FIRST_SECS + EVERY_SECS * index as f64;
            let at = flight.after(in_secs) + offset;
            if !at.is_finite() || at.y - floor < LOWEST * stature {
                break;
            }
            let away = (at - hips).with_y(0.0).length();
            if away > FARTHEST * stature || at.y - floor > self.frame.highest_m {
                continue;
            }
            let mut other = self.clone();
            other.style = Style { time_secs: Some(in_secs), speed_m_s: None, ..usual };
            let goal =
                if side == 0 { Goal { left: Some(at), right: None } } else { Goal { left: None, right: Some(at) } };
            let outcome = other.reach(&goal);
            if !outcome.is_reached() || outcome.is_late {
                continue;
            }
            let bends = outcome.twist_rad.abs() + outcome.swing_rad.abs() + outcome.squat_m;
            let cost = WAITS * in_secs + STEPS * outcome.steps.len() as f64 + bends;
            if best.as_ref().is_none_or(|best| cost < best.0) {
                best = Some((cost, other, Meeting { at, in_secs }));
            }
        }
        let (_, reacher, meeting) = best?;
        *self = reacher;
        Some(meeting)
    }
}
