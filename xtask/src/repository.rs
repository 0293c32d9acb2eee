//! The repository and what lies in it.

use crate::command;
use std::env;
use std::path::{Path, PathBuf};
use std::process::Command;

/// The repository's root.
pub fn root() -> PathBuf {
    let here = Path::new(env!("CARGO_MANIFEST_DIR"));
    here.parent().unwrap_or(here).to_owned()
}

/// Every file that is, or would be, under version control: paths from the root with `/`.
///
/// # Errors
/// When this is no git repository, or there is no git.
pub fn files() -> Result<Vec<String>, String> {
    let mut git = Command::new("git");
    git.args(["ls-files", "-z", "--cached", "--others", "--exclude-standard"]).current_dir(root());
    let listed = command::output(&mut git)?;
    let present = |path: &&str| !path.is_empty() && root().join(path).is_file();
    Ok(listed.split('\0').filter(present).map(str::to_owned).collect())
}

/// Where cargo puts what it builds.
pub fn target() -> PathBuf {
    env::var_os("CARGO_TARGET_DIR").map_or_else(|| root().join("target"), PathBuf::from)
}

/// The folder of captured motion that is not part of the project, where there is one.
pub fn shared() -> Option<PathBuf> {
    let folder = env::var_os("SINEW_SHARED").map_or_else(|| root().join("../shared"), PathBuf::from);
    folder.is_dir().then_some(folder)
}
