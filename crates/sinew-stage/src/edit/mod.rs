//! A scene's text is edited, and the running stage follows as far as it can without a restart.
//!
//! Values become commands (`follow`), which are carried out, recorded and undone like any others. What comes, goes or is read anew
//! changes the stage between two steps (`restructure`), after a plan (`plan`), and is recorded as the command `edit` with the whole text:
//! so a take of an edited run replays.

mod difference;
mod follow;
mod outcome;
mod plan;
mod restructure;

pub use outcome::{EditError, EditOutcome, Edited, RestartReason};

use crate::Stage;
use crate::event::{Cause, Effect};
use crate::scene::Scene;
use crate::take::{self, Stamped};
use difference::{differences, put, table};
use follow::{Followed, follow};
use sinew_control::{Action, Command, OrderError, OrderErrorKind};
use toml::Table;

/// An edited text, compared with what runs.
struct Edit {
    /// The scene that runs from now on: the edited one without what needs a restart.
    scene: Scene,
    /// Its text as a table.
    running: Table,
    edited: Vec<Edited>,
    commands: Vec<Command>,
    /// More than values change.
    is_structural: bool,
}

impl Stage {
    /// Takes an edited text of the scene: the stage follows what it can. Says for every key that differs from what runs whether it
    /// does, and if not, why.
    ///
    /// *From the next step on*, as commands that can be undone: gains, gravity of characters and props, reflexes, layers, sources,
    /// tracker, controller, plane, settings and weights of `kd`, places and velocities of props, motors, key bindings.
    ///
    /// *At once*, between two steps: characters, props, joints and ropes come and go; a prop becomes heavier or another shape where it
    /// is now, unless something is fastened to it; joints and ropes that changed are made anew where their things are now; gravity, poses, graphs,
    /// shapes, aliases, joints' springs and controllers' texts are read anew; `[[when]]` and what is still to come of `[[at]]` follow.
    ///
    /// What a character or prop that is removed held, or was held by, is let go; its timed effects and its controller end; commands for it
    /// are refused from then on (`NotFound`); a reach for it stays where it was aimed. Its id is stale, and its slot in the frame vacant until
    /// something else comes.
    ///
    /// Files that the scene has read already are not read again. A [`Recording`](crate::Recording) goes on, with the newcomers.
    ///
    /// ```
    /// use sinew_stage::scene::SceneDocument;
    /// use sinew_stage::{EditOutcome, RestartReason, Scene, Stage};
    /// let text = "format = 1\n[characters.one] # she boxes\nmass_kg = 60\n";
    /// let mut stage = Stage::new(Scene::from_text(text)?, None)?;
    /// stage.step();
    /// let mut document = SceneDocument::parse(text)?;
    /// document.set("characters.one.pose_gain", "0.5")?;
    /// document.set("characters.one.mass_kg", "70")?;
    /// document.set("props.ball", "{ ball_radius_m = 0.1, mass_kg = 1, position_m = [0, 2, 0.1] }")?;
    /// let edited = stage.edit(&document.to_string())?;
    /// let outcomes: Vec<(&str, EditOutcome)> = edited.iter().map(|one| (one.path.as_str(), one.outcome)).collect();
    /// assert_eq!(
    ///     outcomes,
    ///     [
    ///         ("characters.one.mass_kg", EditOutcome::NeedsRestart(RestartReason::Body)),
    ///         ("characters.one.pose_gain", EditOutcome::Applied),
    ///         ("props.ball", EditOutcome::Applied),
    ///     ]
    /// );
    /// assert!(stage.cast().prop("ball").is_some());
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// A text that is no sound scene, also without what needs a restart; or something new that cannot be built. Nothing is changed then.
    pub fn edit(&mut self, text: &str) -> Result<Vec<Edited>, EditError> {
        let Edit { scene, running, edited, commands, is_structural } = self.compare(text)?;
        let keys = scene.keys.clone();
        if is_structural {
            self.restructure(scene)?;
            self.record_edit(text);
        }
        commands.into_iter().for_each(|command| self.command(command));
        self.keys = keys;
        self.running = Some(running);
        Ok(edited)
    }

