//! `sinew ground`.

use crate::files::Files;
use crate::{Reading, Who, output};
use anyhow::{Context, Result};
use sinew::figure::body_shapes;
use sinew::jobs::ground::{GroundError, GroundJob, GroundReport, Grounded, ground, movie, sheet};
use sinew::motion::formats::MotionFile;
use std::path::PathBuf;

/// Arguments of `sinew ground`.
#[derive(Debug, clap::Args)]
pub(crate) struct Ground {
    /// The clip that floats, sinks, drifts or shakes: .bvh, .amc, .glb, .gltf, .vrm, .vrma or .fbx.
    clip: PathBuf,
    /// Height of the floor in metres, instead of where the clip's own soles stand on average.
    #[arg(long, value_name = "M", allow_negative_numbers = true)]
    floor: Option<f64>,
    #[command(flatten)]
    files: Files,
    #[command(flatten)]
    reading: Reading,
    #[command(flatten)]
    who: Who,
}

impl Ground {
    pub(crate) fn run(&self) -> Result<()> {
        self.files.check_places([&self.clip].into_iter().chain(&self.reading.skeleton), std::iter::empty())?;
        self.files.motions.iter().try_for_each(|path| output::check_format(path))?;
        let bar = output::spinner();
        bar.set_message("reading");
        let file = MotionFile::read(&self.clip, &self.reading.options())?;
        bar.set_message("grounding");
        let job = GroundJob { floor_m: self.floor, person: self.who.person() };
        let grounded = ground(&file, &job).map_err(|error| match error {
            // It names its file itself.
            GroundError::File(error) => anyhow::Error::new(error),
            error => anyhow::Error::new(error).context(file.path.display().to_string()),
        })?;
        bar.set_message("writing");
        let mut notes = file.notes.clone();
        let rows: Vec<usize> = (0..grounded.clip.frames()).collect();
        let body = body_shapes(&grounded.reduction.shapes());
        for path in &self.files.motions {
            output::make_folder(path)?;
            notes.extend(file.write(path, &grounded.clip, &rows, &body)?);
        }
        self.files.write_report(&grounded.report)?;
        let title = file.path.file_name().unwrap_or(file.path.as_os_str()).display().to_string();
        let humanoid = file.body_parts()?;
        if let Some(path) = &self.files.picture {
            let png = sheet(&grounded, &file.clip, humanoid, &title).to_png().context("the picture")?;
            output::write_bytes(path, &png)?;
        }
        self.files.write_video(|| movie(&grounded, &file.clip, humanoid, &title))?;
        bar.finish_and_clear();
        notes.iter().chain(&grounded.notes).for_each(output::note);
        output::say(&words(&grounded, &self.files))
    }
}

fn words(grounded: &Grounded, files: &Files) -> String {
    let GroundReport { file, frames, fps, floor_m, drift_m, lifted_m, jitter_m, before, after, .. } = &grounded.report;
    let mut lines = vec![
        format!("{file}: {frames} frames at {fps:.3} fps; its soles stand at {:+.1} cm", floor_m * 1e2),
        format!(
            "shifted: {:.1} cm over the ground by the end, {:+.1} to {:+.1} cm up; jitter of the root was {:.1} mm",
            drift_m * 1e2,
            lifted_m[0] * 1e2,
            lifted_m[1] * 1e2,
            jitter_m * 1e3
        ),
    ];
    let row =
        |name: &str, before: f64, after: f64, unit: &str| format!("  {name:<22} {before:7.2} -> {after:6.2} {unit}");
    lines.push(row("standing feet slide", before.slide_mean_m_s * 1e2, after.slide_mean_m_s * 1e2, "cm/s"));
    lines.push(row("height over the floor", before.height_rms_m * 1e2, after.height_rms_m * 1e2, "cm rms"));
    lines.push(row("deepest in the floor", before.penetration_m * 1e2, after.penetration_m * 1e2, "cm"));
    let force = (before.residual_force_weights, after.residual_force_weights);
    lines.push(row("residual root force", force.0, force.1, "of the body's weight"));
    let nothing = || "nothing written; add -o grounded.bvh, --report r.json or --picture p.png".to_owned();
    lines.push(files.words(std::iter::empty()).unwrap_or_else(nothing));
    lines.join("\n")
}
