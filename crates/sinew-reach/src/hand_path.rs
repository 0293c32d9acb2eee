//! The hand's path under `print`: EQ1 to EQ4, Algorithm 1.
//!
//! The hand starts at full speed and slows down in the last part. Its acceleration jumps, at the start also its speed;
//! the default therefore uses minimum jerk instead ([`MinimumJerk`](crate::MinimumJerk)). Algorithm 1 as printed
//! divides the vector v_s before it is set; here EQ1 comes first.

use glam::DVec3;

/// v_s of the paper \[m/s\].
pub const PRINTED_SPEED_M_S: f64 = 0.2;

/// r_s of the paper \[1\].
pub const PRINTED_RATIO: f64 = 0.8;

/// A straight path with an ease-out.
///
/// ```
/// use glam::DVec3;
/// use sinew_reach::HandPath;
/// let path = HandPath::new(DVec3::ZERO, DVec3::X * 0.8, 0.2, 0.8);
/// assert!((path.total_secs - 2.0 * 0.8 / (0.2 * 1.8)).abs() < 1e-12); // EQ4
/// assert!((path.at(path.total_secs) - DVec3::X * 0.8).length() < 1e-12);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct HandPath {
    /// p_s \[m\].
    pub from: DVec3,
    /// d_h = p_e − p_s \[m\].
    pub displacement: DVec3,
    /// Start velocity **v**_s, EQ1 \[m/s\].
    pub velocity: DVec3,
    /// Deceleration **a** of the last part, EQ2 \[m/s²\].
    pub deceleration: DVec3,
    /// r_s: share of the time at full speed \[1\].
    pub ratio: f64,
    /// t_t, EQ4 \[s\].
    pub total_secs: f64,
}

sinew_snapshot::snapshot!(HandPath { from, displacement, velocity, deceleration, ratio, total_secs });

impl HandPath {
    /// The path from one point to another \[m\] with a start speed \[m/s\] and the ratio r_s, 0 to 1 (excluded).
    pub fn new(from: DVec3, to: DVec3, speed_m_s: f64, ratio: f64) -> HandPath {
        let displacement = to - from;
        let velocity = displacement.normalize_or_zero() * speed_m_s; // EQ1
        let total_secs = 2.0 * displacement.length() / (speed_m_s * (ratio + 1.0)); // EQ4
        let slowing = total_secs * (1.0 - ratio);
        let deceleration = if slowing > 0.0 { -velocity / slowing } else { DVec3::ZERO }; // EQ2
        HandPath { from, displacement, velocity, deceleration, ratio, total_secs }
    }

    /// Position of the hand \[m\]; EQ3 at the end.
    pub fn at(&self, secs: f64) -> DVec3 {
        let secs = secs.clamp(0.0, self.total_secs);
        let slow = (secs - self.total_secs * self.ratio).max(0.0);
        self.from + self.velocity * secs + self.deceleration * (0.5 * slow * slow)
    }

    /// Its velocity \[m/s\]: 0 before and after.
    pub fn velocity_at(&self, secs: f64) -> DVec3 {
        if !(0.0..=self.total_secs).contains(&secs) {
            return DVec3::ZERO;
        }
        self.velocity + self.deceleration * (secs - self.total_secs * self.ratio).max(0.0)
    }

    /// Share of the path that is done.
    pub fn share_at(&self, secs: f64) -> f64 {
        let length_squared = self.displacement.length_squared();
        if length_squared > 0.0 { (self.at(secs) - self.from).dot(self.displacement) / length_squared } else { 1.0 }
    }
}
