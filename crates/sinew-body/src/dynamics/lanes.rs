//! Several characters side by side in one vector register.

use std::ops::{Add, Neg, Sub};

use wide::{f64x4, f64x8};

use super::Real;
use super::triple::Triple;

/// Three numbers that are vectors of lanes already.
#[derive(Clone, Copy, Debug)]
pub struct Plain<S>([S; 3]);

impl<S: Real> Triple<S> for Plain<S> {
    const ZERO: Plain<S> = Plain([S::ZERO; 3]);

    #[inline(always)]
    fn new(x: S, y: S, z: S) -> Plain<S> {
        Plain([x, y, z])
    }

    #[inline(always)]
    fn to_array(self) -> [S; 3] {
        self.0
    }

    #[inline(always)]
    fn scaled(self, factor: S) -> Plain<S> {
        Plain(self.0.map(|component| component * factor))
    }

    #[inline(always)]
    fn cross(self, other: Plain<S>) -> Plain<S> {
        let ([a, b, c], [x, y, z]) = (self.0, other.0);
        Plain([b * z - c * y, c * x - a * z, a * y - b * x])
    }
}

impl<S: Real> Add for Plain<S> {
    type Output = Plain<S>;
    #[inline(always)]
    fn add(self, other: Plain<S>) -> Plain<S> {
        let ([a, b, c], [x, y, z]) = (self.0, other.0);
        Plain([a + x, b + y, c + z])
    }
}

impl<S: Real> Sub for Plain<S> {
    type Output = Plain<S>;
    #[inline(always)]
    fn sub(self, other: Plain<S>) -> Plain<S> {
        let ([a, b, c], [x, y, z]) = (self.0, other.0);
        Plain([a - x, b - y, c - z])
    }
}

impl<S: Real> Neg for Plain<S> {
    type Output = Plain<S>;
    #[inline(always)]
    fn neg(self) -> Plain<S> {
        Plain(self.0.map(|component| -component))
    }
}

macro_rules! lanes {
    ($type:ident, $lanes:literal) => {
        impl Real for $type {
            type Triple = Plain<$type>;
            const LANES: usize = $lanes;
            const ZERO: $type = $type::ZERO;
            const ONE: $type = $type::ONE;

            #[inline(always)]
            fn splat(value: f64) -> $type {
                $type::splat(value)
            }

            #[inline(always)]
            fn from_lanes(value: impl FnMut(usize) -> f64) -> $type {
                $type::new(std::array::from_fn(value))
            }

            #[inline(always)]
            fn lane(self, lane: usize) -> f64 {
                self.to_array()[lane]
            }

            #[inline(always)]
            fn recip(self) -> $type {
                $type::ONE / self
            }

            #[inline(always)]
            fn larger(self, other: $type) -> $type {
                self.fast_max(other)
            }

            #[inline(always)]
            fn abs(self) -> $type {
                $type::abs(self)
            }
        }
    };
}

lanes!(f64x4, 4);
lanes!(f64x8, 8);
