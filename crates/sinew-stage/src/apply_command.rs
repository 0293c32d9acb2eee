//! What each command does.

use crate::Stage;
use crate::fade::Weighs;
use crate::scene::TrackerKind;
use crate::stage::step_of;
use crate::timed_effect::{Expiry, LastingPush, MAX_PUSHES};
use glam::{DQuat, DVec3};
use sinew_body::humanoid::Node;
use sinew_control::{Action, Command};
use sinew_world::{Entity, PartShape};

impl Stage {
    /// Does what a command says and notes it. A command that makes no sense here (an unknown name, a number that is not
    /// finite) is noted as refused, with the reason.
    pub(crate) fn apply(&mut self, command: &Command, cause: &str) {
        match self.try_apply(command) {
            Ok(Some(effect)) => self.note(cause, effect),
            Ok(None) => {}
            Err(problem) => self.note(cause, format!("refused: {problem}")),
        }
    }

    fn try_apply(&mut self, command: &Command) -> Result<Option<String>, String> {
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

    fn apply_to_character(&mut self, character: usize, action: &Action) -> Result<Option<String>, String> {
        let who = self.cast.characters()[character].clone();
        let effect = match action {
            Action::Pose { name } => {
                if !self.actors[character].aim(name)? {
                    // It aims there already: a script says so at every step.
                    return Ok(None);
                }
                format!("{who} takes the pose {name}")
            }
            Action::Graph { name, state } => {
                self.actors[character].start_graph(name, state.as_deref())?;
                format!("{who} starts the graph {name}")
            }
            Action::Signal { name } => {
                self.actors[character].signal(name);
                format!("{who} gets the signal {name}")
            }
            Action::Ik { link, target_m } => {
                let target = vector(*target_m, "target_m")?;
                let limb = match link {
                    Some(link) => self.part(character, link)?,
                    None => self.holding_part(character).unwrap_or(Node::RightHand),
                };
                let effector = self.effector(character, limb);
                if !self.actors[character].reach(limb, target, effector)? {
                    return Ok(None);
                }
                format!("{who}'s {} reaches for {target:.2}", limb.part())
            }
            Action::Reach(order) => match self.begin_reach(character, order)? {
                Some(effect) => format!("{who} {effect}"),
                None => return Ok(None),
            },
            Action::ReachEnd {} => {
                if !self.actors[character].end_reach(self.world.frame().time_secs) {
                    return Ok(None);
                }
                format!("{who} reaches no longer")
            }
            Action::IkRelease { link } => {
                let limb = link.as_deref().map(|link| self.part(character, link)).transpose()?;
                self.actors[character].stop_reaching(limb);
                format!("{who} reaches no longer")
            }
            Action::Attach { .. } | Action::Detach { .. } => return self.apply_grasp(character, action),
            Action::Push { on, force_n, for_secs, facing, at_m } => {
                let node = self.part(character, on)?;
                let mut force = vector(*force_n, "force_n")?;
                if *facing {
                    let frame = &self.world.frame().characters[character];
                    force = frame.left() * force.x + DVec3::Y * force.y + frame.facing * force.z;
                }
                if !self.start_push(Entity::Part(character, node), force, *at_m, *for_secs)? {
                    return Ok(None);
                }
                format!("{who}'s {} is pushed with {:.0} N for {for_secs:.2} s", node.part(), force.length())
            }
            Action::Gain { factor, part } => {
                let factor = number(*factor, "factor")?.max(0.0);
                let part = part.as_deref().map(|part| self.part(character, part)).transpose()?;
                self.actors[character].set_gain(part, factor);
                let what = part.map_or("all joints".to_owned(), |node| node.part().name().to_owned());
                format!("{who}: gain of {what} is {factor}")
            }
            Action::ForcesOff { parts, for_secs } => {
                let nodes = if parts.is_empty() { vec![Node::Hips] } else { self.parts(character, parts)? };
                let until = self.until(*for_secs)?;
                for &node in &nodes {
                    self.world.set_forces(character, node, false);
                    self.timed_effects.end_at(until, Expiry::ForcesOff(character, node));
                }
                format!("{who}: forces on {} are off", listed(&nodes))
            }
            Action::ForcesOn { parts } => {
                let nodes = if parts.is_empty() { Node::ALL.to_vec() } else { self.parts(character, parts)? };
                for &node in &nodes {
                    self.world.set_forces(character, node, true);
                    self.timed_effects.end_at(None, Expiry::ForcesOff(character, node));
                }
                format!("{who}: forces on {} are on", listed(&nodes))
            }
            Action::Plane { facing_deg, for_secs } => {
                let facing = match facing_deg {
                    Some(degrees) => heading(number(*degrees, "facing_deg")?),
                    None => self.world.frame().characters[character].facing,
                };
                let until = self.until(*for_secs)?;
                self.world.hold_to_plane(character, facing);
                self.timed_effects.end_at(until, Expiry::Plane(character));
                format!("{who} is held to a plane")
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
                let of = if only.is_some() { format!(" on {}", listed(&nodes)) } else { String::new() };
                format!("{who}: gravity{of} times {scale}{}", over(over_secs))
            }
            Action::Shape { part, shape, for_secs } => {
                let node = self.part(character, part)?;
                let until = self.until(*for_secs)?;
                let solid = match shape.as_str() {
                    "own" => PartShape::Own,
                    "none" => PartShape::None,
                    name => PartShape::Other(self.shape(name)?),
                };
                self.world.set_shape(character, node, solid.clone()).map_err(|error| error.to_string())?;
                self.note_shape(character, node, solid);
                self.timed_effects.end_at(until, Expiry::Shape(character, node));
                format!("{who}'s {} has the shape {shape}", node.part())
            }
            Action::AddShape { part, shape, for_secs } => {
                let node = self.part(character, part)?;
                let until = self.until(*for_secs)?;
                let solid = self.shape(shape)?;
                self.world.add_shape(character, node, shape, &solid).map_err(|error| error.to_string())?;
                self.timed_effects.end_at(until, Expiry::ExtraShape(character, node, shape.clone()));
                format!("{who}'s {} has the shape {shape} as well", node.part())
            }
            Action::RemoveShape { part, shape } => {
                let node = self.part(character, part)?;
                if !self.world.remove_shape(character, node, shape) {
                    return Err(format!("no shape `{shape}` was added to the {}", node.part()));
                }
                self.timed_effects.end_at(None, Expiry::ExtraShape(character, node, shape.clone()));
                format!("{who}'s {} has the shape {shape} no longer", node.part())
            }
            Action::Layer { layer, on } => {
                self.actors[character].set_layer(*layer, *on);
                let state = if *on { "on" } else { "off" };
                format!("{who}: layer {} {state}", format!("{layer:?}").to_lowercase())
            }
            Action::Reflex { name, on } => {
                self.actors[character].set_reflex(name, *on)?;
                format!("{who}: reflex {name} {}", if *on { "on" } else { "off" })
            }
            Action::Controller { name } => {
                self.start_controller(character, name)?;
                format!("{who} is run by {}", if name.is_empty() { "no controller" } else { name })
            }
            Action::Weights { .. } | Action::Kd { .. } | Action::Pins { .. } => self.apply_kd(character, action)?,
            Action::Tracker { name } => {
                let kind = TrackerKind::of(name).ok_or_else(|| {
                    format!("no tracker `{name}`; there are {}", TrackerKind::ALL.map(TrackerKind::name).join(", "))
                })?;
                self.set_tracker(character, kind)?;
                format!("{who} follows by {name}")
            }
            Action::Perform { sample } => {
                // Many a second: what came of them is counted, not told.
                let now_secs = self.world.frame().time_secs;
                self.actors[character].performer()?.receive(sample, now_secs);
                return Ok(None);
            }
            Action::Live { on } => {
                self.actors[character].follow_performer(*on)?;
                format!("{who} follows {}", if *on { "its performer" } else { "its performer no longer" })
            }
            Action::Reload { name, text } => return self.reload(name, text.as_deref()).map(Some),
            Action::ScriptKilled { name, reason } => return self.kill_script(name, reason).map(Some),
            Action::Say { text } => format!("{who}: {text}"),
            Action::Place { .. } | Action::Accelerate { .. } | Action::Motor { .. } | Action::Cut { .. } => {
                return self.apply_to_stage(action);
            }
        };
        Ok(Some(effect))
    }

    /// Undoes what has lasted for its time.
    pub(crate) fn end(&mut self, ending: &Expiry) {
        let who = |index: usize| self.cast.characters().get(index).cloned().unwrap_or_default();
        let effect = match ending {
            Expiry::ForcesOff(character, node) => {
                self.world.set_forces(*character, *node, true);
                format!("{}: forces on {} are on", who(*character), node.part())
            }
            Expiry::Plane(character) => {
                if !self.world.is_held_to_plane(*character) {
                    return;
                }
                self.world.free_from_plane(*character);
                format!("{} is free in three dimensions", who(*character))
            }
            Expiry::Gravity(character) => {
                let scale = self.scene.characters.values().nth(*character).map_or(1.0, |spec| spec.gravity_scale);
                let effect = format!("{}: gravity times {scale}", who(*character));
                self.weigh(&Node::ALL.map(|node| Weighs::Part(*character, node)), scale, None);
                effect
            }
            Expiry::PartGravity(character, node) => {
                let scale = self.scene.characters.values().nth(*character).map_or(1.0, |spec| spec.gravity_scale);
                let effect = format!("{}: gravity on {} times {scale}", who(*character), node.part());
                self.weigh(&[Weighs::Part(*character, *node)], scale, None);
                effect
            }
            Expiry::PropGravity(prop) => {
                let scale = self.scene.props.values().nth(*prop).and_then(|spec| spec.gravity_scale).unwrap_or(1.0);
                self.weigh(&[Weighs::Prop(*prop)], scale, None);
                format!("{}: gravity times {scale}", self.cast.props()[*prop])
            }
            Expiry::Shape(character, node) => {
                // The body's own shape is one.
                let _ = self.world.set_shape(*character, *node, PartShape::Own);
                self.shapes.remove(&(*character, *node));
                format!("{}'s {} has its own shape", who(*character), node.part())
            }
            Expiry::ExtraShape(character, node, name) => {
                self.world.remove_shape(*character, *node, name);
                format!("{}'s {} has the shape {name} no longer", who(*character), node.part())
            }
            Expiry::Weights(..) | Expiry::Kd(_) | Expiry::Pins(_) => {
                let Some(effect) = self.end_kd(ending) else { return };
                effect
            }
            Expiry::Acceleration(prop) => {
                self.world.accelerate_prop(*prop, DVec3::ZERO);
                format!("{} keeps its speed", self.cast.props()[*prop])
            }
        };
        self.note("its time is over", effect);
    }

    fn note_shape(&mut self, character: usize, node: Node, shape: PartShape) {
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

    pub(crate) fn part(&self, character: usize, name: &str) -> Result<Node, String> {
        self.cast.part(character, name).ok_or_else(|| {
            let aliases: Vec<&str> = self.cast.aliases(character).map(|(alias, _)| alias.as_str()).collect();
            let known = Node::ALL.map(|node| node.part().name()).join(", ");
            format!("no part `{name}`; there are {} {known}", aliases.join(", "))
        })
    }

    pub(crate) fn parts(&self, character: usize, names: &[String]) -> Result<Vec<Node>, String> {
        names.iter().map(|name| self.part(character, name)).collect()
    }

    pub(crate) fn prop(&self, name: &str) -> Result<usize, String> {
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
    fn effector(&self, character: usize, node: Node) -> DVec3 {
        let own = self.world.body(character).map_or(DVec3::ZERO, |body| body.link(node).centre);
        let held = self.world.held().find(|held| held.character == character && held.node == node);
        let Some(Entity::Prop(prop)) = held.map(|held| held.object) else { return own };
        let frame = self.world.frame();
        let part = frame.characters[character].part(node);
        part.rotation.conjugate() * (frame.props[prop].centre - part.position)
    }

    /// The part that holds something.
    fn holding_part(&self, character: usize) -> Option<Node> {
        self.world.held().find(|held| held.character == character).map(|held| held.node)
    }
}

/// The horizontal unit vector of a heading \[degrees about +Y from +Z to +X\].
pub(crate) fn heading(degrees: f64) -> DVec3 {
    DQuat::from_axis_angle(DVec3::Y, degrees.to_radians()) * DVec3::Z
}

pub(crate) fn number(value: f64, what: &str) -> Result<f64, String> {
    if value.is_finite() { Ok(value) } else { Err(format!("{what} is not a finite number")) }
}

pub(crate) fn vector(value: [f64; 3], what: &str) -> Result<DVec3, String> {
    let vector = DVec3::from(value);
    if vector.is_finite() { Ok(vector) } else { Err(format!("{what} is not made of finite numbers")) }
}

/// How long something takes, for an event.
pub(crate) fn over(over_secs: Option<f64>) -> String {
    over_secs.map_or(String::new(), |secs| format!(" within {secs:.2} s"))
}

pub(crate) fn listed(nodes: &[Node]) -> String {
    if nodes.len() == Node::COUNT {
        return "all parts".to_owned();
    }
    nodes.iter().map(|node| node.part().name()).collect::<Vec<_>>().join(", ")
}
