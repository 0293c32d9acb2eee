//! `-o`, `--report`, `--picture`: output files.

use crate::output;
use anyhow::{Context, Result, bail};
use sinew::jobs::run::{body_shapes, character_clip, csv, scene_clip};
use sinew::motion::formats::{Format, WriteJob, write};
use sinew::stage::{RecordedCharacter, Recording};
use std::path::{Path, PathBuf};

/// Where results go.
#[derive(Clone, Debug, Default, clap::Args)]
pub(crate) struct Files {
    /// Output file of the motion; the extension decides the format: .bvh, .amc (with .asf), .glb or .gltf, of scenes
    /// and reaches .csv too; may be repeated.
    #[arg(short = 'o', long = "output", value_name = "OUT")]
    pub motions: Vec<PathBuf>,
    /// Where to write a report as JSON.
    #[arg(long, value_name = "R.json")]
    pub report: Option<PathBuf>,
    /// Where to draw a picture.
    #[arg(long, value_name = "P.png")]
    pub picture: Option<PathBuf>,
}

impl Files {
    /// All of them.
    pub fn all(&self) -> impl Iterator<Item = &PathBuf> {
        self.motions.iter().chain(&self.report).chain(&self.picture)
    }

    /// Checks outputs before any work is done: no input is overwritten, no two results go to one file.
    pub fn check_places<'a>(
        &'a self,
        inputs: impl Iterator<Item = &'a PathBuf>,
        more: impl Iterator<Item = &'a PathBuf>,
    ) -> Result<()> {
        output::check_places(inputs, self.all().chain(more))
    }

    /// Refuses formats in which a recording is not written.
    pub fn check_recorded(&self) -> Result<()> {
        self.motions.iter().filter(|path| !is_csv(path)).try_for_each(|path| output::check_format(path))
    }

    /// Writes the report, if one is asked for.
    pub fn write_report(&self, report: &impl serde::Serialize) -> Result<()> {
        self.report.as_ref().map_or(Ok(()), |path| output::write_json(path, report))
    }

    /// The list of written files, as text.
    pub fn words<'a>(&'a self, more: impl Iterator<Item = &'a PathBuf>) -> Option<String> {
        let names: Vec<String> = self.all().chain(more).map(|path| path.display().to_string()).collect();
        (!names.is_empty()).then(|| format!("wrote {}", names.join(", ")))
    }
}

/// Writes a recording as a file: of all in it, or of one character.
pub(crate) fn write_recording(path: &Path, recording: &Recording, character: Option<&str>) -> Result<()> {
    output::make_folder(path)?;
    if is_csv(path) {
        if character.is_some() {
            one_of(recording, character, path)?;
        }
        return output::write_bytes(path, csv(recording, character).as_bytes());
    }
    let shows_all = character.is_none() && matches!(Format::of(path), Some(Format::Glb | Format::Gltf));
    let (clip, shapes) = if shows_all {
        scene_clip(recording)
    } else {
        let character = one_of(recording, character, path)?;
        (character_clip(recording, character), body_shapes(&character.body, 0))
    };
    for note in write(path, &WriteJob { clip: &clip, source: None }, &shapes)? {
        eprintln!("note: {note}");
    }
    Ok(())
}

/// The character for a file that holds one.
fn one_of<'a>(recording: &'a Recording, character: Option<&str>, path: &Path) -> Result<&'a RecordedCharacter> {
    let characters = &recording.characters;
    let names: Vec<&str> = characters.iter().map(|character| character.name.as_str()).collect();
    match (character, &characters[..]) {
        (Some(name), _) => characters
            .iter()
            .find(|character| character.name == name)
            .with_context(|| format!("no character `{name}`; there are {}", names.join(", "))),
        (None, [one]) => Ok(one),
        (None, []) => bail!("{}: the scene has no character; write .glb or .csv", path.display()),
        (None, _) => bail!(
            "{}: this format holds one character; add --character NAME of {}, or write .glb",
            path.display(),
            names.join(", ")
        ),
    }
}

fn is_csv(path: &Path) -> bool {
    path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("csv"))
}
