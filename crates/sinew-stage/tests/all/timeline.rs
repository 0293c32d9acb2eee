//! Any earlier time can be gone back to, and run on from in another way, while the first take is kept.

#![allow(clippy::unwrap_used, reason = "a test that fails may panic")]

use sinew_control::{Action, Command};
use sinew_stage::{EditOutcome, Runner, Scene, SeekError, Stage, StageSnapshot, Timeline};

const SCENE: &str = "format = 1\n[characters.one]\nreflexes = [\"balance\"]\n\
                     [props.ball]\nball_radius_m = 0.1\nmass_kg = 2\nposition_m = [0.1, 2.5, 0.3]\n\
                     [[at]]\ntime_secs = 0.1\ncharacter = \"one\"\ndo = \"push\"\non = \"chest\"\nforce_n = [0, 0, 60]\nfor_secs = 0.1\n";

fn stage() -> Stage {
    Stage::new(Scene::from_text(SCENE).unwrap(), None).unwrap()
}

fn gain(factor: f64) -> Command {
    Command::to("one", Action::Gain { factor, part: None })
}

/// Steps to a step, with commands before some; gives the hash after every step.
fn run(stage: &mut Stage, timeline: &mut Timeline, until: u64, commands: &[(u64, Command)]) -> Vec<u64> {
    let mut hashes = Vec::new();
    while stage.frame().step < until {
        let now = stage.frame().step;
        commands.iter().filter(|(step, _)| *step == now).for_each(|(_, command)| stage.command(command.clone()));
        stage.step();
        timeline.watch(stage).unwrap();
        hashes.push(stage.hash());
    }
    hashes
}

#[test]
fn every_step_that_is_sought_is_what_it_was_and_goes_on_as_it_did() {
    let mut stage = stage();
    let mut timeline = Timeline::new(&mut stage).unwrap();
    let hashes = run(&mut stage, &mut timeline, 120, &[(20, gain(0.5)), (60, gain(2.0))]);
    for step in [119, 61, 60, 21, 20, 1] {
        timeline.seek(&mut stage, step).unwrap();
        assert_eq!((stage.frame().step, stage.hash()), (step, hashes[step as usize - 1]));
        assert!(run(&mut stage, &mut timeline, 120, &[]) == hashes[step as usize..], "on from {step}");
        assert_eq!(timeline.takes().len(), 1, "nothing was changed");
    }
    timeline.seek(&mut stage, 0).unwrap();
    assert_eq!(stage.frame().step, 0);
}

#[test]
fn what_if_is_another_take_and_the_first_is_kept() {
    let mut stage = stage();
    let mut timeline = Timeline::new(&mut stage).unwrap();
    let first = run(&mut stage, &mut timeline, 120, &[(20, gain(0.5)), (60, gain(2.0))]);
    let other = timeline.what_if(&mut stage, 40).unwrap();
    assert_eq!((other, timeline.present()), (1, 1));
    assert_eq!(stage.hash(), first[39]);
    let second = run(&mut stage, &mut timeline, 150, &[(50, gain(0.1))]);
    assert_ne!(second[79], first[119]);
    // Without the command of step 60: what was prescribed no longer is.
    let commands = |take: usize| timeline.takes()[take].commands().iter().map(|one| one.step).collect::<Vec<_>>();
    assert_eq!((commands(0), commands(1)), (vec![20, 60], vec![20, 50]));
    assert_eq!(timeline.takes()[1].from(), Some((0, 40)));
    // Both can be gone to, each with its own hashes.
    timeline.go_to(&mut stage, 0, 120).unwrap();
    assert_eq!(stage.hash(), first[119]);
    timeline.go_to(&mut stage, 1, 150).unwrap();
    assert_eq!(stage.hash(), second[109]);
}

#[test]
fn a_command_in_the_middle_of_what_is_known_begins_a_take_that_keeps_what_follows() {
    let mut stage = stage();
    let mut timeline = Timeline::new(&mut stage).unwrap();
    let first = run(&mut stage, &mut timeline, 100, &[(60, gain(2.0))]);
    timeline.seek(&mut stage, 30).unwrap();
    run(&mut stage, &mut timeline, 100, &[(40, gain(0.3))]);
    assert_eq!(timeline.takes()[1].from(), Some((0, 40)));
    assert_eq!(timeline.takes()[1].commands().iter().map(|one| one.step).collect::<Vec<_>>(), [40, 60]);
    assert_ne!(stage.hash(), first[99]);
    timeline.go_to(&mut stage, 0, 100).unwrap();
    assert_eq!(stage.hash(), first[99]);
}

#[test]
fn what_is_not_known_is_an_error_and_changes_nothing() {
    let mut stage = stage();
    let mut timeline = Timeline::new(&mut stage).unwrap();
    run(&mut stage, &mut timeline, 10, &[]);
    let hash = stage.hash();
    assert!(matches!(timeline.seek(&mut stage, 11), Err(SeekError::Beyond { take: 0, step: 11, known: 10 })));
    assert!(matches!(timeline.go_to(&mut stage, 1, 0), Err(SeekError::NoTake { take: 1, count: 1 })));
    assert_eq!(stage.hash(), hash);
    assert!(matches!(Timeline::new(&mut stage), Err(SeekError::BegunLate { step: 10 })));
    stage.step();
    stage.step();
    assert!(matches!(timeline.watch(&stage), Err(SeekError::NotWatched { step: 12, seen: 10 })));
}

