//! Three by three matrices.

use std::ops::Mul;

use glam::{DMat3, DQuat};

use super::{Real, V3};

/// A 3 × 3 matrix, by columns: a rotation, or the three axes of a joint by component.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct M3<S: Real> {
    /// The three columns.
    pub columns: [V3<S>; 3],
}

impl<S: Real> M3<S> {
    /// All zero.
    pub const ZERO: M3<S> = M3 { columns: [V3::ZERO; 3] };

    /// From columns.
    #[inline(always)]
    pub fn new(x: V3<S>, y: V3<S>, z: V3<S>) -> M3<S> {
        M3 { columns: [x, y, z] }
    }

    /// The unit matrix.
    #[inline(always)]
    pub fn identity() -> M3<S> {
        let (one, zero) = (S::ONE, S::ZERO);
        M3::new(V3::new(one, zero, zero), V3::new(zero, one, zero), V3::new(zero, zero, one))
    }

    /// The same f64 matrix in every lane.
    pub fn splat(matrix: DMat3) -> M3<S> {
        M3::new(V3::splat(matrix.x_axis), V3::splat(matrix.y_axis), V3::splat(matrix.z_axis))
    }

    /// One f64 matrix per lane.
    pub fn from_lanes(matrix: impl Fn(usize) -> DMat3) -> M3<S> {
        M3::new(
            V3::from_lanes(|lane| matrix(lane).x_axis),
            V3::from_lanes(|lane| matrix(lane).y_axis),
            V3::from_lanes(|lane| matrix(lane).z_axis),
        )
    }

    /// The matrix in one lane.
    pub fn lane(self, lane: usize) -> DMat3 {
        let [x, y, z] = self.columns;
        DMat3::from_cols(x.lane(lane), y.lane(lane), z.lane(lane))
    }

    /// The rotation of a unit quaternion given as x, y, z, w.
    #[inline(always)]
    pub fn from_quaternion([x, y, z, w]: [S; 4]) -> M3<S> {
        let two = S::splat(2.0);
        let (x2, y2, z2) = (x * two, y * two, z * two);
        let (xx, yy, zz) = (x * x2, y * y2, z * z2);
        let (xy, yz, zx) = (x * y2, y * z2, z * x2);
        let (wx, wy, wz) = (w * x2, w * y2, w * z2);
        M3::new(
            V3::new(S::ONE - (yy + zz), xy + wz, zx - wy),
            V3::new(xy - wz, S::ONE - (zz + xx), yz + wx),
            V3::new(zx + wy, yz - wx, S::ONE - (xx + yy)),
        )
    }

    /// Turn about a unit axis (Rodrigues), from the sine and cosine of the angle.
    #[inline(always)]
    pub fn turn(axis: V3<S>, sine: S, cosine: S) -> M3<S> {
        let versine = S::ONE - cosine;
        let [x, y, z] = axis.to_array();
        let (s, v) = (axis * sine, axis * versine);
        M3::new(
            V3::new(v.x() * x + cosine, v.x() * y + s.z(), v.x() * z - s.y()),
            V3::new(v.y() * x - s.z(), v.y() * y + cosine, v.y() * z + s.x()),
            V3::new(v.z() * x + s.y(), v.z() * y - s.x(), v.z() * z + cosine),
        )
    }

    /// Rows become columns.
    #[inline(always)]
    #[must_use]
    pub fn transpose(self) -> M3<S> {
        let [a, b, c] = self.columns;
        M3::new(V3::new(a.x(), b.x(), c.x()), V3::new(a.y(), b.y(), c.y()), V3::new(a.z(), b.z(), c.z()))
    }

    /// selfᵀ · vector.
    #[inline(always)]
    pub fn transpose_times(&self, vector: V3<S>) -> V3<S> {
        let [a, b, c] = self.columns;
        V3::new(a.dot(vector), b.dot(vector), c.dot(vector))
    }

    /// self · otherᵀ.
    #[inline(always)]
    pub fn times_transpose(&self, other: &M3<S>) -> M3<S> {
        let [a, b, c] = other.columns;
        M3::new(
            *self * V3::new(a.x(), b.x(), c.x()),
            *self * V3::new(a.y(), b.y(), c.y()),
            *self * V3::new(a.z(), b.z(), c.z()),
        )
    }
}

impl<S: Real> Mul<V3<S>> for M3<S> {
    type Output = V3<S>;
    #[inline(always)]
    fn mul(self, vector: V3<S>) -> V3<S> {
        let [a, b, c] = self.columns;
        (a * vector.x()).plus(b, vector.y()).plus(c, vector.z())
    }
}

impl<S: Real> Mul for M3<S> {
    type Output = M3<S>;
    #[inline(always)]
    fn mul(self, other: M3<S>) -> M3<S> {
        let [x, y, z] = other.columns;
        M3::new(self * x, self * y, self * z)
    }
}

impl From<DMat3> for M3<f64> {
    fn from(matrix: DMat3) -> M3<f64> {
        M3::splat(matrix)
    }
}

impl From<DQuat> for M3<f64> {
    fn from(rotation: DQuat) -> M3<f64> {
        M3::from_quaternion(rotation.to_array())
    }
}

impl From<M3<f64>> for DMat3 {
    fn from(matrix: M3<f64>) -> DMat3 {
        matrix.lane(0)
    }
}
