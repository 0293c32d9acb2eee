//! One character on the stage: its layers, and how its body follows them.

use crate::event::CharacterEffect;
use crate::foot_lock::FootLock;
use crate::motion_source::MotionSource;
use crate::performance::Performance;
use crate::reaching::{self, Reaching};
use crate::scene::TrackerKind;
use crate::scripts::Running;
use glam::{DQuat, DVec3};
use sinew_body::humanoid::{Body, Limb, Node, Pose};
use sinew_control::graph::{Cause, Graph, GraphPlayer};
use sinew_control::ik::Reach;
use sinew_control::perform::{LiveSource, Presence};
use sinew_control::pose::{KeyPose, PosePlayer};
use sinew_control::reflex::{Reflex, Sense};
use sinew_control::tracker::{JointGain, KdTracker, KinematicTracker, PdTracker, ResponseTracker};
use sinew_control::{Layer, Target};
use sinew_world::{World, hips_over_soles_m};
use std::collections::BTreeMap;

/// A character's control: three layers (key poses and graphs, a script, reflexes) and a tracker.
pub struct Actor {
    index: usize,
    body: Body,
    poses: BTreeMap<String, KeyPose>,
    graphs: BTreeMap<String, Graph>,
    player: PosePlayer,
    /// The pose that is aimed at, by its name.
    pose: String,
    graph: Option<(String, GraphPlayer)>,
    signals: Vec<String>,
    reflexes: Vec<(Box<dyn Reflex>, bool)>,
    layers: [bool; 3],
    pub(crate) tracker: TrackerKind,
    pub(crate) pd: PdTracker,
    pub(crate) kinematic: Option<KinematicTracker>,
    pub(crate) kd: Option<KdTracker>,
    pub(crate) response: Option<ResponseTracker>,
    /// Where the hips stay when no source moves them: position and `world_from_hips`.
    pub(crate) stand: (DVec3, DQuat),
    /// Height of the floor that its soles keep to when no source moves its hips, for a tracker that holds the hips \[m\].
    pub(crate) sole_m: Option<f64>,
    /// What moves that place over the ground.
    pub(crate) foot_lock: FootLock,
    pub(crate) motion: Option<MotionSource>,
    pub(crate) reaching: Option<Reaching>,
    /// How often it was told to reach.
    pub(crate) reaches: u64,
    /// Hands, left 0 and right 1, and the props that they pass through.
    pub(crate) through: Vec<(usize, usize)>,
    pub(crate) performance: Option<Performance>,
    /// Whether a source moved its hips in the last step.
    pub(crate) moved_root: bool,
    pub(crate) script: Option<Running>,
    pub(crate) target: Target,
    step_secs: f64,
}

/// Signals that may wait for a step.
const MAX_SIGNALS: usize = 100;

impl Actor {
    pub(crate) fn new(
        index: usize,
        body: Body,
        poses: BTreeMap<String, KeyPose>,
        graphs: BTreeMap<String, Graph>,
        pose: &str,
        joints: &[JointGain; Node::COUNT],
        step_secs: f64,
    ) -> Actor {
        let first = poses.get(pose).cloned().unwrap_or(KeyPose::STAND);
        Actor {
            index,
            pd: PdTracker::new(&body, joints),
            body,
            player: PosePlayer::new(&first),
            pose: pose.to_owned(),
            poses,
            graphs,
            graph: None,
            signals: Vec::new(),
            reflexes: Vec::new(),
            layers: [true; 3],
            tracker: TrackerKind::Pd,
            kinematic: None,
            kd: None,
            response: None,
            stand: (DVec3::ZERO, DQuat::IDENTITY),
            sole_m: None,
            foot_lock: FootLock::default(),
            motion: None,
            reaching: None,
            reaches: 0,
            through: Vec::new(),
            performance: None,
            moved_root: false,
            script: None,
            target: Target::STANDING,
            step_secs,
        }
    }

    /// The name of the pose that it aims at.
    pub fn pose(&self) -> &str {
        &self.pose
    }

    /// The graph that it plays, and the state that it is in.
    pub fn graph_state(&self) -> Option<(&str, &str)> {
        let (name, player) = self.graph.as_ref()?;
        Some((name, player.state_name(self.graphs.get(name)?)))
    }

    /// How its body follows.
    pub fn tracker(&self) -> TrackerKind {
        self.tracker
    }

    /// Whether a layer is on.
    pub fn has_layer(&self, layer: Layer) -> bool {
        self.layers[layer as usize]
    }

    /// What it wants.
    pub fn target(&self) -> &Target {
        &self.target
    }

    /// Aims at a key pose; stops a graph, a clip and limbs that reach. False when it aims there already.
    pub(crate) fn aim(&mut self, name: &str) -> Result<bool, String> {
        let pose = self.poses.get(name).ok_or_else(|| unknown("pose", name, self.poses.keys()))?;
        let reaches = Limb::ALL.into_iter().any(|limb| self.player.ik.of(limb).is_some());
        let is_alone =
            self.graph.is_none() && self.motion.is_none() && self.followed().is_none() && self.reaching.is_none();
        if self.pose == name && is_alone && !reaches {
            return Ok(false);
        }
        self.player.aim(pose);
        self.player.ik.release_all();
        self.pose = name.to_owned();
        self.graph = None;
        self.leave_motion();
        Ok(true)
    }

