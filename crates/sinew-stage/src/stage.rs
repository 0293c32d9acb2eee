//! The running stage: commands in, frames out, at a fixed step.
//!
//! A step, from left to right, once: what is due (commands of the scene, of the outside, ends of spans) → scripts →
//! poses and graphs → reflexes → trackers → the world → the frame. What a layer senses is the frame of the step before.

use crate::actor::Actor;
use crate::build::{self, StageError};
use crate::cast::Cast;
use crate::event::{Cause, CharacterEffect, Effect, Event, Events};
use crate::reaction::Reactions;
use crate::run_hash::RunHash;
use crate::scene::Scene;
use crate::scripts::Running;
use crate::step::step_of;
use crate::take::{self, Stamped};
use crate::timed_effect::TimedEffects;
use sinew_body::humanoid::Node;
use sinew_control::{Action, Command, OrderError, OrderErrorKind};
use sinew_script::ScriptHost;
use sinew_world::{CharacterId, Frame, PartShape, PropId, PropJointId, World};
use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

/// A scene that runs.
pub struct Stage {
    pub(crate) scene: Arc<Scene>,
    pub(crate) cast: Cast,
    pub(crate) world: World,
    pub(crate) actors: Vec<Actor>,
    pub(crate) timed_effects: TimedEffects,
    /// Shapes that parts have in place of their own.
    pub(crate) shapes: BTreeMap<(CharacterId, Node), PartShape>,
    pub(crate) events: Events,
    pub(crate) host: Option<ScriptHost>,
    /// Commands that came from outside, with the steps in which they were applied.
    pub(crate) record: Vec<Stamped>,
    pub(crate) records: bool,
    /// Kills of scripts that a take prescribes; `None` when scripts are held to time themselves.
    pub(crate) prescribed: Option<Vec<Stamped>>,
    reactions: Reactions,
    /// Joints of the scene that are cut or broken, as far as that is noted.
    pub(crate) broken: BTreeSet<PropJointId>,
    /// Controllers of props.
    pub(crate) prop_scripts: BTreeMap<PropId, Running>,
    /// Commands for the next step.
    inbox: Vec<Command>,
    /// The scene's own commands that are still to come, the next one last.
    timed: Vec<(u64, usize, Command)>,
    hash: RunHash,
}

impl Stage {
    /// Builds what a scene describes. `host` says how Python controllers are run; without one a scene that has any is
    /// refused.
    ///
    /// ```
    /// use sinew_stage::{Scene, Stage};
    /// let scene = Scene::from_text("format = 1\n[props.ball]\nball_radius_m = 0.1\nmass_kg = 1\nposition_m = [0, 1, 0]")?;
    /// let mut stage = Stage::new(scene, None)?;
    /// for _ in 0..240 {
    ///     stage.step();
    /// }
    /// assert!(stage.frame().props[0].position.y < 0.11);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// When a clip cannot be read, a pose does not suit its body, a shape is none or a script does not start.
    pub fn new(scene: Scene, host: Option<ScriptHost>) -> Result<Stage, StageError> {
        let scene = Arc::new(scene);
        let cast = Cast::of(&scene);
        let mut world = World::new(scene.stage.world_settings());
        let actors = build::populate(&scene, &cast, &mut world)?;
        let step_secs = world.settings().step_secs();
        let mut timed: Vec<(u64, usize, Command)> = scene
            .at
            .iter()
            .map(|timed| (step_of(timed.at_secs, step_secs), timed.line, timed.command.clone()))
            .collect();
        // Those of one step keep the file's order; the next one lies at the end.
        timed.sort_by_key(|(step, ..)| *step);
        timed.reverse();
        let reactions = Reactions::of(&scene, &cast);
        let mut stage = Stage {
            scene,
            cast,
            world,
            actors,
            timed_effects: TimedEffects::default(),
            shapes: BTreeMap::new(),
            events: Events::default(),
            host,
            record: Vec::new(),
            records: true,
            prescribed: None,
            reactions,
            broken: BTreeSet::new(),
            prop_scripts: BTreeMap::new(),
            inbox: Vec::new(),
            timed,
            hash: RunHash::new(),
        };
        build::begin(&mut stage)?;
        Ok(stage)
    }

    /// Gives a command; it is applied at the beginning of the next step. One that does not suit the scene is noted among the
    /// events as refused, with the reason, and does nothing else.
    pub fn command(&mut self, command: Command) {
        if self.inbox.len() < MAX_INBOX {
            self.inbox.push(command);
        }
    }

    /// Commands bound to a key of the scene; applied at the beginning of the next step. Returns whether there are any.
    pub fn press(&mut self, key: &str) -> bool {
        let bound: Vec<Command> = self
            .scene
            .keys
            .iter()
            .filter(|binding| binding.key == key)
            .map(|binding| binding.command.clone())
            .collect();
        let any = !bound.is_empty();
        for command in bound {
            self.command(command);
        }
        any
    }

