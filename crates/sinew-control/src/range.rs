//! Ranges of the numbers in commands and scenes: each stands here once, and whoever takes such a number checks it here.

use crate::{OrderError, OrderErrorKind};
use std::ops::RangeInclusive;

/// A closed interval. NaN lies in none.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Range {
    /// The smallest number.
    pub min: f64,
    /// The largest number.
    pub max: f64,
}

impl Range {
    /// From one number to another.
    pub const fn new(min: f64, max: f64) -> Range {
        Range { min, max }
    }

    /// From minus this to this.
    pub const fn both_ways(max: f64) -> Range {
        Range { min: -max, max }
    }

    /// Whether a number lies in it.
    ///
    /// ```
    /// use sinew_control::range;
    /// assert!(range::GAIN.contains(0.5));
    /// assert!(!range::GAIN.contains(1e30) && !range::GAIN.contains(f64::NAN));
    /// ```
    pub fn contains(self, value: f64) -> bool {
        self.inclusive().contains(&value)
    }

    /// The number, if it lies in it; `key` is what the command calls it.
    ///
    /// # Errors
    /// [`OrderErrorKind::OutOfRange`], with the range in words.
    pub fn check(self, key: &str, value: f64) -> Result<f64, OrderError> {
        if self.contains(value) {
            return Ok(value);
        }
        let problem = format!("{key} = {value} is out of range {} to {}", self.min, self.max);
        Err(OrderError::new(OrderErrorKind::OutOfRange, problem))
    }

    /// The same for a number that may be left out.
    ///
    /// # Errors
    /// As [`Range::check`].
    pub fn check_some(self, key: &str, value: Option<f64>) -> Result<Option<f64>, OrderError> {
        value.map(|value| self.check(key, value)).transpose()
    }

    /// The same for each of three numbers.
    ///
    /// # Errors
    /// As [`Range::check`].
    pub fn check_three(self, key: &str, values: [f64; 3]) -> Result<[f64; 3], OrderError> {
        values.into_iter().try_for_each(|value| self.check(key, value).map(drop))?;
        Ok(values)
    }

    /// As the standard library has it.
    pub const fn inclusive(self) -> RangeInclusive<f64> {
        self.min..=self.max
    }
}

/// How long something lasts or fades \[s\].
pub const SECS: Range = Range::new(0.0, 3600.0);

/// A factor on the stiffness of joints.
pub const GAIN: Range = Range::new(0.0, 1000.0);

/// A factor on gravity.
pub const GRAVITY_SCALE: Range = Range::both_ways(100.0);

/// A gain of the tracker `kd`, in its own unit.
pub const KD_GAIN: Range = Range::new(0.0, 1e5);

/// How far the tracker `kd` holds a part or its joint.
pub const KD_WEIGHT: Range = Range::new(0.0, 100.0);

/// A component of a force \[N\].
pub const FORCE_N: Range = Range::both_ways(sinew_world::MAX_FORCE_N);

/// A force at which something breaks \[N\].
pub const BREAK_FORCE_N: Range = Range::new(1e-6, 1e9);

/// A coordinate of a place in the world \[m\].
pub const PLACE_M: Range = Range::both_ways(1e5);

/// A coordinate of a point on a part or prop, in its own frame \[m\].
pub const POINT_M: Range = Range::both_ways(1e3);

/// A component of a velocity \[m/s\].
pub const VELOCITY_M_S: Range = Range::both_ways(1e3);

/// A component of an acceleration \[m/s²\].
pub const ACCELERATION_M_S2: Range = Range::both_ways(1e4);

/// A heading \[degrees\].
pub const FACING_DEG: Range = Range::both_ways(360.0);

/// What a motor aims at, in the key's own unit \[rad/s, degrees, m/s, m\].
pub const MOTOR_AIM: Range = Range::both_ways(300.0);

/// The time stamp of a performer's sample, by the performer's own clock \[s\].
pub const SAMPLE_TIME_SECS: Range = Range::both_ways(1e9);

/// A coordinate of a point to reach for \[m\].
pub const REACH_M: Range = Range::both_ways(1e4);

/// Flexibility of the legs in a reach.
pub const REACH_FLEXIBILITY: Range = Range::new(0.25, 4.0);

/// Peak speed of a hand that reaches \[m/s\].
pub const REACH_SPEED_M_S: Range = Range::new(0.05, 10.0);

/// Time of a reach \[s\].
pub const REACH_SECS: Range = Range::new(0.2, 600.0);
