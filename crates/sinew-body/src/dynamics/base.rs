//! The base of a tree: pose, motion and gravity.

use super::{M3, Real, V3};

/// Pose and motion of the frame to which a tree's first links are attached, and gravity.
///
/// For a whole character this is the world at rest. For part of one, such as the body above the pelvis, it is the
/// link below with its motion prescribed: since a prescribed motion passes nothing back, the torques above are exact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Base<S: Real> {
    /// `world_from_base` rotation.
    pub rotation: M3<S>,
    /// Origin of the base's frame \[m\], world.
    pub origin: V3<S>,
    /// Angular velocity \[rad/s\], world axes.
    pub angular_velocity: V3<S>,
    /// Velocity of the origin \[m/s\], world axes.
    pub velocity: V3<S>,
    /// Angular acceleration \[rad/s²\], world axes.
    pub angular_acceleration: V3<S>,
    /// Acceleration of the origin \[m/s²\], world axes, without gravity.
    pub acceleration: V3<S>,
    /// Acceleration of free fall \[m/s²\], world axes.
    pub gravity: V3<S>,
}

impl<S: Real> Base<S> {
    /// The world at rest, in a field of gravity \[m/s²\].
    pub fn at_rest(gravity: V3<S>) -> Base<S> {
        Base {
            rotation: M3::identity(),
            origin: V3::ZERO,
            angular_velocity: V3::ZERO,
            velocity: V3::ZERO,
            angular_acceleration: V3::ZERO,
            acceleration: V3::ZERO,
            gravity,
        }
    }
}
