//! Plane constraints: characters restricted to two dimensions (Shapiro et al. 2007, section 4.1).
//!
//! Every part keeps its distance to a vertical plane and rotates about the plane's normal alone, by rows of the solver:
//! forces across the plane are resolved by the constraint, those along it act unchanged.

use crate::{CharacterId, World};
use glam::{DMat3, DQuat, DVec3};
use rapier3d_f64::prelude::*;

impl World {
    /// Constrains a character to vertical planes that contain `facing` (horizontal) and pass through each part at its
    /// present position.
    pub fn hold_to_plane(&mut self, character: CharacterId, facing: DVec3) {
        self.free_from_plane(character);
        let Some(normal) = DVec3::Y.cross(facing).try_normalize() else { return };
        let Some(one) = self.characters.get_mut(character) else { return };
        let up = DVec3::Y;
        let world_from_plane = DQuat::from_mat3(&DMat3::from_cols(normal, up, normal.cross(up))).normalize();
        let locks = JointAxesMask::LIN_X | JointAxesMask::ANG_Y | JointAxesMask::ANG_Z;
        for handle in one.bodies {
            let Some(body) = self.engine.bodies.get_mut(handle) else { continue };
            let place = *body.position();
            let flatten = |velocity: DVec3| velocity - normal * velocity.dot(normal);
            let flat = flatten(body.linvel());
            body.set_linvel(flat, true);
            body.set_angvel(normal * body.angvel().dot(normal), true);
            // The part's rotation out of the plane is kept: its own frame, rotated into the plane's.
            let joint = GenericJointBuilder::new(locks)
                .local_frame1(Pose::from_parts(body.center_of_mass(), world_from_plane))
                .local_frame2(Pose::from_parts(
                    body.local_center_of_mass(),
                    (place.rotation.conjugate() * world_from_plane).normalize(),
                ))
                .contacts_enabled(true)
                .build();
            let ground = self.engine.ground;
            one.planes.push(self.engine.insert_joint(ground, handle, joint));
        }
    }

    /// Frees a character to three dimensions again.
    pub fn free_from_plane(&mut self, character: CharacterId) {
        let Some(one) = self.characters.get_mut(character) else { return self.count_stale() };
        self.engine.removed_joints.append(&mut one.planes);
    }

    /// Whether a character is constrained to a plane.
    pub fn is_held_to_plane(&self, character: CharacterId) -> bool {
        self.characters.get(character).is_some_and(|one| !one.planes.is_empty())
    }
}
