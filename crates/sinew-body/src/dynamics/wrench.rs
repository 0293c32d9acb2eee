//! Forces with their moments.

use std::ops::AddAssign;

use super::{Real, V3};

/// A force and its moment about the common reference point, in world axes (Featherstone's spatial force, 2008, 2.4).
///
/// Because every wrench is about the same point, wrenches of different links simply add.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Wrench<S: Real> {
    /// Moment about the reference \[N m\], world axes.
    pub moment: V3<S>,
    /// Force \[N\], world axes.
    pub force: V3<S>,
}

impl<S: Real> Wrench<S> {
    /// No force, no moment.
    pub const ZERO: Wrench<S> = Wrench { moment: V3::ZERO, force: V3::ZERO };

    /// The moment about another point, given relative to the reference \[m\].
    #[inline(always)]
    pub fn moment_about(&self, point: V3<S>) -> V3<S> {
        self.moment - point.cross(self.force)
    }
}

impl<S: Real> AddAssign<&Wrench<S>> for Wrench<S> {
    #[inline(always)]
    fn add_assign(&mut self, other: &Wrench<S>) {
        self.moment += other.moment;
        self.force += other.force;
    }
}

/// An external force on a link: a push, a contact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PointForce<S: Real> {
    /// Index of the link pushed.
    pub link: usize,
    /// Where it acts \[m\], world.
    pub point: V3<S>,
    /// The force \[N\], world axes.
    pub force: V3<S>,
}
