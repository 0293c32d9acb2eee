//! Pins: springs that hold parts to positions and rotations in the world.

use glam::{DMat3, DQuat, DVec3};
use rapier3d_f64::prelude::RigidBody;
use sinew_body::humanoid::log;

/// A pin: an implicit spring, per unit of mass and inertia, that holds a part to a position and rotation in the world.
/// Its force is an external (residual) force.
///
/// F = m (k (x̂ − x + h Δv) + d Δv + â) / (1 + h d + h² k) with Δv = v̂ − v and the step h, and the same with the inertia for
/// the turn: stable at any k and d, because it is the force of the step's end.
///
/// A part without error in position and velocity gets the acceleration â if v̂ is the velocity at the end of the step.
/// With â = 0 it lags.
///
/// It takes effect with the next step after [`World::set_pin`](crate::World::set_pin) and stays until another one is set. A pin with a
/// gain out of range, a NaN, an infinity, a degenerate rotation or a position beyond 10 km holds nothing. [`Pin::LOOSE`] states the
/// defaults.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pin {
    /// Wanted position of the part's joint \[m\], world.
    pub position: DVec3,
    /// Wanted `world_from_part`.
    pub rotation: DQuat,
    /// Wanted velocity of the centre of mass \[m/s\], world, shortened to 400 m/s. Default zero.
    pub velocity: DVec3,
    /// Wanted angular velocity \[rad/s\], world, shortened to 500 rad/s. Default zero.
    pub angular_velocity: DVec3,
    /// Wanted acceleration of the centre of mass, added to the spring (feed-forward) \[m/s²\], world, shortened to 1e5 m/s². Default
    /// zero.
    pub acceleration: DVec3,
    /// Torque added to the spring \[N m\], world, shortened to 1e4 N m. Default zero.
    pub torque: DVec3,
    /// Stiffness per unit mass \[1/s²\], 0 to 1e9 (exclusive), default 0.
    pub stiffness: f64,
    /// Damping per unit mass \[1/s\], 0 to 1e9 (exclusive), default 0.
    pub damping: f64,
    /// Stiffness of the turn per unit inertia \[1/s²\], 0 to 1e9 (exclusive), default 0.
    pub turn_stiffness: f64,
    /// Damping of the turn per unit inertia \[1/s\], 0 to 1e9 (exclusive), default 0.
    pub turn_damping: f64,
    /// Share of the part's weight that the pin carries \[1\], clamped to 0 to 1, default 0.
    pub gravity_share: f64,
    /// Maximum force \[N\], clamped to 0 to [`MAX_FORCE_N`](crate::MAX_FORCE_N), default infinite; the torque is reduced in the same
    /// proportion.
    pub max_force_n: f64,
}

impl Pin {
    /// A pin at the origin without any force, for struct update syntax.
    pub const LOOSE: Pin = Pin {
        position: DVec3::ZERO,
        rotation: DQuat::IDENTITY,
        velocity: DVec3::ZERO,
        angular_velocity: DVec3::ZERO,
        acceleration: DVec3::ZERO,
        torque: DVec3::ZERO,
        stiffness: 0.0,
        damping: 0.0,
        turn_stiffness: 0.0,
        turn_damping: 0.0,
        gravity_share: 0.0,
        max_force_n: f64::INFINITY,
    };
}

/// [`Pin::LOOSE`].
impl Default for Pin {
    fn default() -> Pin {
        Pin::LOOSE
    }
}

sinew_snapshot::snapshot!(Pin {
    position,
    rotation,
    velocity,
    angular_velocity,
    acceleration,
    torque,
    stiffness,
    damping,
    turn_stiffness,
    turn_damping,
    gravity_share,
    max_force_n,
});

/// Force \[N\] and torque \[N m\] of a pin on a body with these moments of inertia along its axes. (The library's own are along
/// axes that it chooses: with those of another axis the torque is no longer stable.)
pub(crate) fn pin_force(body: &RigidBody, inertia: DVec3, pin: &Pin, step_secs: f64, gravity: DVec3) -> (DVec3, DVec3) {
    let (h, k, d) = (step_secs, pin.stiffness, pin.damping);
    let scale = 1.0 / (1.0 + h * d + h * h * k);
    let centre = pin.position + pin.rotation * body.local_center_of_mass();
    let slip = pin.velocity - body.linvel();
    let acceleration = ((centre - body.center_of_mass() + slip * h) * k + slip * d + pin.acceleration) * scale;
    let force = acceleration * body.mass() - gravity * (body.mass() * pin.gravity_share);

    let (k, d) = (pin.turn_stiffness, pin.turn_damping);
    let mut torque = pin.torque;
    if k + d > 0.0 {
        let scale = 1.0 / (1.0 + h * d + h * h * k);
        let spin = pin.angular_velocity - body.angvel();
        let turn = log(pin.rotation * body.rotation().conjugate());
        let turning = ((turn + spin * h) * k + spin * d) * scale;
        let rotation = DMat3::from_quat(*body.rotation());
        torque += rotation * (DMat3::from_diagonal(inertia) * (rotation.transpose() * turning));
    }

    let cut = (pin.max_force_n / force.length().max(1e-9)).min(1.0);
    (force * cut, torque * cut)
}
