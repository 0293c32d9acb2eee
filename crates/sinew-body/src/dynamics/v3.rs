//! Vectors of three.

use std::fmt::{Debug, Formatter};
use std::ops::{Add, AddAssign, Mul, Neg, Sub, SubAssign};

use glam::DVec3;

use super::Real;
use super::triple::Triple;

/// Three numbers: the components of a vector, or one number for each of a joint's three axes.
#[derive(Clone, Copy)]
pub struct V3<S: Real>(S::Triple);

impl<S: Real> V3<S> {
    /// (0, 0, 0).
    pub const ZERO: V3<S> = V3(S::Triple::ZERO);

    /// From components.
    #[inline(always)]
    pub fn new(x: S, y: S, z: S) -> V3<S> {
        V3(S::Triple::new(x, y, z))
    }

    /// The same f64 vector in every lane.
    pub fn splat(vector: DVec3) -> V3<S> {
        V3::new(S::splat(vector.x), S::splat(vector.y), S::splat(vector.z))
    }

    /// One f64 vector per lane.
    pub fn from_lanes(vector: impl Fn(usize) -> DVec3) -> V3<S> {
        V3::new(
            S::from_lanes(|lane| vector(lane).x),
            S::from_lanes(|lane| vector(lane).y),
            S::from_lanes(|lane| vector(lane).z),
        )
    }

    /// The vector in one lane.
    pub fn lane(self, lane: usize) -> DVec3 {
        DVec3::from_array(self.to_array().map(|component| component.lane(lane)))
    }

    /// First component.
    #[inline(always)]
    pub fn x(self) -> S {
        self.to_array()[0]
    }

    /// Second component.
    #[inline(always)]
    pub fn y(self) -> S {
        self.to_array()[1]
    }

    /// Third component.
    #[inline(always)]
    pub fn z(self) -> S {
        self.to_array()[2]
    }

    /// The three components.
    #[inline(always)]
    pub fn to_array(self) -> [S; 3] {
        self.0.to_array()
    }

    /// From an array of components.
    #[inline(always)]
    pub fn from_array([x, y, z]: [S; 3]) -> V3<S> {
        V3::new(x, y, z)
    }

    /// Scalar product.
    #[inline(always)]
    pub fn dot(self, other: V3<S>) -> S {
        let ([a, b, c], [x, y, z]) = (self.to_array(), other.to_array());
        a * x + b * y + c * z
    }

    /// Vector product, self × other.
    #[inline(always)]
    #[must_use]
    pub fn cross(self, other: V3<S>) -> V3<S> {
        V3(self.0.cross(other.0))
    }

    /// self + vector · factor.
    #[inline(always)]
    #[must_use]
    pub fn plus(self, vector: V3<S>, factor: S) -> V3<S> {
        self + vector * factor
    }

    /// self − vector · factor.
    #[inline(always)]
    #[must_use]
    pub fn minus(self, vector: V3<S>, factor: S) -> V3<S> {
        self - vector * factor
    }
}

impl<S: Real> Default for V3<S> {
    fn default() -> V3<S> {
        V3::ZERO
    }
}

impl<S: Real + PartialEq> PartialEq for V3<S> {
    fn eq(&self, other: &V3<S>) -> bool {
        self.to_array() == other.to_array()
    }
}

impl<S: Real> Debug for V3<S> {
    fn fmt(&self, f: &mut Formatter<'_>) -> std::fmt::Result {
        let [x, y, z] = self.to_array();
        f.debug_tuple("V3").field(&x).field(&y).field(&z).finish()
    }
}

impl<S: Real> Add for V3<S> {
    type Output = V3<S>;
    #[inline(always)]
    fn add(self, other: V3<S>) -> V3<S> {
        V3(self.0 + other.0)
    }
}

impl<S: Real> Sub for V3<S> {
    type Output = V3<S>;
    #[inline(always)]
    fn sub(self, other: V3<S>) -> V3<S> {
        V3(self.0 - other.0)
    }
}

impl<S: Real> Neg for V3<S> {
    type Output = V3<S>;
    #[inline(always)]
    fn neg(self) -> V3<S> {
        V3(-self.0)
    }
}

impl<S: Real> Mul<S> for V3<S> {
    type Output = V3<S>;
    #[inline(always)]
    fn mul(self, factor: S) -> V3<S> {
        V3(self.0.scaled(factor))
    }
}

impl<S: Real> AddAssign for V3<S> {
    #[inline(always)]
    fn add_assign(&mut self, other: V3<S>) {
        *self = *self + other;
    }
}

impl<S: Real> SubAssign for V3<S> {
    #[inline(always)]
    fn sub_assign(&mut self, other: V3<S>) {
        *self = *self - other;
    }
}

impl From<DVec3> for V3<f64> {
    fn from(vector: DVec3) -> V3<f64> {
        V3::splat(vector)
    }
}

impl From<V3<f64>> for DVec3 {
    fn from(vector: V3<f64>) -> DVec3 {
        vector.lane(0)
    }
}
