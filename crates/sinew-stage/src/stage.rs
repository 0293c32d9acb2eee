//! The running stage: commands in, frames out, at a fixed step.
//!
//! A step, from left to right, once: what is due (commands of the scene, of the outside, ends of spans) → scripts →
//! poses and graphs → reflexes → trackers → the world → the frame. What a layer senses is the frame of the step before.

use crate::actor::Actor;
use crate::build::{self, StageError, StageErrorKind};
use crate::cast::Cast;
use crate::event::{Cause, CharacterEffect, Effect, Event, Events};
use crate::order::{Order, Resolver, ShapeChoice, Undo};
use crate::populate::{Newcomers, at, populate};
use crate::reaction::Reactions;
use crate::run_hash::RunHash;
use crate::scene::{CharacterSpec, HeldFile, KeyBinding, PropSpec, Scene};
use crate::scripts::{Owner, Running};
use crate::snapshot_bytes::Start;
use crate::step::step_of;
use crate::take::{self, Stamped, Take};
use crate::timed_effect::TimedEffects;
use sinew_body::humanoid::Node;
use sinew_control::{Action, Command, OrderError, OrderErrorKind};
use sinew_script::ScriptHost;
use sinew_world::{CharacterFrame, CharacterId, Frame, PartShape, PropId, PropJointId, Solid, World};
use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

/// A scene that runs.
pub struct Stage {
    /// The scene that it was made from.
    pub(crate) first_scene: Arc<Scene>,
    /// The scene that runs: as edited.
    pub(crate) scene: Arc<Scene>,
    /// Files that edits have read.
    pub(crate) edit_files: BTreeMap<String, HeldFile>,
    pub(crate) cast: Cast,
    pub(crate) world: World,
    pub(crate) actors: BTreeMap<CharacterId, Actor>,
    pub(crate) timed_effects: TimedEffects,
    /// Shapes that parts have in place of their own.
    pub(crate) shapes: BTreeMap<(CharacterId, Node), (ShapeChoice, PartShape)>,
    pub(crate) events: Events,
    pub(crate) host: Option<ScriptHost>,
    /// Commands that came from outside, with the steps in which they were applied.
    pub(crate) record: Vec<Stamped>,
    pub(crate) records: bool,
    /// Kills of scripts that a take prescribes; `None` when scripts are held to time themselves.
    pub(crate) prescribed: Option<Vec<Stamped>>,
    pub(crate) reactions: Reactions,
    /// Joints of the scene that are cut or broken, as far as that is noted.
    pub(crate) broken: BTreeSet<PropJointId>,
    /// Controllers that run: of characters, then of props.
    pub(crate) scripts: BTreeMap<Owner, Running>,
    /// Commands for the next step, each with whether it is worth undoing.
    pub(crate) inbox: Vec<(Command, bool)>,
    /// What runs of an edited text, when one was given; else what runs is the scene's own.
    pub(crate) running: Option<toml::Table>,
    /// The scene's key bindings, as edited.
    pub(crate) keys: Vec<KeyBinding>,
    /// How commands from outside are taken back, the newest last.
    pub(crate) history: Vec<Vec<Order>>,
    /// The scene's own commands that are still to come, the next one last.
    pub(crate) timed: Vec<(u64, usize, Order)>,
    pub(crate) hash: RunHash,
    /// The stage as it was built, to which bytes of a snapshot are relative; `None` only while it is built.
    pub(crate) start: Option<Arc<Start>>,
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
    /// A clip cannot be read, a pose does not fit its body, a shape is degenerate or a script does not start.
    pub fn new(scene: Scene, host: Option<ScriptHost>) -> Result<Stage, StageError> {
        let scene = Arc::new(scene);
        let mut cast = Cast::default();
        let mut world = World::new(scene.stage.world_settings());
        let all = Newcomers::all(&scene);
        let actors = populate(&scene, &mut cast, &mut world, &all)?;
        let step_secs = world.settings().step_secs();
        let timed = timed_orders(&scene, &cast, 0, step_secs)?;
        let reactions = Reactions::of(&scene, &cast)
            .map_err(|error| at(&scene, StageErrorKind::Refused, "when".to_owned(), error))?;
        let keys = scene.keys.clone();
        let mut stage = Stage {
            first_scene: Arc::clone(&scene),
            edit_files: BTreeMap::new(),
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
            scripts: BTreeMap::new(),
            inbox: Vec::new(),
            history: Vec::new(),
            running: None,
            keys,
            timed,
            hash: RunHash::new(),
            start: None,
        };
        let first = Arc::clone(&stage.scene);
        let all = Newcomers::all(&first);
        build::begin(&mut stage, &all.characters, &all.props)?;
        for actor in stage.actors.values_mut() {
            actor.has_first_tracker = true;
        }
        stage.start = Some(Arc::new(Start::of(&stage)));
        Ok(stage)
    }

