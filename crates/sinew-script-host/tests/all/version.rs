//! A host and a stage of different versions do not talk past each other.

use crate::scene::{host, info};
use sinew_script::protocol::{VERSION, VERSION_VARIABLE, WRONG_VERSION};
use sinew_script::{Script, ScriptHost};
use std::process::{Command, Stdio};

/// The exit code of the host, started with a version or with none.
fn code(version: Option<u32>) -> Option<i32> {
    let mut command = Command::new(host().program);
    command.env_clear().stdin(Stdio::null()).stderr(Stdio::null());
    if let Some(version) = version {
        command.env(VERSION_VARIABLE, version.to_string());
    }
    command.status().unwrap().code()
}

#[test]
fn the_host_refuses_another_version_and_whoever_starts_it_by_hand() {
    assert_eq!(code(Some(VERSION + 1)), Some(i32::from(WRONG_VERSION)));
    assert_eq!(code(None), Some(2));
    // The right version waits for a question, and ends when there is nobody to ask.
    assert_eq!(code(Some(VERSION)), Some(1));
}

#[test]
fn a_stage_that_meets_another_version_says_how_to_build_the_right_one() {
    let args = vec!["-c".to_owned(), format!("exit {WRONG_VERSION}")];
    let other = ScriptHost { program: "/bin/sh".into(), args, ..host() };
    let error = Script::start(other, &info("class C:\n    def step(self): pass\n")).unwrap_err();
    assert!(error.message.contains("another version"), "{error}");
    assert!(error.message.contains("cargo build --release -p sinew-script-host"), "{error}");
}
