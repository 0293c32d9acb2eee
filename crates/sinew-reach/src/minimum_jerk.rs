//! A minimum-jerk trajectory that can be redirected at any time without a jump in value, velocity or acceleration.

use sinew_snapshot::{Snapshot, snapshot};
use std::ops::{Add, Mul, Sub};

/// Types that can be interpolated: numbers and vectors.
pub trait Value:
    Copy + Add<Output = Self> + Sub<Output = Self> + Mul<f64, Output = Self> + PartialEq + Default
{
}

impl<T: Copy + Add<Output = T> + Sub<Output = T> + Mul<f64, Output = T> + PartialEq + Default> Value for T {}

/// A value over time: at rest, or along a polynomial of fifth degree whose value, velocity and acceleration are
/// continuous at both ends. From rest to rest that is the minimum-jerk profile of human reaching (Flash, Hogan 1985).
///
/// ```
/// use sinew_reach::MinimumJerk;
/// let mut turn = MinimumJerk::rest(0.0);
/// turn.go(0.0, 1.0, 0.0, 2.0);
/// assert_eq!(turn.at(1.0), 0.5);
/// // Somewhere else, in the middle of the way: nothing jumps.
/// let (value, velocity) = (turn.at(1.0), turn.velocity(1.0));
/// turn.go(1.0, -1.0, 0.0, 1.0);
/// assert_eq!((turn.at(1.0), turn.velocity(1.0)), (value, velocity));
/// assert_eq!(turn.at(2.0), -1.0);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MinimumJerk<T> {
    from_secs: f64,
    for_secs: f64,
    /// Coefficients of the powers of the elapsed share of the time.
    factors: [T; 6],
    goal: T,
    /// Whether its time is warped: fast first, then slow.
    early: bool,
}

snapshot!([T: Snapshot] MinimumJerk<T> { from_secs, for_secs, factors, goal, early });

impl<T: Value> MinimumJerk<T> {
    /// A constant value.
    pub fn rest(value: T) -> MinimumJerk<T> {
        let mut factors = [T::default(); 6];
        factors[0] = value;
        MinimumJerk { from_secs: 0.0, for_secs: 0.0, factors, goal: value, early: false }
    }

    /// Starts with a velocity \[1/s\] and reaches `goal` after `for_secs`.
    pub fn moving(now: f64, value: T, velocity: T, goal: T, for_secs: f64) -> MinimumJerk<T> {
        MinimumJerk::between(now, for_secs, value, velocity, T::default(), goal)
    }

    /// Goes to `goal` in `for_secs` \[s\], beginning `after_secs` from `now`; a value that moves already begins at once
    /// and arrives at the same time.
    pub fn go(&mut self, now: f64, goal: T, after_secs: f64, for_secs: f64) {
        let (velocity, acceleration) = (self.velocity(now), self.acceleration(now));
        let is_moving = velocity != T::default() || acceleration != T::default();
        let (from, lasts) = if is_moving { (now, after_secs + for_secs) } else { (now + after_secs, for_secs) };
        *self = MinimumJerk::between(from, lasts, self.at(now), velocity, acceleration, goal);
    }

    /// As [`MinimumJerk::go`], from rest, but faster in the first half and slower for longer at the end, as people's
    /// hands are: the same polynomial in a time that runs fast first, u becoming 1 − (1 − u)^1.5. It is fastest after a
    /// third of the time, at 2.26 of its mean speed.
    pub fn go_early(&mut self, now: f64, goal: T, after_secs: f64, for_secs: f64) {
        self.go(now, goal, after_secs, for_secs);
        self.early = self.factors[1] == T::default() && self.factors[2] == T::default();
    }

    /// Shifts value and goal by a step: the origin from which they are measured has changed.
    pub fn shift(&mut self, by: T) {
        self.factors[0] = self.factors[0] + by;
        self.goal = self.goal + by;
    }

    /// From a value, velocity and acceleration at a time \[s\] to rest at `goal` after `for_secs`.
    pub(crate) fn between(
        from_secs: f64,
        for_secs: f64,
        value: T,
        velocity: T,
        acceleration: T,
        goal: T,
    ) -> MinimumJerk<T> {
        let for_secs = for_secs.max(MIN_SECS);
        let (way, v, a) = (goal - value, velocity * for_secs, acceleration * (for_secs * for_secs));
        let factors = [
            value,
            v,
            a * 0.5,
            way * 10.0 - v * 6.0 - a * 1.5,
            v * 8.0 - way * 15.0 + a * 1.5,
            way * 6.0 - v * 3.0 - a * 0.5,
        ];
        MinimumJerk { from_secs, for_secs, factors, goal, early: false }
    }

