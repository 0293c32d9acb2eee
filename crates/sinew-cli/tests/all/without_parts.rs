//! What the program says where the parts that are built apart are not there: the host of Python controllers, and sessions.

use sinew_testkit::repository;
use std::path::Path;
use std::process::{Command, Output};

/// Runs the program in a folder where nothing is beside it, without a `PATH`.
fn alone(folder: &Path, arguments: &[&str]) -> Output {
    let program = folder.join("sinew");
    std::fs::copy(env!("CARGO_BIN_EXE_sinew"), &program).unwrap();
    Command::new(program).env_remove("PATH").args(arguments).output().unwrap()
}

#[test]
fn a_scene_with_controllers_names_the_command_that_builds_their_host() {
    let folder = tempfile::tempdir().unwrap();
    let scene = repository("scenes/dunk.toml");
    let ran = alone(folder.path(), &["run", scene.to_str().unwrap(), "--for", "0.1"]);
    let words = String::from_utf8(ran.stderr).unwrap();
    assert_eq!(ran.status.code(), Some(1), "{words}");
    assert!(words.contains("cargo build --release -p sinew-script-host"), "{words}");
}

#[cfg(not(feature = "session"))]
#[test]
fn sessions_name_the_command_that_builds_them() {
    let folder = tempfile::tempdir().unwrap();
    for arguments in [["serve", "scenes/duel.toml", "--for", "2"], ["join", "127.0.0.1", "--as", "red"]] {
        let ran = alone(folder.path(), &arguments);
        let words = String::from_utf8(ran.stderr).unwrap();
        assert_eq!(ran.status.code(), Some(1), "{words}");
        assert!(words.contains("--features session"), "{words}");
    }
}