    pub(crate) fn start_graph(&mut self, name: &str, state: Option<&str>) -> Result<(), String> {
        let graph = self.graphs.get(name).ok_or_else(|| unknown("graph", name, self.graphs.keys()))?;
        let mut player = GraphPlayer::new(graph, self.step_secs);
        if let Some(state) = state
            && !player.jump(graph, state)
        {
            return Err(format!(
                "no state `{state}`; there are {}",
                graph.state_names().collect::<Vec<_>>().join(", ")
            ));
        }
        self.player.aim(player.pose(graph));
        self.pose = player.pose_name(graph).to_owned();
        self.graph = Some((name.to_owned(), player));
        self.leave_motion();
        Ok(())
    }

    /// Neither a clip nor a performer is followed any more.
    fn leave_motion(&mut self) {
        self.motion = None;
        if let Some(reaching) = &mut self.reaching {
            reaching.leave();
        }
        if let Some(performance) = &mut self.performance {
            performance.leave();
        }
    }

    /// The performer, whether it is followed or not.
    pub(crate) fn performer(&mut self) -> Result<&mut LiveSource, String> {
        let performance = self.performance.as_mut().map(Performance::source_mut);
        performance.ok_or_else(|| "it has no performer; write source = { live = {} } in its table".to_owned())
    }

    /// The performer's stream, where the character has one.
    pub fn performance(&self) -> Option<&LiveSource> {
        self.performance.as_ref().map(Performance::source)
    }

    pub(crate) fn follow_performer(&mut self, on: bool) -> Result<(), String> {
        self.performer()?;
        if let Some(performance) = &mut self.performance {
            performance.follow(on);
        }
        if on {
            self.graph = None;
            self.motion = None;
            self.player.ik.release_all();
        }
        Ok(())
    }

    /// The performer that is followed now.
    fn followed(&self) -> Option<&LiveSource> {
        self.performance.as_ref().filter(|performance| performance.is_followed()).map(Performance::source)
    }

    /// The performer's stream goes on by a step. Returns what there is to tell.
    pub(crate) fn step_performance(&mut self, now_secs: f64) -> Option<CharacterEffect> {
        let is_understudied = self.performance.as_ref()?.has_understudy_on();
        if is_understudied {
            let acted = self.wanted_pose(now_secs);
            self.performance.as_mut()?.stand_by(&acted);
        }
        let performance = self.performance.as_mut()?;
        let change = performance.advance(now_secs, self.step_secs);
        if is_understudied && performance.source().presence() == Presence::Performing {
            self.follow_performer(true).ok()?;
        }
        change
    }

    /// Whether its controller is called: one that belongs to an understudy is silent while the performer acts.
    pub(crate) fn hears_scripts(&self) -> bool {
        let is_off = self.performance.as_ref().is_some_and(Performance::has_understudy_off);
        self.has_layer(Layer::Scripts) && !is_off
    }

    pub(crate) fn signal(&mut self, name: &str) {
        if self.signals.len() < MAX_SIGNALS {
            self.signals.push(name.to_owned());
        }
    }

    /// Makes a limb reach. False when it reaches there already.
    /// `effector` is the point that is to arrive, in the frame of the limb's end.
    pub(crate) fn reach(&mut self, node: Node, target: DVec3, effector: DVec3) -> Result<bool, String> {
        let limb = Limb::of(node).ok_or_else(|| format!("{} is no part of an arm or a leg", node.part()))?;
        let reach = Reach { target, effector };
        let is_new = self.player.ik.of(limb).is_none_or(|before| before.target != target);
        self.player.ik.reach(limb, reach);
        Ok(is_new)
    }

    pub(crate) fn stop_reaching(&mut self, node: Option<Node>) {
        match node.and_then(Limb::of) {
            Some(limb) => self.player.ik.release(limb),
            None => self.player.ik.release_all(),
        }
    }

    pub(crate) fn set_gain(&mut self, node: Option<Node>, factor: f64) {
        match node {
            Some(node) => self.pd.joint_gain[node.index()] = factor,
            None => self.pd.global_gain = factor,
        }
    }

    pub(crate) fn set_layer(&mut self, layer: Layer, on: bool) {
        self.layers[layer as usize] = on;
        if layer == Layer::Reflexes && on {
            self.reset();
        }
    }

    pub(crate) fn set_reflex(&mut self, name: &str, on: bool) -> Result<(), String> {
        match self.reflexes.iter_mut().find(|(reflex, _)| reflex.name() == name) {
            Some((reflex, is_on)) => {
                if on && !*is_on {
                    reflex.reset();
                }
                *is_on = on;
            }
            None => {
                let reflex = sinew_control::reflex::by_name(name, &self.body);
                let known = sinew_control::reflex::NAMES.join(", ");
                self.reflexes.push((reflex.ok_or_else(|| format!("no reflex `{name}`; there are {known}"))?, on));
            }
        }
        if on {
            self.layers[Layer::Reflexes as usize] = true;
        }
        Ok(())
    }

