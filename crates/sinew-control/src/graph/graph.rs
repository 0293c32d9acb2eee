//! A pose graph, its names resolved.

use super::names::{Names, Thing};
use super::sensor::Sensor;
use super::spec::{GraphSpec, Quantity, SensorSpec, StateSpec, TransitionSpec};
use super::steering::{Feedback, Steering, WorldHips};
use super::{GraphError, Touchable};
use crate::pose::{KeyPose, PartName, list, number};
use sinew_body::humanoid::Node;
use sinew_world::Entity;
use std::collections::BTreeMap;

/// Maximum number of states of a graph.
pub const MAX_STATES: usize = 500;
/// Maximum number of transitions out of a state, and of feedback rules and upright parts in it.
const MAX_RULES: usize = 50;

/// A graph that can be played, by any number of players.
#[derive(Clone, Debug, PartialEq)]
pub struct Graph {
    pub(super) start: usize,
    pub(super) states: Vec<State>,
}

/// One state.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct State {
    pub(super) name: String,
    pub(super) pose_name: String,
    pub(super) pose: KeyPose,
    pub(super) steering: Steering,
    pub(super) edges: Vec<Edge>,
}

/// A transition.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Edge {
    pub(super) to: usize,
    pub(super) after_secs: Option<f64>,
    pub(super) touching: Option<(Thing, Thing)>,
    pub(super) sensor: Option<Sensor>,
    pub(super) signal: Option<String>,
    /// Its conditions in words, for the report.
    pub(super) words: String,
}

impl Graph {
    /// Resolves a graph against the known poses and names.
    ///
    /// # Errors
    /// The first error in it, see [`GraphError`].
    pub fn new(spec: &GraphSpec, poses: &BTreeMap<String, KeyPose>, names: &dyn Names) -> Result<Graph, GraphError> {
        at_most(MAX_STATES, spec.states.len(), "graph", "states")?;
        let order: Vec<&str> = spec.states.keys().map(String::as_str).collect();
        let state_index = |name: &str, place: &str| {
            order.iter().position(|state| *state == name).ok_or_else(|| GraphError::UnknownState {
                place: place.to_owned(),
                name: short(name),
                known: list(&order),
            })
        };
        let start = state_index(&spec.start, "start")?;
        let mut states = Vec::with_capacity(order.len());
        for (name, state) in &spec.states {
            let place = format!("state {:?}", short(name));
            let pose = poses.get(&state.pose).ok_or_else(|| GraphError::UnknownPose {
                state: short(name),
                name: short(&state.pose),
                known: list(&poses.keys().map(String::as_str).collect::<Vec<_>>()),
            })?;
            at_most(MAX_RULES, state.to.len(), &place, "ways out")?;
            let mut edges = Vec::with_capacity(state.to.len());
            for (index, edge) in state.to.iter().enumerate() {
                let place = format!("{place}, to[{index}]");
                edges.push(resolve_edge(edge, state_index(&edge.state, &place)?, &place, names)?);
            }
            states.push(State {
                name: name.clone(),
                pose_name: state.pose.clone(),
                pose: pose.clone(),
                steering: resolve_steering(state, &place)?,
                edges,
            });
        }
        Ok(Graph { start, states })
    }

    /// The states' names, in alphabetical order.
    pub fn state_names(&self) -> impl Iterator<Item = &str> {
        self.states.iter().map(|state| state.name.as_str())
    }

    /// A state's index in that order.
    pub(super) fn state(&self, name: &str) -> Option<usize> {
        self.states.iter().position(|state| state.name == name)
    }
}

fn resolve_edge(edge: &TransitionSpec, to: usize, place: &str, names: &dyn Names) -> Result<Edge, GraphError> {
    let wrong = |problem: String| GraphError::Condition { place: place.to_owned(), problem };
    if edge.after_secs.is_none() && edge.touching.is_none() && edge.sensor.is_none() && edge.signal.is_none() {
        return Err(wrong("no condition; give after_secs, touching, sensor or signal".to_owned()));
    }
    if let Some(after_secs) = edge.after_secs {
        number::checked(after_secs, &number::SECS, "after_secs").map_err(wrong)?;
    }
    let thing = |name: &str| {
        Thing::find(name, names).ok_or_else(|| GraphError::UnknownName {
            place: place.to_owned(),
            name: short(name),
            known: list(&names.known()),
        })
    };
    let touching = match &edge.touching {
        Some([one, other]) => Some((thing(one)?, thing(other)?)),
        None => None,
    };
    let sensor = match &edge.sensor {
        Some(sensor) => Some(resolve_sensor(sensor, place, thing)?),
        None => None,
    };
    let words = words_of(edge);
    Ok(Edge { to, after_secs: edge.after_secs, touching, sensor, signal: edge.signal.clone(), words })
}