    /// Edits that are prescribed for a step, before anything else of it: as in the run that was recorded.
    pub(crate) fn edit_as_prescribed(&mut self, step: u64) {
        let due = take::due(self.prescribed.as_deref().unwrap_or_default(), step);
        let texts: Vec<String> = due.iter().filter_map(|one| edit_text(&one.command)).map(str::to_owned).collect();
        for text in texts {
            // One that was given just before a snapshot is in it.
            let known = take::due(&self.record, step);
            if known.iter().any(|one| edit_text(&one.command) == Some(&text)) {
                continue;
            }
            let done = self.compare(&text).and_then(|edit| {
                self.restructure(edit.scene)?;
                self.running = Some(edit.running);
                Ok(())
            });
            match done {
                Ok(()) => self.record_edit(&text),
                Err(error) => {
                    let error = OrderError::new(OrderErrorKind::WrongState, error.to_string());
                    self.note(Cause::Command, Effect::Refused(error));
                }
            }
        }
    }

    fn record_edit(&mut self, text: &str) {
        if self.records {
            let command = Command::stage(Action::Edit { text: text.to_owned() });
            self.record.push(Stamped { step: self.world.frame().step, command });
        }
    }

    fn compare(&self, text: &str) -> Result<Edit, EditError> {
        let new = self.first_scene.with_text(text, &self.edit_files)?;
        let mut running = match &self.running {
            Some(running) => running.clone(),
            None => table(self.first_scene.text()),
        };
        let wanted = table(text);
        let (mut edited, mut commands) = (Vec::new(), Vec::<Command>::new());
        let (mut is_structural, mut is_whole) = (false, true);
        for path in differences(&running, &wanted) {
            let keys: Vec<&str> = path.iter().map(String::as_str).collect();
            let outcome = match follow(&self.scene, &new, &keys) {
                Ok(followed) => {
                    put(&mut running, &keys, &wanted);
                    is_structural |= matches!(followed, Followed::Structure(_));
                    let (Followed::Values(more) | Followed::Structure(more)) = followed;
                    // Two keys of one command ask for it twice.
                    more.into_iter().for_each(|command| {
                        if !commands.contains(&command) {
                            commands.push(command);
                        }
                    });
                    EditOutcome::Applied
                }
                Err(reason) => {
                    is_whole = false;
                    EditOutcome::NeedsRestart(reason)
                }
            };
            edited.push(Edited { path: path.join("."), outcome });
        }
        edited.extend(self.overdue(&new));
        let scene = if is_whole || !is_structural {
            new
        } else {
            let text = toml::to_string(&running).unwrap_or_default();
            let mut scene = self.first_scene.with_text(&text, &self.edit_files)?;
            scene.take_lines_of(&new);
            scene
        };
        Ok(Edit { scene, running, edited, commands, is_structural })
    }

    /// New commands of `[[at]]` whose time is over.
    fn overdue(&self, new: &Scene) -> Vec<Edited> {
        let now_secs = self.world.frame().time_secs;
        let old = &self.scene.at;
        let is_known = |one: &crate::scene::Timed| {
            old.iter().any(|known| (known.at_secs, &known.command) == (one.at_secs, &one.command))
        };
        let overdue = new.at.iter().enumerate().filter(|(_, one)| one.at_secs < now_secs && !is_known(one));
        let edited = |(index, _)| Edited {
            path: format!("at.{index}"),
            outcome: EditOutcome::NeedsRestart(RestartReason::Past),
        };
        overdue.map(edited).collect()
    }
}

/// The text of a command `edit`.
pub(crate) fn edit_text(command: &Command) -> Option<&str> {
    match &command.action {
        Action::Edit { text } => Some(text),
        _ => None,
    }
}
