//! The wanted motion as input of the response: one frame, and the step that led to it.

use crate::torque::{Differences, steps, world_turn};
use crate::upper_body::{ABOVE, Coordinates24, UpperBody, locals};
use glam::{DQuat, DVec3};
use sinew_body::humanoid::{Body, HipsDeviation, Node, Pose, UPPER_NODES, exp};
use sinew_snapshot::snapshot;

/// A wanted pose with the quantities derived from it and from the one before, each computed once.
#[derive(Clone, Debug)]
pub(crate) struct Input {
    pub pose: Pose,
    /// `parent_from_node` of the upper bodies.
    pub local: [DQuat; UPPER_NODES],
    /// The hips' position in the frame before \[m\].
    pub hips_before: DVec3,
    /// The hips' turn from the frame before \[rad\], world.
    pub hips_turn: DVec3,
    /// Each joint's turn from the frame before \[rad\], child's frame.
    pub step: [DVec3; UPPER_NODES],
}

snapshot!(Input { pose, local, hips_before, hips_turn, step });

impl Input {
    /// A pose and the one before it.
    pub(crate) fn at(before: &Pose, pose: &Pose) -> Input {
        Input::from(before, &locals(before), pose)
    }

    /// The next frame.
    pub(crate) fn followed_by(&self, next: &Pose) -> Input {
        Input::from(&self.pose, &self.local, next)
    }

    fn from(before: &Pose, local_before: &[DQuat; UPPER_NODES], pose: &Pose) -> Input {
        let local = locals(pose);
        Input {
            pose: *pose,
            step: steps(local_before, &local),
            local,
            hips_before: before.hips_position,
            hips_turn: world_turn(before.world[0], pose.world[0]),
        }
    }

    /// The torque \[N m\] of this frame's motion, given the next frame.
    pub(crate) fn torque(&self, next: &Input, upper: &mut UpperBody, time_step_secs: f64) -> Coordinates24 {
        Differences {
            time_step_secs,
            rotation: self.pose.world[0],
            positions: [self.hips_before, self.pose.hips_position, next.pose.hips_position],
            turns: [self.hips_turn, next.hips_turn],
            local: &self.local,
            steps: [&self.step, &next.step],
        }
        .torque(upper)
    }
}

/// The wanted pose with the deviation on it, feet where the wanted pose has them.
pub(crate) fn posed(
    body: &Body,
    wanted: &Input,
    turned: &[DQuat; UPPER_NODES],
    hips: &HipsDeviation,
    ground: DVec3,
) -> Pose {
    let mut pose = wanted.pose;
    pose.hips_position += hips.shift + ground;
    let hips_turned = exp(hips.turn);
    let mut moved = [false; UPPER_NODES];
    if hips.turn != DVec3::ZERO {
        pose.world[0] = hips_turned * wanted.pose.world[0];
        moved[0] = true;
    }
    for node in ABOVE {
        let (at, parent) = (node.index(), node.parent().map_or(0, Node::index));
        moved[at] = moved[parent] || turned[at] != DQuat::IDENTITY;
        if moved[at] {
            pose.world[at] = (pose.world[parent] * (wanted.local[at] * turned[at])).normalize();
        }
    }
    if !hips.is_none() {
        pose.plant_feet(body, &wanted.pose, hips.shift, hips_turned);
    }
    pose
}
