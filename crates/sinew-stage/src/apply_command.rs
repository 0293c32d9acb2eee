//! What each command does.

use crate::Stage;
use crate::event::{Cause, CharacterEffect, Effect, ShapeChoice};
use crate::fade::Weighs;
use crate::heading::heading;
use crate::step::step_of;
use crate::timed_effect::{Expiry, LastingPush, MAX_PUSHES};
use glam::DVec3;
use sinew_body::humanoid::Node;
use sinew_control::source::NO_PERFORMER;
use sinew_control::tracker::TrackerKind;
use sinew_control::{Action, Command, OrderError, OrderErrorKind};
use sinew_world::{CharacterId, Entity, PartShape, PropId};

impl Stage {
    /// Does what a command says and notes it. A command that makes no sense here (an unknown name, a number that is not
    /// finite) is noted as refused, with the reason.
    pub(crate) fn apply(&mut self, command: &Command, cause: Cause) {
        match self.try_apply(command) {
            Ok(Some(effect)) => self.note(cause, effect),
            Ok(None) => {}
            Err(problem) => {
                self.note(cause, Effect::Refused(OrderError::new(OrderErrorKind::WrongState, problem)));
            }
        }
    }

    fn try_apply(&mut self, command: &Command) -> Result<Option<Effect>, String> {
        match &command.character {
            Some(name) => {
                let character = self
                    .cast
                    .character(name)
                    .ok_or_else(|| format!("no character `{name}`; there are {}", self.cast.characters().join(", ")))?;
                self.apply_to_character(character, &command.action)
            }
            None => self.apply_to_stage(&command.action),
        }
    }

