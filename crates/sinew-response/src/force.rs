//! External forces on a body.

use glam::DVec3;
use sinew_body::humanoid::{Body, Node, Pose};

/// Maximum force \[N\], the weight of ten tonnes; larger ones are clamped, so that any finite force gives a finite
/// pose.
const MAX_FORCE_N: f64 = 1e5;

/// A force at a point of a body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PointForce {
    /// The body it acts on.
    pub node: Node,
    /// Point of application in the node's anatomical frame \[m\]; `None` for its centre of mass.
    pub point: Option<DVec3>,
    /// The force in the world \[N\].
    pub force_n: DVec3,
}

impl PointForce {
    /// A force at a body's centre of mass.
    pub fn at_centre(node: Node, force_n: DVec3) -> PointForce {
        PointForce { node, point: None, force_n }
    }

    /// A force at a point of the world, on a body in a pose.
    pub fn at_world_point(node: Node, point_in_world: DVec3, force_n: DVec3, body: &Body, pose: &Pose) -> PointForce {
        let from_joint = point_in_world - pose.positions(body)[node.index()];
        PointForce { node, point: Some(pose.world[node.index()].conjugate() * from_joint), force_n }
    }

    /// The sanitized force: NaN and infinite values removed, magnitudes clamped.
    pub(crate) fn tamed(&self) -> PointForce {
        let finite = |vector: DVec3| if vector.is_finite() { vector } else { DVec3::ZERO };
        let scale = self.force_n.abs().max_element();
        let force_n = if scale > MAX_FORCE_N { self.force_n * (MAX_FORCE_N / scale) } else { self.force_n };
        // A point is clamped to a body's length from its joint.
        let point = self.point.map(|point| finite(point).clamp_length_max(10.0));
        PointForce { node: self.node, point, force_n: finite(force_n) }
    }
}
