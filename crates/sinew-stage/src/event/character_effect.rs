//! What happened to a character.

use super::cut;
use super::effect::over;
use crate::order::ShapeChoice;
use glam::DVec3;
use sinew_body::humanoid::Node;
use sinew_control::Layer;
use sinew_control::perform::Presence;
use sinew_control::tracker::{KdGains, TrackerKind};
use sinew_reach::Reason;
use std::fmt;

/// What happened to a character. Names are those of the scene.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum CharacterEffect {
    /// Its target is a key pose.
    Pose {
        /// The pose.
        pose: String,
    },
    /// It starts a pose graph.
    Graph {
        /// The graph.
        graph: String,
    },
    /// Its graph went from one state to another.
    Transition {
        /// The graph.
        graph: String,
        /// The state that was left.
        from: String,
        /// The state that begins.
        to: String,
    },
    /// Its graph gets a signal.
    Signal {
        /// The word.
        signal: String,
    },
    /// A limb reaches for a point by inverse kinematics.
    LimbReaches {
        /// The limb's end.
        node: Node,
        /// The point, world \[m\].
        target: DVec3,
    },
    /// It starts a reach with the whole body.
    Reaches {
        /// The target.
        target: ReachTarget,
        /// Duration \[s\].
        in_secs: f64,
        /// Steps that are taken.
        steps: usize,
        /// Why it does not arrive; `None` if it does.
        fails: Option<Reason>,
        /// Whether it takes longer than it was told to, because no body is that fast.
        late: bool,
    },
    /// The reach ends.
    ReachEnds,
    /// The time of a reach is over, with this distance of a hand from its target.
    HandArrives {
        /// The hand.
        node: Node,
        /// The distance \[m\].
        gap_m: f64,
    },
    /// Something is attached to a part.
    Holds {
        /// The part.
        node: Node,
        /// What it holds: a prop, or `character.part`.
        object: String,
    },
    /// Something is detached from a part.
    LetsGo {
        /// The part.
        node: Node,
        /// What it held.
        objects: Vec<String>,
    },
    /// An attachment broke.
    LosesHold {
        /// The part.
        node: Node,
        /// What it held.
        object: String,
    },
    /// A part is pushed.
    Pushed {
        /// The part.
        node: Node,
        /// The size of the force \[N\].
        force_n: f64,
        /// For how long \[s\].
        for_secs: f64,
    },
    /// Joint gains have another factor.
    Gain {
        /// The part whose joint; `None` for all.
        node: Option<Node>,
        /// The factor on the stiffness.
        factor: f64,
    },
    /// Physics is switched on or off on parts.
    Forces {
        /// The parts.
        nodes: Vec<Node>,
        /// On or off.
        on: bool,
    },
    /// It is constrained to a vertical plane.
    HeldToPlane,
    /// It is free in three dimensions.
    FreeFromPlane,
    /// Gravity has another factor.
    Gravity {
        /// The part; `None` for all.
        node: Option<Node>,
        /// The factor.
        scale: f64,
        /// How long it takes to come to it \[s\]; `None` for at once.
        over_secs: Option<f64>,
    },
    /// A part was given a shape.
    Shape {
        /// The part.
        node: Node,
        /// Which.
        shape: ShapeChoice,
    },
    /// A part has its own shape again, for the time of another is over.
    OwnShape {
        /// The part.
        node: Node,
    },
    /// A shape was added to a part.
    ShapeAdded {
        /// The part.
        node: Node,
        /// The shape.
        shape: String,
    },
    /// An added shape was taken away.
    ShapeRemoved {
        /// The part.
        node: Node,
        /// The shape.
        shape: String,
    },
    /// A layer is switched.
    Layer {
        /// Which.
        layer: Layer,
        /// On or off.
        on: bool,
    },
    /// A reflex is switched.
    Reflex {
        /// Which.
        reflex: String,
        /// On or off.
        on: bool,
    },
    /// Another controller runs it, or none.
    Controller {
        /// The controller.
        controller: Option<String>,
    },
    /// Weights of parts changed (tracker `kd`).
    Weights {
        /// The parts.
        nodes: Vec<Node>,
        /// Weight of the pins; `None` if unchanged.
        pin: Option<f64>,
        /// Weight of the joints; `None` if unchanged.
        joint: Option<f64>,
    },
    /// The weights of a part are restored (tracker `kd`).
    WeightsRestored {
        /// The part.
        node: Node,
    },
    /// The tracker `kd` has other gains.
    KdGains(KdGains),
    /// The gains of the tracker `kd` are restored.
    KdGainsRestored,
    /// Kinematic forces are switched (tracker `kd`).
    Pins {
        /// On or off.
        on: bool,
    },
    /// It follows by another tracker.
    Tracker(TrackerKind),
    /// It follows another source of its own.
    Source {
        /// The kind.
        kind: &'static str,
    },
    /// It follows its performer, or no longer.
    Live {
        /// On or off.
        on: bool,
    },
    /// Its performer's stream changes.
    Performer {
        /// What the stream does now.
        presence: Presence,
        /// An understudy acted until now.
        replaces_understudy: bool,
    },
    /// Its state was not finite, and it is reset to its last valid state.
    PutBack,
    /// A line for the report.
    Says {
        /// The words.
        text: String,
    },
}

