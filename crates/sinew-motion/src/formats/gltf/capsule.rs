//! A mesh of capsules, each rigid to its joint.

use crate::Transform;
use crate::formats::BodyShape;
use glam::DVec3;
use std::f64::consts::{FRAC_PI_2, TAU};

/// Corners around the axis, and rings from the pole to the equator: enough to look round at arm's length.
const SECTORS: u32 = 16;
const RINGS: u32 = 5;

/// Triangles with smooth normals, in the world of the rest pose.
#[derive(Debug, Default)]
pub(super) struct Mesh {
    /// xyz of each vertex \[m\].
    pub positions: Vec<f32>,
    /// xyz of each vertex, unit length.
    pub normals: Vec<f32>,
    /// The joint of each vertex.
    pub joints: Vec<u16>,
    /// Three vertices for each triangle, counter-clockwise from outside.
    pub indices: Vec<u32>,
}

impl Mesh {
    /// Adds a shape whose joint rests at `world_from_joint`; `joint` is the shape's as the skin counts it.
    pub fn push(&mut self, shape: &BodyShape, joint: u16, world_from_joint: Transform) {
        let axis = (shape.to - shape.from).try_normalize();
        let up = axis.unwrap_or(DVec3::Y);
        let (side, other) = up.any_orthonormal_pair();
        // Rings from the pole at `to` down to the pole at `from`; a capsule has its equator twice.
        let mut rings = Vec::new();
        for ring in 1..=RINGS {
            rings.push((f64::from(ring) / f64::from(RINGS) * FRAC_PI_2, shape.to));
        }
        for ring in u32::from(axis.is_none())..RINGS {
            rings.push((FRAC_PI_2 * (1.0 + f64::from(ring) / f64::from(RINGS)), shape.from));
        }
        let top = self.vertex(shape, joint, world_from_joint, shape.to, up);
        let mut above: Option<u32> = None;
        for (from_pole, centre) in rings {
            let start = (self.positions.len() / 3) as u32;
            for sector in 0..SECTORS {
                let turn = f64::from(sector) / f64::from(SECTORS) * TAU;
                let out = side * libm::cos(turn) + other * libm::sin(turn);
                let normal = up * libm::cos(from_pole) + out * libm::sin(from_pole);
                self.vertex(shape, joint, world_from_joint, centre, normal);
            }
            for sector in 0..SECTORS {
                let next = (sector + 1) % SECTORS;
                match above {
                    None => self.indices.extend([top, start + sector, start + next]),
                    Some(above) => self.indices.extend([
                        above + sector,
                        start + sector,
                        start + next,
                        above + sector,
                        start + next,
                        above + next,
                    ]),
                }
            }
            above = Some(start);
        }
        let bottom = self.vertex(shape, joint, world_from_joint, shape.from, -up);
        let last = above.unwrap_or(top);
        for sector in 0..SECTORS {
            self.indices.extend([last + sector, bottom, last + (sector + 1) % SECTORS]);
        }
    }

    fn vertex(&mut self, shape: &BodyShape, joint: u16, world: Transform, centre: DVec3, normal: DVec3) -> u32 {
        let index = (self.positions.len() / 3) as u32;
        let position = world.point(centre + normal * shape.radius_m).as_vec3();
        self.positions.extend(position.to_array());
        self.normals.extend((world.rotation * normal).normalize().as_vec3().to_array());
        self.joints.push(joint);
        index
    }
}
