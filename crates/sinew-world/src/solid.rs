//! Collision shapes.

use glam::{DQuat, DVec3};
use rapier3d_f64::prelude::{Pose as Placement, SharedShape};

/// A collision shape, in the frame of its body.
#[derive(Clone, Debug, PartialEq)]
pub struct Solid {
    /// Its form.
    pub form: Form,
    /// Its centre \[m\].
    pub centre: DVec3,
    /// `carrier_from_shape`.
    pub rotation: DQuat,
}

/// The form of a [`Solid`]. All sizes in metres, above 0.
#[derive(Clone, Debug, PartialEq)]
pub enum Form {
    /// A ball.
    Ball {
        /// Radius.
        radius_m: f64,
    },
    /// A box of full edge lengths.
    Box {
        /// Along x, y, z.
        size_m: DVec3,
    },
    /// A capsule along y; `length_m` without the caps.
    Capsule {
        /// Radius.
        radius_m: f64,
        /// Between the centres of the caps.
        length_m: f64,
    },
    /// A ring (torus) about y, made of straight pieces.
    Ring {
        /// From the axis to the middle of the tube.
        radius_m: f64,
        /// Radius of the tube.
        tube_m: f64,
    },
    /// A triangle mesh; has no inside, so only for bodies that are not dynamic.
    Mesh {
        /// Corners.
        points_m: Vec<DVec3>,
        /// Three indices each.
        triangles: Vec<[u32; 3]>,
    },
    /// The convex hull of points.
    Hull {
        /// The points, at least four that do not lie in a plane.
        points_m: Vec<DVec3>,
    },
}

sinew_snapshot::snapshot!(Solid { form, centre, rotation });
sinew_snapshot::snapshot!(enum Form {
    0: Ball { radius_m },
    1: Box { size_m },
    2: Capsule { radius_m, length_m },
    3: Ring { radius_m, tube_m },
    4: Mesh { points_m, triangles },
    5: Hull { points_m },
});

/// Number of pieces of a ring: enough that no corner deviates by more than a hundredth of the radius.
pub const RING_PIECES: usize = 16;

/// A ball of 10 cm at the origin.
impl Default for Solid {
    fn default() -> Solid {
        Solid::new(Form::Ball { radius_m: 0.1 })
    }
}

impl Solid {
    /// A form at the origin.
    pub fn new(form: Form) -> Solid {
        Solid { form, centre: DVec3::ZERO, rotation: DQuat::IDENTITY }
    }

    /// The same, its centre elsewhere \[m\].
    #[must_use]
    pub fn at(self, centre: DVec3) -> Solid {
        Solid { centre, ..self }
    }

    /// A capsule between two points \[m\].
    pub fn capsule_between(from: DVec3, to: DVec3, radius_m: f64) -> Solid {
        let line = to - from;
        let rotation = line.try_normalize().map_or(DQuat::IDENTITY, |along| DQuat::from_rotation_arc(DVec3::Y, along));
        Solid { form: Form::Capsule { radius_m, length_m: line.length() }, centre: (from + to) * 0.5, rotation }
    }

    pub(crate) fn placement(&self) -> Placement {
        Placement::from_parts(self.centre, self.rotation.normalize())
    }

    /// `None` for a degenerate hull or mesh, and for sizes that are not above 0 or out of range.
    pub(crate) fn shape(&self) -> Option<SharedShape> {
        if !crate::sanitize::is_solid(self) {
            return None;
        }
        Some(match &self.form {
            Form::Ball { radius_m } => SharedShape::ball(*radius_m),
            Form::Box { size_m } => SharedShape::cuboid(size_m.x / 2.0, size_m.y / 2.0, size_m.z / 2.0),
            Form::Capsule { radius_m, length_m } if *length_m < 1e-6 => SharedShape::ball(*radius_m),
            Form::Capsule { radius_m, length_m } => SharedShape::capsule_y(length_m / 2.0, *radius_m),
            Form::Ring { radius_m, tube_m } => {
                let pieces = ring_corners(*radius_m);
                let piece = |at: usize| {
                    let (from, to) = (pieces[at], pieces[(at + 1) % RING_PIECES]);
                    (Placement::identity(), SharedShape::capsule(from, to, *tube_m))
                };
                SharedShape::compound((0..RING_PIECES).map(piece).collect())
            }
            Form::Mesh { points_m, triangles } => SharedShape::trimesh(points_m.clone(), triangles.clone()).ok()?,
            Form::Hull { points_m } => SharedShape::convex_hull(points_m)?,
        })
    }
}

/// Corners of the polygon that approximates a ring about y.
pub fn ring_corners(radius_m: f64) -> [DVec3; RING_PIECES] {
    std::array::from_fn(|at| {
        let (sin, cos) = libm::sincos(at as f64 * std::f64::consts::TAU / RING_PIECES as f64);
        DVec3::new(sin, 0.0, cos) * radius_m
    })
}
