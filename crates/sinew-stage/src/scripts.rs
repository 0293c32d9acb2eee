//! Python controllers on the stage: started, stepped, reloaded, stopped.

use crate::Stage;
use crate::actor::Actor;
use crate::event::{Cause, Effect};
use crate::script_snapshot::{names, snapshot};
use sinew_control::{Action, Command, OrderError, OrderErrorKind};
use sinew_script::{Script, ScriptHost, ScriptState, StartInfo};
use sinew_snapshot::snapshot;
use sinew_world::{CharacterId, PropId};

/// What a controller runs.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Owner {
    Character(CharacterId),
    Prop(PropId),
}

/// What a snapshot keeps of a controller.
#[derive(Clone, Default)]
pub(crate) struct KeptScript {
    pub owner: Owner,
    /// Its name in the scene.
    pub name: String,
    pub state: ScriptState,
}

/// The first character.
impl Default for Owner {
    fn default() -> Owner {
        Owner::Character(CharacterId::default())
    }
}

snapshot!(enum Owner { 0: Character(id), 1: Prop(id) });
snapshot!(KeptScript { owner, name, state });

/// A controller that runs a character or a prop.
pub(crate) struct Running {
    /// Its name in the scene.
    pub name: String,
    pub script: Script,
}

impl Stage {
    /// Starts a controller of the scene for a prop.
    pub(crate) fn start_prop_controller(&mut self, prop: PropId, name: &str) -> Result<(), OrderError> {
        let running = self.start_script(name, self.owner_name(Owner::Prop(prop)))?;
        self.scripts.insert(Owner::Prop(prop), running);
        Ok(())
    }

    /// The name of what a controller runs.
    pub(crate) fn owner_name(&self, owner: Owner) -> String {
        match owner {
            Owner::Character(character) => self.cast.character_name(character).to_owned(),
            Owner::Prop(prop) => self.cast.prop_name(prop).to_owned(),
        }
    }

    pub(crate) fn start_script(&self, name: &str, own: String) -> Result<Running, OrderError> {
        let failed = |problem: String| OrderError::new(OrderErrorKind::Script, problem);
        let spec = self.scene.controllers.get(name);
        let spec = spec.ok_or_else(|| failed(format!("the scene has no controller `{name}` any more")))?;
        let source = self.scene.controller_text(name).unwrap_or_default().to_owned();
        let info = StartInfo {
            source,
            file: spec.file.clone().unwrap_or_else(|| format!("controllers.{name}")),
            class: spec.class.clone().unwrap_or_else(|| name.to_owned()),
            own,
            seed: self.scene.stage.seed,
            names: names(&self.scene, &self.cast, self.world.frame()),
        };
        let host = self.host.clone().ok_or_else(|| failed(ScriptHost::missing()))?;
        let script = Script::start(host, &info).map_err(|error| failed(error.to_string()))?;
        Ok(Running { name: name.to_owned(), script })
    }

    /// Everything that a controller runs: characters, then props.
    pub(crate) fn owners(&self) -> Vec<Owner> {
        self.scripts.keys().copied().collect()
    }

    fn running(&mut self, owner: Owner) -> Option<&mut Running> {
        self.scripts.get_mut(&owner)
    }

    /// Whether a controller is to be called.
    fn is_called(&mut self, owner: Owner) -> bool {
        let is_heard = match owner {
            Owner::Character(character) => self.actors.get(&character).is_some_and(Actor::hears_scripts),
            Owner::Prop(_) => true,
        };
        is_heard && self.running(owner).is_some_and(|running| running.script.is_running())
    }

    /// Reads a controller's text again, for everything that it runs.
    pub(crate) fn reload(&mut self, name: &str, text: Option<&str>) -> Result<Effect, OrderError> {
        let text = match text {
            Some(text) => text.to_owned(),
            None => self.scene.controller_text_again(name)?,
        };
        // What a take replays must not ask the disk again.
        if let Some(command) = self.record.iter_mut().rev().find(
            |timed| matches!(&timed.command.action, Action::Reload { name: reloaded, text: None } if reloaded == name),
        ) {
            command.command.action = Action::Reload { name: name.to_owned(), text: Some(text.clone()) };
        }
        let mut count = 0;
        for owner in self.owners() {
            if let Some(running) = self.running(owner).filter(|running| running.name == name) {
                running.script.reload(&text).map_err(|error| {
                    OrderError::new(OrderErrorKind::Script, format!("{error}; the old text goes on"))
                })?;
                count += 1;
            }
        }
        if count == 0 {
            return Err(OrderError::new(OrderErrorKind::WrongState, format!("nothing is run by `{name}`")));
        }
        Ok(Effect::Reloaded { controller: name.to_owned() })
    }

