//! Capsules that make a body visible in a written file.

use glam::DVec3;

/// A capsule (a sphere if both ends coincide) that represents a limb in files that show a body.
///
/// It is rigid to its joint: it shows where the joint is and how it turns, and nothing else.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BodyShape {
    /// Index of the joint that carries it.
    pub joint: usize,
    /// Centre of one end, in the joint's frame \[m\].
    pub from: DVec3,
    /// Centre of the other end, in the joint's frame \[m\].
    pub to: DVec3,
    /// Radius, positive \[m\].
    pub radius_m: f64,
}
