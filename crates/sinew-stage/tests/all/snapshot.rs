//! A stage is restored to the same bits, whatever runs on it, and runs on from there in another way.

#![allow(clippy::unwrap_used, reason = "a test that fails may panic")]

use sinew_control::{Action, Command};
use sinew_stage::{Cause, CharacterEffect, Effect, RestoreError, Scene, Stage};
use sinew_testkit::{none_of, repository, work};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// Half a second at 240 Hz.
pub const HALF: usize = 120;

pub fn run(stage: &mut Stage, steps: usize) -> u64 {
    (0..steps).for_each(|_| stage.step());
    stage.hash()
}

/// All shipped scenes that need no Python host.
pub fn shipped() -> Vec<PathBuf> {
    let scenes = std::fs::read_dir(repository("scenes")).unwrap().map(|entry| entry.unwrap().path());
    let mut scenes: Vec<PathBuf> =
        scenes.filter(|path| path.extension().is_some_and(|extension| extension == "toml")).collect();
    scenes.retain(|path| Scene::read(path).unwrap().controllers.is_empty());
    scenes.sort();
    scenes
}

/// What is wrong, if anything.
fn try_scene(golden: &BTreeMap<String, String>, path: &Path) -> Option<String> {
    let name = path.file_stem().unwrap().display().to_string();
    let wrong = |what: &str| Some(format!("{name}: {what}"));
    let new = || Stage::new(Scene::read(path).unwrap(), None).unwrap();
    let mut stage = new();
    run(&mut stage, HALF);
    let kept = stage.snapshot();
    if kept.hash() != stage.hash() || kept.step() != HALF as u64 {
        return wrong("the snapshot is not of this step");
    }
    let first = run(&mut stage, HALF);
    // The golden hashes are those of the first second.
    if golden.get(&name) != Some(&format!("{first:016x}")) {
        return wrong("taking a snapshot changes the bits of the run");
    }
    let (frame, events) = (stage.frame().clone(), stage.events().list().to_vec());
    stage.restore(&kept).unwrap();
    if stage.hash() != kept.hash() {
        return wrong("the hash is not restored");
    }
    if run(&mut stage, HALF) != first || *stage.frame() != frame || stage.events().list() != events {
        return wrong("after a restore it goes on to other bits");
    }
    None
}

#[test]
fn every_shipped_scene_goes_on_to_the_same_bits_after_a_restore() {
    let scenes = shipped();
    assert!(scenes.len() > 30, "the shipped scenes are there: {}", scenes.len());
    let golden = std::fs::read_to_string(repository("scenes/golden.json")).unwrap();
    let golden: BTreeMap<String, String> = serde_json::from_str(&golden).unwrap();
    let failures: Vec<String> = work(&scenes, |path| try_scene(&golden, path)).into_iter().flatten().collect();
    none_of(scenes.len(), &failures);
}

#[test]
fn what_if_is_another_run_and_the_snapshot_still_gives_the_first_one() {
    let new = || Stage::new(Scene::read(&repository("scenes/block.toml")).unwrap(), None).unwrap();
    let mut stage = new();
    run(&mut stage, HALF);
    let kept = stage.snapshot();
    let first = run(&mut stage, HALF);
    stage.restore(&kept).unwrap();
    let cast = stage.cast().clone();
    for (_, name) in cast.characters() {
        stage.command(Command::to(name, Action::Tracker { name: "none".to_owned() }));
    }
    assert_ne!(run(&mut stage, HALF), first);
    // Back again, out of a state that the snapshot has never seen, and in another stage of the same scene.
    stage.restore(&kept).unwrap();
    assert_eq!(run(&mut stage, HALF), first);
    let mut another = new();
    another.restore(&kept).unwrap();
    assert_eq!(run(&mut another, HALF), first);
}

const SCENE: &str = "format = 1\n[characters.one]\n[props.ball]\nball_radius_m = 0.1\nmass_kg = 1\nposition_m = [0, 3, 0]\n\
                     [[at]]\ntime_secs = 0.5\ncharacter = \"one\"\ndo = \"tracker\"\nname = \"kinematic\"\n";

fn stage(text: &str) -> Stage {
    Stage::new(Scene::from_text(text).unwrap(), None).unwrap()
}

#[test]
fn a_snapshot_of_another_scene_is_an_error_and_changes_nothing() {
    let kept = stage(&SCENE.replace("3, 0", "2, 0")).snapshot();
    let mut stage = stage(SCENE);
    run(&mut stage, 10);
    let (hash, step) = (stage.hash(), stage.frame().step);
    assert_eq!(stage.restore(&kept), Err(RestoreError::OtherScene));
    assert_eq!((stage.hash(), stage.frame().step), (hash, step));
}

#[test]
fn what_waits_what_is_timed_and_what_can_be_undone_are_restored() {
    let gain = |factor| Command::to("one", Action::Gain { factor, part: None });
    let mut stage = stage(SCENE);
    stage.command(gain(0.5));
    stage.step();
    stage.command(gain(0.25));
    // One command was applied, another waits, and a change of tracker is still to come.
    let kept = stage.snapshot();
    let seen = |stage: &mut Stage| {
        let one = stage.cast().character("one").unwrap();
        let mut seen = Vec::new();
        run(stage, 1);
        seen.push(stage.state_of(one).unwrap().gain(None).to_string());
        assert!(stage.undo() && stage.undo());
        run(stage, 1);
        seen.push(stage.state_of(one).unwrap().gain(None).to_string());
        run(stage, HALF);
        seen.push(format!("{:?}", stage.state_of(one).unwrap().tracker().kind()));
        seen.push(stage.record().len().to_string());
        (seen, stage.hash())
    };
    let first = seen(&mut stage);
    assert_eq!(first.0, ["0.25", "1", "Kinematic", "4"]);
    // The body has another tracker now than the snapshot's.
    stage.restore(&kept).unwrap();
    assert_eq!(stage.record().len(), 1);
    assert_eq!(seen(&mut stage), first);
    let applied = |event: &&sinew_stage::Event| {
        event.cause == Cause::Command
            && matches!(event.effect, Effect::Character { effect: CharacterEffect::Gain { .. }, .. })
    };
    assert_eq!(stage.events().list().iter().filter(applied).count(), 4, "none stands twice");
}
