//! A character's body: mass, shape and joint limit of each of the 18 nodes.

use super::anthropometry::{STANDARD_STATURE_M, segment, standard_offset, standard_radii, standard_tip};
use super::{Limit, Node, Pose};
use glam::{DMat3, DVec3};

/// A tapered capsule in a node's frame: its visible and collision shape.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shape {
    /// Centre of the first cap \[m\].
    pub from: DVec3,
    /// Centre of the second cap \[m\].
    pub to: DVec3,
    /// Radius of the first cap \[m\].
    pub from_radius_m: f64,
    /// Radius of the second cap \[m\].
    pub to_radius_m: f64,
}

/// One body of the tree.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Link {
    /// From the parent's joint to this node's, in the parent's frame \[m\]; zero for the hips.
    pub offset: DVec3,
    /// From the joint to the far end of the segment, in the node's frame \[m\].
    pub tip: DVec3,
    /// Mass \[kg\].
    pub mass_kg: f64,
    /// Centre of mass in the node's frame \[m\].
    pub centre: DVec3,
    /// Moments of inertia about the centre of mass, along the node's axes \[kg m²\].
    pub inertia: DVec3,
    /// Its capsule.
    pub shape: Shape,
    /// Limit of its joint.
    pub limit: Limit,
}

/// A character's body.
///
/// ```
/// use sinew_body::humanoid::{Body, Node};
/// let body = Body::standard(40.0, 1.5);
/// assert!((body.mass_kg() - 40.0).abs() < 1e-9);
/// assert!(body.link(Node::LeftHand).mass_kg < 0.3);
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Body {
    links: [Link; Node::COUNT],
    stature_m: f64,
}

impl Body {
    /// A body of average proportions: de Leva's masses and the method's own tree, scaled. See [`Body::shaped`].
    pub fn standard(mass_kg: f64, stature_m: f64) -> Body {
        let scale = stature_m / STANDARD_STATURE_M;
        let mut offsets = [DVec3::ZERO; Node::COUNT];
        let mut tips = [DVec3::ZERO; Node::COUNT];
        for node in Node::ALL {
            offsets[node.index()] = standard_offset(node) * scale;
            tips[node.index()] = standard_tip(node) * scale;
        }
        Body::shaped(mass_kg, stature_m, &offsets, &tips)
    }

    /// A body of given bones: `offsets` from the parent's joint to the node's own in the parent's frame, `tips` from
    /// the joint to the end of the segment in the node's frame, both in metres and by [`Node::index`].
    ///
    /// Limbs take their inertia from their own length; the trunk, the shoulders and the head from the stature, since
    /// capture skeletons disagree about where a spine begins.
    pub fn shaped(mass_kg: f64, stature_m: f64, offsets: &[DVec3; Node::COUNT], tips: &[DVec3; Node::COUNT]) -> Body {
        let scale = stature_m / STANDARD_STATURE_M;
        // Breadths of a body of other proportions: mass grows with length times breadth squared.
        let build = (mass_kg / 80.0 / scale).max(1e-3).sqrt();
        let links = Node::ALL.map(|node| {
            let segment = segment(node);
            let tip = tips[node.index()];
            let by_stature = matches!(
                node,
                Node::Hips | Node::Chest | Node::Neck | Node::Head | Node::LeftShoulder | Node::RightShoulder
            );
            let length = match node {
                Node::Chest => 0.335 * scale,
                Node::Hips => 0.1457 * scale,
                _ if by_stature => standard_tip(node).length() * scale,
                Node::LeftFoot | Node::RightFoot => 0.258 * scale,
                _ => tip.length(),
            };
            let mass = segment.mass * mass_kg;
            let moment = |radius: f64| mass * (radius * length) * (radius * length);
            let centre = match node {
                Node::Hips => DVec3::new(0.0, -0.02 * scale, 0.0),
                _ => tip * segment.centre,
            };
            let (from_radius, to_radius) = standard_radii(node);
            let shape = shape(node, tip, scale, from_radius * build, to_radius * build);
            Link {
                offset: offsets[node.index()],
                tip,
                mass_kg: mass,
                centre,
                inertia: DVec3::new(
                    moment(segment.gyration[0]),
                    moment(segment.gyration[1]),
                    moment(segment.gyration[2]),
                ),
                shape,
                limit: Limit::of(node),
            }
        });
        Body { links, stature_m }
    }

    /// One of the bodies.
    pub fn link(&self, node: Node) -> &Link {
        &self.links[node.index()]
    }

    /// One of the bodies, to change its limits.
    pub fn link_mut(&mut self, node: Node) -> &mut Link {
        &mut self.links[node.index()]
    }

    /// Mass of the whole body \[kg\].
    pub fn mass_kg(&self) -> f64 {
        self.links.iter().map(|link| link.mass_kg).sum()
    }

    /// Standing height \[m\].
    pub fn stature_m(&self) -> f64 {
        self.stature_m
    }

    /// Widens every joint's limit so that it contains a pose of the input.
    pub fn widen_limits(&mut self, pose: &Pose) {
        for node in Node::ALL {
            self.links[node.index()].limit.widen(pose.local(node));
        }
    }

    /// Centre of mass of a pose \[m\].
    pub fn centre_of_mass(&self, pose: &Pose) -> DVec3 {
        let positions = pose.positions(self);
        let moment: DVec3 = Node::ALL
            .into_iter()
            .map(|node| {
                let link = self.link(node);
                (positions[node.index()] + pose.world[node.index()] * link.centre) * link.mass_kg
            })
            .sum();
        moment / self.mass_kg()
    }

    /// Inertia of the whole body in a pose about a point, world axes \[kg m²\].
    pub fn inertia_about(&self, pose: &Pose, point: DVec3) -> DMat3 {
        let positions = pose.positions(self);
        let mut total = DMat3::ZERO;
        for node in Node::ALL {
            let link = self.link(node);
            let rotation = DMat3::from_quat(pose.world[node.index()]);
            let arm = positions[node.index()] + rotation * link.centre - point;
            let own = rotation * DMat3::from_diagonal(link.inertia) * rotation.transpose();
            let outer = DMat3::from_cols(arm * arm.x, arm * arm.y, arm * arm.z);
            total += own + (DMat3::from_diagonal(DVec3::splat(arm.length_squared())) - outer) * link.mass_kg;
        }
        total
    }
}

fn shape(node: Node, tip: DVec3, scale: f64, from_radius_m: f64, to_radius_m: f64) -> Shape {
    let (from, to) = match node {
        // The pelvis lies across.
        Node::Hips => (DVec3::new(0.055 * scale, -0.03 * scale, 0.0), DVec3::new(-0.055 * scale, -0.03 * scale, 0.0)),
        Node::Chest => (DVec3::new(0.0, -0.02 * scale, 0.0), tip * 0.78),
        Node::Head => (tip * 0.15, tip * 0.62),
        Node::LeftFoot | Node::RightFoot => (DVec3::new(tip.x * 0.1, tip.y * 0.35, -0.03 * scale), tip * 0.9),
        _ => (DVec3::ZERO, tip),
    };
    Shape { from, to, from_radius_m, to_radius_m }
}
