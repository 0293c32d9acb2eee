//! `sinew respond`.

use crate::files::Files;
use crate::push_argument::{cycle, ground, push};
use crate::{Reading, Who, output};
use anyhow::{Context, Result};
use clap::ValueEnum;
use glam::DVec3;
use sinew::figure::body_shapes;
use sinew::jobs::respond::{Answer, RespondError, RespondJob, movie, respond, sheet};
use sinew::motion::formats::{MotionFile, ReadOptions};
use sinew::motion::{Note, Part};
use sinew::response::{Coordinates, GroundJerk, Preset, Push, PushFrame, Settings};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// Arguments of `sinew respond`.
#[derive(Debug, clap::Args)]
pub(crate) struct Respond {
    /// The clip to push: .bvh, .amc, .glb, .gltf, .vrm, .vrma or .fbx. Without one, the sample walk.
    clip: Option<PathBuf>,
    /// A push, such as part=leftHand,force=0:0:-100,at=1.0,for=0.1[,frame=world][,point=x:y:z]; may be repeated.
    /// Newtons and seconds; x to the character's left, y up, z forward.
    #[arg(long, value_name = "PUSH", value_parser = push)]
    push: Vec<Push>,
    /// An acceleration of the ground, such as accel=4:0:0,at=1.0,for=0.2 (m/s²); may be repeated.
    #[arg(long, value_name = "JERK", value_parser = ground)]
    platform: Vec<GroundJerk>,
    /// The preset.
    #[arg(long, value_enum, default_value = "robust")]
    preset: PresetName,
    /// Compliance of the body, from 0.25 (stiff) to 4 (loose).
    #[arg(long, value_name = "C", default_value_t = 1.0)]
    compliance: f64,
    /// Keep pushed forearms and hands out of trunk, head and thighs, as far as the clip's are.
    #[arg(long)]
    arms_clear: bool,
    /// Number of coordinates under dynamics, 0 to 24.
    #[arg(short, value_name = "K", default_value_t = 10)]
    k: usize,
    /// Which coordinates are under dynamics; `high` is the paper's counter-experiment, with --preset paper.
    #[arg(long, value_enum, default_value = "low")]
    coordinates: CoordinatesName,
    /// Take the coordinates of actuation from another clip.
    #[arg(long, value_name = "OTHER_CLIP")]
    basis: Option<PathBuf>,
    /// The frames of one gait cycle, from 0, both ends in, instead of the one found.
    #[arg(long, value_name = "A..B", value_parser = cycle)]
    cycle: Option<(usize, usize)>,
    /// Play the cycle N times, seamlessly, instead of the clip.
    #[arg(long, value_name = "N", default_value_t = 0)]
    repeat: usize,
    #[command(flatten)]
    files: Files,
    #[command(flatten)]
    reading: Reading,
    #[command(flatten)]
    who: Who,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
enum PresetName {
    /// Robust on every clip.
    Robust,
    /// Close to the paper as printed: shows its sweep over k.
    Paper,
    /// The paper as printed, which is unstable.
    Literal,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
enum CoordinatesName {
    Low,
    High,
}

/// The demonstration without a clip and without a push.
const SHOW: Push = Push {
    part: Part::LeftHand,
    point: None,
    force_n: DVec3::new(0.0, 0.0, -120.0),
    frame: PushFrame::Facing,
    at_secs: 2.0,
    for_secs: 0.1,
};

impl Respond {
    pub(crate) fn run(&self) -> Result<()> {
        let shows = self.clip.is_none() && self.push.is_empty() && self.platform.is_empty();
        let pushes = if shows { vec![SHOW] } else { self.push.clone() };
        let inputs = self.clip.iter().chain(&self.basis).chain(&self.reading.skeleton);
        self.files.check_places(inputs, std::iter::empty())?;
        for path in &self.files.motions {
            output::check_format(path)?;
        }
        let bar = output::spinner();
        bar.set_message("reading");
        let file = match &self.clip {
            Some(path) => MotionFile::read(path, &self.reading.options())?,
            None => {
                let mut file = MotionFile::from_bvh(&sinew::stage::sample_walk_bvh()?, &ReadOptions::default())?;
                file.path = "sample walk".into();
                file
            }
        };
        let basis = self.basis.as_deref().map(|path| MotionFile::read(path, &ReadOptions::default())).transpose()?;
        let job = RespondJob {
            pushes,
            ground: self.platform.clone(),
            settings: self.settings(),
            cycle: self.cycle,
            repeat: self.repeat,
            person: self.who.person(),
        };
        bar.set_message("responding");
        let answer = respond(&file, &job, basis.as_ref()).map_err(|error| match error {
            // It names its file itself.
            RespondError::File(error) => anyhow::Error::new(error),
            error => anyhow::Error::new(error).context(file.path.display().to_string()),
        })?;
        bar.set_message("writing");
        let mut files = self.files.clone();
        if self.clip.is_none() && files.all().next().is_none() {
            files = in_folder("out".as_ref());
        }
        let notes = write(&files, &file, &answer, &job)?;
        bar.finish_and_clear();
        file.notes.iter().chain(&answer.notes).chain(&notes).for_each(output::note);
        output::say(&words(&answer, &job, &files))
    }

