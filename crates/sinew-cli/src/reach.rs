//! `sinew reach`.

use crate::files::{Files, write_recording};
use crate::number::within;
use crate::reach_argument::{ball, from, moving, point};
use crate::{Reading, Who, output};
use anyhow::{Context, Result, bail};
use clap::ValueEnum;
use glam::DVec3;
use sinew::jobs::reach::{Ball, Hand, MovingPoint, ReachJob, Reached, contact_sheet, movie, reach, sheet};
use sinew::motion::formats::MotionFile;
use sinew::reach::Style;
use sinew::stage::RecordedCharacter;
use std::path::{Path, PathBuf};

/// Arguments of `sinew reach`.
#[derive(Debug, clap::Args)]
pub(crate) struct Reach {
    /// The target in metres: x to the character's left, y up from the floor, z forward from between the feet.
    #[arg(long, value_name = "X:Y:Z", value_parser = point, allow_hyphen_values = true)]
    target: Option<DVec3>,
    /// Which hand reaches.
    #[arg(long, value_enum, ignore_case = true, default_value = "auto")]
    hand: HandName,
    /// A target of the left hand alone; with --target-right both hands reach.
    #[arg(long, value_name = "X:Y:Z", value_parser = point, allow_hyphen_values = true, conflicts_with_all = ["target", "hand"])]
    target_left: Option<DVec3>,
    /// A target of the right hand alone.
    #[arg(long, value_name = "X:Y:Z", value_parser = point, allow_hyphen_values = true, conflicts_with_all = ["target", "hand"])]
    target_right: Option<DVec3>,
    /// Flexibility of the legs, 0.25 to 4: the higher, the sooner the body squats instead of stooping.
    #[arg(long, value_name = "F", default_value_t = 1.0, value_parser = within::<25, 400>)]
    flexibility: f64,
    /// Peak speed of the hand in metres a second, 0.05 to 10 (with --print the paper's start speed).
    #[arg(long, value_name = "V", conflicts_with = "time", value_parser = within::<5, 1000>)]
    speed: Option<f64>,
    /// Time from start to arrival in seconds, 0.2 to 600, instead of a speed; the least that a body can if that is more.
    #[arg(long, value_name = "T", value_parser = within::<20, 60_000>)]
    time: Option<f64>,
    /// Share of the stepping after which arm and twist begin, 0 to 1.
    #[arg(long, value_name = "R", value_parser = within::<0, 100>)]
    overlap_step: Option<f64>,
    /// Share of the twist after which the spine swings, 0 to 1.
    #[arg(long, value_name = "R", value_parser = within::<0, 100>)]
    overlap_twist: Option<f64>,
    /// Position of the moving target at a time; may be repeated, for later times. Without --target it begins at the first.
    #[arg(long, value_name = "X:Y:Z@T", value_parser = moving, allow_hyphen_values = true)]
    moving: Vec<MovingPoint>,
    /// A ball as obstacle of the arms: its centre and radius in metres; may be repeated. Scenes know other shapes.
    #[arg(long, value_name = "X:Y:Z:R", value_parser = ball, allow_hyphen_values = true)]
    avoid: Vec<Ball>,
    /// Number of variations, 1 to 200, with seeds from --seed on; the picture is a contact sheet, and files
    /// are named by their seeds, such as reach_seed3.glb.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(1..=200))]
    variations: Option<u64>,
    /// Begin in a clip at a time, such as walk.bvh@1.5.
    #[arg(long, value_name = "CLIP@T", value_parser = from)]
    from: Option<(PathBuf, f64)>,
    /// Stand up again afterwards; with --from continue the clip.
    #[arg(long)]
    back: bool,
    /// Follow the paper as printed where it can be built.
    #[arg(long)]
    print: bool,
    /// Seed of all random choices.
    #[arg(long, value_name = "N", default_value_t = 0)]
    seed: u64,
    #[command(flatten)]
    files: Files,
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

/// Who reaches.
const BODY: &str = "body";

impl Reach {
    pub(crate) fn run(&self) -> Result<()> {
        let clip = self.from.as_ref().map(|(path, _)| path);
        self.files.check_places(clip.into_iter().chain(&self.reading.skeleton), std::iter::empty())?;
        self.files.check_recorded()?;
        if self.files.video.is_some() && self.variations.is_some() {
            bail!("--video shows one reach; leave --variations out");
        }
        let clip = clip.map(|path| MotionFile::read(path, &self.reading.options())).transpose()?;
        clip.iter().flat_map(|file| &file.notes).for_each(output::note);
        let bar = output::spinner();
        bar.set_message("reaching");
        let mut all = Vec::new();
        for index in 0..self.variations.unwrap_or(1) {
            let job = self.job(self.seed.wrapping_add(index));
            let reached = reach(&job, clip.as_ref())?;
            for path in &self.files.motions {
                let path = if self.variations.is_some() { of_seed(path, reached.report.seed) } else { path.clone() };
                let rig =
                    |_: &RecordedCharacter| Ok(clip.as_ref().map(|file| reached.own_rig(&job, file)).transpose()?);
                // Out of a clip, the character alone: the targets are no part of its file.
                let only = clip.as_ref().map(|_| BODY);
                write_recording(&path, &reached.recording, only, rig)?;
            }
            all.push(reached);
        }
        let title = self.title();
        let picture = match (&all[..], self.variations) {
            ([one], None) => {
                self.files.write_report(&one.report)?;
                self.files.picture.as_ref().map(|_| sheet(one, &title))
            }
            (all, _) => {
                self.files.write_report(&all.iter().map(|one| &one.report).collect::<Vec<_>>())?;
                self.files.picture.as_ref().map(|_| contact_sheet(all, &title))
            }
        };
        if let Some((path, sheet)) = self.files.picture.as_ref().zip(picture) {
            output::write_bytes(path, &sheet.to_png().context("the picture")?)?;
        }
        if let [one] = &all[..] {
            self.files.write_video(|| movie(one, &title))?;
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
            avoid: self.avoid.clone(),
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
            back: self.back,
        }
    }

