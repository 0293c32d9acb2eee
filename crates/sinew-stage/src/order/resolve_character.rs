//! Commands for a character.

use super::resolve::{MAX_WORDS, Resolver, one_of, words};
use super::{CharacterOrder, KdChange, ShapeChoice};
use crate::scene::REFLEXES;
use glam::DVec3;
use sinew_body::humanoid::{Limb, Node};
use sinew_control::source::SourceSpec;
use sinew_control::tracker::TrackerKind;
use sinew_control::{Action, OrderError, OrderErrorKind as Kind, ReachOrder, range};
use sinew_world::{CharacterId, PropId};

/// Gains and switches of the tracker `kd` fade over this time when a command does not say \[s\].
pub(crate) const FADE_SECS: f64 = 0.5;

impl Resolver<'_> {
    pub(super) fn character_order(&self, id: CharacterId, action: &Action) -> Result<CharacterOrder, OrderError> {
        use CharacterOrder as O;
        let lasts = |secs: Option<f64>| range::SECS.check_some("for_secs", secs);
        Ok(match action {
            Action::Pose { name } => O::Pose { name: one_of("pose", name, self.scene.pose_names())? },
            Action::Graph { name, state } => {
                let name = one_of("graph", name, self.scene.graphs.keys().map(String::as_str))?;
                let graph = self.scene.graphs.get(&name);
                let states = || graph.into_iter().flat_map(|graph| graph.states.keys().map(String::as_str));
                let state = state.as_deref().map(|state| one_of("state", state, states())).transpose()?;
                O::Graph { name, state }
            }
            Action::Signal { name } => O::Signal { name: words(name, MAX_WORDS)? },
            Action::Ik { link, target_m } => {
                let node = self.some_node(id, link.as_deref())?;
                if let Some(node) = node.filter(|node| Limb::of(*node).is_none()) {
                    let problem = format!("{} is no part of an arm or a leg; name a hand or a foot", node.part());
                    return Err(OrderError::new(Kind::WrongTarget, problem));
                }
                O::LimbReach { node, target: range::PLACE_M.check_three("target_m", *target_m)?.into() }
            }
            Action::IkRelease { link } => O::LimbRelease { node: self.some_node(id, link.as_deref())? },
            Action::Attach { link, object, soft, break_n } => O::Attach {
                node: self.node(id, link)?,
                object: self.holdable(id, object)?,
                soft: *soft,
                break_force_n: range::BREAK_FORCE_N.check_some("break_n", *break_n)?,
            },
            Action::Detach { link, object } => {
                O::Detach { node: self.node(id, link)?, object: self.holdable(id, object)? }
            }
            Action::Push { on, force_n, for_secs, facing, at_m } => O::Push {
                node: self.node(id, on)?,
                force: range::FORCE_N.check_three("force_n", *force_n)?.into(),
                facing: *facing,
                at: at_m.map(|at| range::POINT_M.check_three("at_m", at)).transpose()?.map(DVec3::from),
                for_secs: range::SECS.check("for_secs", *for_secs)?,
            },
            Action::Gain { factor, part } => {
                O::Gain { node: self.some_node(id, part.as_deref())?, factor: range::GAIN.check("factor", *factor)? }
            }
            Action::ForcesOff { parts, for_secs } => {
                O::ForcesOff { nodes: self.nodes(id, parts, &[Node::Hips])?, for_secs: lasts(*for_secs)? }
            }
            Action::ForcesOn { parts } => O::ForcesOn { nodes: self.nodes(id, parts, &Node::ALL)? },
            Action::Plane { facing_deg, for_secs } => O::Plane {
                facing_deg: range::FACING_DEG.check_some("facing_deg", *facing_deg)?,
                for_secs: lasts(*for_secs)?,
            },
            Action::PlaneOff {} => O::PlaneOff,
            Action::Gravity { on: Some(_), .. } => {
                let problem = "`on` is for objects; remove it or `character`";
                return Err(OrderError::new(Kind::Contradiction, problem));
            }
            Action::Gravity { scale, on: None, part, over_secs, for_secs } => O::Gravity {
                node: self.some_node(id, part.as_deref())?,
                scale: range::GRAVITY_SCALE.check("scale", *scale)?,
                over_secs: range::SECS.check_some("over_secs", *over_secs)?,
                for_secs: lasts(*for_secs)?,
            },
            Action::Shape { part, shape, for_secs } => {
                let names = self.scene.shapes.keys().map(String::as_str).chain(["own", "none"]);
                let shape = ShapeChoice::of(&one_of("shape", shape, names)?);
                O::Shape { node: self.node(id, part)?, shape, for_secs: lasts(*for_secs)? }
            }
            Action::AddShape { part, shape, for_secs } => {
                O::AddShape { node: self.node(id, part)?, shape: self.shape(shape)?, for_secs: lasts(*for_secs)? }
            }
            Action::RemoveShape { part, shape } => {
                O::RemoveShape { node: self.node(id, part)?, shape: self.shape(shape)? }
            }
            Action::Layer { layer, on } => O::Layer { layer: *layer, on: *on },
            Action::Reflex { name, on } => O::Reflex { name: one_of("reflex", name, REFLEXES.into_iter())?, on: *on },
            Action::Controller { name } => {
                O::Controller { name: (!name.is_empty()).then(|| self.controller(name)).transpose()? }
            }
            Action::Weights { .. } | Action::Kd { .. } | Action::Pins { .. } => self.kd_order(id, action)?,
            Action::Tracker { name } => {
                let name = one_of("tracker", name, TrackerKind::ALL.into_iter().map(TrackerKind::name))?;
                O::Tracker(TrackerKind::of(&name).unwrap_or_default())
            }
            Action::Perform { sample } => {
                self.performer(id)?;
                range::SAMPLE_TIME_SECS.check("time_secs", sample.time_secs)?;
                O::Perform(sample.clone())
            }
            Action::Live { on } => {
                self.performer(id)?;
                O::Live { on: *on }
            }
            Action::Source { source } => {
                self.check_source(id, source)?;
                O::Source(source.clone())
            }
            Action::Reach(order) => O::Reach(self.reach(order)?),
            Action::ReachEnd {} => O::ReachEnd,
            Action::Say { text } => O::Say { text: words(text, MAX_WORDS)? },
            _ => return Err(OrderError::new(Kind::WrongTarget, "it is not for a character; remove `character`")),
        })
    }

    /// A reach with the ids of its objects.
    pub(crate) fn reach(&self, order: &ReachOrder) -> Result<ReachOrder<PropId>, OrderError> {
        order.check()?;
        order.try_map(|name| self.prop(name))
    }

    fn kd_order(&self, id: CharacterId, action: &Action) -> Result<CharacterOrder, OrderError> {
        use CharacterOrder as O;
        let fade = |secs: Option<f64>| range::SECS.check("fade_secs", secs.unwrap_or(FADE_SECS));
        let lasts = |secs: Option<f64>| range::SECS.check_some("for_secs", secs);
        Ok(match action {
            Action::Weights { parts, pin, joint, fade_secs, for_secs } => O::Weights {
                nodes: self.nodes(id, parts, &Node::ALL)?,
                pin: range::KD_WEIGHT.check_some("pin", *pin)?,
                joint: range::KD_WEIGHT.check_some("joint", *joint)?,
                fade_secs: fade(*fade_secs)?,
                for_secs: lasts(*for_secs)?,
            },
            Action::Kd { preset, k_p, d_p, k_q, d_q, damping, feed_forward, fade_secs, for_secs } => {
                let gain = |key, value: &Option<f64>| range::KD_GAIN.check_some(key, *value);
                let change = KdChange {
                    preset: *preset,
                    k_p: gain("k_p", k_p)?,
                    d_p: gain("d_p", d_p)?,
                    k_q: gain("k_q", k_q)?,
                    d_q: gain("d_q", d_q)?,
                    damping: *damping,
                    feed_forward: *feed_forward,
                };
                O::Kd { change, fade_secs: fade(*fade_secs)?, for_secs: lasts(*for_secs)? }
            }
            Action::Pins { on, fade_secs, for_secs } => {
                O::Pins { on: *on, fade_secs: fade(*fade_secs)?, for_secs: lasts(*for_secs)? }
            }
            _ => return Err(OrderError::new(Kind::WrongTarget, "this is no command to the tracker kd")),
        })
    }

    /// Whether a character can follow a source in the middle of a run.
    fn check_source(&self, id: CharacterId, source: &SourceSpec) -> Result<(), OrderError> {
        if source.live.is_some() || source.reach.is_some() {
            let problem = "live and reach have commands of their own: do = \"live\", do = \"reach\"";
            return Err(OrderError::new(Kind::Contradiction, problem));
        }
        let spec = self.spec(id)?;
        source.check(&|named| self.scene.exists(spec, named)).map_err(|fault| {
            let fault = fault.within("source");
            let place = fault.keys.join(".");
            fault.error.map_problem(|problem| format!("{place}: {problem}"))
        })
    }

    fn shape(&self, name: &str) -> Result<String, OrderError> {
        one_of("shape", name, self.scene.shapes.keys().map(String::as_str))
    }

    /// Whether the character has a performer.
    fn performer(&self, id: CharacterId) -> Result<(), OrderError> {
        let source = self.spec(id)?.source.as_ref();
        if source.is_some_and(|source| source.live.is_some()) {
            return Ok(());
        }
        let problem = "the character has no performer; write source = { live = {} } in its table";
        Err(OrderError::new(Kind::NotHonoured, problem))
    }
}
