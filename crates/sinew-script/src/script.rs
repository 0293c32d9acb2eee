//! A Python controller: the stage's side.

use crate::process::Process;
use crate::protocol::{self, MAX_REQUEST, MAX_SOURCE, Reply, Request};
use crate::state::ScriptState;
use crate::{Limits, Names, ScriptError, ScriptErrorKind as Kind, Snapshot, StartInfo};
use sinew_control::Command;
use std::path::{Path, PathBuf};
use std::time::Duration;

/// What brings the host program there, as an error's remedy.
pub(crate) const BUILD_IT: &str = "`cargo build --release -p sinew-script-host` in Sinew's repository puts it beside a release build of `sinew` (without \
     --release, beside a debug build), `cargo install --path crates/sinew-script-host` into the PATH";

/// How the child is started and limited.
#[derive(Clone, Debug)]
pub struct ScriptHost {
    /// The program `sinew-script-host`, of the same version as this library.
    pub program: PathBuf,
    /// Its arguments; it needs none.
    pub args: Vec<String>,
    /// How much the script may use.
    pub limits: Limits,
}

impl ScriptHost {
    /// The host program beside the running program, else in a folder of `PATH`; `None` when it is in neither. With the default
    /// [`Limits`].
    ///
    /// ```
    /// // Controllers are refused with [`ScriptHost::missing`] where it is not built.
    /// let host = sinew_script::ScriptHost::find();
    /// assert!(host.is_none_or(|host| host.program.is_file()));
    /// ```
    pub fn find() -> Option<ScriptHost> {
        let own = std::env::current_exe().ok();
        let beside = own.as_deref().and_then(Path::parent).map(Path::to_owned);
        let path = std::env::var_os("PATH").unwrap_or_default();
        let name = format!("sinew-script-host{}", std::env::consts::EXE_SUFFIX);
        let mut places = beside.into_iter().chain(std::env::split_paths(&path)).map(|folder| folder.join(&name));
        let program = places.find(|program| program.is_file())?;
        Some(ScriptHost { program, args: Vec::new(), limits: Limits::default() })
    }

    /// Why a stage without a host refuses a controller, and what to do.
    pub fn missing() -> String {
        format!("Python controllers run in the program sinew-script-host, which is not there; {BUILD_IT}")
    }
}

/// The outcome of a step.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct StepOutcome {
    /// Commands of the script, in order, including those before an error.
    pub commands: Vec<Command>,
    /// Lines that it printed.
    pub printed: Vec<String>,
    /// An exception that left `start()` or `step()`: the controller has stopped.
    pub error: Option<ScriptError>,
    /// Why the child was killed, if it was: the controller has stopped.
    pub killed: Option<String>,
}

/// A controller in Python. After an error, a kill or a crash it stays stopped, its steps do nothing and cost nothing, until
/// it is reloaded. Dropped, it ends its process.
#[derive(Debug)]
pub struct Script {
    host: ScriptHost,
    info: StartInfo,
    process: Option<Process>,
    /// No error yet since the text was read.
    is_running: bool,
    /// `start()` has not been called yet.
    is_new: bool,
    /// Lines printed while the text was read; they go with the next step.
    printed: Vec<String>,
}

impl Script {
    /// Starts a process, reads the text there and makes an object of its class. `start()` is called in the first
    /// [`Script::step`], where there is something to sense.
    ///
    /// # Errors
    /// When there is no such program, when the text is not Python, has no such class, raises or does not come back.
    pub fn start(host: ScriptHost, info: &StartInfo) -> Result<Script, ScriptError> {
        let mut script =
            Script { host, info: info.clone(), process: None, is_running: false, is_new: true, printed: Vec::new() };
        script.read(None)?;
        Ok(script)
    }

    /// Calls `start()` if that is still to be done, then `step()`. Returns within the time of [`Limits`] and never
    /// panics.
    pub fn step(&mut self, snapshot: &Snapshot) -> StepOutcome {
        let limit = if self.is_new { self.host.limits.startup() } else { self.host.limits.step() };
        let Some(process) = self.process.as_mut().filter(|_| self.is_running) else {
            return StepOutcome::default();
        };
        if !snapshot.fits(&self.info.names) {
            self.is_running = false;
            return StepOutcome {
                error: Some(self.error(Kind::Names, "the snapshot does not fit the names that it knows")),
                ..StepOutcome::default()
            };
        }
        self.is_new = false;
        match ask(process, &Request::Step(snapshot), limit, self.host.limits.commands) {
            Ok((commands, mut reply)) => {
                self.is_running = reply.error.is_none();
                let mut printed = std::mem::take(&mut self.printed);
                printed.append(&mut reply.printed);
                StepOutcome { commands, printed, error: reply.error, killed: None }
            }
            Err(reason) => {
                self.kill();
                let printed = std::mem::take(&mut self.printed);
                StepOutcome { printed, killed: Some(reason), ..StepOutcome::default() }
            }
        }
    }

    /// Continues with another text. The class's `reload(self, old)` is called in the next step if it has one, else
    /// `start()`. If the text is invalid, the present controller continues; only a text that does not return stops it
    /// too.
    ///
    /// # Errors
    /// As [`Script::start`].
    pub fn reload(&mut self, text: &str) -> Result<(), ScriptError> {
        self.read(Some(text))
    }