    fn title(&self) -> String {
        let place = |point: &DVec3| format!("{}:{}:{}", point.x, point.y, point.z);
        let targets: Vec<String> =
            [&self.target, &self.target_left, &self.target_right].into_iter().flatten().map(place).collect();
        let reach = format!("reach for {}", targets.join(" and "));
        match &self.from {
            Some((path, secs)) => {
                let name = path.file_name().unwrap_or(path.as_os_str()).display();
                format!("{name} at {secs} s, then {reach}")
            }
            None => reach,
        }
    }

    fn words(&self, all: &[Reached]) -> String {
        let seed = |seed: u64| if all.len() > 1 { format!("seed {seed}: ") } else { String::new() };
        let mut lines: Vec<String> =
            all.iter().map(|one| format!("{}{}", seed(one.report.seed), one.report.words())).collect();
        let nothing = || "nothing written; add -o reach.glb, --report r.json or --picture p.png".to_owned();
        lines.push(self.written(all).unwrap_or_else(nothing));
        lines.join("\n")
    }

    /// The list of written files, as text: of variations the first and the last.
    fn written(&self, all: &[Reached]) -> Option<String> {
        if self.variations.is_none() {
            return self.files.words(std::iter::empty());
        }
        let (first, last) = (all.first()?.report.seed, all.last()?.report.seed);
        let of = |path: &PathBuf| match all.len() {
            1 => of_seed(path, first).display().to_string(),
            many => format!("{} to {} ({many} files)", of_seed(path, first).display(), of_seed(path, last).display()),
        };
        let others = self.files.report.iter().chain(&self.files.picture).map(|path| path.display().to_string());
        let names: Vec<String> = self.files.motions.iter().map(of).chain(others).collect();
        (!names.is_empty()).then(|| format!("wrote {}", names.join(", ")))
    }
}

/// `reach.glb` as `reach_seed7.glb`.
fn of_seed(path: &Path, seed: u64) -> PathBuf {
    let stem = path.file_stem().unwrap_or_default().to_string_lossy();
    let extension = path.extension().unwrap_or_default().to_string_lossy();
    path.with_file_name(format!("{stem}_seed{seed}.{extension}"))
}
