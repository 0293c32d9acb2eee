//! The player of a graph.

use super::names::contact_between;
use super::{Graph, Steering};
use crate::pose::KeyPose;
use sinew_snapshot::snapshot;
use sinew_world::{CharacterId, Contact, Entity, Frame};
use std::fmt;

/// The state of one character in a graph. The graph is passed to each call, so that many players can share it.
#[derive(Clone, Debug, PartialEq)]
pub struct GraphPlayer {
    state: usize,
    /// Number of steps in the present state.
    steps: u64,
    step_secs: f64,
}

snapshot!(GraphPlayer { state, steps } fixed { step_secs } valid |player| player.steps <= u64::MAX / 2);

/// A transition that was taken.
#[derive(Clone, Debug, PartialEq)]
pub struct Transition {
    /// Index of the previous state.
    pub from: usize,
    /// Index of the new state.
    pub to: usize,
    /// Index of the transition among those of `from`, in the order of the file.
    pub edge: usize,
    /// Time spent in the previous state \[s\].
    pub lasted_secs: f64,
    /// Its cause.
    pub cause: Cause,
}

/// The cause of a transition. With several conditions, the most specific one: a contact, else a sensor, a signal, the
/// timer.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Cause {
    /// Time was up.
    Timer,
    /// Two things touch.
    Touch(Contact),
    /// A measured value was beyond its threshold, in the quantity's unit.
    Sensor(f64),
    /// The word was sent.
    Signal,
}

impl GraphPlayer {
    /// A player at the graph's first state, for a world with this step length \[s\].
    pub fn new(graph: &Graph, step_secs: f64) -> GraphPlayer {
        GraphPlayer { state: graph.start, steps: 0, step_secs }
    }

    /// Whether it is in a state that this graph has.
    pub(crate) fn is_of(&self, graph: &Graph) -> bool {
        self.state < graph.states.len()
    }

    /// Enters a state by name; false if it does not exist.
    pub fn jump(&mut self, graph: &Graph, name: &str) -> bool {
        let found = graph.state(name);
        if let Some(state) = found {
            (self.state, self.steps) = (state, 0);
        }
        found.is_some()
    }

    /// Goes on in the state of this name of a graph that was read anew, as if it had been in it all along; false if it does not exist.
    pub fn carry_over(&mut self, graph: &Graph, name: &str) -> bool {
        let found = graph.state(name);
        self.state = found.unwrap_or(self.state);
        found.is_some()
    }

    /// The present state's name.
    pub fn state_name<'a>(&self, graph: &'a Graph) -> &'a str {
        &graph.states[self.state].name
    }

    /// The pose to aim at.
    pub fn pose<'a>(&self, graph: &'a Graph) -> &'a KeyPose {
        &graph.states[self.state].pose
    }

    /// Its name.
    pub fn pose_name<'a>(&self, graph: &'a Graph) -> &'a str {
        &graph.states[self.state].pose_name
    }

    /// The feedback rules of the state.
    pub fn steering<'a>(&self, graph: &'a Graph) -> &'a Steering {
        &graph.states[self.state].steering
    }

    /// Time that the state has lasted \[s\].
    pub fn lasted_secs(&self) -> f64 {
        self.steps as f64 * self.step_secs
    }

    /// Advances by a step, after the world's step: takes the first transition whose conditions hold. `signals` are
    /// those sent since the last step. At most one transition fires.
    pub fn step(
        &mut self,
        graph: &Graph,
        frame: &Frame,
        own: CharacterId,
        signals: &[impl AsRef<str>],
    ) -> Option<Transition> {
        self.steps += 1;
        for (index, edge) in graph.states.get(self.state)?.edges.iter().enumerate() {
            let mut cause = Cause::Timer;
            if let Some(after_secs) = edge.after_secs {
                // Whole steps: the one whose end comes nearest to the time.
                if (self.steps as f64) < libm::round(after_secs / self.step_secs) {
                    continue;
                }
            }
            if let Some(word) = &edge.signal {
                if !signals.iter().any(|signal| signal.as_ref() == word) {
                    continue;
                }
                cause = Cause::Signal;
            }
            if let Some(sensor) = &edge.sensor {
                match sensor.fires(frame, own, self.step_secs) {
                    Some(value) => cause = Cause::Sensor(value),
                    None => continue,
                }
            }
            if let Some((one, other)) = edge.touching {
                match contact_between(frame, one.seen_by(own), other.seen_by(own)) {
                    Some(contact) => cause = Cause::Touch(*contact),
                    None => continue,
                }
            }
            let transition =
                Transition { from: self.state, to: edge.to, edge: index, lasted_secs: self.lasted_secs(), cause };
            (self.state, self.steps) = (edge.to, 0);
            return Some(transition);
        }
        None
    }
}

impl Transition {
    /// The names of the two states.
    pub fn names<'a>(&self, graph: &'a Graph) -> (&'a str, &'a str) {
        (&graph.states[self.from].name, &graph.states[self.to].name)
    }

    /// A line for the report: `up to down after 0.300 s (rightFoot touches ground): rightFoot of character 0 touched the
    /// ground with 3.10 N s`.
    pub fn text(&self, graph: &Graph) -> String {
        let (from, to) = self.names(graph);
        let words = graph.states[self.from].edges.get(self.edge).map_or("", |edge| edge.words.as_str());
        format!("{from} to {to} after {:.3} s ({words}): {}", self.lasted_secs, self.cause)
    }
}

impl fmt::Display for Cause {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Cause::Timer => f.write_str("time was up"),
            Cause::Signal => f.write_str("the signal came"),
            Cause::Sensor(value) => write!(f, "the sensor read {value:.3}"),
            Cause::Touch(contact) => {
                let name = |f: &mut fmt::Formatter<'_>, entity| match entity {
                    Entity::Floor => f.write_str("the ground"),
                    Entity::Prop(index) => write!(f, "object {index}"),
                    Entity::Part(index, node) => write!(f, "{} of character {index}", node.part().name()),
                };
                name(f, contact.a)?;
                f.write_str(" touched ")?;
                name(f, contact.b)?;
                write!(f, " with {:.2} N s", contact.impulse.length())
            }
        }
    }
}