    /// One physics step.
    pub fn step(&mut self) {
        let step = self.world.frame().step;
        for ending in self.timed_effects.take_due(step) {
            self.end(&ending);
        }
        while let Some((_, line, command)) = self.timed.pop_if(|(at, ..)| *at <= step) {
            self.apply(&command, Cause::Timeline { line });
        }
        let prescribed = take::due(self.prescribed.as_deref().unwrap_or_default(), step);
        let prescribed = prescribed.iter().filter(|one| !matches!(one.command.action, Action::ScriptKilled { .. }));
        self.inbox.extend(prescribed.map(|stamped| stamped.command.clone()));
        for command in std::mem::take(&mut self.inbox) {
            // What is refused here is not recorded: a take holds only what it can give again.
            match self.scene.check_command(&command) {
                Ok(()) => {
                    if self.records {
                        self.record.push(Stamped { step, command: command.clone() });
                    }
                    self.apply(&command, Cause::Command);
                }
                Err(problem) => {
                    let error = OrderError::new(OrderErrorKind::WrongState, problem);
                    self.note(Cause::Command, Effect::Refused(error));
                }
            }
        }
        for (command, cause) in self.reactions.fired(self.world.frame(), &self.cast) {
            self.apply(&command, cause);
        }
        self.step_scripts(step);
        self.step_actors();
        self.push_on(step);
        self.fade_on(step);
        self.world.step();
        self.note_resets();
        self.note_breaks();
        self.hash.push(self.world.hash());
    }

    /// The frame after the last step.
    pub fn frame(&self) -> &Frame {
        self.world.frame()
    }

    /// Commands that are given at their steps, as a take recorded them. Scripts are stopped where the take says so.
    pub fn prescribe(&mut self, mut commands: Vec<Stamped>) {
        commands.sort_by_key(|stamped| stamped.step);
        self.prescribed = Some(commands);
    }

    /// Nothing is prescribed any more: scripts are held to time themselves.
    pub(crate) fn prescribe_nothing(&mut self) {
        self.prescribed = None;
    }

    /// Another stage of the same scene, at its start.
    ///
    /// # Errors
    /// As [`Stage::new`].
    pub(crate) fn again(&self) -> Result<Stage, StageError> {
        Stage::new(Scene::clone(&self.scene), self.host.clone())
    }

    /// Steps the world on this many threads from now on, 1 to 64, and says on how many: always 1 without the feature `threads`.
    /// The number changes no bit of what comes out.
    pub fn set_threads(&mut self, threads: usize) -> usize {
        self.world.set_threads(threads)
    }

    /// Whether commands from outside are kept for a take, as they are at first. A stage that runs for days without a take would
    /// keep them for nothing.
    pub fn keep_record(&mut self, on: bool) {
        self.records = on;
    }

    /// The world, to look at.
    pub fn world(&self) -> &World {
        &self.world
    }

    /// The shape that a command has given to a part of a character in place of its own.
    pub fn shape_in_place_of_own(&self, character: CharacterId, node: Node) -> Option<&PartShape> {
        self.shapes.get(&(character, node))
    }

    /// The scene that it was made from.
    pub fn scene(&self) -> &Scene {
        &self.scene
    }

    /// Names of who and what is on it.
    pub fn cast(&self) -> &Cast {
        &self.cast
    }

    /// What happened so far.
    pub fn events(&self) -> &Events {
        &self.events
    }

    /// A hash over all steps so far; equal for equal runs, whatever the machine.
    pub fn hash(&self) -> u64 {
        self.hash.digest()
    }

    /// Commands that came from outside, for a take.
    pub fn record(&self) -> &[Stamped] {
        &self.record
    }

    /// Which tracker, pose, graph state and layers a character has now.
    pub fn state_of(&self, character: CharacterId) -> Option<&Actor> {
        self.actors.get(character.slot())
    }

    pub(crate) fn note(&mut self, cause: Cause, effect: Effect) {
        let frame = self.world.frame();
        self.events.note(Event { time_secs: frame.time_secs, step: frame.step, cause, effect });
    }

    fn push_on(&mut self, step: u64) {
        let world = &mut self.world;
        self.timed_effects.pushes.retain(|push| push.until_step > step);
        for push in &self.timed_effects.pushes {
            match push.on {
                sinew_world::Entity::Part(character, node) => {
                    let at = push.at.map(|at| world.frame().characters[character.slot()].part(node).point(at));
                    world.push_part(character, node, push.force, at);
                }
                sinew_world::Entity::Prop(prop) => {
                    let at = push.at.map(|at| world.frame().props[prop.slot()].point(at));
                    world.push_prop(prop, push.force, at);
                }
                sinew_world::Entity::Floor => {}
            }
        }
    }

    fn note_resets(&mut self) {
        for at in 0..self.actors.len() {
            let index = self.actors[at].id;
            if self.world.frame().characters[index.slot()].was_reset {
                self.actors[index.slot()].reset();
                let name = self.cast.characters()[index.slot()].clone();
                self.note(Cause::BodyDiverged, Effect::of(name, CharacterEffect::PutBack));
            }
        }
    }
}

impl Stage {
    /// Joints that broke in the last step; those that were cut are noted by the command.
    fn note_breaks(&mut self) {
        self.note_broken_holds();
        for at in 0..self.cast.joints().len() {
            let joint = PropJointId::first_in(at);
            if !self.world.prop_joint(joint).is_whole && self.broken.insert(joint) {
                let name = self.cast.joints()[at].clone();
                self.note(Cause::JointOverload { joint: name.clone() }, Effect::JointBreaks { joint: name });
            }
        }
    }
}

/// Commands that may wait for a step.
const MAX_INBOX: usize = 10_000;
