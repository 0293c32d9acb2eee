//! The shipped scenes in a release build: their hashes are those that the tests find in a development build.

use crate::{command, repository};
use std::ffi::OsString;
use std::fs;
use std::process::Command;
use std::sync::atomic::{AtomicUsize, Ordering};

/// Runs every scene of `scenes/golden.json` for a second with the release build of `sinew`, two at a time, and compares the hash
/// in each report. Python controllers run in the host of the development build: what they say is text, and needs no second
/// build.
///
/// # Errors
/// When a scene does not run or gives other bits.
pub fn run() -> Result<(), String> {
    let path = repository::root().join("scenes/golden.json");
    let text = fs::read_to_string(&path).map_err(|error| format!("{}: {error}", path.display()))?;
    let entries = entries(&text);
    let next = AtomicUsize::new(0);
    let work = || {
        while let Some((name, hash)) = entries.get(next.fetch_add(1, Ordering::Relaxed)) {
            compare(name, hash)?;
        }
        Ok(())
    };
    std::thread::scope(|scope| {
        let other = scope.spawn(work);
        work().and(other.join().unwrap_or_else(|_| Err("a thread of the check has panicked".to_owned())))
    })
}

/// Runs one scene and looks for its hash.
fn compare(name: &str, hash: &str) -> Result<(), String> {
    let scene = format!("scenes/{name}.toml");
    let report = std::env::temp_dir().join(format!("sinew-golden-{}-{name}.json", std::process::id()));
    let mut sinew = Command::new(repository::target().join("release/sinew"));
    sinew.current_dir(repository::root()).env("PATH", path_with_host());
    sinew.args(["run", &scene, "--no-live", "--for", "1", "--report"]).arg(&report);
    command::output(&mut sinew)?;
    let found = fs::read_to_string(&report).map_err(|error| error.to_string())?;
    let _ = fs::remove_file(report);
    if !found.contains(&format!("\"hash\": \"{hash}\"")) {
        return Err(format!("{scene}: a release build gives other bits than {hash} in scenes/golden.json"));
    }
    println!("{scene}: {hash}");
    Ok(())
}

/// `PATH`, with the folder of the development build first.
fn path_with_host() -> OsString {
    let path = std::env::var_os("PATH").unwrap_or_default();
    let folders = [repository::target().join("debug")].into_iter().chain(std::env::split_paths(&path));
    std::env::join_paths(folders).unwrap_or(path)
}

/// Names and hashes of a flat JSON object, one entry a line.
fn entries(text: &str) -> Vec<(&str, &str)> {
    text.lines()
        .filter_map(|line| {
            let mut words = line.split('"').skip(1).step_by(2);
            Some((words.next()?, words.next()?))
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_and_hashes_are_read() {
        assert_eq!(entries("{\n  \"a\": \"0f\",\n  \"b\": \"1e\"\n}\n"), [("a", "0f"), ("b", "1e")]);
    }
}
