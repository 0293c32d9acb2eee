//! Output: text, files, progress.

use anyhow::{Context, Result, bail};
use indicatif::{ProgressBar, ProgressStyle};
use serde::Serialize;
use sinew::motion::formats::{Format, write_whole};
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::time::Duration;

/// Prints to standard output; an error if the pipe is closed.
pub(crate) fn say(text: &str) -> Result<()> {
    let mut out = io::stdout().lock();
    out.write_all(crate::flag_names::with_options(text).as_bytes())?;
    out.write_all(b"\n")?;
    Ok(out.flush()?)
}

/// Whether an error is only that the reader of our output has gone.
pub(crate) fn is_broken_pipe(error: &anyhow::Error) -> bool {
    error.downcast_ref::<io::Error>().is_some_and(|error| error.kind() == io::ErrorKind::BrokenPipe)
}

/// Writes a value as JSON with line breaks.
pub(crate) fn write_json(path: &Path, value: &impl Serialize) -> Result<()> {
    let mut text = serde_json::to_vec_pretty(value)?;
    text.push(b'\n');
    write_bytes(path, &text)
}

/// Writes a file atomically, and makes its folder.
pub(crate) fn write_bytes(path: &Path, bytes: &[u8]) -> Result<()> {
    make_folder(path)?;
    Ok(write_whole(path, bytes)?)
}

/// Refuses to overwrite an input, or to write two results to one file.
pub(crate) fn check_places<'a>(
    inputs: impl Iterator<Item = &'a PathBuf>,
    outputs: impl Iterator<Item = &'a PathBuf>,
) -> Result<()> {
    // A file that does not exist yet is identified by its folder and name.
    let place = |path: &Path| {
        path.canonicalize().ok().or_else(|| {
            let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
            Some(folder.canonicalize().unwrap_or_else(|_| folder.to_owned()).join(path.file_name()?))
        })
    };
    let mut taken: Vec<Option<PathBuf>> = inputs.map(|path| place(path)).collect();
    let read = taken.len();
    for path in outputs {
        let here = place(path);
        match taken.iter().position(|other| other.is_some() && *other == here) {
            Some(index) if index < read => {
                bail!("{}: this would overwrite an input; write to another file", path.display())
            }
            Some(_) => bail!("{}: two results have this file; give each its own file", path.display()),
            None => taken.push(here),
        }
    }
    Ok(())
}

/// Refuses a motion file to write whose format cannot be written, before any work is done.
pub(crate) fn check_format(path: &Path) -> Result<()> {
    match Format::of(path) {
        Some(Format::Fbx) | None => {
            bail!("{}: motion is written as .bvh, .amc (with .asf), .glb or .gltf", path.display())
        }
        Some(_) => Ok(()),
    }
}

/// Refuses a picture in another format than PNG, before any work is done.
pub(crate) fn check_picture(path: &Path) -> Result<()> {
    if path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("png")) {
        return Ok(());
    }
    bail!("{}: pictures are drawn as .png; --video draws .gif, .apng and .mp4", path.display())
}

/// Makes the folder that a file is to be in.
pub(crate) fn make_folder(path: &Path) -> Result<()> {
    match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => std::fs::create_dir_all(folder)
            .with_context(|| format!("{}: cannot make the folder; choose another place", folder.display())),
        _ => Ok(()),
    }
}

/// A spinner on a terminal with the present activity; nothing when piped.
pub(crate) fn spinner() -> ProgressBar {
    let bar = ProgressBar::new_spinner();
    if let Ok(style) = ProgressStyle::with_template("{spinner} {msg} {elapsed}") {
        bar.set_style(style);
    }
    bar.enable_steady_tick(Duration::from_millis(100));
    bar
}

/// Prints a note, with options in place of fields.
pub(crate) fn note(note: &sinew::motion::Note) {
    eprintln!("note: {}", crate::flag_names::with_options(&note.to_string()));
}