/// "after 0.1 s, rightFoot touches ground".
fn words_of(edge: &TransitionSpec) -> String {
    let mut words = Vec::new();
    if let Some(secs) = edge.after_secs {
        words.push(format!("after {secs} s"));
    }
    if let Some([one, other]) = &edge.touching {
        words.push(format!("{} touches {}", short(one), short(other)));
    }
    if let Some(sensor) = &edge.sensor {
        let mut said = format!("{} of {}", sensor.is.name(), short(&sensor.of));
        if let Some(to) = &sensor.to {
            said += &format!(" to {}", short(to));
        }
        if let Some(below) = sensor.below {
            said += &format!(" below {below}");
        }
        if let Some(above) = sensor.above {
            said += &format!(" above {above}");
        }
        words.push(said);
    }
    if let Some(signal) = &edge.signal {
        words.push(format!("signal {}", short(signal)));
    }
    words.join(", ")
}

fn resolve_sensor(
    spec: &SensorSpec,
    place: &str,
    thing: impl Fn(&str) -> Result<Thing, GraphError>,
) -> Result<Sensor, GraphError> {
    let wrong = |problem: String| GraphError::Condition { place: place.to_owned(), problem };
    if spec.below.is_none() && spec.above.is_none() {
        return Err(wrong("a sensor without a threshold; give below or above".to_owned()));
    }
    for threshold in [spec.below, spec.above].into_iter().flatten() {
        number::checked(threshold, &number::ANY, "the threshold").map_err(wrong)?;
    }
    if spec.to.is_some() != (spec.is == Quantity::DistanceM) {
        return Err(wrong("distance_m, and nothing else, is measured to something: give `to` there".to_owned()));
    }
    let of = thing(&spec.of)?;
    let to = spec.to.as_deref().map(thing).transpose()?;
    let ground = Thing::Other(Touchable::One(Entity::Floor));
    if spec.is == Quantity::ComMarginM && of != Thing::Whole {
        return Err(wrong("com_margin_m is measured of the own centre; leave `of` out".to_owned()));
    }
    if (of == ground && spec.is != Quantity::LoadN) || to == Some(ground) {
        return Err(wrong("the ground has no centre and does not move; name a part or an object".to_owned()));
    }
    Ok(Sensor { of, to, is: spec.is, below: spec.below, above: spec.above })
}

fn resolve_steering(state: &StateSpec, place: &str) -> Result<Steering, GraphError> {
    let wrong = |problem: String| GraphError::Condition { place: place.to_owned(), problem };
    at_most(MAX_RULES, state.feedback.len(), place, "rules of feedback")?;
    at_most(MAX_RULES, state.upright.len(), place, "upright parts")?;
    let not_hips = |part: PartName| match part.0 {
        Node::Hips => Err(wrong("the hips hang from nothing; use world_hips to hold them".to_owned())),
        node => Ok(node),
    };
    let mut feedback = Vec::with_capacity(state.feedback.len());
    for rule in &state.feedback {
        for gain in [rule.rad_per_m, rule.rad_per_m_s] {
            number::checked(gain, &number::ANY, "a feedback gain").map_err(wrong)?;
        }
        feedback.push(Feedback {
            joint: not_hips(rule.joint)?,
            axis: rule.axis,
            from: rule.from.0,
            rad_per_m: rule.rad_per_m,
            rad_per_m_s: rule.rad_per_m_s,
        });
    }
    let upright = state.upright.iter().map(|part| not_hips(*part)).collect::<Result<_, _>>()?;
    let lean_deg = number::checked(state.hips_lean_deg, &number::LEAN_DEG, "hips_lean_deg").map_err(wrong)?;
    let heading_deg = match state.heading_deg {
        Some(degrees) => Some(number::checked(degrees, &number::HEADING_DEG, "heading_deg").map_err(wrong)?),
        None => None,
    };
    let world_hips = match (state.world_hips, state.stance) {
        (true, Some(stance)) => {
            Some(WorldHips { stance, lean: lean_deg.to_radians(), heading: heading_deg.map(f64::to_radians) })
        }
        (true, None) => {
            return Err(wrong("world_hips needs to know the leg that carries; give stance".to_owned()));
        }
        (false, _) if lean_deg != 0.0 => {
            return Err(wrong("hips_lean_deg does nothing without world_hips = true".to_owned()));
        }
        (false, _) if heading_deg.is_some() => {
            return Err(wrong("heading_deg does nothing without world_hips = true".to_owned()));
        }
        (false, _) => None,
    };
    Ok(Steering { feedback, upright, world_hips })
}

fn at_most(most: usize, count: usize, place: &str, what: &'static str) -> Result<(), GraphError> {
    if count > most {
        return Err(GraphError::TooMany { place: place.to_owned(), what, count, most });
    }
    Ok(())
}

/// A name, shortened for a message.
fn short(name: &str) -> String {
    name.chars().take(60).collect()
}
