//! Several characters side by side in one vector register.

use wide::{f64x4, f64x8};

use super::Real;
use super::triple::Plain;

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
