//! The README's commands, run as a reader would.

use crate::page::shell_lines;
use crate::{command, repository};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

/// What the first command leaves in `out/`.
const FILES: [&str; 5] = ["pushed.bvh", "pushed.glb", "pushed.png", "pushed.gif", "report.json"];

/// The clips that the README's examples are about: stand-ins are put there.
const CLIPS: [&str; 2] = ["walk.bvh", "other.bvh"];

/// An empty folder in which the README's commands run; it is gone afterwards.
#[derive(Debug)]
pub struct Folder(PathBuf);

impl Folder {
    /// Makes the folder.
    ///
    /// # Errors
    /// When the temporary folder cannot be written.
    pub fn new() -> Result<Folder, String> {
        let path = std::env::temp_dir().join(format!("sinew-readme-{}", std::process::id()));
        fs::create_dir(&path).map_err(|error| format!("{}: {error}", path.display()))?;
        Ok(Folder(path))
    }

    /// Runs the README's first command as it is printed, but for the folder, and looks whether its files appear. It leaves a release
    /// build without sessions, which must name the command that builds them.
    ///
    /// # Errors
    /// When it fails or leaves a file out.
    pub fn first(&self) -> Result<(), String> {
        let lines = lines()?;
        let first = lines.first().ok_or("README.md has no shell block")?;
        let arguments =
            first.strip_prefix("cargo run ").ok_or_else(|| format!("README.md's first command is {first:?}"))?;
        let manifest = repository::root().join("Cargo.toml");
        let manifest = manifest.to_str().ok_or("the repository's path is not Unicode")?;
        let arguments: Vec<&str> =
            ["run", "--manifest-path", manifest].into_iter().chain(arguments.split_whitespace()).collect();
        command::run(&mut command::cargo(&self.0, &arguments))?;
        for name in FILES {
            let path = self.0.join("out").join(name);
            let bytes = fs::metadata(&path).map_or(0, |file| file.len());
            if bytes == 0 {
                return Err(format!("the README's first command did not write out/{name}"));
            }
            println!("out/{name}: {bytes} bytes");
        }
        let mut serve = Command::new(repository::target().join("release/sinew"));
        match command::output(serve.args(["serve", "scenes/duel.toml"])) {
            Err(words) if words.contains("--features session") => Ok(()),
            other => Err(format!("`sinew serve` without sessions does not name the build that has them: {other:?}")),
        }
    }

    /// Runs every line of the README's shell blocks that begins with `sinew`, on copies of what the first command wrote, with the
    /// development build of the tests: the claim is that the commands work.
    ///
    /// # Errors
    /// When a command fails.
    pub fn others(&self) -> Result<(), String> {
        for clip in CLIPS {
            fs::copy(self.0.join("out/pushed.bvh"), self.0.join(clip)).map_err(|error| error.to_string())?;
        }
        // The examples name the shipped scenes, which name the samples.
        for name in ["scenes", "samples"] {
            copy_folder(&repository::root().join(name), &self.0.join(name))?;
        }
        let program = repository::target().join("debug/sinew");
        for line in lines()?.iter().filter_map(|line| line.strip_prefix("sinew ")) {
            command::run(Command::new(&program).current_dir(&self.0).args(line.split_whitespace()))?;
        }
        Ok(())
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = fs::remove_dir_all(&self.0);
    }
}

fn lines() -> Result<Vec<String>, String> {
    let page = repository::root().join("README.md");
    let page = fs::read_to_string(&page).map_err(|error| format!("{}: {error}", page.display()))?;
    Ok(shell_lines(&page))
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