    fn apply_to_character(&mut self, character: CharacterId, action: &Action) -> Result<Option<Effect>, String> {
        let who = self.cast.characters()[character.slot()].clone();
        let effect = match action {
            Action::Pose { name } => {
                if !self.actors[character.slot()].sources.aim(name)? {
                    // It aims there already: a script says so at every step.
                    return Ok(None);
                }
                CharacterEffect::Pose { pose: name.clone() }
            }
            Action::Graph { name, state } => {
                self.actors[character.slot()].sources.start_graph(name, state.as_deref())?;
                CharacterEffect::Graph { graph: name.clone() }
            }
            Action::Signal { name } => {
                self.actors[character.slot()].sources.signal(name);
                CharacterEffect::Signal { signal: name.clone() }
            }
            Action::Ik { link, target_m } => {
                let target = vector(*target_m, "target_m")?;
                let limb = match link {
                    Some(link) => self.part(character, link)?,
                    None => self.holding_part(character).unwrap_or(Node::RightHand),
                };
                let effector = self.effector(character, limb);
                let poses = self.actors[character.slot()].sources.key_poses_mut().ok_or(NO_KEY_POSES)?;
                if !poses.reach(limb, target, effector)? {
                    return Ok(None);
                }
                CharacterEffect::LimbReaches { node: limb, target }
            }
            Action::Reach(order) => match self.begin_reach(character, order)? {
                Some(effect) => effect,
                None => return Ok(None),
            },
            Action::ReachEnd {} => {
                if !self.end_reach(character) {
                    return Ok(None);
                }
                CharacterEffect::ReachEnds
            }
            Action::IkRelease { link } => {
                let limb = link.as_deref().map(|link| self.part(character, link)).transpose()?;
                if let Some(poses) = self.actors[character.slot()].sources.key_poses_mut() {
                    poses.stop_reaching(limb);
                }
                CharacterEffect::ReachEnds
            }
            Action::Attach { .. } | Action::Detach { .. } => return self.apply_grasp(character, action),
            Action::Push { on, force_n, for_secs, facing, at_m } => {
                let node = self.part(character, on)?;
                let mut force = vector(*force_n, "force_n")?;
                if *facing {
                    let frame = &self.world.frame().characters[character.slot()];
                    force = frame.left() * force.x + DVec3::Y * force.y + frame.facing * force.z;
                }
                if !self.start_push(Entity::Part(character, node), force, *at_m, *for_secs)? {
                    return Ok(None);
                }
                CharacterEffect::Pushed { node, force_n: force.length(), for_secs: *for_secs }
            }
            Action::Gain { factor, part } => {
                let factor = number(*factor, "factor")?.max(0.0);
                let part = part.as_deref().map(|part| self.part(character, part)).transpose()?;
                self.actors[character.slot()].set_gain(part, factor);
                CharacterEffect::Gain { node: part, factor }
            }
            Action::ForcesOff { parts, for_secs } => {
                let nodes = if parts.is_empty() { vec![Node::Hips] } else { self.parts(character, parts)? };
                let until = self.until(*for_secs)?;
                for &node in &nodes {
                    self.world.set_forces(character, node, false);
                    self.timed_effects.end_at(until, Expiry::ForcesOff(character, node));
                }
                CharacterEffect::Forces { nodes, on: false }
            }
            Action::ForcesOn { parts } => {
                let nodes = if parts.is_empty() { Node::ALL.to_vec() } else { self.parts(character, parts)? };
                for &node in &nodes {
                    self.world.set_forces(character, node, true);
                    self.timed_effects.end_at(None, Expiry::ForcesOff(character, node));
                }
                CharacterEffect::Forces { nodes, on: true }
            }
            Action::Plane { facing_deg, for_secs } => {
                let facing = match facing_deg {
                    Some(degrees) => heading(number(*degrees, "facing_deg")?),
                    None => self.world.frame().characters[character.slot()].facing,
                };
                let until = self.until(*for_secs)?;
                self.world.hold_to_plane(character, facing);
                self.timed_effects.end_at(until, Expiry::Plane(character));
                CharacterEffect::HeldToPlane
            }
            Action::PlaneOff {} => {
                self.end(&Expiry::Plane(character));
                self.timed_effects.end_at(None, Expiry::Plane(character));
                return Ok(None);
            }
            Action::Gravity { scale, part, over_secs, for_secs, .. } => {
                let scale = number(*scale, "scale")?;
                let over_secs = over_secs.map(|secs| number(secs, "over_secs")).transpose()?;
                let until = self.until(*for_secs)?;
                let only = part.as_deref().map(|part| self.part(character, part)).transpose()?;
                let nodes = only.map_or(Node::ALL.to_vec(), |node| vec![node]);
                let things: Vec<Weighs> = nodes.iter().map(|&node| Weighs::Part(character, node)).collect();
                self.weigh(&things, scale, over_secs);
                for &node in &nodes {
                    self.timed_effects.end_at(until.filter(|_| only.is_some()), Expiry::PartGravity(character, node));
                }
                if only.is_none() {
                    self.timed_effects.end_at(until, Expiry::Gravity(character));
                }
                CharacterEffect::Gravity { node: only, scale, over_secs }
            }
            Action::Shape { part, shape, for_secs } => {
                let node = self.part(character, part)?;
                let until = self.until(*for_secs)?;
                let (solid, shape) = match shape.as_str() {
                    "own" => (PartShape::Own, ShapeChoice::Own),
                    "none" => (PartShape::None, ShapeChoice::None),
                    name => (PartShape::Other(self.shape(name)?), ShapeChoice::Named(name.to_owned())),
                };
                self.world.set_shape(character, node, solid.clone()).map_err(|error| error.to_string())?;
                self.note_shape(character, node, solid);
                self.timed_effects.end_at(until, Expiry::Shape(character, node));
                CharacterEffect::Shape { node, shape }
            }
            Action::AddShape { part, shape, for_secs } => {
                let node = self.part(character, part)?;
                let until = self.until(*for_secs)?;
                let solid = self.shape(shape)?;
                self.world.add_shape(character, node, shape, &solid).map_err(|error| error.to_string())?;
                self.timed_effects.end_at(until, Expiry::ExtraShape(character, node, shape.clone()));
                CharacterEffect::ShapeAdded { node, shape: shape.clone() }
            }
            Action::RemoveShape { part, shape } => {
                let node = self.part(character, part)?;
                if !self.world.remove_shape(character, node, shape) {
                    return Err(format!("no shape `{shape}` was added to the {}", node.part()));
                }
                self.timed_effects.end_at(None, Expiry::ExtraShape(character, node, shape.clone()));
                CharacterEffect::ShapeRemoved { node, shape: shape.clone() }
            }
            Action::Layer { layer, on } => {
                self.actors[character.slot()].set_layer(*layer, *on);
                CharacterEffect::Layer { layer: *layer, on: *on }
            }
            Action::Reflex { name, on } => {
                self.actors[character.slot()].set_reflex(name, *on)?;
                CharacterEffect::Reflex { reflex: name.clone(), on: *on }
            }
            Action::Controller { name } => {
                self.start_controller(character, name)?;
                CharacterEffect::Controller { controller: (!name.is_empty()).then(|| name.clone()) }
            }
            Action::Weights { .. } | Action::Kd { .. } | Action::Pins { .. } => self.apply_kd(character, action)?,
            Action::Tracker { name } => {
                let kind = TrackerKind::of(name).ok_or_else(|| {
                    format!("no tracker `{name}`; there are {}", TrackerKind::ALL.map(TrackerKind::name).join(", "))
                })?;
                self.set_tracker(character, kind)?;
                CharacterEffect::Tracker(kind)
            }
            Action::Perform { sample } => {
                // Many a second: what came of them is counted, not told.
                let now_secs = self.world.frame().time_secs;
                let performer = self.actors[character.slot()].sources.performer_mut().ok_or(NO_PERFORMER)?;
                performer.source_mut().receive(sample, now_secs);
                return Ok(None);
            }
            Action::Live { on } => {
                self.actors[character.slot()].sources.follow_performer(*on)?;
                CharacterEffect::Live { on: *on }
            }
            Action::Reload { name, text } => return self.reload(name, text.as_deref()).map(Some),
            Action::ScriptKilled { name, reason } => return Ok(Some(self.kill_script(name, reason))),
            Action::Say { text } => CharacterEffect::Says { text: text.clone() },
            Action::Place { .. } | Action::Accelerate { .. } | Action::Motor { .. } | Action::Cut { .. } => {
                return self.apply_to_stage(action);
            }
        };
        Ok(Some(Effect::of(who, effect)))
    }

