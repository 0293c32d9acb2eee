//! Python controllers on the stage: started, stepped, reloaded, stopped.

use crate::Stage;
use crate::sight::{names, snapshot};
use sinew_control::{Action, Command, Layer};
use sinew_script::{Script, StartInfo};

/// A controller that runs a character.
pub(crate) struct Running {
    /// Its name in the scene.
    pub name: String,
    pub script: Script,
}

impl Stage {
    /// Starts a controller of the scene for a character, in place of the one it has; with an empty name stops that one.
    pub(crate) fn start_controller(&mut self, character: usize, name: &str) -> Result<(), String> {
        if name.is_empty() {
            self.actors[character].script = None;
            return Ok(());
        }
        let known = || self.scene.controllers.keys().cloned().collect::<Vec<_>>().join(", ");
        let spec = self.scene.controllers.get(name);
        let spec = spec.ok_or_else(|| format!("no controller `{name}`; there are {}", known()))?;
        let source = self.scene.controller_text(name).unwrap_or_default().to_owned();
        let info = StartInfo {
            source,
            file: spec.file.clone().unwrap_or_else(|| format!("controllers.{name}")),
            class: spec.class.clone().unwrap_or_else(|| name.to_owned()),
            own: self.cast.characters()[character].clone(),
            seed: self.scene.stage.seed,
            names: names(&self.scene, &self.cast),
        };
        let host = self.host.clone().ok_or("this program runs no Python controllers")?;
        let script = Script::start(host, &info).map_err(|error| error.to_string())?;
        self.actors[character].script = Some(Running { name: name.to_owned(), script });
        Ok(())
    }

    /// Reads a controller's text again, for every character that it runs.
    pub(crate) fn reload(&mut self, name: &str, text: Option<&str>) -> Result<String, String> {
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
        for actor in &mut self.actors {
            if let Some(running) = actor.script.as_mut().filter(|running| running.name == name) {
                running.script.reload(&text).map_err(|error| format!("{error}; the old text goes on"))?;
                count += 1;
            }
        }
        if count == 0 {
            return Err(format!("no character is run by `{name}`"));
        }
        Ok(format!("{name} goes on with its new text"))
    }

    /// Stops a script that did not come back, or that did not when the take was recorded.
    pub(crate) fn kill_script(&mut self, name: &str, reason: &str) -> Result<String, String> {
        for actor in &mut self.actors {
            if let Some(running) = actor.script.as_mut().filter(|running| running.name == name) {
                running.script.kill();
            }
        }
        Ok(format!("{name} is stopped: {reason}"))
    }

    /// Calls every script that runs, in the order of the characters, and obeys it.
    pub(crate) fn step_scripts(&mut self, step: u64) {
        let runs = |actor: &crate::Actor| {
            actor.has_layer(Layer::Scripts) && actor.script.as_ref().is_some_and(|running| running.script.is_running())
        };
        if !self.actors.iter().any(runs) {
            return;
        }
        let seen = snapshot(&self.world);
        for index in 0..self.actors.len() {
            if !runs(&self.actors[index]) || self.is_to_be_killed(index, step) {
                continue;
            }
            let Some(running) = &mut self.actors[index].script else { continue };
            let name = running.name.clone();
            let outcome = running.script.step(&seen);
            for line in outcome.printed {
                self.note(format!("{name} prints"), line);
            }
            for command in outcome.commands {
                self.obey(&command, &name);
            }
            if let Some(error) = outcome.error {
                self.note(&name, format!("stopped by an error: {error}"));
            }
            if let Some(reason) = outcome.killed {
                let command = Command::stage(Action::ScriptKilled { name: name.clone(), reason: reason.clone() });
                self.record.push(crate::take::Stamped { step, command });
                self.note(&name, format!("stopped: {reason}"));
            }
        }
    }

    /// In a replay a script is stopped where it was stopped then, before it is called.
    fn is_to_be_killed(&mut self, index: usize, step: u64) -> bool {
        let Some(name) = self.actors[index].script.as_ref().map(|running| running.name.clone()) else { return false };
        let prescribed = crate::take::due(self.prescribed.as_deref().unwrap_or_default(), step);
        let kill = prescribed.iter().find(
            |timed| matches!(&timed.command.action, Action::ScriptKilled { name: killed, .. } if *killed == name),
        );
        let Some(kill) = kill.cloned() else { return false };
        self.record.push(kill.clone());
        if let Action::ScriptKilled { reason, .. } = &kill.command.action {
            let words = self.kill_script(&name, reason);
            self.note(&name, words.unwrap_or_default());
        }
        true
    }
}
