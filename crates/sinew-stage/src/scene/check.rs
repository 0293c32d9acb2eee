//! Validation of a scene: names exist, numbers are in range.

use super::error::{Fault, known, shortened};
use super::range::{count, name, new_name, number, optional};
use super::{CharacterSpec, SCENE_FORMAT, SceneErrorKind, SceneSpec, Touchable};
use crate::Cast;
use crate::order::{Resolver, one_of};
use sinew_control::source::Named;
use sinew_control::{Command, GraphSpec, OrderError, OrderErrorKind, range};

/// The built-in pose: standing, arms hanging.
pub const STAND: &str = "stand";

/// Maximum number of key poses and graph states, over all characters.
const MAX_RESOLVED: usize = 100_000;

impl SceneSpec {
    /// Names of all key poses, the built-in one included.
    pub fn pose_names(&self) -> impl Iterator<Item = &str> + Clone {
        let own = self.poses.contains_key(STAND);
        self.poses.keys().map(String::as_str).chain((!own).then_some(STAND))
    }

    /// Names of all objects and characters.
    pub(super) fn thing_names(&self) -> impl Iterator<Item = &str> + Clone {
        self.props.keys().chain(self.characters.keys()).map(String::as_str)
    }

    pub(super) fn check(&self) -> Result<(), Fault> {
        if self.format != SCENE_FORMAT {
            let problem = if self.format > SCENE_FORMAT {
                format!("format {} is newer than the {SCENE_FORMAT} that this version reads; update Sinew", self.format)
            } else {
                format!("there is no format {}; write format = {SCENE_FORMAT}", self.format)
            };
            return Err(Fault::at(&["format"], problem).of_kind(SceneErrorKind::WrongVersion));
        }
        self.stage.check()?;
        self.camera.check()?;
        self.check_counts()?;
        for (shape, spec) in &self.shapes {
            new_name(&["shapes", shape], shape)?;
            if ["own", "none"].contains(&shape.as_str()) {
                return Err(Fault::at(
                    &["shapes", shape],
                    "the command `shape` has its own meaning for this name; choose another",
                ));
            }
            spec.check(["shapes", shape])?;
        }
        for (prop, spec) in &self.props {
            new_name(&["props", prop], prop)?;
            spec.check(prop)?;
            if let Some(controller) = &spec.controller {
                let names = self.controllers.keys().map(String::as_str);
                name(&["props", prop, "controller"], "controller", controller, names)?;
            }
        }
        for (joint, spec) in &self.joints {
            new_name(&["joints", joint], joint)?;
            spec.check(joint, self)?;
        }
        for (controller, spec) in &self.controllers {
            new_name(&["controllers", controller], controller)?;
            spec.check(controller)?;
        }
        self.check_characters()?;
        self.check_poses()?;
        self.check_commands()
    }

    fn check_counts(&self) -> Result<(), Fault> {
        count(&["shapes"], self.shapes.len(), 1_000)?;
        count(&["characters"], self.characters.len(), 256)?;
        count(&["props"], self.props.len(), 1_000)?;
        count(&["joints"], self.joints.len(), 1_000)?;
        count(&["poses"], self.poses.len(), 1_000)?;
        count(&["graphs"], self.graphs.len(), 200)?;
        count(&["controllers"], self.controllers.len(), 64)?;
        count(&["at"], self.at.len(), 10_000)?;
        count(&["when"], self.when.len(), 1_000)?;
        count(&["keys"], self.keys.len(), 1_000)?;
        // Every character has its own of all poses and states.
        let states: usize = self.graphs.values().map(|graph| graph.states.len()).sum();
        let resolved = self.characters.len() * (self.poses.len() + states);
        if resolved > MAX_RESOLVED {
            let problem = format!(
                "{} characters with {} poses and {states} states of graphs are too many: their product is above {MAX_RESOLVED}; \
                 leave some out",
                self.characters.len(),
                self.poses.len()
            );
            return Err(Fault::at(&["characters"], problem).of_kind(SceneErrorKind::TooLarge));
        }
        match &self.name {
            Some(name) if name.len() > 200 => Err(Fault::at(&["name"], "it is longer than 200 bytes; shorten it")),
            _ => Ok(()),
        }
    }

