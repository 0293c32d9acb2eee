//! From a scene or a take to what it showed.

use super::report::RunReport;
use sinew_script::ScriptHost;
use sinew_stage::{Recording, Scene, SceneError, Stage, StageError, Take};
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
}

/// A run: the report, the motion, the take.
pub struct Ran {
    /// What happened, in numbers.
    pub report: RunReport,
    /// What was seen.
    pub recording: Recording,
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

/// The longest run \[s\].
pub(crate) const MAX_SECS: f64 = 3600.0;

/// Steps between two hashes of a take's trace: one a second at 240 Hz.
pub(crate) const TRACE_STEPS: u64 = 240;

/// Runs a scene. `before_step` is called before every step with the stage, how many steps are done, and of how many; it may give
/// the stage commands, which go into the take.
///
/// ```
/// use sinew::run::{RunJob, run};
/// use sinew::stage::Scene;
/// let scene = Scene::from_text("format = 1\n[characters.one]\npose = \"stand\"\n")?;
/// let ran = run(scene, &RunJob { for_secs: Some(0.5), ..RunJob::default() }, |_, _, _| ())?;
/// assert_eq!(ran.report.steps, 120);
/// assert_eq!(ran.recording.frames, 31);
/// # Ok::<(), sinew::run::RunError>(())
/// ```
///
/// # Errors
/// When the scene cannot be built or the time is out of range.
pub fn run(scene: Scene, job: &RunJob, before_step: impl FnMut(&mut Stage, u64, u64)) -> Result<Ran, RunError> {
    let for_secs = job.for_secs.unwrap_or(scene.stage.duration_secs);
    if !(for_secs > 0.0 && for_secs <= MAX_SECS) {
        return Err(RunError::Duration(for_secs));
    }
    let steps = (for_secs * f64::from(scene.stage.physics_hz)).round().max(1.0) as u64;
    let take = Take::of(&scene);
    let mut stage = Stage::new(scene, job.host.clone())?;
    stage.set_threads(job.threads.max(1));
    let mut presses = job.presses.clone();
    presses.sort_by(|(one, _), (other, _)| one.total_cmp(other));
    if let Some((_, key)) = presses.iter().find(|(_, key)| !stage.scene().keys.iter().any(|bound| bound.key == *key)) {
        return Err(RunError::Key(key.clone()));
    }
    Ok(play(stage, steps, take, &presses, before_step))
}

/// Plays a take again, with the commands at their steps. `sets` change values of the scene first, as `--set` does;
/// `folder` is where large files are looked for that the take only names.
///
/// # Errors
/// When the take's scene no longer reads or cannot be built.
pub fn replay(
    take: &Take,
    sets: &[(String, String)],
    folder: Option<&Path>,
    host: Option<ScriptHost>,
    before_step: impl FnMut(&mut Stage, u64, u64),
) -> Result<Ran, RunError> {
    let mut scene = take.to_scene(folder)?;
    for (path, value) in sets {
        scene.set(path, value)?;
    }
    let again = Take::of(&scene);
    let mut stage = Stage::new(scene, host)?;
    stage.prescribe(take.commands.clone());
    Ok(play(stage, take.steps, again, &[], before_step))
}

fn play(
    mut stage: Stage,
    steps: u64,
    mut take: Take,
    presses: &[(f64, String)],
    mut before_step: impl FnMut(&mut Stage, u64, u64),
) -> Ran {
    let mut presses = presses.iter().peekable();
    let mut recording = Recording::new(&stage);
    let mut report = RunReport::of(&stage);
    recording.push(&stage);
    let per_frame = u64::from(stage.scene().stage.steps_per_frame());
    let mut hashes = Vec::new();
    for step in 1..=steps {
        while let Some((_, key)) = presses.next_if(|(secs, _)| *secs <= stage.frame().time_secs + 1e-9) {
            stage.press(key);
        }
        before_step(&mut stage, step - 1, steps);
        stage.step();
        report.watch(&stage);
        if step % per_frame == 0 {
            recording.push(&stage);
        }
        if step % TRACE_STEPS == 0 {
            hashes.push(stage.hash());
        }
    }
    take.commands = stage.record().to_vec();
    take.steps = steps;
    take.hash = stage.hash();
    take.trace = Some(sinew_stage::take::HashTrace { every_steps: TRACE_STEPS, hashes });
    report.finish(&stage);
    Ran { report, recording, take }
}
