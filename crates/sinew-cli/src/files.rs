//! `-o`, `--report`, `--picture`, `--video`: output files.

use crate::{output, video};
use anyhow::{Context, Result, bail};
use sinew::jobs::run::{character_clip, character_scene, csv, scene_file};
use sinew::motion::formats::{Format, WriteJob, write, write_scene};
use sinew::motion::nearest_name;
use sinew::picture::Movie;
use sinew::stage::{OwnRig, RecordedCharacter, Recording};
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
    /// Where to show the motion as moving pictures, in real time at 25 a second: .gif, .apng, or .mp4 where ffmpeg is
    /// installed.
    #[arg(long, value_name = "V.gif")]
    pub video: Option<PathBuf>,
}

impl Files {
    /// All of them.
    pub fn all(&self) -> impl Iterator<Item = &PathBuf> {
        self.motions.iter().chain(&self.report).chain(&self.picture).chain(&self.video)
    }

    /// Checks outputs before any work is done: no input is overwritten, no two results go to one file.
    pub fn check_places<'a>(
        &'a self,
        inputs: impl Iterator<Item = &'a PathBuf>,
        more: impl Iterator<Item = &'a PathBuf>,
    ) -> Result<()> {
        output::check_places(inputs, self.all().chain(more))?;
        self.picture.as_deref().map_or(Ok(()), output::check_picture)?;
        self.video.as_deref().map_or(Ok(()), video::check)
    }

    /// Refuses formats in which a recording is not written.
    pub fn check_recorded(&self) -> Result<()> {
        self.motions.iter().filter(|path| !is_csv(path)).try_for_each(|path| output::check_format(path))
    }

    /// Writes the moving pictures, if they are asked for.
    pub fn write_video(&self, movie: impl FnOnce() -> Movie) -> Result<()> {
        self.video.as_ref().map_or(Ok(()), |path| video::write(path, &movie()))
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

/// Writes a recording as a file: of all in it, or of one character. `rig` gives a character's own skeleton where it has one: what one
/// character does is written on that, and a note says on which.
pub(crate) fn write_recording(
    path: &Path,
    recording: &Recording,
    character: Option<&str>,
    rig: impl Fn(&RecordedCharacter) -> Result<Option<OwnRig>>,
) -> Result<()> {
    output::make_folder(path)?;
    if is_csv(path) {
        if character.is_some() {
            one_of(recording, character, path)?;
        }
        return output::write_bytes(path, csv(recording, character).as_bytes());
    }
    let is_alone = recording.characters.len() == 1 && recording.props.iter().all(|prop| prop.is_sensor);
    let holds_all = matches!(Format::of(path), Some(Format::Glb | Format::Gltf));
    let place = path.display();
    if character.is_none() && holds_all && !is_alone {
        write_scene(path, &scene_file(recording))?;
        for character in &recording.characters {
            if let Some(rig) = rig(character)? {
                let (name, file) = (&character.name, rig.file().path.display());
                eprintln!(
                    "note: {place}: {name} is shown as a body of 18 parts; --character {name} writes it on the skeleton of {file}"
                );
            }
        }
        return Ok(());
    }
    let character = one_of(recording, character, path)?;
    let name = &character.name;
    let notes = match rig(character)? {
        Some(rig) => {
            let (clip, rows) = rig.clip(&character.poses);
            eprintln!("note: {place}: {name} is on the skeleton and mesh of {}", rig.file().path.display());
            rig.file().write(path, &clip, &rows, &sinew::figure::body_shapes(&rig.reduction().shapes()))?
        }
        None => {
            eprintln!("note: {place}: {name} has no clip of its own and is written as a body of 18 parts");
            if holds_all {
                write_scene(path, &character_scene(recording, character))?;
                return Ok(());
            }
            let clip = character_clip(recording, character);
            write(path, &WriteJob { clip: &clip, source: None }, &[])?
        }
    };
    notes.iter().for_each(output::note);
    Ok(())
}

/// The character for a file that holds one.
fn one_of<'a>(recording: &'a Recording, character: Option<&str>, path: &Path) -> Result<&'a RecordedCharacter> {
    let characters = &recording.characters;
    let names: Vec<&str> = characters.iter().map(|character| character.name.as_str()).collect();
    let find = |same: &dyn Fn(&str) -> bool| characters.iter().find(|character| same(&character.name));
    match (character, &characters[..]) {
        (Some(name), _) => {
            let nearest = || match nearest_name(name, names.iter().copied()) {
                Some(near) => format!("did you mean `{near}`? "),
                None => String::new(),
            };
            find(&|known| known == name)
                .or_else(|| find(&|known| known.eq_ignore_ascii_case(name)))
                .with_context(|| format!("no character `{name}`; {}there are {}", nearest(), names.join(", ")))
        }
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
