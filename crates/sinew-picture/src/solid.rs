//! What a panel shows, projected: shapes in panel axes, and rays that meet them.

use glam::Vec3;

use crate::Shade;
use crate::cone::Cone;
use crate::slabs::Slabs;

/// A shape in panel axes: x right, y *up* from the panel's top edge (so negative), z toward the viewer \[px\].
#[derive(Clone, Copy, Debug)]
pub(crate) struct Solid {
    pub form: Form,
    pub shade: Shade,
}

/// What a solid is.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Form {
    Capsule {
        from: Vec3,
        to: Vec3,
        radius_from: f32,
        radius_to: f32,
    },
    /// Unit vectors along its edges, and half the length of each.
    Cuboid {
        centre: Vec3,
        axes: [Vec3; 3],
        half: Vec3,
    },
}

impl Form {
    /// Ready for rays, `scale` times as large.
    pub fn surface(&self, scale: f32) -> Option<Surface> {
        match *self {
            Form::Capsule { from, to, radius_from, radius_to } => {
                Cone::new(from * scale, to * scale, radius_from * scale, radius_to * scale).map(Surface::Cone)
            }
            Form::Cuboid { centre, axes, half } => Slabs::new(centre * scale, axes, half * scale).map(Surface::Cuboid),
        }
    }
}

/// What a ray along the view axis can meet.
pub(crate) enum Surface {
    Cone(Cone),
    Cuboid(Slabs),
}

impl Surface {
    /// Depth of its farthest and of its nearest point.
    pub fn depths(&self) -> (f32, f32) {
        match self {
            Surface::Cone(cone) => (cone.farthest(), cone.nearest()),
            Surface::Cuboid(slabs) => slabs.depths(),
        }
    }

    /// Lowest and highest y that it covers.
    pub fn rows(&self) -> (f32, f32) {
        match self {
            Surface::Cone(cone) => cone.rows(),
            Surface::Cuboid(slabs) => slabs.rows(),
        }
    }

    /// Minimum and maximum x that it covers at this y, or at any.
    pub fn columns(&self, y: f32) -> Option<(f32, f32)> {
        match self {
            Surface::Cone(cone) => cone.columns(y),
            Surface::Cuboid(slabs) => Some(slabs.columns()),
        }
    }

    /// Depth and unit normal of what the ray through (x, y) meets first.
    #[inline]
    pub fn hit(&self, x: f32, y: f32) -> Option<(f32, Vec3)> {
        match self {
            Surface::Cone(cone) => cone.hit(x, y),
            Surface::Cuboid(slabs) => slabs.hit(x, y),
        }
    }
}