    /// The same way from another value, begun with the same velocity.
    pub(crate) fn begun_at(&self, value: T) -> MinimumJerk<T> {
        let velocity = self.velocity(self.from_secs);
        MinimumJerk::between(self.from_secs, self.for_secs, value, velocity, T::default(), self.goal)
    }

    /// The goal.
    pub fn goal(&self) -> T {
        self.goal
    }

    /// Time of its start \[s\].
    pub fn begins_secs(&self) -> f64 {
        self.from_secs
    }

    /// Time of its arrival \[s\].
    pub fn end_secs(&self) -> f64 {
        self.from_secs + self.for_secs
    }

    /// Its value at a time \[s\].
    pub fn at(&self, secs: f64) -> T {
        match self.share(secs) {
            None => self.goal,
            Some(u) => {
                let f = &self.factors;
                let u = self.warped(u)[0];
                f[0] + (f[1] + (f[2] + (f[3] + (f[4] + f[5] * u) * u) * u) * u) * u
            }
        }
    }

    /// Its velocity at a time \[1/s\].
    pub fn velocity(&self, secs: f64) -> T {
        match self.share(secs) {
            Some(u) if self.for_secs > 0.0 && secs >= self.from_secs => {
                let [u, rate, _] = self.warped(u);
                self.slope(u) * (rate / self.for_secs)
            }
            _ => T::default(),
        }
    }

    /// Its acceleration at a time \[1/s²\].
    pub fn acceleration(&self, secs: f64) -> T {
        match self.share(secs) {
            Some(u) if self.for_secs > 0.0 && secs >= self.from_secs => {
                let f = &self.factors;
                let [u, rate, bend] = self.warped(u);
                let curve = f[2] * 2.0 + (f[3] * 6.0 + (f[4] * 12.0 + f[5] * (20.0 * u)) * u) * u;
                (curve * (rate * rate) + self.slope(u) * bend) * (1.0 / (self.for_secs * self.for_secs))
            }
            _ => T::default(),
        }
    }

    fn slope(&self, u: f64) -> T {
        let f = &self.factors;
        f[1] + (f[2] * 2.0 + (f[3] * 3.0 + (f[4] * 4.0 + f[5] * (5.0 * u)) * u) * u) * u
    }

    /// The warped share of the time, with its first and second derivative.
    fn warped(&self, u: f64) -> [f64; 3] {
        if !self.early {
            return [u, 1.0, 0.0];
        }
        let left = 1.0 - u;
        let root = left.max(0.0).sqrt();
        // The second derivative has a pole at the end, where the slope is 0 to the second order.
        [1.0 - left * root, 1.5 * root, if root > 1e-6 { -0.75 / root } else { 0.0 }]
    }

    /// Elapsed share of its time; `None` after arrival.
    fn share(&self, secs: f64) -> Option<f64> {
        let passed = secs - self.from_secs;
        if passed >= self.for_secs { None } else { Some(if passed <= 0.0 { 0.0 } else { passed / self.for_secs }) }
    }
}

/// Minimum duration: a shorter one would be a jump \[s\].
const MIN_SECS: f64 = 1e-3;

/// From 0 to 1 by minimum jerk.
pub fn eased(share: f64) -> f64 {
    let u = share.clamp(0.0, 1.0);
    u * u * u * (10.0 + u * (6.0 * u - 15.0))
}

/// A share of a time that runs fast first: u becomes 1 − (1 − u)^1.5.
pub fn early(share: f64) -> f64 {
    let left = 1.0 - share.clamp(0.0, 1.0);
    1.0 - left * left.sqrt()
}

/// From 0 over 1 in the middle back to 0, with velocity and acceleration 0 at both ends: a convex arc.
pub fn arc(share: f64) -> f64 {
    let u = share.clamp(0.0, 1.0);
    let hump = 4.0 * u * (1.0 - u);
    hump * hump * hump
}
