//! Foot locking: without root motion, the root follows the stance foot.

use crate::{Root, Wanted};
use glam::{DQuat, DVec3};
use sinew_body::humanoid::{Body, Node, Pose};
use sinew_world::{CharacterFrame, hips_over_soles_m};

/// Places wanted poses with [`Root::Free`], for trackers that follow whole poses.
///
/// ```
/// use sinew_body::humanoid::{Body, Pose};
/// use sinew_control::{FreeRoot, Wanted};
/// let root = FreeRoot::at(&Pose::STANDING, Some(0.0));
/// let pose = root.pose(&Body::standard(80.0, 1.7), &Wanted::STANDING);
/// assert!(pose.hips_position.y > 0.8, "the soles are on the floor");
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FreeRoot {
    position: DVec3,
    rotation: DQuat,
    sole_m: Option<f64>,
    /// The feet of the last pose, relative to the hips.
    feet: Option<[DVec3; 2]>,
    /// The last wanted pose had root motion.
    was_placed: bool,
}

sinew_snapshot::snapshot!(FreeRoot { position, rotation, sole_m, feet, was_placed });

/// Height above the other foot at which a foot does not stand \[m\].
const LIFTED_M: f64 = 0.04;

impl FreeRoot {
    /// At the hips of a pose. With the height of a floor \[m\] the soles are kept on it, and the hips follow the stance
    /// foot; without one they stay.
    pub fn at(pose: &Pose, sole_m: Option<f64>) -> FreeRoot {
        let (position, rotation) = (pose.hips_position, pose.world[0]);
        FreeRoot { position, rotation, sole_m, feet: None, was_placed: false }
    }

    /// Sets the root to the hips of a pose.
    pub fn stand_at(&mut self, pose: &Pose) {
        (self.position, self.rotation) = (pose.hips_position, pose.world[0]);
    }

    /// Sets the root to the body's hips, upright.
    pub fn stand_where_it_is(&mut self, character: &CharacterFrame) {
        let facing = character.facing;
        self.position = character.parts[0].position;
        self.rotation = DQuat::from_rotation_y(libm::atan2(facing.x, facing.z));
        self.feet = None;
    }

    /// The wanted joints with the hips at this place.
    pub fn pose(&self, body: &Body, wanted: &Wanted) -> Pose {
        let mut pose = wanted.pose_with_hips(self.position, self.rotation);
        if let Some(sole_m) = self.sole_m {
            pose.hips_position.y = sole_m + hips_over_soles_m(body, &pose);
        }
        pose
    }

    /// Places a wanted pose, once a motion frame. One after poses with root motion starts at the body's position.
    pub fn place(&mut self, body: &Body, character: &CharacterFrame, wanted: &mut Wanted) {
        let was_placed = std::mem::replace(&mut self.was_placed, wanted.root == Root::Placed);
        if wanted.root == Root::Placed {
            return;
        }
        if self.sole_m.is_some() {
            if was_placed {
                self.stand_where_it_is(character);
            }
            let pose = wanted.pose_with_hips(self.position, self.rotation);
            let step = self.stance_step(body, &pose);
            self.position += step;
        }
        wanted.pose = self.pose(body, wanted);
    }

    /// The displacement of the hips over the ground that keeps the stance foot of this pose where it was in the last.
    fn stance_step(&mut self, body: &Body, pose: &Pose) -> DVec3 {
        let places = pose.positions(body);
        let feet = [Node::LeftFoot, Node::RightFoot].map(|foot| places[foot.index()] - pose.hips_position);
        let Some(before) = self.feet.replace(feet) else { return DVec3::ZERO };
        let lowest = feet[0].y.min(feet[1].y);
        let weights = feet.map(|foot| (1.0 - (foot.y - lowest) / LIFTED_M).max(0.0));
        let back = (before[0] - feet[0]) * weights[0] + (before[1] - feet[1]) * weights[1];
        DVec3::new(back.x, 0.0, back.z) / (weights[0] + weights[1])
    }
}
