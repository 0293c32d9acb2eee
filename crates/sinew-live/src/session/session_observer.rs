//! What a session does around each step of its stage.

use super::limits::MAX_SCENE;
use super::server::SceneManifest;
use super::stage_queue::{Order, Placed, StageQueue};
use super::{SessionError, note_hash};
use sinew_control::{Action, Command};
use sinew_stage::take::{Take, TakeFile};
use sinew_stage::{Observer, Scene, Stage};
use std::collections::BTreeMap;
use std::sync::Arc;

impl SceneManifest {
    /// What has to be told of a scene.
    ///
    /// # Errors
    /// A scene whose files are too large to be sent.
    pub fn of(scene: &Scene) -> Result<SceneManifest, SessionError> {
        let mut take = Take::of(scene);
        // A take may leave large files to the disk; here there is none on the other side.
        for (path, held) in scene.files() {
            take.files.insert(path.clone(), TakeFile { hash: held.hash, bytes: Some(Arc::clone(&held.bytes)) });
        }
        let bytes = take.to_bytes().map_err(|error| SessionError::Machine(error.to_string()))?;
        if bytes.len() > MAX_SCENE {
            let problem =
                format!("the scene and its files have {} bytes, of {MAX_SCENE} that can be sent", bytes.len());
            return Err(SessionError::Machine(format!("{problem}; use shorter clips")));
        }
        let mut keys: BTreeMap<String, Vec<Command>> = BTreeMap::new();
        for binding in &scene.keys {
            keys.entry(binding.key.clone()).or_default().push(binding.command.clone());
        }
        Ok(SceneManifest {
            scene: bytes.into(),
            actors: scene.characters.keys().cloned().collect(),
            keys,
            physics_hz: scene.stage.physics_hz,
            seed: scene.stage.seed,
            rules: Some(Arc::new(scene.clone())),
        })
    }
}

/// Ties a session's queue to a stage: an [`Observer`] that hands the stage what clients sent, and the clients what came of it.
///
/// ```
/// use sinew_live::session::{SceneManifest, Server, ServerSettings, SessionObserver};
/// use sinew_stage::{Runner, Scene, Stage};
/// let scene = Scene::from_text("format = 1\n[characters.red]\n")?;
/// let settings = ServerSettings { bind: "127.0.0.1:0".parse()?, ..ServerSettings::default() };
/// let (_server, queue) = Server::open(&settings, SceneManifest::of(&scene)?)?;
/// let mut runner = Runner::new(Stage::new(scene, None)?).paced();
/// let mut session_observer = SessionObserver::new(queue, runner.stage());
/// runner.run(8, &mut [&mut session_observer]);
/// assert_eq!(runner.stage().frame().step, 8);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub struct SessionObserver {
    queue: StageQueue,
    steps_per_frame: u64,
    has_obeyed: bool,
    hashes: BTreeMap<u64, String>,
    applied: Vec<AppliedCommand>,
}

/// A command or key that was applied, for the report.
#[derive(Clone, Debug, PartialEq, Eq, serde::Serialize)]
pub struct AppliedCommand {
    /// A key, or the command's word.
    pub what: String,
    /// Whose client sent it.
    pub by: String,
    /// Physics steps that were done when it arrived.
    pub arrived_step: u64,
    /// Physics steps that were done before the one that applied it; it stands in the take so.
    pub step: u64,
}

/// AppliedCommand commands that are kept; of more the last.
const MAX_OBEYED: usize = 1_000;

impl SessionObserver {
    /// A queue for a stage.
    pub fn new(queue: StageQueue, stage: &Stage) -> SessionObserver {
        let steps_per_frame = u64::from(stage.scene().stage.steps_per_frame()).max(1);
        let mut session_observer =
            SessionObserver { queue, steps_per_frame, has_obeyed: false, hashes: BTreeMap::new(), applied: Vec::new() };
        session_observer.after_step(stage);
        session_observer
    }

    /// [`Frame::hash`](sinew_world::Frame::hash) by step, as [`ClientStats::hashes`](super::ClientStats::hashes) of a client has them.
    pub fn hashes(&self) -> &BTreeMap<u64, String> {
        &self.hashes
    }

    /// Commands and keys of clients that were applied, performance left out: the last thousand.
    pub fn applied(&self) -> &[AppliedCommand] {
        &self.applied
    }
}

impl Observer for SessionObserver {
    /// Hands the stage what has arrived.
    fn before_step(&mut self, stage: &mut Stage) {
        self.has_obeyed = false;
        let step = stage.frame().step;
        for Placed { order, by, arrived_step } in self.queue.orders_of_step() {
            let what = match order {
                Order::Press(key) => {
                    stage.press(&key);
                    key
                }
                Order::Command(command) => {
                    let is_sample = matches!(command.action, Action::Perform { .. });
                    let what = (!is_sample).then(|| word(&command));
                    stage.command(command);
                    let Some(what) = what else { continue };
                    what
                }
            };
            self.has_obeyed = true;
            if self.applied.len() >= MAX_OBEYED {
                self.applied.remove(0);
            }
            self.applied.push(AppliedCommand { what, by: by.to_string(), arrived_step, step });
        }
    }

    /// Shows what has come of it: at the motion rate, and at once when somebody was applied, so that a pull is seen without
    /// waiting for the next frame.
    fn after_step(&mut self, stage: &Stage) {
        let frame = stage.frame();
        self.queue.done(frame.step);
        note_hash(&mut self.hashes, frame.step, frame.hash());
        if self.has_obeyed || frame.step.is_multiple_of(self.steps_per_frame) {
            self.queue.publish(frame);
        }
    }

    /// Whether somebody asked for the end.
    fn should_stop(&self) -> bool {
        self.queue.should_stop()
    }
}

/// What a command is called in scenes.
fn word(command: &Command) -> String {
    let action = serde_json::to_value(&command.action).unwrap_or_default();
    action.get("do").and_then(|word| word.as_str()).unwrap_or_default().to_owned()
}
