//! Everything that must hold before a change goes in.

use crate::command::{self, cargo, output};
use crate::{golden, package, readme, repository};

/// Crates that others use alone, and the crates that these must not bring along.
const ALONE: [(&str, &[&str]); 10] = [
    ("sinew-motion", &["ufbx", "serde_json", "base64"]),
    ("sinew-body", &["ufbx", "serde_json", "base64"]),
    ("sinew-response", &["ufbx", "serde_json", "base64", "clap", "tiny-skia"]),
    ("sinew-world", &["ufbx", "clap", "tiny-skia", "rustpython-vm", "toml"]),
    ("sinew-control", &["ufbx", "clap", "tiny-skia", "rustpython-vm"]),
    ("sinew-script", &["rustpython-vm", "malachite-bigint", "sinew-stage", "clap"]),
    ("sinew-stage", &["rustpython-vm", "clap", "tiny-skia"]),
    ("sinew-live", &["quinn", "tokio", "rustls", "rustpython-vm", "clap", "tiny-skia"]),
    ("sinew-picture", &["sinew-motion", "sinew-body"]),
    ("sinew", &["anyhow", "clap", "indicatif", "rustpython-vm", "malachite-bigint", "quinn", "tokio", "rustls"]),
];

/// Runs all of it, and stops at the first failure.
///
/// # Errors
/// What failed.
pub fn run() -> Result<(), String> {
    let root = repository::root();
    command::run(&mut cargo(&root, &["fmt", "--all", "--check"]))?;
    let lints = ["clippy", "--workspace", "--all-targets", "--all-features", "--", "-D", "warnings"];
    command::run(&mut cargo(&root, &lints))?;
    for (name, unwanted) in ALONE {
        command::run(&mut cargo(&root, &["check", "--package", name, "--no-default-features"]))?;
        brings_along_none_of(name, unwanted)?;
    }
    let docs = ["doc", "--workspace", "--all-features", "--no-deps"];
    command::run(cargo(&root, &docs).env("RUSTDOCFLAGS", "-D warnings"))?;
    package::run()?;
    readme::run()?;
    golden::run()?;
    tests()
}

/// Every test and every example in the documentation, with the features that are off by default.
fn tests() -> Result<(), String> {
    let root = repository::root();
    let tests = ["test", "--workspace", "--all-features"];
    match repository::shared() {
        Some(folder) => {
            println!("\ncaptured motion: {}; no test may skip it", folder.display());
            command::run(cargo(&root, &tests).env("SINEW_REQUIRE_SHARED", "1"))
        }
        None => {
            // Only a test's captured words tell that it was skipped.
            let tests: Vec<&str> = tests.into_iter().chain(["--", "--show-output"]).collect();
            let skipped = command::run_counting(&mut cargo(&root, &tests), "SKIPPED")?;
            println!("\n{skipped} tests were skipped: they need the shared folder, set SINEW_SHARED");
            Ok(())
        }
    }
}

fn brings_along_none_of(name: &str, unwanted: &[&str]) -> Result<(), String> {
    let tree = ["tree", "--package", name, "--no-default-features", "--edges", "normal", "--prefix", "none"];
    let tree = output(&mut cargo(&repository::root(), &tree))?;
    let found = tree.lines().filter_map(|line| line.split(' ').next()).find(|name| unwanted.contains(name));
    found.map_or(Ok(()), |found| Err(format!("{name} must stand alone, yet brings {found} along; see Cargo.toml")))
}
