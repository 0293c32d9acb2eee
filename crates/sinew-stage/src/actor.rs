//! The control of one character on a stage: its sources, layers and tracker.

use sinew_body::humanoid::{Body, Node, Pose};
use sinew_control::perform::LiveSource;
use sinew_control::reflex::{Reflex, Sense};
use sinew_control::source::{KeyPoses, Performer, PoseBook, SourceEvent, Sources};
use sinew_control::tracker::{Gains, PdTracker, Tracker, TrackerKind, TrackerStart, Wants};
use sinew_control::{Layer, OrderError, OrderErrorKind, Root, Wanted};
use sinew_world::{CharacterId, PropId, World};
use std::any::Any;
use std::sync::Arc;

/// Controls one character: its sources give the wanted pose, three layers (key poses and graphs, a script, reflexes) change it, and
/// a tracker makes the body follow. A clone continues bit for bit.
#[derive(Clone)]
pub struct Actor {
    pub(crate) id: CharacterId,
    pub(crate) sources: Sources,
    pub(crate) tracker: Box<dyn Tracker>,
    /// Whether the tracker is still the one that the scene gave.
    pub(crate) has_first_tracker: bool,
    pub(crate) wanted: Wanted,
    pub(crate) reflexes: Vec<(Box<dyn Reflex>, bool)>,
    pub(crate) layers: [bool; 3],
    /// Joint spring gains before any factor.
    pub(crate) springs: Gains,
    /// k_sg, the global gain (Shapiro et al. 2007, EQ3), and a factor for each joint on top \[1\].
    pub(crate) global_gain: f64,
    pub(crate) joint_gain: [f64; Node::COUNT],
    /// Number of reaches ordered so far.
    pub(crate) reaches: u64,
    /// Hands (left 0, right 1) with the props that they do not collide with.
    pub(crate) through: Vec<(usize, PropId)>,
    pub(crate) step_secs: f64,
}

impl Actor {
    /// A character that holds the key pose `pose` of the book by joint springs, starting from the pose `start`.
    pub(crate) fn new(
        id: CharacterId,
        body: &Body,
        book: Arc<PoseBook>,
        pose: &str,
        start: &Pose,
        springs: Gains,
        step_secs: f64,
    ) -> Actor {
        Actor {
            id,
            sources: Sources::new(body, book, pose, start, step_secs),
            tracker: Box::new(PdTracker::with(springs.clone())),
            has_first_tracker: false,
            wanted: Wanted::STANDING,
            reflexes: Vec::new(),
            layers: [true; 3],
            springs,
            global_gain: 1.0,
            joint_gain: [1.0; Node::COUNT],
            reaches: 0,
            through: Vec::new(),
            step_secs,
        }
    }

    /// Name of the key pose that it moves to; `None` when it follows no key poses.
    pub fn pose(&self) -> Option<&str> {
        self.sources.key_poses().map(KeyPoses::pose)
    }

    /// The running pose graph and its present state.
    pub fn graph_state(&self) -> Option<(&str, &str)> {
        self.sources.key_poses()?.graph_state()
    }

    /// The tracker.
    pub fn tracker(&self) -> &dyn Tracker {
        self.tracker.as_ref()
    }

    /// The tracker, if it is of this type.
    pub(crate) fn tracker_as<T: Tracker>(&mut self) -> Option<&mut T> {
        (self.tracker.as_mut() as &mut dyn Any).downcast_mut()
    }

    /// Whether a layer is on.
    pub fn has_layer(&self, layer: Layer) -> bool {
        self.layers[layer as usize]
    }

    /// The wanted pose of the last step; only the fields that the tracker asks for are set.
    pub fn wanted(&self) -> &Wanted {
        &self.wanted
    }

    /// The sources of its wanted pose.
    pub fn sources(&self) -> &Sources {
        &self.sources
    }

    /// The live performer's stream, if it has one.
    pub fn performance(&self) -> Option<&LiveSource> {
        self.sources.performer().map(Performer::source)
    }

    /// The body.
    pub fn body(&self) -> &Body {
        self.sources.body()
    }

    /// Joint spring gains before any factor.
    pub(crate) fn springs(&self) -> &Gains {
        &self.springs
    }

    /// Replaces the joint spring gains, in the present tracker too.
    pub(crate) fn set_springs(&mut self, springs: Gains) {
        if self.tracker.kind() == TrackerKind::Pd {
            self.tracker = Box::new(PdTracker::with(springs.clone()));
        }
        self.springs = springs;
    }

    /// Whether its Python controller runs: that of an understudy is paused while the performer acts.
    pub(crate) fn hears_scripts(&self) -> bool {
        let is_off = self.sources.performer().is_some_and(Performer::has_understudy_off);
        self.has_layer(Layer::Scripts) && !is_off
    }

    /// Factor on the stiffness of a part's joint, or, for `None`, of all joints \[1\].
    pub fn gain(&self, node: Option<Node>) -> f64 {
        node.map_or(self.global_gain, |node| self.joint_gain[node.index()])
    }