    /// Reflexes forget what they remember: the body was put back.
    pub(crate) fn reset(&mut self) {
        for (reflex, _) in &mut self.reflexes {
            reflex.reset();
        }
    }

    /// Takes the wanted pose from where the body is: another tracker has moved it until now.
    pub(crate) fn take_over(&mut self, world: &World) {
        if let Some(character) = world.frame().characters.get(self.index) {
            self.player.take_over(character);
        }
    }

    /// The body.
    pub fn body(&self) -> &Body {
        &self.body
    }

    /// Whether its source says where the hips are to be.
    pub(crate) fn moves_root(&self) -> bool {
        self.motion.is_some() || self.followed().is_some() || self.reaching.is_some()
    }

    /// The whole pose that is wanted at a time \[s\]: of the clip, or of the target with the hips where they stand.
    pub(crate) fn wanted_pose(&self, time_secs: f64) -> Pose {
        match &self.reaching {
            Some(reaching) => reaching.pose_at(time_secs, || self.pose_without_reach(time_secs)),
            None => self.pose_without_reach(time_secs),
        }
    }

    /// What is wanted apart from a reach.
    pub(crate) fn pose_without_reach(&self, time_secs: f64) -> Pose {
        if let Some(motion) = &self.motion {
            return motion.pose_at(time_secs);
        }
        if let Some(performer) = self.followed() {
            return performer.pose_at(time_secs);
        }
        let mut locals = self.target.joints.map(|joint| joint.rotation);
        locals[0] = self.stand.1;
        let mut pose = Pose::from_locals(self.stand.0, &locals);
        if let Some(sole_m) = self.sole_m {
            pose.hips_position.y = sole_m + hips_over_soles_m(&self.body, &pose);
        }
        pose
    }

    /// A body whose source knows no place goes where its standing foot has it go.
    pub(crate) fn step_foot_lock(&mut self) {
        if self.sole_m.is_none() || self.moves_root() {
            return;
        }
        let mut locals = self.target.joints.map(|joint| joint.rotation);
        locals[0] = self.stand.1;
        let pose = Pose::from_locals(self.stand.0, &locals);
        self.stand.0 += self.foot_lock.step(&self.body, &pose);
    }

    /// Decides what is wanted at the end of the next step. Returns what the graph did, if it did something: cause and effect.
    pub(crate) fn decide(&mut self, world: &World, gravity_m_s2: f64) -> Option<(Cause, CharacterEffect)> {
        let frame = world.frame();
        let step_secs = self.step_secs;
        let mut happened = None;
        if self.has_layer(Layer::Poses)
            && let Some((name, player)) = &mut self.graph
            && let Some(graph) = self.graphs.get(name)
            && let Some(transition) = player.step(graph, frame, self.index, &self.signals)
        {
            self.player.aim(player.pose(graph));
            player.pose_name(graph).clone_into(&mut self.pose);
            let (from, to) = transition.names(graph);
            let (graph, from, to) = (name.clone(), from.to_owned(), to.to_owned());
            happened = Some((transition.cause, CharacterEffect::Transition { graph, from, to }));
        }
        self.signals.clear();
        for joint in &mut self.target.joints {
            joint.torque = DVec3::ZERO;
        }
        self.player.write(frame, self.index, &self.body, step_secs, &mut self.target);
        if let Some((name, player)) = &self.graph
            && let Some(graph) = self.graphs.get(name)
        {
            player.steering(graph).apply(frame, self.index, &mut self.target);
        }
        if let Some(motion) = &self.motion {
            motion.write(frame.time_secs + step_secs, &mut self.target);
        }
        if let Some(performance) = self.performance.as_ref().filter(|performance| performance.is_followed()) {
            performance.source().write(&mut self.target);
        }
        if let Some(reaching) = &self.reaching {
            let now = frame.time_secs + step_secs;
            let poses = [now, now + step_secs].map(|secs| reaching.pose_at(secs, || self.pose_without_reach(secs)));
            reaching::write(&poses, step_secs, &mut self.target);
        }
        if !self.has_layer(Layer::Poses) {
            for joint in &mut self.target.joints {
                joint.gain = 0.0;
            }
        }
        if self.has_layer(Layer::Reflexes) {
            let sense =
                Sense { frame, own: self.index, body: &self.body, gains: self.pd.gains(), step_secs, gravity_m_s2 };
            for (reflex, _) in self.reflexes.iter_mut().filter(|(_, on)| *on) {
                reflex.step(&sense, &mut self.target);
            }
        }
        happened
    }
}

fn unknown<'a>(what: &str, name: &str, known: impl Iterator<Item = &'a String>) -> String {
    let known: Vec<&str> = known.map(String::as_str).collect();
    format!("no {what} `{name}`; there are {}", known.join(", "))
}
