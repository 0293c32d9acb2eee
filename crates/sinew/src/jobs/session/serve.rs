//! Serves a scene in real time to clients.

use crate::jobs::run::{Marks, RunError, RunReport};
use serde::Serialize;
use sinew_live::session::{AppliedCommand, Server, ServerCounts, SessionObserver, StageQueue};
use sinew_script::ScriptHost;
use sinew_stage::{Observer, Recording, Runner, Scene, Stage, Take};
use std::collections::BTreeMap;

/// How a scene is to be served.
#[derive(Clone, Debug, Default)]
pub struct ServeJob {
    /// Duration \[s\]. Default: until it is stopped.
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
    /// What happened, for its pictures; empty unless the motion was to be kept.
    pub marks: Marks,
    /// All that is needed to see it again, if it was to be kept.
    pub take: Option<Take>,
}

/// The report of `sinew serve`.
#[derive(Clone, Debug, Serialize)]
pub struct ServeReport {
    /// As of a run.
    #[serde(flatten)]
    pub run: RunReport,
    /// Statistics of the server.
    pub clients: ServerCounts,
    /// Commands and keys of clients, with the steps of their arrival and of their application.
    pub applied: Vec<AppliedCommand>,
    /// Number of times that the machine fell so far behind real time that time was skipped.
    pub lapses: u64,
    /// Hash of single frames by step, to be compared with those in the reports of `sinew join`.
    pub hashes: BTreeMap<u64, String>,
}

/// Runs a scene in real time until its duration is over or it is stopped. Commands that the observers give the stage
/// before its steps go into the take.
///
/// ```
/// use sinew::jobs::session::{ServeJob, serve};
/// use sinew::live::session::{SceneManifest, Server, ServerSettings};
/// use sinew::stage::Scene;
/// let scene = Scene::from_text("format = 1\n[characters.red]\n")?;
/// let settings = ServerSettings { bind: "127.0.0.1:0".parse()?, ..ServerSettings::default() };
/// let (server, queue) = Server::open(&settings, SceneManifest::of(&scene)?)?;
/// let job = ServeJob { for_secs: Some(0.1), ..ServeJob::default() };
/// let served = serve(scene, &job, &server, queue, &mut [])?;
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
    observers: &mut [&mut dyn Observer],
) -> Result<Served, RunError> {
    if let Some(secs) = job.for_secs
        && !(secs > 0.0 && secs.is_finite())
    {
        return Err(RunError::Duration(secs));
    }
    let physics_hz = f64::from(scene.stage.physics_hz);
    let last = job.for_secs.map_or(u64::MAX, |secs| (secs * physics_hz).round().max(1.0) as u64);
    let mut runner = Runner::new(Stage::new(scene, job.host.clone())?).paced();
    if job.keeps_take {
        runner = runner.with_take();
    }
    if job.keeps_motion {
        runner = runner.with_motion();
    }
    let mut report = RunReport::of(runner.stage());
    let mut session = SessionObserver::new(queue, runner.stage());
    let mut all: Vec<&mut dyn Observer> = observers.iter_mut().map(|one| &mut **one as &mut dyn Observer).collect();
    all.extend([&mut session as &mut dyn Observer, &mut report]);
    let mut marks = Marks::of(runner.stage());
    if job.keeps_motion {
        all.push(&mut marks);
    }
    runner.run(last, &mut all);
    report.finish(runner.stage());
    if job.keeps_motion {
        marks.finish(runner.stage().events().list());
    }
    let done = runner.finish();
    let report = ServeReport {
        run: report,
        clients: server.counts(),
        applied: session.applied().to_vec(),
        lapses: done.lapses,
        hashes: session.hashes().clone(),
    };
    Ok(Served { report, recording: done.recording, marks, take: done.take })
}