    /// Gives a command; it is applied at the beginning of the next step. One that does not suit the scene is noted among the
    /// events as refused, with the reason, and does nothing else.
    pub fn command(&mut self, command: Command) {
        if self.inbox.len() < MAX_INBOX {
            self.inbox.push((command, true));
        }
    }

    /// Takes back the newest command from outside that can be taken back and was not yet, at the beginning of the next step, by
    /// commands that are recorded as any others. False when there is none: pushes, cuts and words cannot be taken back.
    ///
    /// ```
    /// use sinew_control::{Action, Command};
    /// use sinew_stage::{Scene, Stage};
    /// let mut stage = Stage::new(Scene::from_text("format = 1\n[characters.one]")?, None)?;
    /// stage.command(Command::to("one", Action::Gain { factor: 0.25, part: None }));
    /// stage.step();
    /// assert!(stage.undo());
    /// stage.step();
    /// let one = stage.cast().character("one").ok_or("it is there")?;
    /// assert_eq!(stage.state_of(one).ok_or("it is there")?.gain(None), 1.0);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn undo(&mut self) -> bool {
        let Some(orders) = self.history.pop() else { return false };
        for order in orders {
            self.inbox.push((order.to_command(&self.cast), false));
        }
        true
    }

    /// Commands bound to a key of the scene; applied at the beginning of the next step. Returns whether there are any.
    pub fn press(&mut self, key: &str) -> bool {
        let bound: Vec<Command> =
            self.keys.iter().filter(|binding| binding.key == key).map(|binding| binding.command.clone()).collect();
        let any = !bound.is_empty();
        for command in bound {
            self.command(command);
        }
        any
    }

    /// One physics step.
    pub fn step(&mut self) {
        let step = self.world.frame().step;
        self.edit_as_prescribed(step);
        self.end_timed_effects(step);
        while let Some((_, line, order)) = self.timed.pop_if(|(at, ..)| *at <= step) {
            self.carry_out(&order, Cause::Timeline { line });
        }
        let prescribed = take::due(self.prescribed.as_deref().unwrap_or_default(), step);
        let is_command =
            |one: &&Stamped| !matches!(one.command.action, Action::ScriptKilled { .. } | Action::Edit { .. });
        let prescribed = prescribed.iter().filter(is_command);
        self.inbox.extend(prescribed.map(|stamped| (stamped.command.clone(), false)));
        for (command, is_undoable) in std::mem::take(&mut self.inbox) {
            // What is refused here is not recorded: a take holds only what it can give again.
            let order = match self.resolve(&command) {
                Ok(order) => order,
                Err(error) => {
                    self.note(Cause::Command, Effect::Refused(error));
                    continue;
                }
            };
            if self.records {
                self.record.push(Stamped { step, command });
            }
            let undo = self.carry_out(&order, Cause::Command);
            if let Undo::Orders(orders) = undo
                && is_undoable
            {
                self.remember(orders);
            }
        }
        for (order, cause) in self.reactions.fired(self.world.frame(), &self.cast) {
            self.carry_out(&order, cause);
        }
        self.step_scripts(step);
        self.push_on(step);
        self.step_actors();
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
        Stage::new(Scene::clone(&self.first_scene), self.host.clone())
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
        self.shapes.get(&(character, node)).map(|(_, shape)| shape)
    }

    /// The scene that runs: the one that it was made from, until something comes, goes or is read anew by an
    /// [`edit`](Stage::edit).
    pub fn scene(&self) -> &Scene {
        &self.scene
    }

    /// The scene that it was made from, whatever was edited since.
    pub fn first_scene(&self) -> &Scene {
        &self.first_scene
    }

    /// An empty take of this stage: the scene that it was made from, and the files that edits have read.
    pub(crate) fn empty_take(&self) -> Take {
        let mut take = Take::of(&self.first_scene);
        take.add_files(&self.edit_files);
        take
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
        self.actors.get(&character)
    }

    fn remember(&mut self, orders: Vec<Order>) {
        if self.history.len() == MAX_HISTORY {
            self.history.remove(0);
        }
        self.history.push(orders);
    }

    /// The actor of a character.
    pub(crate) fn actor(&self, id: CharacterId) -> Result<&Actor, OrderError> {
        self.actors.get(&id).ok_or_else(|| gone(id))
    }

    /// The actor of a character, to change it.
    pub(crate) fn actor_mut(&mut self, id: CharacterId) -> Result<&mut Actor, OrderError> {
        self.actors.get_mut(&id).ok_or_else(|| gone(id))
    }

    /// The table of a character in the scene.
    pub(crate) fn spec(&self, id: CharacterId) -> Result<&CharacterSpec, OrderError> {
        self.scene.characters.get(self.cast.character_name(id)).ok_or_else(|| gone(id))
    }

    /// A character as it is now.
    pub(crate) fn character_frame(&self, id: CharacterId) -> Result<&CharacterFrame, OrderError> {
        self.world.frame().character(id).ok_or_else(|| gone(id))
    }

    /// The shape of a prop of the scene.
    pub(crate) fn solid_of(&self, prop: PropId) -> Option<Solid> {
        self.scene.props.get(self.cast.prop_name(prop)).and_then(PropSpec::solid)
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
                    let at =
                        push.at.and_then(|at| world.frame().character(character).map(|seen| seen.part(node).point(at)));
                    world.push_part(character, node, push.force, at);
                }
                sinew_world::Entity::Prop(prop) => {
                    let at = push.at.and_then(|at| world.frame().prop(prop).map(|seen| seen.point(at)));
                    world.push_prop(prop, push.force, at);
                }
                sinew_world::Entity::Floor => {}
            }
        }
    }

    fn note_resets(&mut self) {
        let frame = self.world.frame();
        let was_reset = |id: &CharacterId| frame.character(*id).is_some_and(|seen| seen.was_reset);
        let reset: Vec<CharacterId> = self.actors.keys().copied().filter(was_reset).collect();
        for id in reset {
            if let Some(actor) = self.actors.get_mut(&id) {
                actor.reset();
            }
            let name = self.cast.character_name(id).to_owned();
            self.note(Cause::BodyDiverged, Effect::of(name, CharacterEffect::PutBack));
        }
    }
}