    fn check_characters(&self) -> Result<(), Fault> {
        for (character, spec) in &self.characters {
            let at = |key| ["characters", character, key];
            new_name(&at("")[..2], character)?;
            if self.props.contains_key(character) {
                return Err(Fault::at(&at("")[..2], "a prop has this name too; rename one of the two"));
            }
            spec.check(character)?;
            spec.kd.check_names(character, self)?;
            spec.response.check_names(character, self)?;
            if let Some(pose) = &spec.pose {
                name(&at("pose"), "pose", pose, self.pose_names())?;
            }
            if let Some(controller) = &spec.controller {
                name(&at("controller"), "controller", controller, self.controllers.keys().map(String::as_str))?;
            }
            let Some(source) = &spec.source else { continue };
            source.check(&|named| self.exists(spec, named)).map_err(|fault| {
                let path = ["characters", character, "source"].map(str::to_owned);
                Fault::of_order(&[&path[..], &fault.keys].concat(), &fault.error)
            })?;
        }
        Ok(())
    }

    fn check_poses(&self) -> Result<(), Fault> {
        for (pose, spec) in &self.poses {
            new_name(&["poses", pose], pose)?;
            if let Some(base) = &spec.base {
                name(&["poses", pose, "base"], "pose", base, self.pose_names())?;
            }
        }
        for (graph, spec) in &self.graphs {
            new_name(&["graphs", graph], graph)?;
            self.check_graph(graph, spec)?;
        }
        Ok(())
    }

    fn check_graph(&self, graph: &str, spec: &GraphSpec) -> Result<(), Fault> {
        let states = || spec.states.keys().map(String::as_str);
        count(&["graphs", graph, "states"], spec.states.len(), 200)?;
        name(&["graphs", graph, "start"], "state", &spec.start, states())?;
        for (state, body) in &spec.states {
            let path = ["graphs", graph, "states", state];
            name(&[&path[..], &["pose"]].concat(), "pose", &body.pose, self.pose_names())?;
            count(&[&path[..], &["to"]].concat(), body.to.len(), 100)?;
            count(&[&path[..], &["feedback"]].concat(), body.feedback.len(), 100)?;
            for (index, way) in body.to.iter().enumerate() {
                let index = index.to_string();
                let at = |key| [&path[..], &["to", &index, key]].concat();
                name(&at("state"), "state", &way.state, states())?;
                for thing in way.touching.iter().flatten() {
                    self.graph_thing(&at("touching"), thing, &["self"])?;
                }
                if let Some(sensor) = &way.sensor {
                    self.graph_thing(&at("sensor"), &sensor.of, &["centre"])?;
                    if let Some(to) = &sensor.to {
                        self.graph_thing(&at("sensor"), to, &["centre"])?;
                    }
                }
            }
        }
        Ok(())
    }

    /// A name in a graph: of the character that runs it, whichever that is, or of the scene.
    fn graph_thing(&self, path: &[&str], thing: &str, own: &[&str]) -> Result<(), Fault> {
        let is_own = own.contains(&thing)
            || self.characters.values().any(|character| character.node(thing).is_some())
            || super::CharacterSpec::default().node(thing).is_some();
        if is_own || self.touchable(thing).is_ok() {
            return Ok(());
        }
        let names = own.iter().copied().chain([super::range::GROUND]).chain(self.thing_names());
        Err(Fault::at(path, format!("no part, object or character `{}`; {}", shortened(thing), known(thing, names)))
            .of_kind(SceneErrorKind::NotFound))
    }

