//! The number type of the algorithms: one `f64`, or several side by side.

use std::fmt::Debug;
use std::ops::{Add, AddAssign, Mul, MulAssign, Neg, Sub, SubAssign};

use super::trig;
use super::triple::{Packed, Triple};

/// A real number, or one per *lane*: several characters of the same topology computed by the same instructions.
///
/// `f64` has one lane. With the cargo feature `lanes`, `wide::f64x4` and `wide::f64x8` have four and eight; every
/// lane goes through the same additions and multiplications in the same order as a lone `f64` would, so its bits are
/// the same.
pub trait Real:
    Copy
    + Debug
    + Default
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Neg<Output = Self>
    + AddAssign
    + SubAssign
    + MulAssign
    + 'static
{
    /// Number of lanes.
    const LANES: usize;
    /// Storage of three numbers.
    type Triple: Triple<Self>;
    /// 0 in every lane.
    const ZERO: Self;
    /// 1 in every lane.
    const ONE: Self;

    /// The same number in every lane.
    fn splat(value: f64) -> Self;
    /// One number per lane, `value(0)` first.
    fn from_lanes(value: impl FnMut(usize) -> f64) -> Self;
    /// The number in one lane.
    ///
    /// # Panics
    /// If the lane does not exist.
    fn lane(self, lane: usize) -> f64;
    /// 1/x.
    #[must_use]
    fn recip(self) -> Self;
    /// The larger of two numbers, in each lane; of a number and a NaN, either.
    #[must_use]
    fn larger(self, other: Self) -> Self;
    /// |x|.
    #[must_use]
    fn abs(self) -> Self;
    /// Sine and cosine of an angle \[rad\], to 1e-15; the same bits on every machine.
    #[must_use]
    fn sincos(self) -> (Self, Self) {
        let within = (0..Self::LANES).all(|lane| self.lane(lane).abs() <= trig::REDUCIBLE);
        if within {
            trig::sin_cos(self)
        } else {
            (Self::from_lanes(|lane| libm::sin(self.lane(lane))), Self::from_lanes(|lane| libm::cos(self.lane(lane))))
        }
    }
}

impl Real for f64 {
    type Triple = Packed;
    const LANES: usize = 1;
    const ZERO: f64 = 0.0;
    const ONE: f64 = 1.0;

    #[inline(always)]
    fn splat(value: f64) -> f64 {
        value
    }

    #[inline(always)]
    fn from_lanes(mut value: impl FnMut(usize) -> f64) -> f64 {
        value(0)
    }

    #[inline(always)]
    fn lane(self, lane: usize) -> f64 {
        assert!(lane == 0, "a lone number has one lane");
        self
    }

    #[inline(always)]
    fn recip(self) -> f64 {
        1.0 / self
    }

    #[inline(always)]
    fn larger(self, other: f64) -> f64 {
        if self > other { self } else { other }
    }

    #[inline(always)]
    fn abs(self) -> f64 {
        f64::abs(self)
    }
}
