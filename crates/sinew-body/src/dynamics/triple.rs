//! Storage of three numbers.

use std::fmt::Debug;
use std::ops::{Add, Neg, Sub};

/// Storage and arithmetic of three numbers: the inside of [`V3`](super::V3).
pub trait Triple<S>: Copy + Debug + Add<Output = Self> + Sub<Output = Self> + Neg<Output = Self> + 'static {
    /// (0, 0, 0).
    const ZERO: Self;
    /// From components.
    fn new(x: S, y: S, z: S) -> Self;
    /// The components.
    fn to_array(self) -> [S; 3];
    /// Each component times a number.
    #[must_use]
    fn scaled(self, factor: S) -> Self;
    /// Vector product.
    #[must_use]
    fn cross(self, other: Self) -> Self;
}

/// Three `f64` and an unused fourth in one vector register: adding or scaling is one instruction.
#[derive(Clone, Copy, Debug)]
pub struct Packed(wide::f64x4);

impl Packed {
    /// (y, z, x).
    #[inline(always)]
    fn rolled(self) -> Packed {
        let [x, y, z, w] = self.0.to_array();
        Packed(wide::f64x4::new([y, z, x, w]))
    }
}

impl Triple<f64> for Packed {
    const ZERO: Packed = Packed(wide::f64x4::ZERO);

    #[inline(always)]
    fn new(x: f64, y: f64, z: f64) -> Packed {
        Packed(wide::f64x4::new([x, y, z, 0.0]))
    }

    #[inline(always)]
    fn to_array(self) -> [f64; 3] {
        let [x, y, z, _] = self.0.to_array();
        [x, y, z]
    }

    #[inline(always)]
    fn scaled(self, factor: f64) -> Packed {
        Packed(self.0 * wide::f64x4::splat(factor))
    }

    #[inline(always)]
    fn cross(self, other: Packed) -> Packed {
        // Component z of a × b is a_x b_y − a_y b_x: the one that needs no reordering of a; roll the others into place.
        Packed(self.0 * other.rolled().0 - self.rolled().0 * other.0).rolled()
    }
}

impl Add for Packed {
    type Output = Packed;
    #[inline(always)]
    fn add(self, other: Packed) -> Packed {
        Packed(self.0 + other.0)
    }
}

impl Sub for Packed {
    type Output = Packed;
    #[inline(always)]
    fn sub(self, other: Packed) -> Packed {
        Packed(self.0 - other.0)
    }
}

impl Neg for Packed {
    type Output = Packed;
    #[inline(always)]
    fn neg(self) -> Packed {
        Packed(-self.0)
    }
}
