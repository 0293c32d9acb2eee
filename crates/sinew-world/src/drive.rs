//! Joint drives: a spring towards a rotation (PD control), integrated implicitly by the solver.

use glam::{DQuat, DVec3};

/// The drive of one joint. It takes effect with the next step after [`World::set_drive`](crate::World::set_drive) and stays until
/// another one is set. A drive with a gain out of range, a NaN, an infinity or a degenerate rotation lets the joint go limp.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Drive {
    /// Wanted `parent_from_node`.
    pub rotation: DQuat,
    /// Wanted angular velocity relative to the parent, in the node's frame \[rad/s\], shortened to 500 rad/s.
    pub velocity: DVec3,
    /// Stiffness \[N m/rad\], 0 to 1e9 (exclusive).
    pub stiffness: f64,
    /// Damping \[N m s/rad\], 0 to 1e9 (exclusive).
    pub damping: f64,
    /// Additional torque on the node relative to its parent (feed-forward), world axes \[N m\], shortened to 1e4 N m.
    pub torque: DVec3,
}

impl Drive {
    /// A limp joint: nothing but friction \[N m s/rad\].
    pub const fn limp(damping: f64) -> Drive {
        Drive { rotation: DQuat::IDENTITY, velocity: DVec3::ZERO, stiffness: 0.0, damping, torque: DVec3::ZERO }
    }
}

sinew_snapshot::snapshot!(Drive { rotation, velocity, stiffness, damping, torque });