impl Stage {
    /// Joints that broke in the last step; those that were cut are noted by the command.
    fn note_breaks(&mut self) {
        self.note_broken_holds();
        let is_news =
            |(joint, _): &(PropJointId, &str)| !self.world.prop_joint(*joint).is_whole && !self.broken.contains(joint);
        let news: Vec<(PropJointId, String)> =
            self.cast.joints().filter(is_news).map(|(joint, name)| (joint, name.to_owned())).collect();
        for (joint, name) in news {
            self.broken.insert(joint);
            self.note(Cause::JointOverload { joint: name.clone() }, Effect::JointBreaks { joint: name });
        }
    }
}

/// The scene's own commands from a step on, the next one last.
pub(crate) fn timed_orders(
    scene: &Scene,
    cast: &Cast,
    from_step: u64,
    step_secs: f64,
) -> Result<Vec<(u64, usize, Order)>, StageError> {
    let resolver = Resolver { scene, cast };
    let mut timed = Vec::new();
    for one in &scene.at {
        let order = resolver
            .resolve(&one.command)
            .map_err(|error| at(scene, StageErrorKind::Refused, "at".to_owned(), error))?;
        timed.push((step_of(one.at_secs, step_secs), one.line, order));
    }
    timed.retain(|(step, ..)| *step >= from_step);
    // Those of one step keep the file's order; the next one lies at the end.
    timed.sort_by_key(|(step, ..)| *step);
    timed.reverse();
    Ok(timed)
}

/// The error for a character that was removed.
pub(crate) fn gone(id: CharacterId) -> OrderError {
    OrderError::new(OrderErrorKind::NotFound, format!("character {id} is not there any more"))
}

/// Commands that are remembered for undo.
const MAX_HISTORY: usize = 1_000;

/// Commands that may wait for a step.
const MAX_INBOX: usize = 10_000;
