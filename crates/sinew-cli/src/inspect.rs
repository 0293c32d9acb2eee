//! `sinew inspect`.

use crate::flag_names::with_options;
use crate::{Reading, Who, output};
use anyhow::Result;
use sinew::jobs::inspect::{Inspection, inspect};
use sinew::motion::formats::MotionFile;
use std::fmt::Write;
use std::path::PathBuf;

/// Arguments of `sinew inspect`.
#[derive(Debug, clap::Args)]
pub(crate) struct Inspect {
    /// A motion file: .bvh, .amc, .glb, .gltf, .vrm, .vrma or .fbx.
    file: PathBuf,
    /// Print JSON for programs.
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    reading: Reading,
    #[command(flatten)]
    who: Who,
}

impl Inspect {
    pub(crate) fn run(&self) -> Result<()> {
        let file = MotionFile::read(&self.file, &self.reading.options())?;
        let inspection = inspect(&file, self.who.person());
        if self.json {
            return output::say(&serde_json::to_string_pretty(&inspection)?);
        }
        output::say(&words(&inspection))
    }
}

fn words(of: &Inspection) -> String {
    let mut text = String::new();
    // Writing to a string cannot fail.
    let mut line = |args: std::fmt::Arguments| {
        let _ = text.write_fmt(args);
        text.push('\n');
    };
    line(format_args!("{}", of.file));
    line(format_args!(
        "  {} · {} frames at {:.3} fps, {:.2} s · 1 unit = {} m",
        of.format, of.frames, of.fps, of.duration_s, of.unit_m
    ));
    if let Some(why) = &of.no_body {
        line(format_args!("  no human body: {}", with_options(why)));
    }
    if let Some(stature) = of.stature_m {
        line(format_args!("  stature {stature:.2} m"));
    }
    if let Some(floor) = of.floor_height_m {
        line(format_args!("  floor at {floor:+.3} m"));
    }
    match (of.cycle, of.cycle_s) {
        (Some((first, last)), Some(secs)) => line(format_args!("  gait cycle: frames {first}..{last}, {secs:.2} s")),
        _ if of.stature_m.is_some() => line(format_args!("  no gait cycle")),
        _ => {}
    }
    if of.animations.len() > 1 {
        line(format_args!("\nanimations ({})", of.animations.len()));
    }
    for (index, animation) in of.animations.iter().enumerate().filter(|_| of.animations.len() > 1) {
        let name = if animation.name.is_empty() { "(no name)" } else { &animation.name };
        let is_read = if animation.is_read { "  (read)" } else { "" };
        let (frames, fps) = (animation.frames, animation.fps);
        line(format_args!("  {:3} {name:28} {frames} frames at {fps:.3} fps{is_read}", index + 1));
    }
    line(format_args!("\njoints ({})", of.joints.len()));
    for joint in &of.joints {
        let part = joint.part.as_deref().unwrap_or("-");
        let mass = joint.part.as_ref().and_then(|part| of.mass_kg.get(part));
        let mass = mass.map_or(String::new(), |mass| format!("{mass:6.2} kg"));
        let guessed = if joint.guessed { "  (guessed)" } else { "" };
        line(format_args!("  {:28} {part:15} {mass}{guessed}", joint.name));
    }
    if !of.actuation_n_m.is_empty() {
        line(format_args!("\nactuation spectrum of the upper body, N m (root mean square)"));
        for row in of.actuation_n_m.chunks(8) {
            let row: Vec<String> = row.iter().map(|value| format!("{value:9.3}")).collect();
            line(format_args!("  {}", row.join("")));
        }
        line(format_args!(
            "  {} of 24 coordinates are quiet: under a hundredth of the largest torque",
            of.quiet_coordinates
        ));
    }
    if !of.defects.is_empty() {
        line(format_args!("\ndefects"));
        for defect in &of.defects {
            line(format_args!("  {}", defect.text));
        }
    }
    if !of.notes.is_empty() {
        line(format_args!("\nnotes"));
        for note in &of.notes {
            line(format_args!("  {}", with_options(note)));
        }
    }
    text.truncate(text.trim_end().len());
    text
}