    /// Whether a command can be understood on this scene's stage, as [`Resolver::resolve`] has it.
    ///
    /// # Errors
    /// As [`Resolver::resolve`].
    pub fn check_command(&self, command: &Command) -> Result<(), OrderError> {
        Resolver { scene: self, cast: &Cast::of(self) }.resolve(command).map(drop)
    }

    fn check_commands(&self) -> Result<(), Fault> {
        let cast = Cast::of(self);
        let resolver = Resolver { scene: self, cast: &cast };
        let command = |list: &str, index: usize, command: &sinew_control::Command| {
            let order = resolver.resolve(command).map(drop);
            order.map_err(|error| Fault::of_order(&[list.to_owned(), index.to_string()], &error))
        };
        for (index, timed) in self.at.iter().enumerate() {
            let path = ["at".to_owned(), index.to_string(), "time_secs".to_owned()];
            number(&path, timed.at_secs, range::SECS.inclusive(), "seconds from the start are expected")?;
            command("at", index, &timed.command)?;
        }
        for (index, reaction) in self.when.iter().enumerate() {
            let path = |key: &str| ["when".to_owned(), index.to_string(), key.to_owned()];
            for thing in &reaction.touching {
                self.touchable(thing).map_err(|error| Fault::of_order(&path("touching"), &error))?;
            }
            optional(
                &path("repeat_after_secs"),
                reaction.repeat_after_secs,
                range::SECS.inclusive(),
                "seconds are expected",
            )?;
            command("when", index, &reaction.command)?;
        }
        for (index, binding) in self.keys.iter().enumerate() {
            let path = ["keys".to_owned(), index.to_string(), "key".to_owned()];
            if binding.key.is_empty() || binding.key.len() > 32 || binding.key.chars().any(char::is_control) {
                return Err(Fault::at(&path, "write a letter, a digit, or a name such as Space or ArrowUp"));
            }
            command("keys", index, &binding.command)?;
        }
        Ok(())
    }

    /// Whether something exists that a source of a character names.
    ///
    /// # Errors
    /// What there is instead.
    pub(crate) fn exists(&self, character: &CharacterSpec, named: Named) -> Result<(), OrderError> {
        let graph =
            |graph| self.graphs.get(graph).into_iter().flat_map(|graph| graph.states.keys().map(String::as_str));
        match named {
            Named::Pose(pose) => one_of("pose", pose, self.pose_names()).map(drop),
            Named::Graph(graph) => one_of("graph", graph, self.graphs.keys().map(String::as_str)).map(drop),
            Named::State { graph: of, state } => one_of("state", state, graph(of)).map(drop),
            Named::Part(part) => match character.node(part) {
                Some(_) => Ok(()),
                None => Err(OrderError::new(OrderErrorKind::NotFound, character.no_part(part))),
            },
        }
    }

    /// Resolves the name of something that can have contacts: a prop, a character, a part as `character.part`, or
    /// `ground`.
    ///
    /// # Errors
    /// [`OrderErrorKind::NotFound`] when nothing has this name: what there is instead.
    pub fn touchable(&self, thing: &str) -> Result<Touchable, OrderError> {
        let not_found = |problem: String| OrderError::new(OrderErrorKind::NotFound, problem);
        if thing == super::range::GROUND {
            return Ok(Touchable::Ground);
        }
        if self.props.contains_key(thing) {
            return Ok(Touchable::Prop(thing.to_owned()));
        }
        if self.characters.contains_key(thing) {
            return Ok(Touchable::Character(thing.to_owned()));
        }
        if let Some((character, part)) = thing.split_once('.')
            && let Some(spec) = self.characters.get(character)
        {
            let node = spec.node(part).ok_or_else(|| not_found(spec.no_part(part)))?;
            return Ok(Touchable::Part(character.to_owned(), node));
        }
        let names = self.thing_names().chain([super::range::GROUND]);
        Err(not_found(format!(
            "no object, character or character.part `{}`; {}",
            shortened(thing),
            known(thing, names)
        )))
    }
}
