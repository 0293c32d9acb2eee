//! `sinew reach`.

use super::push_argument::vector;
use super::{Reading, Who, output};
use anyhow::{Context, Result};
use clap::ValueEnum;
use glam::DVec3;
use sinew::motion::formats::{Format, MotionFile, WriteJob, write};
use sinew::reach::{Hand, MovingPoint, ReachJob, Reached, contact_sheet, reach, sheet};
use sinew::reaching::Style;
use sinew::run::{body_shapes, character_clip, csv, scene_clip};
use std::path::{Path, PathBuf};

/// Arguments of `sinew reach`.
#[derive(Debug, clap::Args)]
pub(super) struct Reach {
    /// The target in metres: x to the character's left, y up from the floor, z forward from between the feet.
    #[arg(long, value_name = "X:Y:Z", value_parser = point, allow_hyphen_values = true)]
    target: Option<DVec3>,
    /// Which hand reaches.
    #[arg(long, value_enum, default_value = "auto")]
    hand: HandName,
    /// A target of the left hand alone; with --target-right both hands reach.
    #[arg(long, value_name = "X:Y:Z", value_parser = point, allow_hyphen_values = true, conflicts_with_all = ["target", "hand"])]
    target_left: Option<DVec3>,
    /// A target of the right hand alone.
    #[arg(long, value_name = "X:Y:Z", value_parser = point, allow_hyphen_values = true, conflicts_with_all = ["target", "hand"])]
    target_right: Option<DVec3>,
    /// Flexibility of the legs, 0.25 to 4: the higher, the sooner the body squats instead of stooping.
    #[arg(long, value_name = "F", default_value_t = 1.0)]
    flexibility: f64,
    /// Peak speed of the hand in metres a second (with --print the paper's start speed).
    #[arg(long, value_name = "V", conflicts_with = "time")]
    speed: Option<f64>,
    /// Time from start to arrival in seconds, instead of a speed.
    #[arg(long, value_name = "T")]
    time: Option<f64>,
    /// Share of the stepping after which arm and twist begin, 0 to 1.
    #[arg(long, value_name = "R")]
    overlap_step: Option<f64>,
    /// Share of the twist after which the spine swings, 0 to 1.
    #[arg(long, value_name = "R")]
    overlap_twist: Option<f64>,
    /// Where the target is at a time, X:Y:Z@T; may be repeated.
    #[arg(long, value_name = "X:Y:Z@T", value_parser = moving, num_args = 1.., allow_hyphen_values = true)]
    moving: Vec<MovingPoint>,
    /// Make so many ways with seeds from --seed on; the picture is a contact sheet, and files are numbered.
    #[arg(long, value_name = "N")]
    variations: Option<u64>,
    /// Begin in a clip at a time, such as walk.bvh@1.5.
    #[arg(long, value_name = "CLIP@T", value_parser = from)]
    from: Option<(PathBuf, f64)>,
    /// The paper to the letter where it can be built.
    #[arg(long)]
    print: bool,
    /// Where every random choice comes from.
    #[arg(long, value_name = "N", default_value_t = 0)]
    seed: u64,
    /// Where to write the motion: .glb or .gltf with the target, .bvh of the body, .csv; may be repeated.
    #[arg(short, long, value_name = "OUT")]
    output: Vec<PathBuf>,
    /// Where to write a report as JSON; a list with --variations.
    #[arg(long, value_name = "R.json")]
    report: Option<PathBuf>,
    /// Where to draw a picture.
    #[arg(long, value_name = "P.png")]
    picture: Option<PathBuf>,
    #[command(flatten)]
    reading: Reading,
    #[command(flatten)]
    who: Who,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
enum HandName {
    Left,
    Right,
    Auto,
}

fn point(text: &str) -> Result<DVec3, String> {
    vector(text, "target")
}

fn moving(text: &str) -> Result<MovingPoint, String> {
    let (at, secs) = text.rsplit_once('@').ok_or("write X:Y:Z@T, such as 0.2:1.4:0.6@2")?;
    let secs: f64 = secs.parse().map_err(|_| format!("{secs:?} is no time; write seconds after @"))?;
    Ok(MovingPoint { at: point(at)?, secs })
}

fn from(text: &str) -> Result<(PathBuf, f64), String> {
    let usage = "write CLIP@T, such as walk.bvh@1.5";
    let (path, secs) = text.rsplit_once('@').ok_or(usage)?;
    let secs: f64 = secs.parse().map_err(|_| usage)?;
    if (0.0..=86_400.0).contains(&secs) { Ok((path.into(), secs)) } else { Err(usage.to_owned()) }
}

/// Most variations of one target.
const MOST_VARIATIONS: u64 = 200;

impl Reach {
    pub(super) fn run(&self) -> Result<()> {
        let clip = self.from.as_ref().map(|(path, _)| path);
        let outputs = self.output.iter().chain(&self.report).chain(&self.picture);
        output::check_places(clip.into_iter().chain(&self.reading.skeleton), outputs)?;
        for path in self.output.iter().filter(|path| !is_csv(path)) {
            output::check_format(path)?;
        }
        let clip = clip.map(|path| MotionFile::read(path, &self.reading.options())).transpose()?;
        let bar = output::spinner();
        bar.set_message("reaching");
        let count = self.variations.unwrap_or(1).clamp(1, MOST_VARIATIONS);
        let mut all = Vec::new();
        for index in 0..count {
            let reached = reach(&self.job(self.seed.wrapping_add(index)), clip.as_ref())?;
            for path in &self.output {
                let path = if self.variations.is_some() { numbered(path, index + 1) } else { path.clone() };
                write_motion(&path, &reached)?;
            }
            all.push(reached);
        }
        let title = self.title();
        if let Some(path) = &self.report {
            match (&all[..], self.variations) {
                ([one], None) => output::write_json(path, &one.report)?,
                (all, _) => output::write_json(path, &all.iter().map(|one| &one.report).collect::<Vec<_>>())?,
            }
        }
        if let Some(path) = &self.picture {
            let sheet = match (&all[..], self.variations) {
                ([one], None) => sheet(one, &title),
                (all, _) => contact_sheet(all, &title),
            };
            output::write_bytes(path, &sheet.to_png().context("the picture")?)?;
        }
        bar.finish_and_clear();
        output::say(&self.words(&all))
    }

