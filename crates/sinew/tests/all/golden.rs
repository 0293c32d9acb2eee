//! A shipped scene gives the bits that it always gave, and replays to them.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use sinew::jobs::run::{RunJob, replay, run};
use sinew::stage::{Scene, Take};
use sinew_testkit::repository;
use std::collections::BTreeMap;
use std::sync::Mutex;

/// Hashes over the first second of each scene, by its name. The check compares them with a release build's as well.
fn golden() -> BTreeMap<String, String> {
    serde_json::from_str(&std::fs::read_to_string(repository("scenes/golden.json")).unwrap()).unwrap()
}

/// Runs a scene for a second, compares its hash, and replays its take. `UPDATE_GOLDEN=1` writes the hash instead.
pub fn holds(name: &str) {
    let scene = Scene::read(&repository(&format!("scenes/{name}.toml"))).unwrap_or_else(|error| panic!("{error}"));
    let job = RunJob { for_secs: Some(1.0), host: crate::host(), ..RunJob::default() };
    let ran = run(scene, &job, &mut []).unwrap_or_else(|error| panic!("{name}: {error}"));
    assert!(ran.report.characters.values().all(|character| character.resets == 0), "{name}");
    let take = Take::read(&ran.take.to_bytes().unwrap()).unwrap();
    let folder = repository("scenes");
    let again =
        replay(&take, &[], Some(&folder), crate::host(), &mut []).unwrap_or_else(|error| panic!("{name}: {error}"));
    assert_eq!(again.take.hash, take.hash, "{name}: the replay leaves the take");
    if std::env::var_os("UPDATE_GOLDEN").is_some() {
        update(name, ran.report.hash);
        return;
    }
    assert_eq!(Some(&ran.report.hash), golden().get(name), "{name}; UPDATE_GOLDEN=1 writes scenes/golden.json");
}

/// Tests of one program run side by side; programs run one after another.
fn update(name: &str, hash: String) {
    static FILE: Mutex<()> = Mutex::new(());
    let _held = FILE.lock();
    let mut hashes = golden();
    hashes.insert(name.to_owned(), hash);
    std::fs::write(repository("scenes/golden.json"), serde_json::to_string_pretty(&hashes).unwrap() + "\n").unwrap();
}

/// Names of the shipped scenes with or without controllers, sorted.
pub fn shipped(with_controllers: bool) -> Vec<String> {
    let files = std::fs::read_dir(repository("scenes")).unwrap();
    let paths = files.map(|file| file.unwrap().path()).filter(|path| path.extension().is_some_and(|end| end == "toml"));
    let has = |path: &std::path::PathBuf| std::fs::read_to_string(path).unwrap().contains("[controllers.");
    let mut names: Vec<String> = paths
        .filter(|path| has(path) == with_controllers)
        .map(|path| path.file_stem().unwrap().to_str().unwrap().to_owned())
        .collect();
    names.sort();
    names
}

/// A test for each scene, so that they run side by side, and one that none is missing.
macro_rules! scenes {
    ($with_controllers:literal: $($test:ident $name:literal)*) => {
        $(#[test]
        fn $test() {
            $crate::golden::holds($name);
        })*

        #[test]
        fn every_shipped_scene_has_its_test_here() {
            assert_eq!($crate::golden::shipped($with_controllers), [$($name),*]);
        }
    };
}
pub(crate) use scenes;
