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

/// What holds a part to its place in the world: a spring per unit of mass and inertia, implicit.
///
/// F = m (k (x̂ − x + h Δv) + d Δv) / (1 + h d + h² k) with Δv = v̂ − v and the step h, and the same with the inertia for
/// the turn: stable at any k and d, because it is the force of the step's end.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pin {
    /// Wanted place of the part's joint \[m\].
    pub position: DVec3,
    /// Wanted `world_from_part`.
    pub rotation: DQuat,
    /// Wanted velocity of the centre of mass \[m/s\].
    pub velocity: DVec3,
    /// Wanted angular velocity \[rad/s\].
    pub angular_velocity: DVec3,
    /// Stiffness per unit mass, and per unit inertia \[1/s²\].
    pub stiffness: f64,
    /// Damping per unit mass, and per unit inertia \[1/s\].
    pub damping: f64,
    /// Share of the part's weight that is carried, 0 to 1.
    pub gravity_share: f64,
    /// Largest force \[N\]; the torque is cut in the same proportion.
    pub max_force_n: f64,
}
