//! Key poses, and pose graphs that choose among them.

use super::{Moment, Source, SourceEvent};
use crate::graph::{Graph, GraphPlayer};
use crate::ik::Reach;
use crate::pose::{KeyPose, PosePlayer};
use crate::{OrderError, OrderErrorKind};
use crate::{Root, Wanted};
use glam::DVec3;
use sinew_body::humanoid::{Limb, Node};
use sinew_snapshot::{Reader, Snapshot, SnapshotError, Writer};
use sinew_world::CharacterFrame;
use std::collections::BTreeMap;
use std::sync::Arc;

/// The key poses and pose graphs of one character, resolved on its body.
#[derive(Clone, Debug, Default)]
pub struct PoseBook {
    /// By name.
    pub poses: BTreeMap<String, KeyPose>,
    /// By name.
    pub graphs: BTreeMap<String, Graph>,
}

/// A source that blends to one key pose, or plays a pose graph.
///
/// ```
/// use sinew_body::humanoid::Body;
/// use sinew_control::pose::{KeyPose, STAND};
/// use sinew_control::source::{KeyPoses, PoseBook};
/// let book = PoseBook { poses: [(STAND.to_owned(), KeyPose::STAND)].into(), ..PoseBook::default() };
/// let mut source = KeyPoses::new(book.into(), STAND, 1.0 / 240.0);
/// assert_eq!(source.aim("crouch").unwrap_err().to_string(), "no pose `crouch`; there are stand");
/// ```
#[derive(Clone, Debug)]
pub struct KeyPoses {
    book: Arc<PoseBook>,
    player: PosePlayer,
    pose: String,
    graph: Option<(String, GraphPlayer)>,
    signals: Vec<String>,
    /// The wanted pose at the end of the step.
    now: Wanted,
    step_secs: f64,
}

/// The book, which does not change, says which states a graph has.
impl Snapshot for KeyPoses {
    fn save(&self, to: &mut Writer) {
        let KeyPoses { book: _, player, pose, graph, signals, now, step_secs: _ } = self;
        player.save(to);
        pose.save(to);
        graph.is_some().save(to);
        if let Some((name, player)) = graph {
            name.save(to);
            player.save(to);
        }
        signals.save(to);
        now.save(to);
    }

    fn restore(&mut self, from: &mut Reader<'_>) -> Result<(), SnapshotError> {
        self.player.restore(from)?;
        self.pose.restore(from)?;
        let mut has_graph = false;
        has_graph.restore(from)?;
        self.graph = None;
        if has_graph {
            let mut name = String::new();
            name.restore(from)?;
            let graph = self.book.graphs.get(&name).ok_or(SnapshotError::invalid("pose graph"))?;
            let mut player = GraphPlayer::new(graph, self.step_secs);
            player.restore(from)?;
            if !player.is_of(graph) {
                return Err(SnapshotError::invalid("state of a pose graph"));
            }
            self.graph = Some((name, player));
        }
        self.signals.restore(from)?;
        self.signals.truncate(MAX_SIGNALS);
        self.now.restore(from)
    }
}

/// Maximum number of signals that wait for a step.
const MAX_SIGNALS: usize = 100;

impl KeyPoses {
    /// In a pose of the book, or standing when it has none of that name; for steps of this length \[s\].
    pub fn new(book: Arc<PoseBook>, pose: &str, step_secs: f64) -> KeyPoses {
        let first = book.poses.get(pose).unwrap_or(&KeyPose::STAND);
        let mut now = Wanted::STANDING;
        for (joint, rotation) in now.joints.iter_mut().zip(first.rotations) {
            joint.rotation = rotation;
        }
        let player = PosePlayer::new(first);
        KeyPoses { book, player, pose: pose.to_owned(), graph: None, signals: Vec::new(), now, step_secs }
    }

    /// The name of the target pose.
    pub fn pose(&self) -> &str {
        &self.pose
    }

    /// The graph that is played, and the state that it is in.
    pub fn graph_state(&self) -> Option<(&str, &str)> {
        let (name, player) = self.graph.as_ref()?;
        Some((name, player.state_name(self.book.graphs.get(name)?)))
    }

    /// Whether this pose is its only target: no graph, no IK.
    pub fn is_at(&self, name: &str) -> bool {
        let reaches = Limb::ALL.into_iter().any(|limb| self.player.ik.of(limb).is_some());
        self.pose == name && self.graph.is_none() && !reaches
    }

    /// Sets a key pose as target; stops a graph and IK.
    ///
    /// # Errors
    /// The pose does not exist; lists the known ones.
    pub fn aim(&mut self, name: &str) -> Result<(), OrderError> {
        let pose = self.book.poses.get(name).ok_or_else(|| unknown("pose", name, self.book.poses.keys()))?;
        self.player.aim(pose);
        self.player.ik.release_all();
        self.pose = name.to_owned();
        self.graph = None;
        Ok(())
    }

