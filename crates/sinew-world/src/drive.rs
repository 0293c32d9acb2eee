//! What holds a joint: a spring towards a rotation, integrated implicitly by the solver.

use glam::{DQuat, DVec3};

/// The spring of one joint.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Drive {
    /// Wanted `parent_from_node`.
    pub rotation: DQuat,
    /// Wanted angular velocity against the parent, in the node's frame \[rad/s\].
    pub velocity: DVec3,
    /// Stiffness \[N m/rad\], 0 or more.
    pub stiffness: f64,
    /// Damping \[N m s/rad\], 0 or more.
    pub damping: f64,
    /// Torque on the node against its parent on top, world axes \[N m\].
    pub torque: DVec3,
}

impl Drive {
    /// Nothing but the friction of a joint that is let go \[N m s/rad\].
    pub const fn limp(damping: f64) -> Drive {
        Drive { rotation: DQuat::IDENTITY, velocity: DVec3::ZERO, stiffness: 0.0, damping, torque: DVec3::ZERO }
    }
}