    /// Undoes what has lasted for its time.
    pub(crate) fn end(&mut self, ending: &Expiry) {
        let who = |index: CharacterId| self.cast.characters().get(index.slot()).cloned().unwrap_or_default();
        let effect = match ending {
            Expiry::ForcesOff(character, node) => {
                self.world.set_forces(*character, *node, true);
                Effect::of(who(*character), CharacterEffect::Forces { nodes: vec![*node], on: true })
            }
            Expiry::Plane(character) => {
                if !self.world.is_held_to_plane(*character) {
                    return;
                }
                self.world.free_from_plane(*character);
                Effect::of(who(*character), CharacterEffect::FreeFromPlane)
            }
            Expiry::Gravity(character) => {
                let scale = self.scene.characters.values().nth(character.slot()).map_or(1.0, |spec| spec.gravity_scale);
                let gravity = CharacterEffect::Gravity { node: None, scale, over_secs: None };
                let effect = Effect::of(who(*character), gravity);
                self.weigh(&Node::ALL.map(|node| Weighs::Part(*character, node)), scale, None);
                effect
            }
            Expiry::PartGravity(character, node) => {
                let scale = self.scene.characters.values().nth(character.slot()).map_or(1.0, |spec| spec.gravity_scale);
                let gravity = CharacterEffect::Gravity { node: Some(*node), scale, over_secs: None };
                let effect = Effect::of(who(*character), gravity);
                self.weigh(&[Weighs::Part(*character, *node)], scale, None);
                effect
            }
            Expiry::PropGravity(prop) => {
                let scale =
                    self.scene.props.values().nth(prop.slot()).and_then(|spec| spec.gravity_scale).unwrap_or(1.0);
                self.weigh(&[Weighs::Prop(*prop)], scale, None);
                Effect::PropGravity { prop: self.cast.props()[prop.slot()].clone(), scale, over_secs: None }
            }
            Expiry::Shape(character, node) => {
                // The body's own shape is one.
                let _ = self.world.set_shape(*character, *node, PartShape::Own);
                self.shapes.remove(&(*character, *node));
                Effect::of(who(*character), CharacterEffect::OwnShape { node: *node })
            }
            Expiry::ExtraShape(character, node, name) => {
                self.world.remove_shape(*character, *node, name);
                Effect::of(who(*character), CharacterEffect::ShapeRemoved { node: *node, shape: name.clone() })
            }
            Expiry::Weights(..) | Expiry::Kd(_) | Expiry::Pins(_) => {
                let Some(effect) = self.end_kd(ending) else { return };
                effect
            }
            Expiry::Acceleration(prop) => {
                self.world.accelerate_prop(*prop, DVec3::ZERO);
                Effect::PropKeepsSpeed { prop: self.cast.props()[prop.slot()].clone() }
            }
        };
        self.note(Cause::TimeOver, effect);
    }