    /// Starts a graph, at its first state or another.
    ///
    /// # Errors
    /// The graph or state does not exist; lists the known ones.
    pub fn start_graph(&mut self, name: &str, state: Option<&str>) -> Result<(), OrderError> {
        let graph = self.book.graphs.get(name).ok_or_else(|| unknown("graph", name, self.book.graphs.keys()))?;
        let mut player = GraphPlayer::new(graph, self.step_secs);
        if let Some(state) = state
            && !player.jump(graph, state)
        {
            let states: Vec<&str> = graph.state_names().collect();
            let problem = format!("no state `{state}`; there are {}", states.join(", "));
            return Err(OrderError::new(OrderErrorKind::NotFound, problem));
        }
        self.player.aim(player.pose(graph));
        self.pose = player.pose_name(graph).to_owned();
        self.graph = Some((name.to_owned(), player));
        Ok(())
    }

    /// Stops the graph in its state, and returns limbs to the pose.
    pub fn rest(&mut self) {
        self.graph = None;
        self.player.ik.release_all();
    }

    /// Sets the IK target of a limb. False if it is unchanged. `effector` is a point in the frame of the hand or foot.
    ///
    /// # Errors
    /// The part does not belong to a limb.
    pub fn reach(&mut self, node: Node, target: DVec3, effector: DVec3) -> Result<bool, OrderError> {
        let limb = Limb::of(node).ok_or_else(|| {
            let problem = format!("{} is no part of an arm or a leg", node.part());
            OrderError::new(OrderErrorKind::WrongTarget, problem)
        })?;
        let is_new = self.player.ik.of(limb).is_none_or(|before| before.target != target);
        self.player.ik.reach(limb, Reach { target, effector });
        Ok(is_new)
    }

    /// Returns the limb of a part, or all limbs, to the pose.
    pub fn stop_reaching(&mut self, node: Option<Node>) {
        match node.and_then(Limb::of) {
            Some(limb) => self.player.ik.release(limb),
            None => self.player.ik.release_all(),
        }
    }

    /// Aims at a pose, if that is another one than it aims at.
    fn aim_anew(&mut self, pose: &KeyPose) {
        if self.player.aimed_at() != pose {
            self.player.aim(pose);
        }
    }

    fn step_graph(&mut self, moment: &Moment) -> Option<SourceEvent> {
        let (name, player) = self.graph.as_mut()?;
        let graph = self.book.graphs.get(name)?;
        let transition = player.step(graph, moment.frame, moment.own, &self.signals)?;
        self.player.aim(player.pose(graph));
        player.pose_name(graph).clone_into(&mut self.pose);
        let (from, to) = transition.names(graph);
        let (graph, from, to) = (name.clone(), from.to_owned(), to.to_owned());
        Some(SourceEvent::Graph { cause: transition.cause, graph, from, to })
    }
}

impl Source for KeyPoses {
    fn cloned(&self) -> Box<dyn Source> {
        Box::new(self.clone())
    }

    fn advance(&mut self, moment: &Moment, events: &mut Vec<SourceEvent>) {
        if moment.has_poses_layer {
            events.extend(self.step_graph(moment));
        }
        self.signals.clear();
        let Moment { frame, own, body, step_secs, .. } = *moment;
        self.player.write(frame, own, body, step_secs, &mut self.now);
        if let Some((name, player)) = &self.graph
            && let Some(graph) = self.book.graphs.get(name)
        {
            player.steering(graph).apply(frame, own, &mut self.now);
        }
    }

    /// A graph goes on in its state, or from its start when it has that state no more; a pose that changed is blended to. What is gone
    /// keeps the body where it was aimed at.
    fn set_book(&mut self, book: &Arc<PoseBook>) {
        let state = self.graph_state().map(|(_, state)| state.to_owned());
        self.book = Arc::clone(book);
        if let Some((name, mut player)) = self.graph.take()
            && let Some(graph) = book.graphs.get(&name)
        {
            if !state.is_some_and(|state| player.carry_over(graph, &state)) {
                player = GraphPlayer::new(graph, self.step_secs);
            }
            player.pose_name(graph).clone_into(&mut self.pose);
            self.aim_anew(player.pose(graph));
            self.graph = Some((name, player));
        } else if let Some(pose) = book.poses.get(&self.pose) {
            self.aim_anew(pose);
        }
    }

    /// It is forgotten after the next step.
    fn signal(&mut self, word: &str) {
        if self.signals.len() < MAX_SIGNALS {
            self.signals.push(word.to_owned());
        }
    }

    fn root(&self) -> Root {
        Root::Free
    }

    fn wanted(&self, _: f64, wanted: &mut Wanted) {
        wanted.root = Root::Free;
        for (joint, now) in wanted.joints.iter_mut().zip(&self.now.joints) {
            (joint.rotation, joint.velocity) = (now.rotation, now.velocity);
        }
    }

    fn firmness(&self, wanted: &mut Wanted) {
        for (joint, now) in wanted.joints.iter_mut().zip(&self.now.joints) {
            (joint.gain, joint.damping) = (now.gain, now.damping);
        }
    }

    fn match_body(&mut self, character: &CharacterFrame) {
        self.player.match_body(character);
    }
}

fn unknown<'a>(what: &str, name: &str, known: impl Iterator<Item = &'a String>) -> OrderError {
    let known: Vec<&str> = known.map(String::as_str).collect();
    OrderError::new(OrderErrorKind::NotFound, format!("no {what} `{name}`; there are {}", known.join(", ")))
}