    /// Other names from now on, such as those of a scene that was edited. Costs a round trip to the process, and the script sees nothing
    /// of it.
    ///
    /// # Errors
    /// When the process does not answer in time; it is killed then, as for a step.
    pub fn set_names(&mut self, names: Names) -> Result<(), ScriptError> {
        self.info.names = names;
        let limit = self.host.limits.step();
        if let Some(process) = self.process.as_mut()
            && let Err(reason) = ask(process, &Request::Names(&self.info.names), limit, 0)
        {
            self.kill();
            return Err(self.error(Kind::Host, &reason));
        }
        Ok(())
    }

    /// What is kept of the script; [`Script::restore`] gives it back. Costs a round trip to the process, and the script sees nothing
    /// of it.
    ///
    /// # Errors
    /// When the process does not answer in time; it is killed then, as for a step.
    pub fn state(&mut self) -> Result<ScriptState, ScriptError> {
        let mut state = ScriptState {
            source: self.info.source.clone(),
            is_running: self.is_running,
            is_new: self.is_new,
            printed: self.printed.clone(),
            ..ScriptState::default()
        };
        let limit = self.host.limits.step();
        if let Some(process) = self.process.as_mut().filter(|_| self.is_running) {
            match ask(process, &Request::Save, limit, 0) {
                Ok((_, reply)) => (state.content, state.lost) = (reply.state, reply.lost),
                Err(reason) => {
                    self.kill();
                    return Err(self.error(Kind::Host, &reason));
                }
            }
        }
        Ok(state)
    }

    /// Reads the text of a state anew, makes an object of it and gives it the state. What the state could not hold is as reading the
    /// text and making the object leave it. A script that had stopped is stopped.
    ///
    /// # Errors
    /// When the text does not come back, or the state does not fit it; the script is stopped then.
    pub fn restore(&mut self, state: &ScriptState) -> Result<(), ScriptError> {
        self.info.source.clone_from(&state.source);
        if !state.is_running {
            self.kill();
        } else {
            if self.process.is_none() {
                self.read(None)?;
            }
            let request = Request::Restore(&state.source, &state.content);
            let Some(process) = self.process.as_mut() else {
                return Err(self.error(Kind::Host, "its process has ended"));
            };
            let error = match ask(process, &request, self.host.limits.startup(), 0) {
                Ok((_, reply)) => reply.error,
                Err(reason) => Some(self.error(Kind::Host, &reason)),
            };
            if let Some(error) = error {
                self.kill();
                return Err(error);
            }
            self.is_running = true;
        }
        // Without any state it starts anew.
        self.is_new = state.is_new || state.content.is_empty();
        self.printed.clone_from(&state.printed);
        Ok(())
    }

    /// Ends the process; the controller is stopped until it is reloaded.
    pub fn kill(&mut self) {
        self.process = None;
        self.is_running = false;
    }

    /// Whether the next step will call it.
    pub fn is_running(&self) -> bool {
        self.is_running
    }

    /// Has a text read: another one, or that of the start.
    fn read(&mut self, text: Option<&str>) -> Result<(), ScriptError> {
        if text.unwrap_or(&self.info.source).len() > MAX_SOURCE {
            return Err(self.error(Kind::TooLarge, &format!("the text is longer than {MAX_SOURCE} bytes")));
        }
        let before = text.map(|text| std::mem::replace(&mut self.info.source, text.to_owned()));
        let limits = self.host.limits;
        let is_old = self.process.is_some();
        let mut process = match self.process.take() {
            Some(process) => process,
            None => {
                Process::start(&self.host.program, &self.host.args).map_err(|reason| self.error(Kind::Host, &reason))?
            }
        };
        let request = if is_old { Request::Reload(&self.info.source) } else { Request::Start(&self.info, limits) };
        match ask(&mut process, &request, limits.startup(), 0) {
            Ok((_, mut reply)) => {
                self.printed.append(&mut reply.printed);
                // A few steps' worth, in case no step is taken in between.
                self.printed.truncate(4 * limits.printed_lines);
                if let Some(error) = reply.error {
                    if let Some(before) = before {
                        self.info.source = before;
                    }
                    // A fresh process has no controller so far that could go on.
                    self.process = is_old.then_some(process);
                    return Err(error);
                }
                self.process = Some(process);
                self.is_running = true;
                self.is_new = true;
                Ok(())
            }
            Err(reason) => {
                self.kill();
                Err(self.error(Kind::Host, &reason))
            }
        }
    }

    fn error(&self, kind: Kind, message: &str) -> ScriptError {
        ScriptError { kind, file: self.info.file.clone(), line: None, message: message.to_owned() }
    }
}

/// One request and its answer, or the reason why there is no valid one.
fn ask(
    process: &mut Process,
    request: &Request<'_>,
    limit: Duration,
    most: usize,
) -> Result<(Vec<Command>, Reply), String> {
    let request = protocol::message(request, MAX_REQUEST).map_err(|error| error.to_string())?;
    let reply = process.ask(&request, limit)?;
    let nonsense = |error: String| format!("its process sent an invalid message: {error}");
    let reply: Reply = protocol::content(&reply).map_err(|error| nonsense(error.to_string()))?;
    let commands: Vec<Command> = if reply.commands.is_empty() {
        Vec::new()
    } else {
        serde_json::from_slice(&reply.commands).map_err(|error| nonsense(error.to_string()))?
    };
    if commands.len() > most {
        return Err(nonsense(format!("{} commands; the maximum is {most}", commands.len())));
    }
    Ok((commands, reply))
}
