//! Rigid-body inertia, in ten numbers.

use std::ops::AddAssign;

use super::{Axes, M3, Real, Sym3, V3, Wrench};

/// Mass, first and second moment of mass about the common reference point, in world axes: ∫dm, ∫x dm, ∫x xᵀ dm.
///
/// The inertia of several bodies moving as one is the sum of theirs. The tensor of rotational inertia is
/// tr(∫x xᵀ dm)·1 − ∫x xᵀ dm; the second moment is kept instead because it turns and shifts with fewer operations.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Inertia<S: Real> {
    /// ∫dm \[kg\].
    pub mass: S,
    /// ∫x dm \[kg m\].
    pub first: V3<S>,
    /// ∫x xᵀ dm \[kg m²\].
    pub second: Sym3<S>,
}

impl<S: Real> Inertia<S> {
    /// No mass.
    pub const ZERO: Inertia<S> = Inertia { mass: S::ZERO, first: V3::ZERO, second: Sym3::ZERO };

    /// From the mass \[kg\], the centre of mass relative to the reference \[m\], and the second moment about the
    /// centre of mass in world axes \[kg m²\].
    #[inline(always)]
    pub fn new(mass: S, centre: V3<S>, second_about_centre: Sym3<S>) -> Inertia<S> {
        let first = centre * mass;
        Inertia { mass, first, second: second_about_centre.plus_outer(first, centre) }
    }

    /// Rotational inertia about the reference \[kg m²\].
    #[inline(always)]
    pub fn rotational(&self) -> [V3<S>; 3] {
        let trace = self.second.trace();
        let [x, y, z] = self.second.columns();
        let zero = S::ZERO;
        [V3::new(trace, zero, zero) - *x, V3::new(zero, trace, zero) - *y, V3::new(zero, zero, trace) - *z]
    }

    /// The momentum per unit speed about each of a joint's three axes: what inertia times motion subspace is in
    /// Featherstone 2008, eq. 6.19 (F = I S). As [`Axes`], so by component with the axes side by side.
    #[inline(always)]
    pub fn momentum(&self, axes: &Axes<S>) -> Axes<S> {
        let [ax, ay, az] = axes.angular.columns;
        let [lx, ly, lz] = axes.linear.columns;
        let [hx, hy, hz] = self.first.to_array();
        let [ix, iy, iz] = self.rotational();
        let row = |i: V3<S>| (ax * i.x()).plus(ay, i.y()).plus(az, i.z());
        Axes {
            // I ω + h × v
            angular: M3::new(
                row(ix).plus(lz, hy).minus(ly, hz),
                row(iy).plus(lx, hz).minus(lz, hx),
                row(iz).plus(ly, hx).minus(lx, hy),
            ),
            // m v + ω × h
            linear: M3::new(
                (lx * self.mass).plus(ay, hz).minus(az, hy),
                (ly * self.mass).plus(az, hx).minus(ax, hz),
                (lz * self.mass).plus(ax, hy).minus(ay, hx),
            ),
        }
    }
}

impl<S: Real> AddAssign<&Inertia<S>> for Inertia<S> {
    #[inline(always)]
    fn add_assign(&mut self, other: &Inertia<S>) {
        self.mass += other.mass;
        self.first += other.first;
        self.second += other.second;
    }
}

/// Force and moment required by a body's motion (Newton, Euler), about the reference.
///
/// `gradient` is ∂ẍ/∂x, the matrix \[α\]× + \[ω\]×\[ω\]× that gives the acceleration of any of the body's points. With
/// it Euler's equation I α + ω × I ω reads ∫x × gradient·x dm = Σₖ Jₖ × gradientₖ, J the second moment.
#[inline(always)]
pub(super) fn newton_euler<S: Real>(
    mass: S,
    centre: V3<S>,
    second_about_centre: &Sym3<S>,
    centre_acceleration: V3<S>,
    gradient: &M3<S>,
) -> Wrench<S> {
    let [jx, jy, jz] = second_about_centre.columns();
    let [gx, gy, gz] = gradient.columns;
    let force = centre_acceleration * mass;
    let spin = jx.cross(gx) + jy.cross(gy) + jz.cross(gz);
    Wrench { moment: spin + centre.cross(force), force }
}
