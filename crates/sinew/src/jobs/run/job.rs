//! From a scene or a take to what it showed.

use super::marks::Marks;
use super::report::RunReport;
use sinew_script::ScriptHost;
use sinew_stage::{Observer, Recording, Runner, Scene, SceneError, Stage, StageError, Take};
use std::path::Path;

/// How a scene is to be run.
#[derive(Clone, Debug, Default)]
pub struct RunJob {
    /// For how long \[s\]; the scene's own duration when left out.
    pub for_secs: Option<f64>,
    /// How Python controllers are run; `None` refuses scenes that have any.
    pub host: Option<ScriptHost>,
    /// Keys of the scene that are pressed, with the time of each \[s\].
    pub presses: Vec<(f64, String)>,
    /// Threads that step the world; 0 means one. More than one need the feature `threads` and change no bit.
    pub threads: usize,
    /// Whether the run keeps to the clock: one second of the stage takes one second.
    pub real_time: bool,
}

/// A run: the report, the motion, the take.
pub struct Ran {
    /// What happened, in numbers.
    pub report: RunReport,
    /// What was seen.
    pub recording: Recording,
    /// What happened, for its pictures.
    pub marks: Marks,
    /// All that is needed to see it again.
    pub take: Take,
}

/// Why a scene does not run.
#[derive(Debug, thiserror::Error)]
pub enum RunError {
    /// The scene file.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// What it describes cannot be built.
    #[error(transparent)]
    Stage(#[from] StageError),
    /// A duration out of range.
    #[error("{0} s is out of range; give more than 0 and at most {MAX_SECS} s")]
    Duration(f64),
    /// A key that the scene does not bind.
    #[error("the scene has no key `{0}`; add [[keys]] with key = \"{0}\", or press another")]
    Key(String),
}

/// The longest run \[s\]: all of its motion is recorded.
const MAX_SECS: f64 = Runner::MAX_MOTION_SECS;

impl RunJob {
    /// Physics steps that the job takes on a scene.
    ///
    /// # Errors
    /// When the time is out of range.
    pub fn steps(&self, scene: &Scene) -> Result<u64, RunError> {
        let for_secs = self.for_secs.unwrap_or(scene.stage.duration_secs);
        if !(for_secs > 0.0 && for_secs <= MAX_SECS) {
            return Err(RunError::Duration(for_secs));
        }
        Ok((for_secs * f64::from(scene.stage.physics_hz)).round().max(1.0) as u64)
    }
}

/// Runs a scene. Commands that the observers give the stage before its steps go into the take. An observer may end the run early.
///
/// ```
/// use sinew::jobs::run::{RunJob, run};
/// use sinew::stage::Scene;
/// let scene = Scene::from_text("format = 1\n[characters.one]\npose = \"stand\"\n")?;
/// let ran = run(scene, &RunJob { for_secs: Some(0.5), ..RunJob::default() }, &mut [])?;
/// assert_eq!(ran.report.steps, 120);
/// assert_eq!(ran.recording.frames, 31);
/// # Ok::<(), sinew::jobs::run::RunError>(())
/// ```
///
/// # Errors
/// When the scene cannot be built, the time is out of range, or a key is pressed that the scene does not bind.
pub fn run(scene: Scene, job: &RunJob, observers: &mut [&mut dyn Observer]) -> Result<Ran, RunError> {
    let steps = job.steps(&scene)?;
    let mut presses = Presses::of(job, &scene)?;
    let mut stage = Stage::new(scene, job.host.clone())?;
    stage.set_threads(job.threads.max(1));
    let mut all: Vec<&mut dyn Observer> = vec![&mut presses];
    all.extend(observers.iter_mut().map(|one| &mut **one as &mut dyn Observer));
    let runner = Runner::new(stage);
    Ok(play(if job.real_time { runner.paced() } else { runner }, steps, &mut all))
}

/// Plays a take again, with the commands at their steps. `sets` change values of the scene first, as [`Scene::set`] does;
/// `folder` is where large files are looked for that the take only names.
///
/// ```
/// use sinew::jobs::run::{RunJob, replay, run};
/// use sinew::stage::Scene;
/// let scene = Scene::from_text("format = 1\n[characters.one]\npose = \"stand\"\n")?;
/// let ran = run(scene, &RunJob { for_secs: Some(0.1), ..RunJob::default() }, &mut [])?;
/// let again = replay(&ran.take, &[], None, None, &mut [])?;
/// assert_eq!(again.report.hash, ran.report.hash);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// When the take's scene no longer reads or cannot be built.
pub fn replay(
    take: &Take,
    sets: &[(String, String)],
    folder: Option<&Path>,
    host: Option<ScriptHost>,
    observers: &mut [&mut dyn Observer],
) -> Result<Ran, RunError> {
    let mut scene = take.to_scene(folder)?;
    for (path, value) in sets {
        scene.set(path, value)?;
    }
    let mut stage = Stage::new(scene, host)?;
    stage.prescribe(take.commands.clone());
    Ok(play(Runner::new(stage), take.steps, observers))
}

/// Keys that are pressed at their times.
struct Presses {
    /// The next one last.
    keys: Vec<(f64, String)>,
}

impl Presses {
    fn of(job: &RunJob, scene: &Scene) -> Result<Presses, RunError> {
        let mut keys = job.presses.clone();
        keys.sort_by(|(one, _), (other, _)| one.total_cmp(other));
        keys.reverse();
        match keys.iter().rfind(|(_, key)| !scene.keys.iter().any(|bound| bound.key == *key)) {
            Some((_, key)) => Err(RunError::Key(key.clone())),
            None => Ok(Presses { keys }),
        }
    }
}

impl Observer for Presses {
    fn before_step(&mut self, stage: &mut Stage) {
        let now_secs = stage.frame().time_secs + 1e-9;
        while let Some((_, key)) = self.keys.pop_if(|(secs, _)| *secs <= now_secs) {
            stage.press(&key);
        }
    }
}

fn play(runner: Runner, steps: u64, observers: &mut [&mut dyn Observer]) -> Ran {
    let mut runner = runner.with_motion().with_take();
    let mut report = RunReport::of(runner.stage());
    let mut all: Vec<&mut dyn Observer> = observers.iter_mut().map(|one| &mut **one as &mut dyn Observer).collect();
    let mut marks = Marks::of(runner.stage());
    all.extend([&mut report as &mut dyn Observer, &mut marks]);
    runner.run(steps, &mut all);
    report.finish(runner.stage());
    marks.finish(runner.stage().events().list());
    let done = runner.finish();
    let take = done.take.unwrap_or_else(|| Take::of(done.stage.first_scene()));
    Ran { report, recording: done.recording.unwrap_or_default(), marks, take }
}
