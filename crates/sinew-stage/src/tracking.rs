//! From what actors want to what their bodies do.

use crate::Stage;
use crate::basis::basis_for;
use crate::event::{Cause, Effect};
use crate::scene::TrackerKind;
use sinew_body::humanoid::Node;
use sinew_control::graph::Cause as GraphCause;
use sinew_control::tracker::{KdTracker, KinematicTracker, ResponseTracker};

impl Stage {
    /// Every actor decides, and its tracker tells the world.
    pub(crate) fn step_actors(&mut self) {
        let gravity = self.world.settings().gravity_m_s2;
        let now_secs = self.world.frame().time_secs;
        for index in 0..self.actors.len() {
            if let Some(change) = self.actors[index].step_performance(now_secs) {
                let name = self.cast.characters()[index].clone();
                self.note(Cause::Stream, Effect::of(name, change));
            }
            self.step_reach(index);
            if let Some((cause, effect)) = self.actors[index].decide(&self.world, gravity) {
                let name = self.cast.characters()[index].clone();
                let cause = match cause {
                    GraphCause::Touch(touch) => Cause::GraphTouch {
                        touched: [touch.a, touch.b].map(|thing| self.cast.name_of(thing)),
                        impulse_n_s: touch.impulse.length(),
                    },
                    GraphCause::Timer => Cause::GraphTimer,
                    GraphCause::Signal => Cause::GraphSignal,
                    GraphCause::Sensor(value) => Cause::GraphSensor { value },
                };
                self.note(cause, Effect::of(name, effect));
            }
            self.track(index);
        }
    }

    fn track(&mut self, index: usize) {
        let frame_end = self.world.frame().time_secs + self.frame_secs();
        let actor = &mut self.actors[index];
        match actor.tracker {
            TrackerKind::Pd => actor.pd.apply(&mut self.world, index, actor.target()),
            TrackerKind::Kinematic => {
                let wanted = actor.wanted_pose(frame_end);
                let Some(tracker) = &mut actor.kinematic else { return };
                if tracker.wants_pose() {
                    tracker.wanted(&wanted);
                }
                tracker.physics_step(&mut self.world, index);
            }
            TrackerKind::Kd => {
                let wants_pose = actor.kd.as_ref().is_some_and(KdTracker::wants_pose);
                let moves_root = actor.moves_root();
                if wants_pose && std::mem::replace(&mut actor.moved_root, moves_root) && !moves_root {
                    self.stand_here(index);
                }
                let actor = &mut self.actors[index];
                if wants_pose {
                    actor.step_foot_lock();
                }
                let wanted = wants_pose.then(|| actor.wanted_pose(frame_end));
                let Some(tracker) = &mut actor.kd else { return };
                if let Some(wanted) = wanted {
                    tracker.wanted(&wanted);
                }
                for node in Node::ALL {
                    let at = node.index();
                    let joint = &actor.target.joints[at];
                    tracker.joint_gain[at] = actor.pd.global_gain * actor.pd.joint_gain[at] * joint.gain;
                    tracker.torque[at] = joint.torque;
                }
                tracker.physics_step(&mut self.world, index);
            }
            TrackerKind::Response => {
                let wanted = actor.wanted_pose(frame_end);
                let Some(tracker) = &mut actor.response else { return };
                if tracker.wants_pose() {
                    tracker.wanted(&wanted);
                }
                tracker.physics_step(&mut self.world, index);
            }
            TrackerKind::None => {}
        }
    }

    fn frame_secs(&self) -> f64 {
        1.0 / f64::from(self.scene.stage.motion_hz)
    }

    /// Follows with another tracker from the next step on, from where the body is now.
    ///
    /// # Errors
    /// When the response finds no coordinates in the motion.
    pub(crate) fn set_tracker(&mut self, index: usize, kind: TrackerKind) -> Result<(), String> {
        let frame = &self.world.frame().characters[index];
        let (now, frame_secs) = (frame.pose(), self.frame_secs());
        let Some(spec) = self.scene.characters.values().nth(index) else { return Ok(()) };
        let actor = &mut self.actors[index];
        // What it begins with first: when that fails, all stays as it was.
        let response = match kind {
            TrackerKind::Response => {
                let (basis, settings) = basis_for(spec, actor.body(), actor.motion.as_ref(), frame_secs)?;
                let mut tracker = ResponseTracker::new(actor.body().clone(), basis, settings, &now);
                let prop = |name: &String| self.cast.prop(name).ok_or_else(|| format!("no prop `{name}`"));
                let stands_on = spec.response.stands_on.as_ref().map(prop).transpose()?;
                tracker.stand_on(&self.world, stands_on);
                if let Some(motion) = &actor.motion {
                    // It walks already when it begins.
                    let time_secs = self.world.frame().time_secs;
                    tracker.restart(&motion.pose_at(time_secs - frame_secs), &motion.pose_at(time_secs));
                }
                if let Some(part) = &spec.response.keep_upright {
                    let node = spec.node(part).ok_or_else(|| format!("no part or alias `{part}`"))?;
                    tracker.keep_upright(Some(node));
                }
                let avoided = spec.response.avoid.iter().map(prop).collect::<Result<Vec<usize>, String>>()?;
                tracker.avoid(&avoided);
                Some(tracker)
            }
            _ => None,
        };
        let kd = match kind {
            TrackerKind::Kd => {
                let settings = spec.kd.settings(|part| spec.node(part));
                let mut tracker = KdTracker::new(actor.body(), settings, frame_secs, &now);
                let prop = |name: &String| self.cast.prop(name).ok_or_else(|| format!("no prop `{name}`"));
                let stands_on = spec.kd.stands_on.as_ref().map(prop).transpose()?;
                tracker.stand_on(&self.world, stands_on);
                match &actor.motion {
                    // It is in the middle of its motion when it begins.
                    Some(motion) if self.world.frame().step == 0 => {
                        let step_secs = self.world.settings().step_secs();
                        tracker.restart(actor.body(), &motion.pose_before(0.0, frame_secs), &now, step_secs);
                        tracker.launch(&mut self.world, index);
                    }
                    _ if self.world.frame().step > 0 => tracker.begin_where_it_is(TAKE_OVER_SECS),
                    _ => {}
                }
                Some(tracker)
            }
            _ => None,
        };
        let actor = &mut self.actors[index];
        match actor.tracker {
            TrackerKind::Kinematic => (0..Node::COUNT).for_each(|at| self.world.set_forces(index, Node::ALL[at], true)),
            TrackerKind::Response => self.world.set_limp(index),
            TrackerKind::Kd => {
                if let Some(tracker) = &actor.kd {
                    tracker.release(&mut self.world, index);
                }
            }
            TrackerKind::Pd | TrackerKind::None => {}
        }
        actor.kinematic = (kind == TrackerKind::Kinematic).then(|| KinematicTracker::new(frame_secs, &now));
        actor.response = response;
        actor.kd = kd;
        actor.stand = (now.hips_position, now.world[0]);
        actor.sole_m = (kind == TrackerKind::Kd).then_some(spec.position_m[1]);
        actor.moved_root = actor.moves_root();
        match kind {
            TrackerKind::None => self.world.set_limp(index),
            TrackerKind::Pd => self.actors[index].take_over(&self.world),
            TrackerKind::Kd => self.stand_here(index),
            TrackerKind::Kinematic | TrackerKind::Response => {}
        }
        self.actors[index].tracker = kind;
        Ok(())
    }
}

/// How long a body takes to come to what is wanted when the tracker `kd` begins amid a run \[s\].
const TAKE_OVER_SECS: f64 = 0.5;
