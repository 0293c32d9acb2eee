//! A scene runs in real time for all who join.

use crate::run::{MAX_SECS, RunError, RunReport, TRACE_STEPS};
use serde::Serialize;
use sinew_live::session::{AppliedCommand, Pacer, Server, ServerCounts, SessionRunner, StageQueue};
use sinew_script::ScriptHost;
use sinew_stage::take::HashTrace;
use sinew_stage::{Recording, Scene, Stage, Take};
use std::collections::BTreeMap;

/// How a scene is to be served.
#[derive(Clone, Debug, Default)]
pub struct ServeJob {
    /// For how long \[s\]; until somebody stops it when left out.
    pub for_secs: Option<f64>,
    /// How Python controllers are run; `None` refuses scenes that have any.
    pub host: Option<ScriptHost>,
    /// Whether commands are kept for a take; without it a session may last for days.
    pub keeps_take: bool,
    /// Whether the motion is kept, of the first hour.
    pub keeps_motion: bool,
}

/// A session that has ended.
pub struct Served {
    /// What happened, in numbers.
    pub report: ServeReport,
    /// What was seen, if it was to be kept.
    pub recording: Option<Recording>,
    /// All that is needed to see it again, if it was to be kept.
    pub take: Option<Take>,
}

/// The report of `sinew serve`.
#[derive(Clone, Debug, Serialize)]
pub struct ServeReport {
    /// As of a run.
    #[serde(flatten)]
    pub run: RunReport,
    /// What came of all that arrived.
    pub clients: ServerCounts,
    /// Commands and keys of clients, with the steps of their arrival and of their obedience.
    pub applied: Vec<AppliedCommand>,
    /// Times that the machine fell so far behind the clock that time was given up.
    pub lapses: u64,
    /// Hash of single frames by step, to be compared with those in the reports of `sinew join`.
    pub hashes: BTreeMap<u64, String>,
}

/// Runs a scene at the pace of the clock until its time is over or somebody stops it. `told` is called before every step.
///
/// ```
/// use sinew::session::{SceneManifest, ServeJob, Server, ServerSettings, serve};
/// use sinew::stage::Scene;
/// let scene = Scene::from_text("format = 1\n[characters.red]\n")?;
/// let settings = ServerSettings { bind: "127.0.0.1:0".parse()?, ..ServerSettings::default() };
/// let (server, queue) = Server::open(&settings, SceneManifest::of(&scene)?)?;
/// let job = ServeJob { for_secs: Some(0.1), ..ServeJob::default() };
/// let served = serve(scene, &job, &server, queue, |_| ())?;
/// assert_eq!(served.report.run.steps, 24);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// When the scene cannot be built or the time is out of range.
pub fn serve(
    scene: Scene,
    job: &ServeJob,
    server: &Server,
    queue: StageQueue,
    mut told: impl FnMut(&mut Stage),
) -> Result<Served, RunError> {
    if let Some(secs) = job.for_secs
        && !(secs > 0.0 && secs.is_finite())
    {
        return Err(RunError::Duration(secs));
    }
    let physics_hz = f64::from(scene.stage.physics_hz);
    let last = job.for_secs.map_or(u64::MAX, |secs| (secs * physics_hz).round().max(1.0) as u64);
    let per_frame = u64::from(scene.stage.steps_per_frame());
    let mut take = job.keeps_take.then(|| Take::of(&scene));
    let mut stage = Stage::new(scene, job.host.clone())?;
    stage.keep_record(job.keeps_take);
    let mut recording = job.keeps_motion.then(|| Recording::new(&stage));
    let mut report = RunReport::of(&stage);
    let mut trace = Vec::new();
    let mut session_runner = SessionRunner::new(queue, &stage);
    let mut pacer = Pacer::new(0, stage.world().settings().step_secs());
    if let Some(recording) = &mut recording {
        recording.push(&stage);
    }
    while stage.frame().step < last && !session_runner.should_stop() {
        pacer.wait(stage.frame().step);
        told(&mut stage);
        session_runner.before_step(&mut stage);
        stage.step();
        session_runner.after_step(&stage);
        report.watch(&stage);
        let step = stage.frame().step;
        if let Some(recording) = &mut recording
            && step.is_multiple_of(per_frame)
            && stage.frame().time_secs <= MAX_SECS
        {
            recording.push(&stage);
        }
        if take.is_some() && step.is_multiple_of(TRACE_STEPS) {
            trace.push(stage.hash());
        }
    }
    report.finish(&stage);
    if let Some(take) = &mut take {
        take.commands = stage.record().to_vec();
        (take.steps, take.hash) = (stage.frame().step, stage.hash());
        take.trace = Some(HashTrace { every_steps: TRACE_STEPS, hashes: trace });
    }
    let report = ServeReport {
        run: report,
        clients: server.counts(),
        applied: session_runner.applied().to_vec(),
        lapses: pacer.lapses,
        hashes: session_runner.hashes().clone(),
    };
    Ok(Served { report, recording, take })
}
