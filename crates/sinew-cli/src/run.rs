//! `sinew run` and `sinew replay`.

use crate::files::{Files, write_recording};
use crate::interactive::Interactive;
use crate::live::LiveArguments;
use crate::output;
use crate::progress::Progress;
use crate::stop::Stop;
use anyhow::{Context, Result, bail};
use sinew::jobs::run::{Footage, Ran, RunJob, movie, replay, run, sheet};
use sinew::script::ScriptHost;
use sinew::stage::{Observer, OwnRig, RecordedCharacter, Scene, Take};
use std::path::PathBuf;

/// Arguments of `sinew run`.
#[derive(Debug, clap::Args)]
pub(crate) struct Run {
    /// The scene file.
    scene: PathBuf,
    /// How long to run \[s\] instead of the scene's own duration.
    #[arg(long = "for", value_name = "SECONDS")]
    for_secs: Option<f64>,
    /// Change a value of the scene first, such as characters.left.pose_gain=2; may be repeated.
    #[arg(long, value_name = "PATH=VALUE", value_parser = assignment)]
    set: Vec<(String, String)>,
    /// Press a key of the scene at a time \[s\], such as b@1.5; may be repeated.
    #[arg(long, value_name = "KEY@SECONDS", value_parser = press)]
    press: Vec<(f64, String)>,
    /// Run in real time: controllers are reloaded when their files change, and lines of the standard input are applied:
    /// a key of the scene, or a command as JSON such as {"character":"left","do":"pose","name":"guard"}.
    #[arg(long)]
    real_time: bool,
    /// Step the world on this many threads: a gain for crowds, with the same bits.
    #[cfg(feature = "threads")]
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u16).range(1..=64))]
    threads: u16,
    /// Where to record the take, for `sinew replay`.
    #[arg(long, value_name = "T.take")]
    take: Option<PathBuf>,
    #[command(flatten)]
    live: LiveArguments,
    #[command(flatten)]
    out: Out,
}

/// Arguments of `sinew replay`.
#[derive(Debug, clap::Args)]
pub(crate) struct Replay {
    /// The take to replay.
    take: PathBuf,
    /// Change a value of its scene first, such as characters.left.pose_gain=2; may be repeated.
    #[arg(long, value_name = "PATH=VALUE", value_parser = assignment)]
    set: Vec<(String, String)>,
    #[command(flatten)]
    out: Out,
}

/// Where results go.
#[derive(Debug, clap::Args)]
pub(crate) struct Out {
    #[command(flatten)]
    files: Files,
    /// Write only this character's motion; .bvh and .amc hold one.
    #[arg(long, value_name = "NAME")]
    character: Option<String>,
}

pub(crate) fn assignment(text: &str) -> Result<(String, String), String> {
    let (path, value) = text.split_once('=').ok_or("write PATH=VALUE, such as characters.left.pose_gain=2")?;
    Ok((path.trim().to_owned(), value.trim().to_owned()))
}

pub(crate) fn press(text: &str) -> Result<(f64, String), String> {
    let usage = "write KEY@SECONDS, such as b@1.5";
    let (key, secs) = text.rsplit_once('@').ok_or(usage)?;
    let secs: f64 = secs.parse().map_err(|_| usage)?;
    if secs.is_finite() && secs >= 0.0 { Ok((secs, key.to_owned())) } else { Err(usage.to_owned()) }
}

impl Run {
    pub(crate) fn run(&self) -> Result<()> {
        self.out.check([&self.scene].into_iter(), self.take.iter())?;
        let mut scene = Scene::read(&self.scene)?;
        for (path, value) in &self.set {
            scene.set(path, value)?;
        }
        #[cfg(feature = "threads")]
        let threads = usize::from(self.threads);
        #[cfg(not(feature = "threads"))]
        let threads = 1;
        let for_picture = scene.clone();
        let mut live = self.live.open(&scene)?;
        let keeps_time = self.real_time || live.keeps_time();
        let presses = self.press.clone();
        let job = RunJob { for_secs: self.for_secs, host: ScriptHost::find(), presses, threads, real_time: keeps_time };
        let mut interactive = keeps_time.then(|| Interactive::begin(&scene));
        let mut progress = Progress::of(job.steps(&scene)?);
        let beside: &mut dyn Observer = match &mut interactive {
            Some(interactive) => interactive,
            None => &mut progress,
        };
        let mut ran = run(scene, &job, &mut [beside, &mut live, &mut Stop::listen()])?;
        drop(progress);
        ran.report.add_ports(live.performers());
        if let Some(path) = &self.take {
            output::make_folder(path)?;
            ran.take.write(path)?;
        }
        self.out.write(&ran, &for_picture)?;
        let title = self.scene.file_name().unwrap_or_default().display().to_string();
        self.out.say(&ran, &title, self.take.as_ref())
    }
}

