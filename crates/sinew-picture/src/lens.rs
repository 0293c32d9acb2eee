//! Projection from the world to one panel.

use glam::{DVec3, Vec3};

use crate::canvas::Spot;
use crate::solid::{Form, Solid};
use crate::{Capsule, Cuboid, Figure, View};

/// The view of a panel: the point on the floor that it follows, and the scale.
#[derive(Clone, Copy)]
pub(crate) struct Lens {
    pub view: View,
    /// The point followed, on the floor \[m\], world.
    pub origin: DVec3,
    /// Pixels per metre.
    pub scale: f64,
    /// Position of the origin in the panel \[px\], y down.
    pub at: Spot,
}

impl Lens {
    /// A point of the world in panel axes \[px\]: right from the left edge, *up* from the top edge, toward the viewer.
    pub fn panel_from_world(&self, point: DVec3) -> Vec3 {
        let seen = self.view.view_from_world(point - self.origin) * self.scale;
        Vec3::new(seen.x as f32 + self.at.0, seen.y as f32 - self.at.1, seen.z as f32)
    }

    /// Position of a point of the world in the panel \[px\], y down.
    pub fn spot(&self, point: DVec3) -> Spot {
        let seen = self.panel_from_world(point);
        (seen.x, -seen.y)
    }

    /// A direction of the world in panel axes.
    fn direction(&self, world: DVec3) -> Vec3 {
        self.view.view_from_world(world).as_vec3()
    }

    pub fn solids<'a>(&self, figures: impl IntoIterator<Item = &'a Figure>) -> Vec<Solid> {
        let capsule = |capsule: Capsule| Solid {
            form: Form::Capsule {
                from: self.panel_from_world(capsule.from),
                to: self.panel_from_world(capsule.to),
                radius_from: (capsule.radius_from_m * self.scale) as f32,
                radius_to: (capsule.radius_to_m * self.scale) as f32,
            },
            shade: capsule.shade,
        };
        let cuboid = |cuboid: Cuboid| Solid {
            form: Form::Cuboid {
                centre: self.panel_from_world(cuboid.centre),
                axes: DVec3::AXES.map(|axis| self.direction(cuboid.rotation * axis)),
                half: (cuboid.size_m * (0.5 * self.scale)).as_vec3(),
            },
            shade: cuboid.shade,
        };
        let all = |figure: &'a Figure| {
            figure.drawable().map(capsule).chain(figure.drawable_boxes().map(cuboid)).collect::<Vec<_>>()
        };
        figures.into_iter().flat_map(all).collect()
    }
}
