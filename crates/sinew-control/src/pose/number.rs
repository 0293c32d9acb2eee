//! Range checks of numbers in pose and graph files, at deserialisation, so that the error names the line.

use serde::de::{Deserialize, Deserializer, Error};
use std::ops::RangeInclusive;

/// Turns about one axis \[degrees\].
pub(crate) const TURN_DEG: RangeInclusive<f64> = -360.0..=360.0;
/// Factors on stiffness and damping.
pub(crate) const FACTOR: RangeInclusive<f64> = 0.0..=1000.0;
/// Blends and timers \[s\].
pub(crate) const SECS: RangeInclusive<f64> = 0.0..=3600.0;
/// Coordinates of a target \[m\].
pub(crate) const PLACE_M: RangeInclusive<f64> = -100.0..=100.0;
/// Feedback gains and sensor thresholds.
pub(crate) const ANY: RangeInclusive<f64> = -1e6..=1e6;
/// Leans of the hips \[degrees\].
pub(crate) const LEAN_DEG: RangeInclusive<f64> = -90.0..=90.0;
/// Headings \[degrees\].
pub(crate) const HEADING_DEG: RangeInclusive<f64> = -360.0..=360.0;

fn read<'de, D: Deserializer<'de>>(from: D, range: &RangeInclusive<f64>, what: &str) -> Result<f64, D::Error> {
    checked(f64::deserialize(from)?, range, what).map_err(D::Error::custom)
}

/// The number, or an error text.
pub(crate) fn checked(value: f64, range: &RangeInclusive<f64>, what: &str) -> Result<f64, String> {
    // NaN is in no range.
    if range.contains(&value) {
        return Ok(value);
    }
    Err(format!("{what} is {value}; give a number from {} to {}", range.start(), range.end()))
}

/// Each of three numbers.
pub(crate) fn checked_three(values: [f64; 3], range: &RangeInclusive<f64>, what: &str) -> Result<[f64; 3], String> {
    for value in values {
        checked(value, range, what)?;
    }
    Ok(values)
}

pub(crate) fn some_factor<'de, D: Deserializer<'de>>(from: D) -> Result<Option<f64>, D::Error> {
    read(from, &FACTOR, "a gain or damping factor").map(Some)
}

pub(crate) fn some_secs<'de, D: Deserializer<'de>>(from: D) -> Result<Option<f64>, D::Error> {
    read(from, &SECS, "a time in seconds").map(Some)
}

pub(crate) fn some_threshold<'de, D: Deserializer<'de>>(from: D) -> Result<Option<f64>, D::Error> {
    read(from, &ANY, "a sensor's threshold").map(Some)
}

pub(crate) fn feedback<'de, D: Deserializer<'de>>(from: D) -> Result<f64, D::Error> {
    read(from, &ANY, "a feedback gain")
}

pub(crate) fn lean<'de, D: Deserializer<'de>>(from: D) -> Result<f64, D::Error> {
    read(from, &LEAN_DEG, "the hips' lean in degrees")
}

pub(crate) fn some_heading<'de, D: Deserializer<'de>>(from: D) -> Result<Option<f64>, D::Error> {
    read(from, &HEADING_DEG, "the heading in degrees").map(Some)
}

pub(crate) fn place<'de, D: Deserializer<'de>>(from: D) -> Result<[f64; 3], D::Error> {
    checked_three(<[f64; 3]>::deserialize(from)?, &PLACE_M, "a coordinate in metres").map_err(D::Error::custom)
}

pub(crate) fn some_turn<'de, D: Deserializer<'de>>(from: D) -> Result<Option<[f64; 3]>, D::Error> {
    turn(<[f64; 3]>::deserialize(from)?).map(Some).map_err(D::Error::custom)
}

pub(crate) fn turn(degrees: [f64; 3]) -> Result<[f64; 3], String> {
    checked_three(degrees, &TURN_DEG, "a turn in degrees")
}
