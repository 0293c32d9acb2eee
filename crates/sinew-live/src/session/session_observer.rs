//! What a session does around each step of its stage.

use super::limits::MAX_SCENE;
use super::server::SceneManifest;
use super::stage_queue::{ClientRequest, QueuedRequest, StageQueue};
use super::{SessionError, note_hash};
use sinew_control::{Action, Command};
use sinew_stage::take::{Take, TakeFile};
use sinew_stage::{Observer, Scene, Stage};
use std::collections::BTreeMap;
use std::sync::Arc;

impl SceneManifest {
    /// The manifest of a scene.
    ///
    /// # Errors
    /// A scene whose files exceed [`MAX_SCENE`].
    pub fn of(scene: &Scene) -> Result<SceneManifest, SessionError> {
        let mut take = Take::of(scene);
        // A take may refer to large files on the disk; the client does not have them.
        for (path, held) in scene.files() {
            take.files.insert(path.clone(), TakeFile { hash: held.hash, bytes: Some(Arc::clone(&held.bytes)) });
        }
        let bytes = take.to_bytes().map_err(|error| SessionError::Local(error.to_string()))?;
        if bytes.len() > MAX_SCENE {
            let problem = format!("the scene and its files have {} bytes; the maximum is {MAX_SCENE}", bytes.len());
            return Err(SessionError::Local(format!("{problem}; use shorter clips")));
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

/// Connects a session's queue to a stage: an [`Observer`] that applies clients' requests before each step and publishes
/// frames after it.
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
    has_applied: bool,
    hashes: BTreeMap<u64, String>,
    applied: Vec<AppliedCommand>,
}

/// A command or key that was applied, for the report.
#[derive(Clone, Debug, PartialEq, Eq, serde::Serialize)]
pub struct AppliedCommand {
    /// The key, or the command's `do`.
    pub what: String,
    /// The client: names of its actors, or `operator`.
    pub by: String,
    /// Physics steps that were done when it arrived.
    pub arrived_step: u64,
    /// Physics steps that were done before the one that applied it, as the take records it.
    pub step: u64,
}

/// Maximum number of applied commands that are kept: the last ones.
const MAX_APPLIED: usize = 1_000;

impl SessionObserver {
    /// An observer for a stage and its queue.
    pub fn new(queue: StageQueue, stage: &Stage) -> SessionObserver {
        let steps_per_frame = u64::from(stage.scene().stage.steps_per_frame()).max(1);
        let mut session_observer = SessionObserver {
            queue,
            steps_per_frame,
            has_applied: false,
            hashes: BTreeMap::new(),
            applied: Vec::new(),
        };
        session_observer.after_step(stage);
        session_observer
    }

    /// [`Frame::hash`](sinew_world::Frame::hash) by step, as [`ClientStats::hashes`](super::ClientStats::hashes) of a client has them.
    pub fn hashes(&self) -> &BTreeMap<u64, String> {
        &self.hashes
    }

    /// Commands and keys of clients that were applied, without performance samples: the last thousand.
    pub fn applied(&self) -> &[AppliedCommand] {
        &self.applied
    }
}

impl Observer for SessionObserver {
    /// Passes the requests that have arrived to the stage.
    fn before_step(&mut self, stage: &mut Stage) {
        self.has_applied = false;
        let step = stage.frame().step;
        for QueuedRequest { request, by, arrived_step } in self.queue.requests_for_step() {
            let what = match request {
                ClientRequest::Press(key) => {
                    stage.press(&key);
                    key
                }
                ClientRequest::Command(command) => {
                    let is_sample = matches!(command.action, Action::Perform { .. });
                    let what = (!is_sample).then(|| word(&command));
                    stage.command(command);
                    let Some(what) = what else { continue };
                    what
                }
            };
            self.has_applied = true;
            if self.applied.len() >= MAX_APPLIED {
                self.applied.remove(0);
            }
            self.applied.push(AppliedCommand { what, by: by.to_string(), arrived_step, step });
        }
    }

    /// Publishes the frame: at the motion rate, and at once when a request was applied, so that its effect is visible
    /// without waiting for the next motion frame.
    fn after_step(&mut self, stage: &Stage) {
        let frame = stage.frame();
        self.queue.done(frame.step);
        note_hash(&mut self.hashes, frame.step, frame.hash());
        if self.has_applied || frame.step.is_multiple_of(self.steps_per_frame) {
            self.queue.publish(frame);
        }
    }

    /// Whether the session was asked to end.
    fn should_stop(&self) -> bool {
        self.queue.should_stop()
    }
}

/// The `do` of a command, as scenes write it.
fn word(command: &Command) -> String {
    let action = serde_json::to_value(&command.action).unwrap_or_default();
    action.get("do").and_then(|word| word.as_str()).unwrap_or_default().to_owned()
}