/// The target of a reach.
#[derive(Clone, Debug, PartialEq)]
pub enum ReachTarget {
    /// A prop.
    Object(String),
    /// A point in the world \[m\].
    Point(DVec3),
}

impl CharacterEffect {
    /// The sentence, with the character's name.
    pub(super) fn write(&self, who: &str, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        use CharacterEffect as E;
        let state = |on: bool| if on { "on" } else { "off" };
        match self {
            E::Pose { pose } => write!(f, "{who} takes the pose {pose}"),
            E::Graph { graph } => write!(f, "{who} starts the graph {graph}"),
            E::Transition { graph, from, to } => write!(f, "{who}: {graph}: from {from} to {to}"),
            E::Signal { signal } => write!(f, "{who} gets the signal {signal}"),
            E::LimbReaches { node, target } => write!(f, "{who}'s {} reaches for {target:.2}", node.part()),
            E::Reaches { target, in_secs, steps, fails, late } => {
                write!(f, "{who} reaches for ")?;
                match target {
                    ReachTarget::Object(name) => f.write_str(name)?,
                    ReachTarget::Point(point) => write!(f, "{point:.2}")?,
                }
                write!(f, " in {in_secs:.2} s")?;
                if *late {
                    f.write_str(", the least time that a body can")?;
                }
                match steps {
                    0 => {}
                    1 => f.write_str(", with a step")?,
                    many => write!(f, ", with {many} steps")?,
                }
                fails.map_or(Ok(()), |reason| write!(f, "; {}", reason.text()))
            }
            E::ReachEnds => write!(f, "{who} reaches no longer"),
            E::HandArrives { node, gap_m } => {
                write!(f, "{who}'s {} is {:.0} mm from its target", node.part(), gap_m * 1e3)
            }
            E::Holds { node, object } => write!(f, "{who}'s {} holds {object}", node.part()),
            E::LetsGo { node, objects } => write!(f, "{who}'s {} lets go of {}", node.part(), objects.join(", ")),
            E::LosesHold { node, object } => write!(f, "{who}.{} loses its hold of {object}", node.part()),
            E::Pushed { node, force_n, for_secs } => {
                write!(f, "{who}'s {} is pushed with {force_n:.0} N for {for_secs:.2} s", node.part())
            }
            E::Gain { node, factor } => {
                write!(f, "{who}: gain of {} is {factor}", node.map_or("all joints", |node| node.part().name()))
            }
            E::Forces { nodes, on } => write!(f, "{who}: forces on {} are {}", listed(nodes), state(*on)),
            E::HeldToPlane => write!(f, "{who} is held to a plane"),
            E::FreeFromPlane => write!(f, "{who} is free in three dimensions"),
            E::Gravity { node, scale, over_secs } => {
                write!(f, "{who}: gravity")?;
                node.map_or(Ok(()), |node| write!(f, " on {}", node.part()))?;
                write!(f, " times {scale}")?;
                over(*over_secs, f)
            }
            E::Shape { node, shape } => write!(f, "{who}'s {} has the shape {shape}", node.part()),
            E::OwnShape { node } => write!(f, "{who}'s {} has its own shape", node.part()),
            E::ShapeAdded { node, shape } => write!(f, "{who}'s {} has the shape {shape} as well", node.part()),
            E::ShapeRemoved { node, shape } => write!(f, "{who}'s {} has the shape {shape} no longer", node.part()),
            E::Layer { layer, on } => {
                write!(f, "{who}: layer {} {}", format!("{layer:?}").to_lowercase(), state(*on))
            }
            E::Reflex { reflex, on } => write!(f, "{who}: reflex {reflex} {}", state(*on)),
            E::Controller { controller } => {
                write!(f, "{who} is run by {}", controller.as_deref().unwrap_or("no controller"))
            }
            E::Weights { nodes, pin, joint } => {
                let word = |weight: &Option<f64>| weight.map_or("as it was".to_owned(), |weight| weight.to_string());
                write!(f, "{who}: pin {} and joint {} on {}", word(pin), word(joint), listed(nodes))
            }
            E::WeightsRestored { node } => write!(f, "{who}: {} is held as before", node.part()),
            E::KdGains(KdGains { k_p, d_p, k_q, d_q }) => {
                write!(f, "{who}: k_p {k_p}, d_p {d_p}, k_q {k_q}, d_q {d_q}")
            }
            E::KdGainsRestored => write!(f, "{who}: gains are as before"),
            E::Pins { on } => write!(f, "{who}: kinematic forces are {}", state(*on)),
            E::Tracker(kind) => write!(f, "{who} follows by {}", kind.name()),
            E::Source { kind } => write!(f, "{who} follows a {kind}"),
            E::Live { on: true } => write!(f, "{who} follows its performer"),
            E::Live { on: false } => write!(f, "{who} follows its performer no longer"),
            E::Performer { presence, replaces_understudy } => {
                let does = match presence {
                    Presence::Performing if *replaces_understudy => "is performed in place of its understudy",
                    Presence::Performing => "is performed",
                    Presence::Waiting => "waits for a performer",
                    Presence::Holding => "hears no performer and holds",
                    Presence::Relaxed => "hears no performer and relaxes",
                };
                write!(f, "{who} {does}")
            }
            E::PutBack => write!(f, "{who} is put back to where it was last sound"),
            E::Says { text } => write!(f, "{who}: {text}"),
        }
    }

    /// In the words for something whose time is over.
    pub(super) fn at_its_end(self) -> CharacterEffect {
        match self {
            CharacterEffect::Shape { node, shape: ShapeChoice::Own } => CharacterEffect::OwnShape { node },
            CharacterEffect::Weights { ref nodes, .. } => match nodes[..] {
                [node] => CharacterEffect::WeightsRestored { node },
                _ => self,
            },
            CharacterEffect::KdGains(_) => CharacterEffect::KdGainsRestored,
            other => other,
        }
    }

    /// Truncates untrusted texts.
    pub(super) fn shorten(&mut self) {
        if let CharacterEffect::Says { text } | CharacterEffect::Signal { signal: text } = self {
            cut(text);
        }
    }
}

/// Parts by their names.
fn listed(nodes: &[Node]) -> String {
    if nodes.len() == Node::COUNT {
        return "all parts".to_owned();
    }
    nodes.iter().map(|node| node.part().name()).collect::<Vec<_>>().join(", ")
}