    /// Stops a script that did not come back, or that did not when the take was recorded.
    pub(crate) fn kill_script(&mut self, name: &str, reason: &str) -> Effect {
        for owner in self.owners() {
            if let Some(running) = self.running(owner).filter(|running| running.name == name) {
                running.script.kill();
            }
        }
        Effect::ScriptStopped { controller: name.to_owned(), reason: reason.to_owned() }
    }

    /// Calls every script that runs, in the order of the characters, then of the props, and applies its commands.
    pub(crate) fn step_scripts(&mut self, step: u64) {
        let owners = self.owners();
        if !owners.iter().any(|&owner| self.is_called(owner)) {
            return;
        }
        let seen = snapshot(&self.world, &self.cast);
        for owner in owners {
            if !self.is_called(owner) || self.is_to_be_killed(owner, step) {
                continue;
            }
            let Some(running) = self.running(owner) else { continue };
            let name = running.name.clone();
            let outcome = running.script.step(&seen);
            for line in outcome.printed {
                self.note(Cause::Print { controller: name.clone() }, Effect::Printed { line });
            }
            for command in outcome.commands {
                self.carry_out_command(&command, Cause::Script { controller: name.clone() });
            }
            if let Some(error) = outcome.error {
                self.note(Cause::Script { controller: name.clone() }, Effect::ScriptFailed { error });
            }
            if let Some(reason) = outcome.killed {
                self.note_kill(step, &name, reason);
            }
        }
    }

    /// A controller was killed by its limits, which depend on the machine: the take must say when.
    pub(crate) fn note_kill(&mut self, step: u64, name: &str, reason: String) {
        let command = Command::stage(Action::ScriptKilled { name: name.to_owned(), reason: reason.clone() });
        self.record.push(crate::take::Stamped { step, command });
        self.note(Cause::Script { controller: name.to_owned() }, Effect::ScriptKilled { reason });
    }

    /// In a replay a script is stopped where it was stopped then, before it is called.
    fn is_to_be_killed(&mut self, owner: Owner, step: u64) -> bool {
        let Some(name) = self.running(owner).map(|running| running.name.clone()) else { return false };
        let prescribed = crate::take::due(self.prescribed.as_deref().unwrap_or_default(), step);
        let kill = prescribed.iter().find(
            |timed| matches!(&timed.command.action, Action::ScriptKilled { name: killed, .. } if *killed == name),
        );
        let Some(kill) = kill.cloned() else { return false };
        self.record.push(kill.clone());
        if let Action::ScriptKilled { reason, .. } = &kill.command.action {
            let effect = self.kill_script(&name, reason);
            self.note(Cause::Script { controller: name }, effect);
        }
        true
    }
}

#[cfg(test)]
mod tests {
    use crate::event::{Cause, Effect};
    use crate::{Scene, Stage};
    use sinew_control::{Action, Command, OrderErrorKind};

    #[test]
    fn a_script_may_state_no_gain_that_a_scene_may_not() {
        let mut stage = Stage::new(Scene::from_text("format = 1\n[characters.one]").unwrap(), None).unwrap();
        let cause = Cause::Script { controller: "Limp".to_owned() };
        stage.carry_out_command(&Command::to("one", Action::Gain { factor: 1e30, part: None }), cause.clone());
        let event = &stage.events().list()[0];
        assert_eq!(event.cause, cause);
        let Effect::Refused(error) = &event.effect else { panic!("it is refused: {}", event.effect) };
        assert_eq!(error.kind(), OrderErrorKind::OutOfRange);
        assert!(stage.actors.values().all(|actor| actor.gain(None) == 1.0));
    }
}