    fn note_shape(&mut self, character: CharacterId, node: Node, shape: PartShape) {
        if shape == PartShape::Own {
            self.shapes.remove(&(character, node));
        } else {
            self.shapes.insert((character, node), shape);
        }
    }

    /// Begins a push. False when it is one of a row that a script gives step by step: only its first is worth a note.
    pub(crate) fn start_push(
        &mut self,
        on: Entity,
        force: DVec3,
        at_m: Option<[f64; 3]>,
        for_secs: f64,
    ) -> Result<bool, String> {
        let at = at_m.map(|at| vector(at, "at_m")).transpose()?;
        if self.timed_effects.pushes.len() >= MAX_PUSHES {
            return Err(format!("{MAX_PUSHES} pushes act already"));
        }
        let for_secs = number(for_secs, "for_secs")?;
        let steps = step_of(for_secs, self.world.settings().step_secs()).max(1);
        let until_step = self.world.frame().step.saturating_add(steps);
        let goes_on = steps == 1 && self.timed_effects.pushes.iter().any(|push| push.on == on);
        self.timed_effects.pushes.push(LastingPush { on, at, force, until_step });
        Ok(!goes_on)
    }

    /// The step at which something that begins now ends; `None` for never.
    pub(crate) fn until(&self, for_secs: Option<f64>) -> Result<Option<u64>, String> {
        let Some(secs) = for_secs else { return Ok(None) };
        let steps = step_of(number(secs, "for_secs")?, self.world.settings().step_secs()).max(1);
        Ok(Some(self.world.frame().step.saturating_add(steps)))
    }

    pub(crate) fn part(&self, character: CharacterId, name: &str) -> Result<Node, String> {
        self.cast.part(character, name).ok_or_else(|| {
            let aliases: Vec<&str> = self.cast.aliases(character).map(|(alias, _)| alias.as_str()).collect();
            let known = Node::ALL.map(|node| node.part().name()).join(", ");
            format!("no part `{name}`; there are {} {known}", aliases.join(", "))
        })
    }

    pub(crate) fn parts(&self, character: CharacterId, names: &[String]) -> Result<Vec<Node>, String> {
        names.iter().map(|name| self.part(character, name)).collect()
    }

    pub(crate) fn prop(&self, name: &str) -> Result<PropId, String> {
        self.cast.prop(name).ok_or_else(|| format!("no object `{name}`; there are {}", self.cast.props().join(", ")))
    }

    /// A shape of the scene.
    fn shape(&self, name: &str) -> Result<sinew_world::Solid, String> {
        self.scene.shapes.get(name).and_then(crate::scene::ShapeSpec::solid).ok_or_else(|| {
            let known: Vec<&str> = self.scene.shapes.keys().map(String::as_str).collect();
            format!("no shape `{name}`; there are own, none, {}", known.join(", "))
        })
    }

    /// The point that is to arrive when a part reaches, in the part's frame \[m\]: the centre of what it holds, else its own.
    fn effector(&self, character: CharacterId, node: Node) -> DVec3 {
        let own = self.world.body(character).map_or(DVec3::ZERO, |body| body.link(node).centre);
        let held = self.world.held().find(|held| held.character == character && held.node == node);
        let Some(Entity::Prop(prop)) = held.map(|held| held.object) else { return own };
        let frame = self.world.frame();
        let part = frame.characters[character.slot()].part(node);
        part.rotation.conjugate() * (frame.props[prop.slot()].centre - part.position)
    }

    /// The part that holds something.
    fn holding_part(&self, character: CharacterId) -> Option<Node> {
        self.world.held().find(|held| held.character == character).map(|held| held.node)
    }
}

pub(crate) fn number(value: f64, what: &str) -> Result<f64, String> {
    if value.is_finite() { Ok(value) } else { Err(format!("{what} is not a finite number")) }
}

pub(crate) fn vector(value: [f64; 3], what: &str) -> Result<DVec3, String> {
    let vector = DVec3::from(value);
    if vector.is_finite() { Ok(vector) } else { Err(format!("{what} is not made of finite numbers")) }
}

/// Why a limb does not reach.
const NO_KEY_POSES: &str = "it follows a motion, whose limbs have no IK; give it a pose first, or do = \"reach\"";