    fn settings(&self) -> Settings {
        Settings {
            preset: match self.preset {
                PresetName::Robust => Preset::Robust,
                PresetName::Paper => Preset::Paper,
                PresetName::Literal => Preset::Literal,
            },
            k: self.k,
            coordinates: match self.coordinates {
                CoordinatesName::Low => Coordinates::Low,
                CoordinatesName::High => Coordinates::High,
            },
            compliance: self.compliance,
            arms_clear: self.arms_clear,
            ..Settings::default()
        }
    }
}

/// Default output files.
fn in_folder(folder: &Path) -> Files {
    Files {
        motions: vec![folder.join("pushed.bvh"), folder.join("pushed.glb")],
        report: Some(folder.join("report.json")),
        picture: Some(folder.join("pushed.png")),
        video: Some(folder.join("pushed.gif")),
    }
}

fn write(files: &Files, file: &MotionFile, answer: &Answer, job: &RespondJob) -> Result<Vec<Note>> {
    let mut notes = Vec::new();
    let body = body_shapes(&answer.prepared.reduction().shapes());
    for path in &files.motions {
        output::make_folder(path)?;
        notes.extend(file.write(path, &answer.clip, answer.rows(), &body)?);
    }
    files.write_report(&answer.report)?;
    if let Some(path) = &files.picture {
        let title = file.path.file_name().unwrap_or(file.path.as_os_str()).display().to_string();
        let png = sheet(answer, file.body_parts()?, job, &title).to_png().context("the picture")?;
        output::write_bytes(path, &png)?;
    }
    if files.video.is_some() {
        let title = file.path.file_name().unwrap_or(file.path.as_os_str()).display().to_string();
        let humanoid = file.body_parts()?;
        files.write_video(|| movie(answer, humanoid, job, &title))?;
    }
    Ok(notes)
}

/// A summary in a few lines, and suggestions.
fn words(answer: &Answer, job: &RespondJob, files: &Files) -> String {
    let report = &answer.report;
    let mut lines = vec![format!(
        "{}: {:.0} kg, {:.2} m, {} frames at {:.0} fps",
        report.file, report.mass_kg, report.height_m, report.frames, report.fps
    )];
    if let Some((first, last)) = report.cycle {
        lines.push(format!("style measured on the cycle of frames {first}..{last}"));
    }
    for push in &report.pushes {
        let [x, y, z] = push.force_n;
        let newtons = DVec3::new(x, y, z).length();
        lines.push(format!(
            "push: {newtons:.0} N on the {} ({x}:{y}:{z}, {}) at {:.2} s for {:.2} s",
            push.part, push.frame, push.at_s, push.for_s
        ));
        if push.world_force_n.is_none() {
            lines.push("  it never acted".to_owned());
            continue;
        }
        lines.extend(outcome(&push.peak_deflection_deg, push.recovered_after_s));
    }
    for jerk in &job.ground {
        let DVec3 { x, y, z } = jerk.acceleration;
        lines.push(format!("ground: jerked by {x}:{y}:{z} m/s² at {:.2} s for {:.2} s", jerk.at_secs, jerk.for_secs));
    }
    if !job.ground.is_empty() {
        lines.extend(outcome(&report.peak_deflection_deg, report.recovered_after_s));
    }
    if report.largest_departure_deg < UNCHANGED_DEG {
        lines.push(match job.repeat {
            0 => "nothing disturbs the clip: it passes through unchanged".to_owned(),
            times => format!("nothing disturbs the motion: its cycle plays {times} times as it is"),
        });
    } else if job.pushes.is_empty() && job.ground.is_empty() {
        lines.push(format!(
            "undisturbed, the {} preset leaves the input by up to {:.1}°",
            report.preset, report.largest_departure_deg
        ));
    } else {
        lines.push(format!("stance ankles within {:.2} mm of the input's", report.stance_deviation_max_m * 1e3));
    }
    let nothing = || "nothing written; add -o pushed.bvh, --report r.json or --picture p.png".to_owned();
    lines.push(files.words(std::iter::empty()).unwrap_or_else(nothing));
    lines.push(format!("next: {}", suggestion(job)));
    lines.join("\n")
}

/// The joints that move most, and whether they come back.
fn outcome(peaks: &BTreeMap<String, f64>, recovered_after_s: Option<f64>) -> [String; 2] {
    let mut peaks: Vec<(&String, &f64)> = peaks.iter().collect();
    peaks.sort_by(|a, b| b.1.total_cmp(a.1));
    let most: Vec<String> = peaks.iter().take(6).map(|(part, degrees)| format!("{part} {degrees:.1}°")).collect();
    let recovered = match recovered_after_s {
        Some(secs) => format!("  recovered {secs:.2} s after it ended (every joint within 2°)"),
        None => "  not recovered by the end; --repeat N plays a walk on until it is".to_owned(),
    };
    [format!("  peak deflection: {}", most.join(", ")), recovered]
}

/// Deviation below which the answer looks like the input \[deg\]; files print fewer digits.
const UNCHANGED_DEG: f64 = 1e-6;

fn suggestion(job: &RespondJob) -> &'static str {
    if job.pushes.is_empty() && job.ground.is_empty() {
        "--push part=leftHand,force=0:0:-100,at=1.0,for=0.1 pushes the hand backward"
    } else if job.settings.compliance == 1.0 {
        "--compliance 2 yields further, 0.5 less; sinew respond YOUR.bvh --push ... -o pushed.bvh pushes your own clip"
    } else {
        "--push part=head,... or part=chest,... pushes elsewhere; --platform accel=4:0:0,at=1,for=0.2 jerks the ground"
    }
}
