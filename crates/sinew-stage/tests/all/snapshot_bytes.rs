//! A stage is restored from bytes to the same bits, in another stage of the same scene; other bytes are an error.

#![allow(clippy::unwrap_used, reason = "a test that fails may panic")]

use super::snapshot::{HALF, run, shipped};
use sinew_control::source::SourceSpec;
use sinew_control::tracker::TrackerKind;
use sinew_control::{Action, Command};
use sinew_snapshot::SnapshotError;
use sinew_stage::{SNAPSHOT_VERSION, Scene, SnapshotBytesError, Stage, StageSnapshot};
use sinew_testkit::{none_of, repository, work};
use std::path::Path;

#[path = "../../../../fuzz/src/snapshot.rs"]
mod fuzz;

fn read(path: &Path) -> Stage {
    Stage::new(Scene::read(path).unwrap(), None).unwrap()
}

fn text(text: &str) -> Stage {
    Stage::new(Scene::from_text(text).unwrap(), None).unwrap()
}

/// The stage of the bytes of a stage.
fn through_bytes(stage: &mut Stage, new: impl Fn() -> Stage) -> Result<Stage, SnapshotBytesError> {
    let bytes = stage.snapshot().to_bytes(stage)?;
    let mut other = new();
    let kept = StageSnapshot::from_bytes(&bytes, &other)?;
    other.restore(&kept).unwrap();
    Ok(other)
}

/// What is wrong, if anything.
fn try_scene(path: &Path) -> Option<String> {
    let wrong = |what: String| Some(format!("{}: {what}", path.file_stem().unwrap().display()));
    let mut stage = read(path);
    // Before the first step, in the middle of a motion frame, and later.
    for steps in [0, 50, HALF - 50, HALF] {
        run(&mut stage, steps);
        let mut other = match through_bytes(&mut stage, || read(path)) {
            Ok(other) => other,
            Err(error) => return wrong(error.to_string()),
        };
        let at = stage.frame().step;
        if other.hash() != stage.hash() || other.frame() != stage.frame() {
            return wrong(format!("what is restored at step {at} is not what was kept"));
        }
        let mut uninterrupted = read(path);
        run(&mut uninterrupted, at as usize);
        if run(&mut other, HALF) != run(&mut uninterrupted, HALF) || other.frame() != uninterrupted.frame() {
            return wrong(format!("restored at step {at} it goes on to other bits"));
        }
        let words = |stage: &Stage| {
            stage.events().list().iter().map(|event| (event.step, event.effect.to_string())).collect::<Vec<_>>()
        };
        if words(&other) != words(&uninterrupted) {
            return wrong(format!("restored at step {at} it tells of other events"));
        }
    }
    None
}

#[test]
fn every_shipped_scene_goes_on_to_the_same_bits_in_another_stage() {
    let scenes = shipped();
    let failures: Vec<String> = work(&scenes, |path| try_scene(path)).into_iter().flatten().collect();
    none_of(scenes.len(), &failures);
}

/// Bytes of a snapshot for each character, the mark.
const MAX_BYTES: usize = 20 * 1024;

/// For each character that is tracked by `kd` or `response`, or follows a performer: misses the mark. What these trackers remember (two
/// whole poses with their velocities, the response's frames, the performer's buffer) is some 10 KB more.
const MAX_TRACKED_BYTES: usize = 32 * 1024;

#[test]
fn a_character_takes_at_most_20_kb() {
    let mut failures = Vec::new();
    let scenes = shipped();
    for path in &scenes {
        let mut stage = read(path);
        run(&mut stage, HALF);
        let bytes = stage.snapshot().to_bytes(&stage).unwrap().len();
        let ids: Vec<_> = stage.cast().characters().map(|(id, _)| id).collect();
        let maximum = |id| {
            let actor = stage.state_of(id).unwrap();
            let is_tracked = matches!(actor.tracker().kind(), TrackerKind::Kd | TrackerKind::Response);
            if is_tracked || actor.performance().is_some() { MAX_TRACKED_BYTES } else { MAX_BYTES }
        };
        // A prop is one body, of which a character has eighteen.
        let props = stage.frame().props.len() * MAX_BYTES / 18;
        let maximum = ids.iter().copied().map(maximum).sum::<usize>() + props;
        let name = path.file_stem().unwrap().display().to_string();
        println!("{name}: {bytes} bytes of at most {maximum}");
        if !ids.is_empty() && bytes > maximum {
            failures.push(format!("{name}: {bytes} bytes are more than {maximum}"));
        }
    }
    none_of(scenes.len(), &failures);
}

const BALL: &str = "format = 1\n[props.ball]\nball_radius_m = 0.1\nmass_kg = 1\nposition_m = [0, 0.3, 0]\n";

#[test]
fn every_changed_byte_is_an_error() {
    let mut stage = text(BALL);
    run(&mut stage, HALF);
    let bytes = stage.snapshot().to_bytes(&stage).unwrap();
    for at in 0..bytes.len() {
        for bit in 0..8 {
            let mut changed = bytes.clone();
            changed[at] ^= 1 << bit;
            let error = StageSnapshot::from_bytes(&changed, &stage).unwrap_err();
            let expected = match at {
                0..4 => SnapshotError::NotASnapshot,
                4..8 => {
                    let found = SNAPSHOT_VERSION ^ 1 << (8 * (at - 4) + bit);
                    SnapshotError::Version { found, expected: SNAPSHOT_VERSION }
                }
                _ => SnapshotError::Corrupt,
            };
            assert_eq!(error, SnapshotBytesError::Bytes(expected), "byte {at}");
        }
        assert!(StageSnapshot::from_bytes(&bytes[..at], &stage).is_err(), "cut at {at}");
    }
    assert!(StageSnapshot::from_bytes(&[&bytes[..], &[0]].concat(), &stage).is_err());
}

