//! The shipped scenes in a release build: their hashes are those that the tests find in an unoptimised one.

use crate::{command, repository};
use std::fs;

/// Runs every scene of `scenes/golden.json` for a second, and compares the hash in its report.
///
/// # Errors
/// When a scene does not run or gives other bits.
pub fn run() -> Result<(), String> {
    let root = repository::root();
    let path = root.join("scenes/golden.json");
    let text = fs::read_to_string(&path).map_err(|error| format!("{}: {error}", path.display()))?;
    let report = std::env::temp_dir().join(format!("sinew-golden-{}.json", std::process::id()));
    let report_text = report.to_str().ok_or("the temporary folder's path is not Unicode")?;
    for (name, hash) in entries(&text) {
        let scene = format!("scenes/{name}.toml");
        let arguments =
            ["run", "--quiet", "--release", "--", "run", &scene, "--no-live", "--for", "1", "--report", report_text];
        command::output(&mut command::cargo(&root, &arguments))?;
        let found = fs::read_to_string(&report).map_err(|error| error.to_string())?;
        if !found.contains(&format!("\"hash\": \"{hash}\"")) {
            return Err(format!("{scene}: a release build gives other bits than {hash} in scenes/golden.json"));
        }
        println!("{scene}: {hash}");
    }
    let _ = fs::remove_file(report);
    Ok(())
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
