//! Every shipped scene runs, gives the same bits as ever, and replays to them.

#![allow(clippy::unwrap_used, reason = "helpers of tests")]

use sinew::jobs::run::{RunJob, replay, run};
use sinew::script::{Limits, ScriptHost};
use sinew::stage::{Scene, Take};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes")
}

fn host() -> Option<ScriptHost> {
    let program = env!("CARGO_BIN_EXE_sinew").into();
    // Many tests share the machine: a script that is only slow must not be taken for one that never returns.
    let limits = Limits { step_secs: 20.0, startup_secs: 60.0, ..Limits::default() };
    Some(ScriptHost { program, args: vec!["script-host".to_owned()], limits })
}

fn names() -> Vec<String> {
    let files = std::fs::read_dir(folder()).unwrap();
    let mut names: Vec<String> =
        files.filter_map(|file| Some(file.unwrap().file_name().to_str()?.strip_suffix(".toml")?.to_owned())).collect();
    names.sort();
    names
}

/// Hashes over the first second of each scene, by its name. The check compares them with a release build's as well.
fn golden() -> BTreeMap<String, String> {
    let text = std::fs::read_to_string(folder().join("golden.json")).unwrap();
    serde_json::from_str(&text).unwrap()
}

#[test]
fn every_scene_gives_the_bits_that_it_always_gave_and_replays_to_them() {
    let golden = golden();
    let mut found = BTreeMap::new();
    for name in names() {
        let scene = Scene::read(&folder().join(format!("{name}.toml"))).unwrap_or_else(|error| panic!("{error}"));
        let job = RunJob { for_secs: Some(1.0), host: host(), ..RunJob::default() };
        let ran = run(scene, &job, &mut []).unwrap_or_else(|error| panic!("{name}: {error}"));
        assert!(ran.report.characters.values().all(|character| character.resets == 0), "{name}");
        let take = Take::read(&ran.take.to_bytes().unwrap()).unwrap();
        let again =
            replay(&take, &[], Some(&folder()), host(), &mut []).unwrap_or_else(|error| panic!("{name}: {error}"));
        assert_eq!(again.take.hash, take.hash, "{name}: the replay leaves the take");
        found.insert(name, ran.report.hash);
    }
    let text = serde_json::to_string_pretty(&found).unwrap();
    if std::env::var_os("UPDATE_GOLDEN").is_some() {
        std::fs::write(folder().join("golden.json"), text + "\n").unwrap();
        return;
    }
    assert_eq!(found, golden, "scenes/golden.json should be:\n{text}\nUPDATE_GOLDEN=1 writes it");
}

#[test]
fn a_replay_with_another_gain_is_another_run_of_the_same_commands() {
    let scene = Scene::read(&folder().join("block.toml")).unwrap();
    let job = RunJob { for_secs: Some(0.5), host: host(), ..RunJob::default() };
    let ran = run(scene, &job, &mut []).unwrap();
    let sets = [("characters.left.pose_gain".to_owned(), "2".to_owned())];
    let other = replay(&ran.take, &sets, Some(&folder()), host(), &mut []).unwrap();
    assert_ne!(other.take.hash, ran.take.hash);
    assert_eq!(other.report.steps, ran.report.steps);
}
