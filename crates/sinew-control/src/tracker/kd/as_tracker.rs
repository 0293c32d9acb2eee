//! The tracker `kd` as a [`Tracker`](crate::tracker::Tracker).

use super::KdTracker;
use crate::Wanted;
use crate::tracker::pose_interpolator::led_to;
use crate::tracker::{Honours, Tracker, TrackerKind, TrackerStart, Wants};
use sinew_body::humanoid::Node;
use sinew_world::{CharacterId, World};

/// Duration of the transition when the tracker starts in the middle of a run \[s\].
const TAKE_OVER_SECS: f64 = 0.5;

impl KdTracker {
    /// See [`Tracker::honours`].
    pub const HONOURS: Honours = Honours { gains: true, torques: true, springs: false };
}

impl Tracker for KdTracker {
    fn cloned(&self) -> Box<dyn Tracker> {
        Box::new(self.clone())
    }

    fn kind(&self) -> TrackerKind {
        TrackerKind::Kd
    }

    fn honours(&self) -> Honours {
        KdTracker::HONOURS
    }

    fn wants(&self) -> Wants {
        if self.wants_pose() { Wants::Pose } else { Wants::Firmness }
    }

    fn locks_feet(&self) -> bool {
        true
    }

    /// At the world's start the body has the velocity of its motion; later it keeps its own state.
    fn start(&mut self, start: &TrackerStart, world: &mut World, character: CharacterId) {
        if world.frame().step > 0 {
            self.begin_where_it_is(TAKE_OVER_SECS);
            return;
        }
        let Some(motion) = start.motion else { return };
        let Some(now) = world.frame().character(character).map(|frame| frame.pose()) else { return };
        let frame_secs = self.clock.time_step_secs();
        let before = led_to(&motion(0.0), &motion(frame_secs));
        let step_secs = world.settings().step_secs();
        let Some(body) = world.body(character) else { return };
        self.restart(body, &before, &now, step_secs);
        self.launch(world, character);
    }

    fn follow(&mut self, wanted: &Wanted, world: &mut World, character: CharacterId) {
        if self.wants_pose() {
            self.wanted(&wanted.pose);
        }
        for node in Node::ALL {
            let at = node.index();
            self.joint_gain[at] = wanted.joints[at].gain;
            self.torque[at] = wanted.joints[at].torque;
        }
        self.physics_step(world, character);
    }

    fn release(&mut self, world: &mut World, character: CharacterId) {
        world.set_limp(character);
        world.set_reaction_body(character, None);
        world.set_passes_own(character, [0; Node::COUNT]);
    }
}
