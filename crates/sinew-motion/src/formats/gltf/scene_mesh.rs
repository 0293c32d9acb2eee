//! The shapes of a scene as triangles.

use super::append::{ARRAY_BUFFER, Append};
use super::capsule::Mesh;
use crate::Transform;
use crate::formats::{BodyShape, SceneForm};
use glam::DVec3;
use serde_json::{Value, json};

impl Mesh {
    /// Adds a shape at rest at `world_from_joint`.
    pub fn push_form(&mut self, form: &SceneForm, joint: u16, world: Transform) {
        match form {
            SceneForm::Capsule { from, to, radius_m } => {
                let shape = BodyShape { joint: usize::from(joint), from: *from, to: *to, radius_m: *radius_m };
                self.push(&shape, joint, world);
            }
            SceneForm::Box { centre, rotation, size_m } => {
                for axis in 0..3 {
                    for side in [-1.0, 1.0] {
                        let normal = DVec3::AXES[axis] * side;
                        let (one, other) = (DVec3::AXES[(axis + 1) % 3], DVec3::AXES[(axis + 2) % 3] * side);
                        let corner =
                            |a: f64, b: f64| *centre + *rotation * (0.5 * *size_m * (normal + one * a + other * b));
                        let corners = [corner(-1.0, -1.0), corner(1.0, -1.0), corner(1.0, 1.0), corner(-1.0, 1.0)];
                        self.push_flat(&corners, *rotation * normal, joint, world);
                    }
                }
            }
            SceneForm::Triangles { points_m, triangles } => {
                for triangle in triangles {
                    let corners = triangle.map(|corner| points_m.get(corner as usize).copied());
                    if let [Some(a), Some(b), Some(c)] = corners
                        && let Some(normal) = (b - a).cross(c - a).try_normalize()
                    {
                        self.push_flat(&[a, b, c], normal, joint, world);
                    }
                }
            }
        }
    }

    /// Adds a flat convex face, its corners counter-clockwise from outside.
    fn push_flat(&mut self, corners: &[DVec3], normal: DVec3, joint: u16, world: Transform) {
        let first = (self.positions.len() / 3) as u32;
        let normal = (world.rotation * normal).normalize().as_vec3();
        for corner in corners {
            self.positions.extend(world.point(*corner).as_vec3().to_array());
            self.normals.extend(normal.to_array());
            self.joints.push(joint);
        }
        for last in 2..corners.len() as u32 {
            self.indices.extend([first, first + last - 1, first + last]);
        }
    }

    /// Writes it; `skinned` with the joint of each vertex.
    pub fn primitive(&self, material: usize, skinned: bool, append: &mut Append) -> Value {
        let mut attributes = json!({
            "POSITION": append.floats("VEC3", &self.positions, true, Some(ARRAY_BUFFER)),
            "NORMAL": append.floats("VEC3", &self.normals, false, Some(ARRAY_BUFFER)),
        });
        if skinned {
            attributes["JOINTS_0"] = json!(append.joints(&self.joints));
            attributes["WEIGHTS_0"] = json!(append.whole_weights(self.joints.len()));
        }
        json!({ "attributes": attributes, "indices": append.indices(&self.indices), "material": material })
    }
}
