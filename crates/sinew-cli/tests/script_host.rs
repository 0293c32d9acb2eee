//! `sinew` is the process in which its own Python runs.

#![cfg(feature = "python")]

use sinew_script::{CharacterNames, CharacterState, Limits, Names, Script, ScriptHost, Snapshot, StartInfo};
use std::path::PathBuf;
use std::process::Command;

#[test]
fn sinew_runs_a_controller_in_itself() {
    let host = ScriptHost {
        program: PathBuf::from(env!("CARGO_BIN_EXE_sinew")),
        args: vec!["script-host".to_owned()],
        // Other tests may hold all processors.
        limits: Limits { startup_secs: 60.0, ..Limits::default() },
    };
    let info = StartInfo {
        source: "class C:\n    def step(self): print(getStep())\n".to_owned(),
        file: "c.py".to_owned(),
        class: "C".to_owned(),
        own: "left".to_owned(),
        names: Names {
            characters: vec![CharacterNames { name: "left".to_owned(), aliases: Vec::new() }],
            ..Names::default()
        },
        ..StartInfo::default()
    };
    let mut script = Script::start(host, &info).unwrap();
    let outcome =
        script.step(&Snapshot { step: 3, characters: vec![CharacterState::default()], ..Snapshot::default() });
    assert_eq!((outcome.printed, outcome.error, outcome.killed), (vec!["3".to_owned()], None, None));
}

#[test]
fn help_does_not_offer_what_is_for_sinew_alone() {
    let help = Command::new(env!("CARGO_BIN_EXE_sinew")).arg("--help").output().unwrap();
    let help = String::from_utf8(help.stdout).unwrap();
    assert!(help.contains("respond") && !help.contains("script-host"), "{help}");
}
