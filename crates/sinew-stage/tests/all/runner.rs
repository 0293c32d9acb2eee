//! A runner adds pace, observers, a recording and a take to a stage, and changes none of its bits.

#![allow(clippy::unwrap_used, reason = "tests")]

use sinew_control::{Action, Command};
use sinew_stage::{Observer, Runner, Scene, Stage};

const SCENE: &str = "format = 1\n[characters.one]\n";

fn stage() -> Stage {
    Stage::new(Scene::from_text(SCENE).unwrap(), None).unwrap()
}

/// Pushes the chest before a step, and stops the run after another.
struct Pusher {
    at: u64,
    stop_after: u64,
    seen: u64,
}

impl Observer for Pusher {
    fn before_step(&mut self, stage: &mut Stage) {
        if stage.frame().step == self.at {
            let force_n = [0.0, 0.0, 80.0];
            let push = Action::Push { on: "chest".into(), force_n, for_secs: 0.1, facing: false, at_m: None };
            stage.command(Command::to("one", push));
        }
    }

    fn after_step(&mut self, stage: &Stage) {
        self.seen = stage.frame().step;
    }

    fn should_stop(&self) -> bool {
        self.seen >= self.stop_after
    }
}

fn pushed(at: u64, stop_after: u64) -> Pusher {
    Pusher { at, stop_after, seen: 0 }
}

#[test]
fn a_runner_changes_no_bit_of_what_its_stage_does() {
    let mut alone = stage();
    for _ in 0..60 {
        alone.step();
    }
    let mut runner = Runner::new(stage()).with_motion().with_take().paced();
    runner.run(60, &mut []);
    assert_eq!(runner.stage().hash(), alone.hash());
}

#[test]
fn what_an_observer_commands_acts_in_the_same_step_and_stands_in_the_take() {
    let mut runner = Runner::new(stage()).with_take();
    runner.run(30, &mut [&mut pushed(7, 100)]);
    let take = runner.take().unwrap();
    assert_eq!(take.commands.iter().map(|stamped| stamped.step).collect::<Vec<_>>(), [7]);

    let mut quiet = Runner::new(stage());
    quiet.run(7, &mut []);
    let mut again = Runner::new(stage());
    again.run(7, &mut [&mut pushed(7, 100)]);
    assert_eq!(again.stage().hash(), quiet.stage().hash());
    again.step(&mut [&mut pushed(7, 100)]);
    quiet.step(&mut []);
    assert_ne!(again.stage().hash(), quiet.stage().hash());
}

#[test]
fn the_take_of_a_run_replays_to_its_bits() {
    let mut runner = Runner::new(stage()).with_take();
    runner.run(300, &mut [&mut pushed(7, 1000)]);
    let take = runner.finish().take.unwrap();
    let mut replayed = Stage::new(take.to_scene(None).unwrap(), None).unwrap();
    replayed.prescribe(take.commands.clone());
    let mut again = Runner::new(replayed).with_take();
    again.run(take.steps, &mut []);
    assert_eq!(again.take().unwrap(), take);
    assert_eq!(take.trace.unwrap().hashes.len(), 1, "one hash at step 240");
}

#[test]
fn an_observer_ends_the_run() {
    let mut runner = Runner::new(stage());
    runner.run(100, &mut [&mut pushed(0, 20)]);
    assert_eq!(runner.stage().frame().step, 20);
}

#[test]
fn motion_is_recorded_at_the_motion_rate_from_the_first_pose_on() {
    let mut runner = Runner::new(stage()).with_motion();
    runner.run(241, &mut []);
    // 240 physics steps are a second, that is 60 frames, and the pose at the start.
    assert_eq!(runner.recording().unwrap().frames, 61);
}

#[test]
fn a_stage_that_has_already_run_has_no_whole_take() {
    let mut begun = stage();
    begun.step();
    assert!(Runner::new(begun).with_take().take().is_none());
}

/// An engine keeps what it shares between its threads in a resource of its own, and asks this of it.
#[test]
fn a_stage_can_be_a_resource_of_an_engine() {
    fn is_shared<T: Send + Sync + 'static>() {}
    is_shared::<Stage>();
    is_shared::<Runner>();
}
