//! `--video`: moving pictures.

use crate::output;
use anyhow::{Context, Result, bail};
use sinew::picture::{Error, Movie};
use std::io::Write;
use std::path::Path;
use std::process::{Command, Stdio};

/// How moving pictures are written.
#[derive(Clone, Copy, PartialEq)]
enum Container {
    Gif,
    Apng,
    /// By ffmpeg, which is another program.
    Mp4,
}

fn container(path: &Path) -> Result<Container> {
    let extension = path.extension().unwrap_or_default().to_string_lossy().to_ascii_lowercase();
    match extension.as_str() {
        "gif" => Ok(Container::Gif),
        "apng" => Ok(Container::Apng),
        "mp4" => Ok(Container::Mp4),
        _ => bail!("{}: videos are written as .gif, .apng or, with ffmpeg, .mp4", path.display()),
    }
}

/// Refuses what cannot be written, before any work is done.
pub(crate) fn check(path: &Path) -> Result<()> {
    if container(path)? == Container::Mp4 {
        let found = ffmpeg().arg("-version").stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::null()).status();
        if !found.is_ok_and(|status| status.success()) {
            bail!("{}: .mp4 is written by ffmpeg, which is not found; install it, or write .gif", path.display());
        }
    }
    Ok(())
}

/// Writes moving pictures; the extension decides how.
pub(crate) fn write(path: &Path, movie: &Movie) -> Result<()> {
    match container(path)? {
        Container::Gif => output::write_bytes(path, &movie.to_gif().context("the video")?),
        Container::Apng => output::write_bytes(path, &movie.to_apng().context("the video")?),
        Container::Mp4 => write_mp4(path, movie),
    }
}

fn ffmpeg() -> Command {
    let mut command = Command::new("ffmpeg");
    command.args(["-nostdin", "-hide_banner", "-loglevel", "error"]);
    command
}

/// Gives the frames to ffmpeg, which writes beside the target; only a whole file takes its place.
fn write_mp4(path: &Path, movie: &Movie) -> Result<()> {
    output::make_folder(path)?;
    let mut name = path.file_name().unwrap_or_default().to_owned();
    name.push(format!(".{}.part", std::process::id()));
    let beside = path.with_file_name(name);
    let made = encode(&beside, movie).with_context(|| format!("{}: ffmpeg failed", path.display()));
    let moved = made.and_then(|()| Ok(std::fs::rename(&beside, path)?));
    if moved.is_err() {
        let _ = std::fs::remove_file(&beside);
    }
    moved
}

fn encode(path: &Path, movie: &Movie) -> Result<()> {
    let (width, height) = movie.size_px();
    let mut child = ffmpeg()
        .args(["-y", "-f", "rawvideo", "-pix_fmt", "rgba"])
        .args(["-s", &format!("{width}x{height}"), "-r", &Movie::FRAMES_PER_SEC.to_string(), "-i", "pipe:0"])
        // Every player shows this; quality 16 leaves no blocks around the outlines.
        .args(["-c:v", "libx264", "-pix_fmt", "yuv420p", "-crf", "16", "-movflags", "+faststart", "-f", "mp4"])
        .arg(path)
        .stdin(Stdio::piped())
        .spawn()?;
    let Some(mut pipe) = child.stdin.take() else { bail!("it takes no frames") };
    let sent =
        movie.each_frame(|image| pipe.write_all(image.rgba()).map_err(|error| Error::EncodeMovie(error.to_string())));
    drop(pipe);
    let status = child.wait()?;
    if !status.success() {
        bail!("it ended with {status}; an ffmpeg with libx264 is needed");
    }
    Ok(sent?)
}
