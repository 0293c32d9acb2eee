//! The kinematic tracker shows the wanted pose, whatever is in the way.

use super::clock::Clock;
use super::pose_interpolator::{PoseInterpolator, led_to};
use super::{Honours, Tracker, TrackerKind, TrackerStart, Wants};
use crate::Wanted;
use sinew_body::humanoid::{Node, Pose};
use sinew_world::{CharacterId, World};

/// Moves every part to the wanted pose; bodies in the way are pushed with infinite mass.
///
/// Each step of physics: [`physics_step`](KinematicTracker::physics_step), then [`World::step`]. Where
/// [`wants_pose`](KinematicTracker::wants_pose) says so, that is at the start of each motion frame, pass the pose of
/// the frame's end first.
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

    /// Sets the pose for the end of the motion frame that begins. One that is not finite is ignored.
    pub fn wanted(&mut self, pose: &Pose) {
        if pose.is_finite() {
            self.wanted = *pose;
        }
    }

    /// Sets the pose of every part at the end of the world's next step.
    pub fn physics_step(&mut self, world: &mut World, character: CharacterId) {
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

    /// See [`Tracker::honours`].
    pub const HONOURS: Honours = Honours::NOTHING;
}

impl Tracker for KinematicTracker {
    fn cloned(&self) -> Box<dyn Tracker> {
        Box::new(self.clone())
    }

    fn kind(&self) -> TrackerKind {
        TrackerKind::Kinematic
    }

    fn honours(&self) -> Honours {
        KinematicTracker::HONOURS
    }

    fn wants(&self) -> Wants {
        if self.wants_pose() { Wants::Pose } else { Wants::Nothing }
    }

    /// At the world's start the body is in the motion already.
    fn start(&mut self, start: &TrackerStart, world: &mut World, _: CharacterId) {
        let Some(motion) = start.motion.filter(|_| world.frame().step == 0) else { return };
        let (now, next) = (motion(0.0), motion(self.clock.time_step_secs()));
        self.interpolator = PoseInterpolator::moving(&led_to(&now, &next), &now);
        self.wanted = now;
    }

    fn follow(&mut self, wanted: &Wanted, world: &mut World, character: CharacterId) {
        if self.wants_pose() {
            self.wanted(&wanted.pose);
        }
        self.physics_step(world, character);
    }

    /// The parts go on as they move now.
    fn release(&mut self, world: &mut World, character: CharacterId) {
        for node in Node::ALL {
            world.set_forces(character, node, true);
        }
    }
}