    fn job(&self, seed: u64) -> ReachJob {
        let usual = Style::default();
        ReachJob {
            target: self.target,
            hand: match self.hand {
                HandName::Left => Hand::Left,
                HandName::Right => Hand::Right,
                HandName::Auto => Hand::Auto,
            },
            left: self.target_left,
            right: self.target_right,
            moving: self.moving.clone(),
            person: self.who.person(),
            style: Style {
                flexibility: self.flexibility,
                speed_m_s: self.speed,
                time_secs: self.time,
                overlap_step: self.overlap_step.unwrap_or(usual.overlap_step),
                overlap_twist: self.overlap_twist.unwrap_or(usual.overlap_twist),
                print: self.print,
                seed,
                ..usual
            },
            from_secs: self.from.as_ref().map_or(0.0, |(_, secs)| *secs),
        }
    }

    fn title(&self) -> String {
        let place = |point: &DVec3| format!("{}:{}:{}", point.x, point.y, point.z);
        let targets: Vec<String> =
            [&self.target, &self.target_left, &self.target_right].into_iter().flatten().map(place).collect();
        format!("sinew reach {}", targets.join(" and "))
    }

    fn words(&self, all: &[Reached]) -> String {
        let mut lines = Vec::new();
        for reached in all {
            let report = &reached.report;
            let steps: Vec<String> =
                report.steps.iter().map(|step| format!("{} {} {:.2} m", step.kind, step.foot, step.length_m)).collect();
            let seed = if all.len() > 1 { format!("seed {}: ", report.seed) } else { String::new() };
            lines.push(match &report.reason {
                None => format!(
                    "{seed}{} hand there within {:.2} mm in {:.2} s",
                    report.hands.join(" and "),
                    report.hand_error_m * 1e3,
                    report.duration_s
                ),
                Some(reason) => format!("{seed}not reached, {:.3} m short: {reason}", report.hand_error_m),
            });
            lines.push(format!(
                "  twist {:.0}°, swing {:.0}°, squat {:.2} m, steps: {}",
                report.twist_deg,
                report.swing_deg,
                report.squat_m,
                if steps.is_empty() { "none".to_owned() } else { steps.join(", ") }
            ));
        }
        let written = self.output.iter().chain(&self.report).chain(&self.picture);
        let written: Vec<String> = written.map(|path| path.display().to_string()).collect();
        lines.push(if written.is_empty() {
            "nothing written; add -o reach.glb, --report r.json or --picture p.png".to_owned()
        } else {
            format!("wrote {}", written.join(", "))
        });
        lines.join("\n")
    }
}

fn write_motion(path: &Path, reached: &Reached) -> Result<()> {
    output::make_folder(path)?;
    let recording = &reached.recording;
    if is_csv(path) {
        return output::write_bytes(path, csv(recording, None).as_bytes());
    }
    let (clip, shapes) = if matches!(Format::of(path), Some(Format::Glb | Format::Gltf)) {
        scene_clip(recording)
    } else {
        let character = recording.characters.first().context("there is no body to write")?;
        (character_clip(recording, character), body_shapes(&character.body, 0))
    };
    for note in write(path, &WriteJob { clip: &clip, source: None }, &shapes)? {
        eprintln!("note: {note}");
    }
    Ok(())
}

fn is_csv(path: &Path) -> bool {
    path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("csv"))
}

/// `reach.glb` as `reach_07.glb`.
fn numbered(path: &Path, index: u64) -> PathBuf {
    let stem = path.file_stem().unwrap_or_default().to_string_lossy();
    let extension = path.extension().unwrap_or_default().to_string_lossy();
    path.with_file_name(format!("{stem}_{index:02}.{extension}"))
}
