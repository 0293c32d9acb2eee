//! Headings of scenes and commands.

use glam::{DQuat, DVec3};

/// The horizontal unit vector of a heading \[degrees about +Y from +Z to +X\].
pub(crate) fn heading(degrees: f64) -> DVec3 {
    DQuat::from_axis_angle(DVec3::Y, degrees.to_radians()) * DVec3::Z
}
