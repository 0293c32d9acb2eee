//! Everything that must hold before a change goes in.

use crate::command::{self, cargo, output};
use crate::steps::Steps;
use crate::{golden, package, readme, repository};

/// Crates that others use alone, and the crates that these must not bring along.
const ALONE: [(&str, &[&str]); 11] = [
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
    ("sinew-cli", &["rustpython-vm", "malachite-bigint", "quinn", "tokio", "rustls"]),
];

/// The crates that are compiled with other features where somebody uses them alone than in the whole workspace: without the
/// file formats of `sinew-motion`. All others are compiled by the release build, which has no sessions.
const WITHOUT_FORMATS: [&str; 6] =
    ["sinew-motion", "sinew-body", "sinew-response", "sinew-reach", "sinew-world", "sinew-control"];

/// Runs all of it, stops at the first failure, and prints what each step took.
///
/// # Errors
/// What failed.
pub fn run() -> Result<(), String> {
    let mut steps = Steps::default();
    let done = all(&mut steps);
    println!("{}", steps.table());
    done
}

/// One development build serves lints, tests and most of the README's commands: what those claim is that the commands work. One
/// release build, the one that the README's first command makes, serves the claim that its bits are the same.
fn all(steps: &mut Steps) -> Result<(), String> {
    let root = repository::root();
    steps.run("format", || command::run(&mut cargo(&root, &["fmt", "--all", "--check"])))?;
    steps.run("lints", || {
        let lints = ["clippy", "--workspace", "--all-targets", "--all-features", "--", "-D", "warnings"];
        command::run(&mut cargo(&root, &lints))
    })?;
    steps.run("documentation", || {
        let docs = ["doc", "--workspace", "--all-features", "--no-deps"];
        command::run(cargo(&root, &docs).env("RUSTDOCFLAGS", "-D warnings"))
    })?;
    steps.run("crates that stand alone", alone)?;
    // No examples: the lints have compiled them, and nobody runs them here.
    let tests = ["test", "--workspace", "--all-features", "--tests"];
    steps.run("tests, built", || command::run(cargo(&root, &tests).arg("--no-run")))?;
    steps.run("tests", || captured(&tests))?;
    steps.run("examples in the documentation", || captured(&["test", "--workspace", "--all-features", "--doc"]))?;
    steps.run("packages", package::run)?;
    let folder = readme::Folder::new()?;
    steps.run("README, first command: release build and run", || folder.first())?;
    steps.run("README, all other commands", || folder.others())?;
    steps.run("bits of the release build", golden::run)
}

/// Tests, with those on captured motion where it is.
///
/// The runner is cargo's own, which runs the tests of one program side by side in one process: the claims of the response
/// share clips, stability searches and sweeps there, which a process for each test would make again.
fn captured(tests: &[&str]) -> Result<(), String> {
    let root = repository::root();
    match repository::shared() {
        Some(folder) => {
            println!("\ncaptured motion: {}; no test may skip it", folder.display());
            command::run(cargo(&root, tests).env("SINEW_REQUIRE_SHARED", "1"))
        }
        None => {
            // Only a test's captured words tell that it was skipped.
            let tests: Vec<&str> = tests.iter().copied().chain(["--", "--show-output"]).collect();
            let skipped = command::run_counting(&mut cargo(&root, &tests), "SKIPPED")?;
            println!("\n{skipped} tests were skipped: they need the shared folder, set SINEW_SHARED");
            Ok(())
        }
    }
}

fn alone() -> Result<(), String> {
    let packages = WITHOUT_FORMATS.iter().flat_map(|name| ["--package", name]);
    let check: Vec<&str> = ["check", "--no-default-features"].into_iter().chain(packages).collect();
    command::run(&mut cargo(&repository::root(), &check))?;
    ALONE.iter().try_for_each(|(name, unwanted)| brings_along_none_of(name, unwanted))
}

fn brings_along_none_of(name: &str, unwanted: &[&str]) -> Result<(), String> {
    let tree = ["tree", "--package", name, "--no-default-features", "--edges", "normal", "--prefix", "none"];
    let tree = output(&mut cargo(&repository::root(), &tree))?;
    let found = tree.lines().filter_map(|line| line.split(' ').next()).find(|name| unwanted.contains(name));
    found.map_or(Ok(()), |found| Err(format!("{name} must stand alone, yet brings {found} along; see Cargo.toml")))
}