    /// Whether a reflex is enabled.
    pub fn has_reflex(&self, name: &str) -> bool {
        self.reflexes.iter().any(|(reflex, on)| *on && reflex.name() == name)
    }

    pub(crate) fn set_gain(&mut self, node: Option<Node>, factor: f64) {
        match node {
            Some(node) => self.joint_gain[node.index()] = factor,
            None => self.global_gain = factor,
        }
    }

    pub(crate) fn set_layer(&mut self, layer: Layer, on: bool) {
        self.layers[layer as usize] = on;
        if layer == Layer::Reflexes && on {
            self.reset();
        }
    }

    pub(crate) fn set_reflex(&mut self, name: &str, on: bool) -> Result<(), OrderError> {
        match self.reflexes.iter_mut().find(|(reflex, _)| reflex.name() == name) {
            Some((reflex, is_on)) => {
                if on && !*is_on {
                    reflex.reset();
                }
                *is_on = on;
            }
            None => {
                let reflex = sinew_control::reflex::by_name(name, self.sources.body());
                let unknown = || {
                    let known = sinew_control::reflex::NAMES.join(", ");
                    OrderError::new(OrderErrorKind::NotFound, format!("no reflex `{name}`; there are {known}"))
                };
                self.reflexes.push((reflex.ok_or_else(unknown)?, on));
            }
        }
        if on {
            self.layers[Layer::Reflexes as usize] = true;
        }
        Ok(())
    }

    /// Clears the memory of the reflexes, after the body was moved.
    pub(crate) fn reset(&mut self) {
        for (reflex, _) in &mut self.reflexes {
            reflex.reset();
        }
    }

    /// Changes the tracker from the next step on, starting from the body's present pose.
    pub(crate) fn set_tracker(&mut self, tracker: Box<dyn Tracker>, floor_m: f64, world: &mut World) {
        let Some(character) = world.frame().character(self.id) else { return };
        self.sources.begin_root(character, tracker.locks_feet().then_some(floor_m));
        if tracker.wants() == Wants::Joints {
            self.sources.match_body(character);
        }
        self.has_first_tracker = false;
        std::mem::replace(&mut self.tracker, tracker).release(world, self.id);
        let is_motion = self.sources.own().motion().is_some();
        let motion = |secs: f64| self.sources.own_pose_at(secs);
        let start = TrackerStart { motion: is_motion.then_some(&motion) };
        self.tracker.start(&start, world, self.id);
    }

    /// Advances all sources by one step.
    pub(crate) fn advance(&mut self, world: &World, events: &mut Vec<SourceEvent>) {
        let has_poses_layer = self.has_layer(Layer::Poses);
        self.sources.advance(world.frame(), self.id, has_poses_layer, events);
    }

    /// Computes what the tracker asks for of the wanted pose and lets it follow; `frame_secs` is the length of a motion frame \[s\].
    pub(crate) fn follow(&mut self, world: &mut World, frame_secs: f64) {
        let wants = self.tracker.wants();
        let frame = world.frame();
        let has_reflexes = self.tracker.honours().torques
            && self.has_layer(Layer::Reflexes)
            && self.reflexes.iter().any(|(_, on)| *on);
        // Reflexes add to joint targets, which must be those of this step.
        if wants >= Wants::Joints || has_reflexes && wants == Wants::Firmness {
            let ahead_secs = if wants == Wants::Pose { frame_secs } else { self.step_secs };
            self.sources.wanted(frame.time_secs + ahead_secs, &mut self.wanted);
        }
        if wants >= Wants::Firmness {
            self.sources.firmness(&mut self.wanted);
            for joint in &mut self.wanted.joints {
                joint.torque = glam::DVec3::ZERO;
                if !self.layers[Layer::Poses as usize] {
                    joint.gain = 0.0;
                }
            }
            if has_reflexes {
                let gravity_m_s2 = world.settings().gravity_m_s2;
                let sense = Sense {
                    frame,
                    own: self.id,
                    body: self.sources.body(),
                    gains: &self.springs,
                    step_secs: self.step_secs,
                    gravity_m_s2,
                };
                for (reflex, _) in self.reflexes.iter_mut().filter(|(_, on)| *on) {
                    reflex.step(&sense, &mut self.wanted);
                }
                if self.wanted.root == Root::Placed {
                    let hips = (self.wanted.pose.hips_position, self.wanted.pose.world[0]);
                    self.wanted.pose = self.wanted.pose_with_hips(hips.0, hips.1);
                }
            }
            for (joint, own) in self.wanted.joints.iter_mut().zip(self.joint_gain) {
                joint.gain *= self.global_gain * own;
            }
        }
        if wants == Wants::Pose
            && let Some(character) = frame.character(self.id)
        {
            self.sources.place_root(character, &mut self.wanted);
        }
        self.tracker.follow(&self.wanted, world, self.id);
    }
}
