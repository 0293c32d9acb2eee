//! Symmetric three by three matrices.

use std::ops::{Add, AddAssign, Mul};

use glam::DMat3;

use super::{M3, Real, V3};

/// A symmetric 3 × 3 matrix. All nine numbers are kept, by columns: adding three more costs less than picking six apart.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Sym3<S: Real> {
    columns: [V3<S>; 3],
}

impl<S: Real> Sym3<S> {
    /// All zero.
    pub const ZERO: Sym3<S> = Sym3 { columns: [V3::ZERO; 3] };

    /// From the lower triangle.
    pub fn new(xx: S, yy: S, zz: S, xy: S, yz: S, zx: S) -> Sym3<S> {
        Sym3 { columns: [V3::new(xx, xy, zx), V3::new(xy, yy, yz), V3::new(zx, yz, zz)] }
    }

    /// One f64 matrix per lane; each is taken to be symmetric.
    pub fn from_lanes(matrix: impl Fn(usize) -> DMat3) -> Sym3<S> {
        Sym3 { columns: M3::from_lanes(matrix).columns }
    }

    /// The matrix in one lane.
    pub fn lane(self, lane: usize) -> DMat3 {
        M3 { columns: self.columns }.lane(lane)
    }

    /// The three columns, which are also the rows.
    #[inline(always)]
    pub fn columns(&self) -> &[V3<S>; 3] {
        &self.columns
    }

    /// Sum of the diagonal.
    #[inline(always)]
    pub fn trace(&self) -> S {
        let [a, b, c] = self.columns;
        a.x() + b.y() + c.z()
    }

    /// rotation · self · rotationᵀ: the same tensor in other axes.
    #[inline(always)]
    #[must_use]
    pub fn turned(&self, rotation: &M3<S>) -> Sym3<S> {
        let half = *rotation * M3 { columns: self.columns };
        Sym3 { columns: half.times_transpose(rotation).columns }
    }

    /// self + a bᵀ, where the caller knows that a bᵀ is symmetric (b a multiple of a).
    #[inline(always)]
    #[must_use]
    pub fn plus_outer(&self, a: V3<S>, b: V3<S>) -> Sym3<S> {
        let [x, y, z] = self.columns;
        Sym3 { columns: [x.plus(a, b.x()), y.plus(a, b.y()), z.plus(a, b.z())] }
    }
}

impl<S: Real> Mul<V3<S>> for Sym3<S> {
    type Output = V3<S>;
    #[inline(always)]
    fn mul(self, vector: V3<S>) -> V3<S> {
        M3 { columns: self.columns } * vector
    }
}

impl<S: Real> Add for Sym3<S> {
    type Output = Sym3<S>;
    #[inline(always)]
    fn add(self, other: Sym3<S>) -> Sym3<S> {
        let ([a, b, c], [d, e, f]) = (self.columns, other.columns);
        Sym3 { columns: [a + d, b + e, c + f] }
    }
}

impl<S: Real> AddAssign for Sym3<S> {
    #[inline(always)]
    fn add_assign(&mut self, other: Sym3<S>) {
        *self = *self + other;
    }
}
