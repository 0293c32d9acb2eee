//! What goes out: words, files, progress.

use anyhow::{Context, Result};
use indicatif::{ProgressBar, ProgressStyle};
use serde::Serialize;
use sinew::motion::formats::write_whole;
use std::io::{self, Write};
use std::path::Path;
use std::time::Duration;

/// Prints to standard output; an error when nobody reads any more.
pub(super) fn say(text: &str) -> Result<()> {
    let mut out = io::stdout().lock();
    out.write_all(text.as_bytes())?;
    out.write_all(b"\n")?;
    Ok(out.flush()?)
}

/// Whether an error is only that the reader of our output has gone.
pub(super) fn is_broken_pipe(error: &anyhow::Error) -> bool {
    error.downcast_ref::<io::Error>().is_some_and(|error| error.kind() == io::ErrorKind::BrokenPipe)
}

/// Writes a value as JSON with line breaks.
pub(super) fn write_json(path: &Path, value: &impl Serialize) -> Result<()> {
    let mut text = serde_json::to_vec_pretty(value)?;
    text.push(b'\n');
    write_bytes(path, &text)
}

/// Writes a file whole or not at all, making its folder.
pub(super) fn write_bytes(path: &Path, bytes: &[u8]) -> Result<()> {
    make_folder(path)?;
    Ok(write_whole(path, bytes)?)
}

/// Makes the folder that a file is to be in.
pub(super) fn make_folder(path: &Path) -> Result<()> {
    match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => std::fs::create_dir_all(folder)
            .with_context(|| format!("{}: cannot make the folder; choose another place", folder.display())),
        _ => Ok(()),
    }
}

/// A spinner on a terminal that says what takes so long; nothing when piped.
pub(super) fn spinner() -> ProgressBar {
    let bar = ProgressBar::new_spinner();
    if let Ok(style) = ProgressStyle::with_template("{spinner} {msg} {elapsed}") {
        bar.set_style(style);
    }
    bar.enable_steady_tick(Duration::from_millis(100));
    bar
}