#[test]
fn a_snapshot_of_another_scene_has_its_own_error() {
    let mut stage = text(BALL);
    let kept = stage.snapshot();
    let bytes = kept.to_bytes(&stage).unwrap();
    let other = text(&BALL.replace("0.1", "0.2"));
    assert_eq!(StageSnapshot::from_bytes(&bytes, &other).unwrap_err(), SnapshotBytesError::OtherScene);
    assert_eq!(kept.to_bytes(&other).unwrap_err(), SnapshotBytesError::OtherScene);
}

/// Bytes whose checksum was made to fit restore something or are an error: nothing panics.
#[test]
fn bytes_that_were_made_on_purpose_do_not_panic() {
    // The target of the fuzzer, with what a generator makes in a second.
    let mut seed = 1_u64;
    let mut next = move || {
        seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (seed >> 33) as usize
    };
    for _ in 0..400 {
        let changes: Vec<u8> = (0..next() % 24).flat_map(|_| [next() as u8, next() as u8, next() as u8]).collect();
        fuzz::snapshot(&changes);
    }
}

const SCENE: &str = "format = 1\n[stage]\npose_files = [\"poses/basic.toml\"]\n[characters.one]\n[characters.two]\nposition_m = [3, 0, 0]\n\
                     source = { clip = \"walk.bvh\" }\ntracker = \"kinematic\"\n[props.ball]\nball_radius_m = 0.1\nmass_kg = 1\n\
                     position_m = [0, 3, 0]\n[[at]]\ntime_secs = 2.6\ncharacter = \"one\"\ndo = \"tracker\"\nname = \"kinematic\"\n";

/// The scene in a folder with what it names.
fn with_files() -> (tempfile::TempDir, impl Fn() -> Stage) {
    let folder = tempfile::tempdir().unwrap();
    std::fs::create_dir(folder.path().join("poses")).unwrap();
    for (from, to) in [("scenes/poses/basic.toml", "poses/basic.toml"), ("samples/walk.bvh", "walk.bvh")] {
        std::fs::copy(repository(from), folder.path().join(to)).unwrap();
    }
    let scene = folder.path().join("scene.toml");
    std::fs::write(&scene, SCENE).unwrap();
    (folder, move || read(&scene))
}

#[test]
fn what_was_changed_in_the_run_is_made_again() {
    let (_folder, new) = with_files();
    let clip = SourceSpec {
        clip: Some(serde_json::from_value(serde_json::json!("walk.bvh")).unwrap()),
        ..SourceSpec::default()
    };
    let reach = serde_json::json!({ "do": "reach", "target_m": [3.2, 1.2, 0.9], "character": "two" });
    let commands: [Vec<Command>; 6] = [
        vec![Command::to("one", Action::Source { source: Box::new(clip) })],
        vec![serde_json::from_value(reach).unwrap()],
        vec![Command::to("two", Action::ReachEnd {}), Command::to("one", Action::Pose { name: "crouch".to_owned() })],
        vec![
            Command::to("two", Action::Pose { name: "guard".to_owned() }),
            Command::to("two", Action::Tracker { name: "kd".to_owned() }),
        ],
        vec![Command::to("one", Action::Reflex { name: "balance".to_owned(), on: true })],
        vec![
            Command::to("one", Action::Gain { factor: 0.5, part: None }),
            Command::to("two", Action::Tracker { name: "response".to_owned() }),
        ],
    ];
    let mut stage = new();
    for commands in commands {
        run(&mut stage, 60);
        commands.into_iter().for_each(|command| stage.command(command));
        for wait in [0, 30] {
            run(&mut stage, wait);
            let mut other = through_bytes(&mut stage, &new).unwrap();
            let kept = stage.snapshot();
            let undone = [&mut stage, &mut other].map(|stage| {
                run(stage, 90);
                stage.undo();
                run(stage, 90);
                (stage.hash(), stage.record().to_vec(), stage.events().list().len())
            });
            assert_eq!(undone[0], undone[1], "from step {}", kept.step());
            stage.restore(&kept).unwrap();
        }
    }
    let refused: Vec<String> = stage
        .events()
        .list()
        .iter()
        .map(|event| event.effect.to_string())
        .filter(|words| words.contains("refused"))
        .collect();
    assert!(refused.is_empty(), "{refused:?}");
}

#[test]
fn a_response_to_a_clip_that_began_in_the_run_says_that_it_has_no_bytes() {
    let (_folder, new) = with_files();
    let mut stage = new();
    stage.command(Command::to("two", Action::Tracker { name: "response".to_owned() }));
    stage.step();
    let error = stage.snapshot().to_bytes(&stage).unwrap_err();
    assert!(matches!(&error, SnapshotBytesError::NotInBytes { .. }), "{error}");
    assert!(error.to_string().starts_with("the response of `two`"), "{error}");
}

#[test]
fn a_run_whose_cast_was_edited_says_that_it_has_no_bytes() {
    let mut stage = text(BALL);
    stage.step();
    stage.edit(&format!("{BALL}[characters.one]\n")).unwrap();
    stage.step();
    let error = stage.snapshot().to_bytes(&stage).unwrap_err();
    assert!(matches!(&error, SnapshotBytesError::NotInBytes { .. }), "{error}");
}
