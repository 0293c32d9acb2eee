//! A joint's motion subspace in world axes.

use super::{M3, Real, V3, Wrench};

/// Up to three twists side by side: for each axis of a joint the angular velocity, and the velocity of the point at
/// the common reference, per unit speed of that axis (the matrix S of Featherstone 2008, 3.5).
///
/// Stored by component: column k of `angular` holds the k-th world component of all three axes. So all axes of one
/// joint are computed by one vector instruction. Axes that a joint does not have are zero. Momenta have the same shape,
/// see [`Inertia::momentum`](super::Inertia::momentum).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Axes<S: Real> {
    /// \[rad/s per unit speed\].
    pub angular: M3<S>,
    /// \[m/s per unit speed\].
    pub linear: M3<S>,
}

impl<S: Real> Axes<S> {
    /// No axes.
    pub const ZERO: Axes<S> = Axes { angular: M3::ZERO, linear: M3::ZERO };

    /// Axes of rotation through a point given relative to the reference \[m\].
    #[inline(always)]
    pub fn turning(angular: M3<S>, point: V3<S>) -> Axes<S> {
        let [ax, ay, az] = angular.columns;
        let [x, y, z] = point.to_array();
        let linear = M3::new((az * y).minus(ay, z), (ax * z).minus(az, x), (ay * x).minus(ax, y));
        Axes { angular, linear }
    }

    /// Axes of translation.
    #[inline(always)]
    pub fn sliding(linear: M3<S>) -> Axes<S> {
        Axes { angular: M3::ZERO, linear }
    }

    /// The power of a wrench per unit speed of each axis: the generalised force, Sᵀ f.
    #[inline(always)]
    pub fn project(&self, wrench: &Wrench<S>) -> V3<S> {
        self.angular * wrench.moment + self.linear * wrench.force
    }

    /// One axis as angular and linear vector.
    #[inline(always)]
    pub(super) fn axis(&self, axis: usize) -> (V3<S>, V3<S>) {
        let pick = |m: &M3<S>| V3::from_array(m.columns.map(|component| component.to_array()[axis]));
        (pick(&self.angular), pick(&self.linear))
    }

    /// The three axes, each as angular and linear vector.
    #[inline(always)]
    pub fn each(&self) -> [(V3<S>, V3<S>); 3] {
        let ([a, b, c], [x, y, z]) = (self.angular.transpose().columns, self.linear.transpose().columns);
        [(a, x), (b, y), (c, z)]
    }
}
