//! The whole state of a stage in memory: taken between two steps, restored to the same bits.

use crate::actor::Actor;
use crate::cast::Cast;
use crate::event::Events;
use crate::order::{Order, ShapeChoice};
use crate::reaction::Reactions;
use crate::run_hash::RunHash;
use crate::scene::{KeyBinding, Scene};
use crate::scripts::{KeptScript, Owner};
use crate::take::Stamped;
use crate::timed_effect::TimedEffects;
use crate::{Cause, Effect, Stage};
use sinew_body::humanoid::Node;
use sinew_control::{Command, OrderError};
use sinew_script::ScriptError;
use sinew_world::{CharacterId, PartShape, PropJointId, World};
use std::collections::{BTreeMap, BTreeSet};
use std::fmt;
use std::sync::Arc;

/// The state of a stage between two steps; see [`Stage::snapshot`].
///
/// It is a value in memory: what does not change (meshes, clips, poses) is shared with the stage. [`StageSnapshot::to_bytes`] makes it
/// bytes for a file. To hand a run to somebody else, hand over its [`Take`](crate::Take).
#[derive(Clone)]
pub struct StageSnapshot {
    /// The scene that the stage was made from.
    pub(crate) scene: Arc<Scene>,
    /// The scene that ran, as edited, and its cast.
    pub(crate) running_scene: Arc<Scene>,
    pub(crate) cast: Cast,
    pub(crate) world: World,
    pub(crate) actors: BTreeMap<CharacterId, Actor>,
    pub(crate) timed_effects: TimedEffects,
    pub(crate) shapes: BTreeMap<(CharacterId, Node), (ShapeChoice, PartShape)>,
    pub(crate) events: Events,
    pub(crate) reactions: Reactions,
    pub(crate) broken: BTreeSet<PropJointId>,
    pub(crate) running: Option<toml::Table>,
    pub(crate) keys: Vec<KeyBinding>,
    pub(crate) timed: Vec<(u64, usize, Order)>,
    pub(crate) hash: RunHash,
    pub(crate) inbox: Vec<(Command, bool)>,
    pub(crate) history: Vec<Vec<Order>>,
    pub(crate) record: Vec<Stamped>,
    pub(crate) scripts: Vec<KeptScript>,
}

