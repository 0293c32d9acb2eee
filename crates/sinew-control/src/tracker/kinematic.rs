//! Shows the wanted pose, whatever is in the way.

use super::clock::Clock;
use super::pose_interpolator::PoseInterpolator;
use sinew_body::humanoid::{Node, Pose};
use sinew_world::World;

/// Moves every part to the wanted pose; what it meets is pushed with infinite mass.
///
/// Each step of physics: [`physics_step`](KinematicTracker::physics_step), then [`World::step`]. Where
/// [`wants_pose`](KinematicTracker::wants_pose) says so, that is at the start of each motion frame, hand it the pose of the
/// frame's end first.
#[derive(Clone, Debug)]
pub struct KinematicTracker {
    clock: Clock,
    interpolator: PoseInterpolator,
    wanted: Pose,
}

sinew_snapshot::snapshot!(KinematicTracker { clock, interpolator, wanted });

impl KinematicTracker {
    /// Starts at rest in `first`; wanted poses come every `time_step_secs`.
    pub fn new(time_step_secs: f64, first: &Pose) -> KinematicTracker {
        KinematicTracker {
            clock: Clock::new(time_step_secs),
            interpolator: PoseInterpolator::rest(first),
            wanted: *first,
        }
    }

    /// Whether the next step of physics begins a motion frame.
    pub fn wants_pose(&self) -> bool {
        self.clock.is_due()
    }

    /// The pose for the end of the motion frame that begins. One that is not finite is passed over.
    pub fn wanted(&mut self, pose: &Pose) {
        if pose.is_finite() {
            self.wanted = *pose;
        }
    }

    /// Says where every part is to be at the end of the world's next step.
    pub fn physics_step(&mut self, world: &mut World, character: usize) {
        if self.clock.is_due() {
            self.clock.begin_frame();
            self.interpolator.next(&self.wanted);
        }
        let pose = self.interpolator.at(self.clock.advance(world.settings().step_secs()));
        let Some(body) = world.body(character) else { return };
        let positions = pose.positions(body);
        for node in Node::ALL {
            world.move_part(character, node, positions[node.index()], pose.world[node.index()]);
        }
    }

    /// Hands the parts back to physics, as they move now.
    pub fn release(&self, world: &mut World, character: usize) {
        for node in Node::ALL {
            world.set_forces(character, node, true);
        }
    }
}
