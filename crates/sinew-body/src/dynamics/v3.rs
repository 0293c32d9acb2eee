//! Vectors of three.

use std::ops::{Add, AddAssign, Mul, Neg, Sub, SubAssign};

use glam::DVec3;

use super::Real;

/// Three numbers: the components of a vector, or one number for each of a joint's three axes.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct V3<S> {
    x: S,
    y: S,
    z: S,
}

impl<S: Real> V3<S> {
    /// (0, 0, 0).
    pub const ZERO: V3<S> = V3 { x: S::ZERO, y: S::ZERO, z: S::ZERO };

    /// From components.
    #[inline(always)]
    pub fn new(x: S, y: S, z: S) -> V3<S> {
        V3 { x, y, z }
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
        DVec3::new(self.x.lane(lane), self.y.lane(lane), self.z.lane(lane))
    }

    /// First component.
    #[inline(always)]
    pub fn x(self) -> S {
        self.x
    }

    /// Second component.
    #[inline(always)]
    pub fn y(self) -> S {
        self.y
    }

    /// Third component.
    #[inline(always)]
    pub fn z(self) -> S {
        self.z
    }

    /// The three components.
    #[inline(always)]
    pub fn to_array(self) -> [S; 3] {
        [self.x, self.y, self.z]
    }

    /// From an array of components.
    #[inline(always)]
    pub fn from_array([x, y, z]: [S; 3]) -> V3<S> {
        V3::new(x, y, z)
    }

    /// Scalar product.
    #[inline(always)]
    pub fn dot(self, other: V3<S>) -> S {
        self.x * other.x + self.y * other.y + self.z * other.z
    }

    /// Vector product, self × other.
    #[inline(always)]
    #[must_use]
    pub fn cross(self, other: V3<S>) -> V3<S> {
        V3::new(
            self.y * other.z - self.z * other.y,
            self.z * other.x - self.x * other.z,
            self.x * other.y - self.y * other.x,
        )
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

impl<S: Real> Add for V3<S> {
    type Output = V3<S>;
    #[inline(always)]
    fn add(self, other: V3<S>) -> V3<S> {
        V3::new(self.x + other.x, self.y + other.y, self.z + other.z)
    }
}

impl<S: Real> Sub for V3<S> {
    type Output = V3<S>;
    #[inline(always)]
    fn sub(self, other: V3<S>) -> V3<S> {
        V3::new(self.x - other.x, self.y - other.y, self.z - other.z)
    }
}

impl<S: Real> Neg for V3<S> {
    type Output = V3<S>;
    #[inline(always)]
    fn neg(self) -> V3<S> {
        V3::new(-self.x, -self.y, -self.z)
    }
}

impl<S: Real> Mul<S> for V3<S> {
    type Output = V3<S>;
    #[inline(always)]
    fn mul(self, factor: S) -> V3<S> {
        V3::new(self.x * factor, self.y * factor, self.z * factor)
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
        V3::new(vector.x, vector.y, vector.z)
    }
}

impl From<V3<f64>> for DVec3 {
    fn from(vector: V3<f64>) -> DVec3 {
        DVec3::new(vector.x, vector.y, vector.z)
    }
}
