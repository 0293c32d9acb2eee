//! The README's commands, run as a reader would.

use crate::page::shell_lines;
use crate::{command, repository};
use std::fs;
use std::path::{Path, PathBuf};

/// What the first command leaves in `out/`.
const FILES: [&str; 4] = ["pushed.bvh", "pushed.glb", "pushed.png", "report.json"];

/// The clips that the README's examples are about: stand-ins are put there.
const CLIPS: [&str; 2] = ["walk.bvh", "other.bvh"];

/// Runs the README's first command in an empty folder and looks whether its files appear; then every line of its shell
/// blocks that begins with `sinew`, on copies of what the first command wrote.
///
/// # Errors
/// When a command fails or leaves a file out.
pub fn run() -> Result<(), String> {
    let page = repository::root().join("README.md");
    let page = fs::read_to_string(&page).map_err(|error| format!("{}: {error}", page.display()))?;
    let lines = shell_lines(&page);
    let first = lines.first().ok_or("README.md has no shell block")?;
    let arguments =
        first.strip_prefix("cargo run ").ok_or_else(|| format!("README.md's first command is {first:?}"))?;
    let folder = Folder::new()?;
    run_here(&folder.0, &arguments.split_whitespace().collect::<Vec<_>>())?;
    for name in FILES {
        let path = folder.0.join("out").join(name);
        let bytes = fs::metadata(&path).map_or(0, |file| file.len());
        if bytes == 0 {
            return Err(format!("the README's first command did not write out/{name}"));
        }
        println!("out/{name}: {bytes} bytes");
    }
    for clip in CLIPS {
        fs::copy(folder.0.join("out/pushed.bvh"), folder.0.join(clip)).map_err(|error| error.to_string())?;
    }
    // The examples name the shipped scenes, which name the samples.
    for name in ["scenes", "samples"] {
        copy_folder(&repository::root().join(name), &folder.0.join(name))?;
    }
    for line in lines.iter().filter_map(|line| line.strip_prefix("sinew ")) {
        let arguments: Vec<&str> = ["--release", "--"].into_iter().chain(line.split_whitespace()).collect();
        run_here(&folder.0, &arguments)?;
    }
    Ok(())
}

/// Copies a folder with all that is in it.
fn copy_folder(from: &Path, to: &Path) -> Result<(), String> {
    let io = |error: std::io::Error| format!("{}: {error}", from.display());
    fs::create_dir_all(to).map_err(io)?;
    for entry in fs::read_dir(from).map_err(io)? {
        let entry = entry.map_err(io)?;
        let (from, to) = (entry.path(), to.join(entry.file_name()));
        if from.is_dir() {
            copy_folder(&from, &to)?;
        } else {
            fs::copy(&from, &to).map_err(io)?;
        }
    }
    Ok(())
}

/// `cargo run` of the project with the working directory elsewhere.
fn run_here(folder: &Path, arguments: &[&str]) -> Result<(), String> {
    let manifest = repository::root().join("Cargo.toml");
    let manifest = manifest.to_str().ok_or("the repository's path is not Unicode")?;
    let arguments: Vec<&str> = ["run", "--manifest-path", manifest].iter().chain(arguments).copied().collect();
    command::run(&mut command::cargo(folder, &arguments))
}

/// An empty folder that is gone afterwards.
struct Folder(PathBuf);

impl Folder {
    fn new() -> Result<Folder, String> {
        let path = std::env::temp_dir().join(format!("sinew-readme-{}", std::process::id()));
        fs::create_dir(&path).map_err(|error| format!("{}: {error}", path.display()))?;
        Ok(Folder(path))
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = fs::remove_dir_all(&self.0);
    }
}
