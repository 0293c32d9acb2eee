//! `sinew convert`.

use crate::{Reading, output};
use anyhow::{Context, Result, bail};
use sinew::body::humanoid::{Person, Reduction};
use sinew::figure::body_shapes;
use sinew::motion::formats::MotionFile;
use sinew::motion::resample;
use std::path::PathBuf;

/// Arguments of `sinew convert`.
#[derive(Debug, clap::Args)]
pub(crate) struct Convert {
    /// The motion file to read: .bvh, .amc, .glb, .gltf, .vrm, .vrma or .fbx.
    input: PathBuf,
    /// The motion file to write: .bvh, .amc (with .asf), .glb or .gltf; .vrm and .vrma from their own kind.
    output: PathBuf,
    /// Frames per second of the output.
    #[arg(long, value_name = "N")]
    fps: Option<f64>,
    #[command(flatten)]
    reading: Reading,
}

impl Convert {
    pub(crate) fn run(&self) -> Result<()> {
        output::check_places([&self.input].into_iter().chain(&self.reading.skeleton), [&self.output].into_iter())?;
        output::check_format(&self.output)?;
        let file = MotionFile::read(&self.input, &self.reading.options())?;
        let (clip, rows): (_, Vec<usize>) = match self.fps {
            None => (file.clip.clone(), (0..file.clip.frames()).collect()),
            Some(fps) if !(1.0..=1000.0).contains(&fps) => bail!("--fps {fps} is out of range; give 1 to 1000"),
            Some(fps) => {
                let clip = resample(&file.clip, fps);
                let last = file.clip.frames().saturating_sub(1);
                let nearest = |frame: usize| (frame as f64 * file.clip.fps() / fps).round() as usize;
                let rows = (0..clip.frames()).map(|frame| nearest(frame).min(last)).collect();
                (clip, rows)
            }
        };
        let body = match &file.humanoid {
            Ok(humanoid) => Reduction::new(&file.clip, humanoid, file.stature_m, Person::default())
                .map(|reduction| body_shapes(&reduction.shapes()))
                .unwrap_or_default(),
            Err(_) => Vec::new(),
        };
        output::make_folder(&self.output)?;
        let notes = file.write(&self.output, &clip, &rows, &body).context("nothing was written")?;
        file.notes.iter().chain(&notes).for_each(output::note);
        output::say(&format!(
            "{}: {} joints, {} frames at {:.6} fps",
            self.output.display(),
            clip.skeleton().len(),
            clip.frames(),
            clip.fps()
        ))
    }
}