#[test]
fn a_runner_goes_back_with_its_motion_and_its_take() {
    let mut runner = Runner::new(stage()).with_motion().with_take().with_timeline().unwrap();
    runner.run(480, &mut []);
    let whole = runner.take().unwrap();
    runner.seek(240).unwrap();
    assert_eq!(runner.recording().unwrap().frames, 61, "a second at 60 Hz, and the start");
    assert_eq!(runner.take().unwrap().trace.unwrap().hashes, whole.trace.as_ref().unwrap().hashes[..1]);
    runner.run(480, &mut []);
    assert_eq!(runner.take().unwrap(), whole);
    assert_eq!(runner.what_if(240).unwrap(), 1);
    runner.stage_mut().command(gain(0.2));
    runner.run(480, &mut []);
    let other = runner.take().unwrap();
    assert_ne!(other.hash, whole.hash);
    assert_eq!((other.commands.len(), runner.recording().unwrap().frames), (1, 121));
    assert!(matches!(Runner::new(stage()).seek(0), Err(SeekError::NoTimeline)));
}

#[test]
fn a_seek_restores_the_nearest_snapshot_instead_of_running_everything_again() {
    let mut stage = stage();
    let mut timeline = Timeline::new(&mut stage).unwrap();
    let hashes = run(&mut stage, &mut timeline, 600, &[(20, gain(0.5)), (300, gain(2.0))]);
    assert_eq!(timeline.steps_run(), 0, "nothing was sought");
    for step in [599, 310, 299, 60, 59] {
        let before = timeline.steps_run();
        timeline.seek(&mut stage, step).unwrap();
        // Snapshots lie a quarter of a second apart, 60 steps.
        assert_eq!(timeline.steps_run() - before, step % 60, "to {step}");
        assert_eq!((stage.frame().step, stage.hash()), (step, hashes[step as usize - 1]));
        assert_eq!(stage.record().len(), [20, 300].iter().filter(|at| **at < step).count());
    }
    // Another take restores the snapshots of the one that it left, up to there.
    timeline.what_if(&mut stage, 200).unwrap();
    let other = run(&mut stage, &mut timeline, 230, &[(210, gain(0.1))]);
    let before = timeline.steps_run();
    timeline.seek(&mut stage, 229).unwrap();
    assert_eq!((timeline.steps_run() - before, stage.hash()), (229 - 180, other[28]));
    timeline.go_to(&mut stage, 0, 600).unwrap();
    assert_eq!(stage.hash(), hashes[599]);
}

#[test]
fn snapshots_of_a_long_run_are_bounded_and_so_is_what_a_seek_runs() {
    let mut stage = Stage::new(Scene::from_text("format = 1\n").unwrap(), None).unwrap();
    let mut timeline = Timeline::new(&mut stage).unwrap();
    let long = 12_000;
    let hashes = run(&mut stage, &mut timeline, long, &[]);
    assert!(timeline.snapshots() <= Timeline::MAX_SNAPSHOTS, "{}", timeline.snapshots());
    for step in [long - 1, long / 2 + 1, long / 3, 7] {
        let before = timeline.steps_run();
        timeline.seek(&mut stage, step).unwrap();
        assert!(timeline.steps_run() - before <= long / 16, "to {step}: {}", timeline.steps_run() - before);
        assert_eq!(stage.hash(), hashes[step as usize - 1]);
    }
}

#[test]
fn a_scene_that_was_edited_is_sought_backwards_and_goes_on_as_a_what_if() {
    let mut stage = stage();
    let mut timeline = Timeline::new(&mut stage).unwrap();
    run(&mut stage, &mut timeline, 100, &[]);
    let edited = stage.edit(&SCENE.replace("mass_kg = 2", "mass_kg = 2\ngravity_scale = 0.1")).unwrap();
    assert_eq!(edited.iter().map(|one| one.outcome).collect::<Vec<_>>(), [EditOutcome::Applied]);
    let first = run(&mut stage, &mut timeline, 240, &[]);
    let height = |stage: &Stage| stage.frame().props[0].position.y;
    let light = height(&stage);

    // Before the edit, in the step that follows it, and long after it, everything is as it was.
    for step in [30, 101, 170] {
        timeline.seek(&mut stage, step).unwrap();
        assert!(
            run(&mut stage, &mut timeline, 240, &[]).ends_with(&first[step.max(100) as usize - 100..]),
            "from {step}"
        );
    }
    // What if it had not been edited: another take, through bytes, in another stage.
    timeline.what_if(&mut stage, 99).unwrap();
    let bytes = stage.snapshot().to_bytes(&stage).unwrap();
    let mut other = self::stage();
    other.restore(&StageSnapshot::from_bytes(&bytes, &other).unwrap()).unwrap();
    let second = run(&mut stage, &mut timeline, 240, &[]);
    (99..240).for_each(|_| other.step());
    assert_eq!(other.hash(), second[140]);
    assert!(height(&stage) < light - 0.05, "the ball weighs again: {} {light}", height(&stage));
    timeline.go_to(&mut stage, 0, 240).unwrap();
    assert_eq!((stage.hash(), height(&stage)), (first[139], light));
}