impl Replay {
    pub(crate) fn run(&self) -> Result<()> {
        self.out.check([&self.take].into_iter(), std::iter::empty())?;
        let take = Take::open(&self.take)?;
        let folder = self.take.parent();
        let ran = replay(&take, &self.set, folder, ScriptHost::find(), &mut [&mut Progress::of(take.steps)])?;
        let mut scene = take.to_scene(folder)?;
        for (path, value) in &self.set {
            scene.set(path, value)?;
        }
        self.out.write(&ran, &scene)?;
        let title = self.take.file_name().unwrap_or_default().display().to_string();
        self.out.say(&ran, &title, None)?;
        if self.set.is_empty() {
            if ran.take.hash != take.hash {
                let place = match first_difference(&ran.take, &take) {
                    Some(step) => format!("they diverge before step {step}"),
                    None => "they diverge near the end".to_owned(),
                };
                bail!(
                    "the replay's hash is {:016x}, the take's {:016x}: {place}; it was recorded by version {}, this is {}",
                    ran.take.hash,
                    take.hash,
                    take.version,
                    env!("CARGO_PKG_VERSION")
                );
            }
            output::say("the replay is the take, bit for bit")?;
        }
        Ok(())
    }
}

impl Out {
    pub(crate) fn check<'a>(
        &'a self,
        inputs: impl Iterator<Item = &'a PathBuf>,
        more: impl Iterator<Item = &'a PathBuf>,
    ) -> Result<()> {
        self.files.check_recorded()?;
        self.files.check_places(inputs, more)
    }

    fn write(&self, ran: &Ran, scene: &Scene) -> Result<()> {
        let subtitle = format!("{:.2} s, {} physics steps", ran.report.duration_s, ran.report.steps);
        self.write_motion(&Footage { recording: &ran.recording, scene, marks: &ran.marks }, &subtitle)?;
        self.files.write_report(&ran.report)
    }

    /// Whether anything is asked for that needs the motion.
    #[cfg(feature = "session")]
    pub(crate) fn needs_motion(&self) -> bool {
        !self.files.motions.is_empty() || self.files.picture.is_some() || self.files.video.is_some()
    }

    /// Where results go.
    #[cfg(feature = "session")]
    pub(crate) fn files(&self) -> &Files {
        &self.files
    }

    /// Motion files, the picture, and moving pictures.
    pub(crate) fn write_motion(&self, footage: &Footage, subtitle: &str) -> Result<()> {
        let scene = footage.scene;
        for path in &self.files.motions {
            let rig = |character: &RecordedCharacter| Ok(OwnRig::of(scene, &character.name, footage.recording.frames)?);
            write_recording(path, footage.recording, self.character.as_deref(), rig)?;
        }
        let title = scene.name.clone().unwrap_or_else(|| scene.file_name().to_owned());
        if let Some(path) = &self.files.picture {
            let png = sheet(footage, &title, subtitle).to_png().context("the picture")?;
            output::write_bytes(path, &png)?;
        }
        self.files.write_video(|| movie(footage, &title))
    }

    fn say(&self, ran: &Ran, title: &str, take: Option<&PathBuf>) -> Result<()> {
        let report = &ran.report;
        let mut lines =
            vec![format!("{title}: {:.2} s, {} steps, hash {}", report.duration_s, report.steps, report.hash)];
        for event in report.events.iter().take(MAX_LINES) {
            lines.push(format!("  {:7.3} s  {}  ({})", event.time_secs, event.effect, event.cause));
        }
        let hidden = report.events.len().saturating_sub(MAX_LINES) as u64 + report.events_dropped;
        if hidden > 0 {
            lines.push(format!("  and {hidden} more events; --report R.json lists them"));
        }
        for (name, character) in &report.characters {
            lines.push(format!(
                "{name}: hips at {:.2} m (lowest {:.2} m), {} steps, {}",
                character.hips_height_end_m,
                character.hips_height_min_m,
                character.steps,
                character.ending()
            ));
        }
        for (name, character) in &report.characters {
            lines.extend(character.reaches.iter().map(|reach| format!("{name} reached: {}", reach.words())));
        }
        for (name, actor) in &report.actors {
            if actor.foreign > 0 {
                lines.push(format!("{name}: {} datagrams of another performer were dropped", actor.foreign));
            }
            if actor.received == 0 {
                lines.push(format!("{name} had no performer"));
                continue;
            }
            let latency = actor.latency_ms.map_or(String::new(), |latency| {
                format!(", {:.1} ms to a frame ({:.1} ms for 99 %)", latency.p50, latency.p99)
            });
            let about = if actor.lost_is_estimate { "about " } else { "" };
            lines.push(format!(
                "{name} was performed: {} samples, {} late, {} rejected, {about}{} lost{latency}",
                actor.received, actor.late, actor.rejected, actor.lost
            ));
        }
        lines.extend(self.files.words(take.into_iter()));
        output::say(&lines.join("\n"))
    }
}

/// The first step at which intermediate hashes differ.
fn first_difference(one: &Take, other: &Take) -> Option<u64> {
    let (one, other) = (one.trace.as_ref()?, other.trace.as_ref()?);
    let place = one.hashes.iter().zip(&other.hashes).position(|(a, b)| a != b)?;
    (one.every_steps == other.every_steps).then(|| (place as u64 + 1) * one.every_steps)
}

/// Events that are printed.
const MAX_LINES: usize = 30;
