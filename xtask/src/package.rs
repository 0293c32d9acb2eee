//! What is to be published can be packaged.

use crate::{command, repository};
use std::fs;

/// The crates that are to be published: all below `crates/` but those that say `publish = false`.
///
/// # Errors
/// When a Cargo.toml cannot be read.
pub fn published() -> Result<Vec<String>, String> {
    let folder = repository::root().join("crates");
    let entries = fs::read_dir(&folder).map_err(|error| format!("{}: {error}", folder.display()))?;
    let mut names = Vec::new();
    for entry in entries.flatten() {
        let path = entry.path().join("Cargo.toml");
        let text = fs::read_to_string(&path).map_err(|error| format!("{}: {error}", path.display()))?;
        if !text.lines().any(|line| line == "publish = false") {
            names.push(entry.file_name().to_string_lossy().into_owned());
        }
    }
    names.sort();
    Ok(names)
}

/// Packages them all in one go, so that each finds the others, which no registry has yet. They are not built from their packages:
/// a test of `xtask` looks that no source includes a file from outside.
///
/// # Errors
/// A dependency of ours without a version, a missing description, a file that is not there.
pub fn run() -> Result<(), String> {
    let names = published()?;
    let packages = names.iter().flat_map(|name| ["--package", name]);
    // The registry's index is there from the builds before.
    let arguments = ["package", "--no-verify", "--allow-dirty", "--offline", "--quiet"];
    command::run(command::cargo(&repository::root(), &arguments).args(packages))
}