/// Why a snapshot is not restored.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum RestoreError {
    /// The snapshot is of another scene, or of the same one with other files or values. Nothing was changed.
    #[error(
        "the snapshot was taken of another scene, or of this one with other files or other values set; load that scene"
    )]
    OtherScene,
    /// A controller's process does not start. All else was restored; the character or prop has no controller.
    #[error("a controller cannot be started again: {0}")]
    Start(#[from] OrderError),
    /// A controller does not take its state. All else was restored; the controller is stopped.
    #[error("a controller's state cannot be restored: {0}")]
    Script(#[from] ScriptError),
}

impl StageSnapshot {
    /// Physics steps that were done when it was taken.
    pub fn step(&self) -> u64 {
        self.world.frame().step
    }

    /// The stage's time when it was taken \[s\].
    pub fn time_secs(&self) -> f64 {
        self.world.frame().time_secs
    }

    /// The stage's hash when it was taken.
    pub fn hash(&self) -> u64 {
        self.hash.digest()
    }

    /// What it could not keep of the controllers' state, such as `Dunk: self.gait (generator)`. After a restore this is as reading the
    /// controller's text and making its object leave it.
    pub fn lost(&self) -> Vec<String> {
        let lost = |script: &KeptScript| {
            script.state.lost().iter().map(|what| format!("{}: {what}", script.name)).collect::<Vec<_>>()
        };
        self.scripts.iter().flat_map(lost).collect()
    }

    /// Whether it is of this scene, with the same files and values.
    pub(crate) fn is_of(&self, scene: &Arc<Scene>) -> bool {
        Arc::ptr_eq(&self.scene, scene) || self.scene.is_same_as(scene)
    }
}

impl fmt::Debug for StageSnapshot {
    fn fmt(&self, to: &mut fmt::Formatter<'_>) -> fmt::Result {
        let hash = format_args!("{:016x}", self.hash()).to_string();
        to.debug_struct("StageSnapshot").field("step", &self.step()).field("hash", &hash).finish_non_exhaustive()
    }
}

impl Stage {
    /// The whole state between two steps. Restored into this stage, or into one that was made of the same scene, it goes on to the same
    /// bits. Controllers in Python are asked for their state, as far as it can be had ([`StageSnapshot::lost`]); one that does not
    /// answer in time is stopped, as in a step. Nothing else changes.
    ///
    /// ```
    /// use sinew_stage::{Scene, Stage};
    /// let scene = Scene::from_text("format = 1\n[props.ball]\nball_radius_m = 0.1\nmass_kg = 1\nposition_m = [0, 1, 0]")?;
    /// let mut stage = Stage::new(scene, None)?;
    /// let start = stage.snapshot();
    /// (0..100).for_each(|_| stage.step());
    /// let hash = stage.hash();
    ///
    /// stage.restore(&start)?;
    /// assert_eq!(stage.frame().step, 0);
    /// (0..100).for_each(|_| stage.step());
    /// assert_eq!(stage.hash(), hash);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn snapshot(&mut self) -> StageSnapshot {
        let scripts = self.keep_scripts();
        StageSnapshot {
            inbox: self.inbox.clone(),
            history: self.history.clone(),
            record: self.record.clone(),
            scripts,
            ..self.snapshot_of_run()
        }
    }

    /// As [`Stage::snapshot`], without what came from outside (waiting commands, undo, the record) and without controllers: for a
    /// [`Timeline`](crate::Timeline), which knows the commands.
    pub(crate) fn snapshot_of_run(&self) -> StageSnapshot {
        StageSnapshot {
            scene: Arc::clone(&self.first_scene),
            running_scene: Arc::clone(&self.scene),
            cast: self.cast.clone(),
            world: self.world.clone(),
            actors: self.actors.clone(),
            timed_effects: self.timed_effects.clone(),
            shapes: self.shapes.clone(),
            events: self.events.clone(),
            reactions: self.reactions.clone(),
            broken: self.broken.clone(),
            running: self.running.clone(),
            keys: self.keys.clone(),
            timed: self.timed.clone(),
            hash: self.hash.clone(),
            inbox: Vec::new(),
            history: Vec::new(),
            record: Vec::new(),
            scripts: Vec::new(),
        }
    }

    /// Takes everything back to where a snapshot was taken: also events, the record, and commands that wait for the next step. What was
    /// given by [`Stage::prescribe`] stays prescribed.
    ///
    /// # Errors
    /// When the snapshot is of another scene: nothing is changed then. When a controller cannot be restored: all else is.
    pub fn restore(&mut self, snapshot: &StageSnapshot) -> Result<(), RestoreError> {
        if !snapshot.is_of(&self.first_scene) {
            return Err(RestoreError::OtherScene);
        }
        self.put_back(snapshot);
        self.inbox.clone_from(&snapshot.inbox);
        self.history.clone_from(&snapshot.history);
        self.record.clone_from(&snapshot.record);
        let restored = self.restore_scripts(&snapshot.scripts);
        let lost = snapshot.lost();
        if !lost.is_empty() {
            self.note(Cause::Restored, Effect::StateLost { names: lost });
        }
        restored
    }

    /// As [`Stage::restore`], without what came from outside and without controllers.
    pub(crate) fn put_back(&mut self, snapshot: &StageSnapshot) {
        self.scene = Arc::clone(&snapshot.running_scene);
        // Of another stage it may hold files that this one has not read; its take needs them.
        self.edit_files.extend(self.scene.files().iter().map(|(path, held)| (path.clone(), held.clone())));
        self.cast.clone_from(&snapshot.cast);
        self.world = snapshot.world.clone();
        self.actors.clone_from(&snapshot.actors);
        self.timed_effects.clone_from(&snapshot.timed_effects);
        self.shapes.clone_from(&snapshot.shapes);
        self.events.clone_from(&snapshot.events);
        self.reactions.clone_from(&snapshot.reactions);
        self.broken.clone_from(&snapshot.broken);
        self.running.clone_from(&snapshot.running);
        self.keys.clone_from(&snapshot.keys);
        self.timed.clone_from(&snapshot.timed);
        self.hash.clone_from(&snapshot.hash);
    }

    /// Asks every controller for its state. One that does not answer is stopped; the take says so, as of a step.
    fn keep_scripts(&mut self) -> Vec<KeptScript> {
        let step = self.world.frame().step;
        let mut kept = Vec::new();
        for owner in self.owners() {
            let Some(running) = self.scripts.get_mut(&owner) else { continue };
            let name = running.name.clone();
            let state = match running.script.state() {
                Ok(state) => state,
                Err(error) => {
                    // Its process has ended: it is asked for nothing any more, and cannot fail again.
                    let state = running.script.state().unwrap_or_default();
                    self.note_kill(step, &name, error.message);
                    state
                }
            };
            kept.push(KeptScript { owner, name, state });
        }
        kept
    }

    fn restore_scripts(&mut self, kept: &[KeptScript]) -> Result<(), RestoreError> {
        let is_kept = |owner: Owner, name: &str| kept.iter().any(|one| one.owner == owner && one.name == name);
        self.scripts.retain(|owner, running| is_kept(*owner, &running.name));
        // One that fails must not keep the others from going on.
        let mut restored = Ok(());
        for KeptScript { owner, name, state } in kept {
            if !self.scripts.contains_key(owner) {
                match self.start_script(name, self.owner_name(*owner)) {
                    Ok(running) => drop(self.scripts.insert(*owner, running)),
                    Err(error) => restored = Err(error.into()),
                }
            }
            if let Some(running) = self.scripts.get_mut(owner)
                && let Err(error) = running.script.restore(state)
            {
                restored = Err(error.into());
            }
        }
        restored
    }
}
