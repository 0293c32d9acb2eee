//! The shipped walk: it walks in two dimensions, bears two pushes, and goes on in three.

#![allow(clippy::unwrap_used, clippy::disallowed_methods, reason = "tests")]

use glam::DVec3;
use sinew::body::humanoid::Node;
use sinew::jobs::run::{Ran, RunJob, run};
use sinew::stage::{Cause, CharacterEffect, Effect, Scene};
use std::path::Path;
use std::sync::LazyLock;

/// Times of the scene \[s\].
const PUSHED_FROM_BEHIND: f64 = 7.0;
const PUSHED_FROM_THE_FRONT: f64 = 11.0;
const FREED: f64 = 15.4;

/// The scene lasts long enough that one run should serve all tests.
static RAN: LazyLock<Ran> = LazyLock::new(|| {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes/walk2d.toml");
    let scene = Scene::read(&file).unwrap_or_else(|error| panic!("{error}"));
    run(scene, &RunJob::default(), &mut []).unwrap_or_else(|error| panic!("{error}"))
});

/// Where a part's joint is in every frame from one time to another \[m\].
fn path(node: Node, from_secs: f64, until_secs: f64) -> Vec<DVec3> {
    let walker = &RAN.recording.characters[0];
    let frame = |secs: f64| ((secs * RAN.recording.motion_hz).round() as usize).min(walker.poses.len());
    walker.poses[frame(from_secs)..frame(until_secs)]
        .iter()
        .map(|pose| pose.positions(&walker.body)[node.index()])
        .collect()
}

/// The feet that came down by a touch of the ground, with the time of each \[s\].
fn steps(from_secs: f64, until_secs: f64) -> Vec<(f64, &'static str)> {
    let events = RAN.report.events.iter().filter(|event| (from_secs..until_secs).contains(&event.time_secs));
    let steps = events.filter_map(|event| {
        let Effect::Character { effect: CharacterEffect::Transition { from, .. }, .. } = &event.effect else {
            return None;
        };
        let Cause::GraphTouch { touched, .. } = &event.cause else { return None };
        let foot = ["left", "right"].into_iter().find(|side| *from == format!("{side}_reach"))?;
        let is_own = touched.iter().any(|thing| *thing == format!("walker.{foot}Foot"));
        is_own.then_some((event.time_secs, foot))
    });
    steps.collect()
}

fn alternate(steps: &[(f64, &str)]) -> bool {
    steps.windows(2).all(|pair| pair[0].1 != pair[1].1)
}

fn end_secs() -> f64 {
    RAN.report.duration_s
}

#[test]
fn it_walks_at_least_eight_steps_with_one_foot_after_the_other_before_anybody_pushes() {
    let steps = steps(0.0, PUSHED_FROM_BEHIND);
    assert!(steps.len() >= 8, "{steps:?}");
    assert!(alternate(&steps), "{steps:?}");
    let hips = path(Node::Hips, 3.0, PUSHED_FROM_BEHIND);
    let metres = hips[hips.len() - 1].z - hips[0].z;
    // People stroll at 0.8 m/s and hurry at 2.
    let speed = metres / (PUSHED_FROM_BEHIND - 3.0);
    assert!((0.8..2.0).contains(&speed), "{speed} m/s");
}

#[test]
fn feet_that_stand_do_not_slide_and_feet_that_swing_leave_the_ground() {
    // A stride and more, long after the start. A foot that stands keeps its ankle; one that swings carries it well above where
    // it stands.
    for foot in [Node::LeftFoot, Node::RightFoot] {
        let path = path(foot, 3.0, PUSHED_FROM_BEHIND);
        let lowest = path.iter().map(|place| place.y).fold(f64::INFINITY, f64::min);
        let highest = path.iter().map(|place| place.y).fold(0.0, f64::max);
        assert!(highest > lowest + 0.05, "{foot:?} from {lowest} m to {highest} m");
        // In the middle of its stance the ankle lies lowest and stays there.
        let still = path.windows(2).filter(|pair| (pair[1] - pair[0]).length() < 0.004).count();
        // A foot stands for three fifths of a walk; heel and toes roll at both ends of that.
        assert!(still as f64 > 0.3 * path.len() as f64, "{foot:?} stands in {still} of {} frames", path.len());
    }
}

#[test]
fn pushes_from_behind_and_from_the_front_do_not_end_the_walk() {
    let forward = |from: f64, until: f64| {
        let hips = path(Node::Hips, from, until);
        (hips[hips.len() - 1].z - hips[0].z) / (until - from)
    };
    let is_push = |effect: &Effect| matches!(effect.on("walker"), Some(CharacterEffect::Pushed { .. }));
    let pushes = RAN.report.events.iter().filter(|event| is_push(&event.effect)).count();
    assert!(pushes >= 2, "{:#?}", RAN.report.events);
    // 100 N s on 80 kg are 1.25 m/s, 40 N s are 0.5 m/s; joints and the ground take some of it at once.
    let before = forward(5.8, 7.0);
    let behind = forward(7.1, 7.5);
    assert!(behind > before + 0.3, "pushed from behind it goes at {behind} m/s instead of {before} m/s");
    let before = forward(9.8, 11.0);
    let front = forward(11.1, 11.5);
    assert!(front < before - 0.1, "pushed from the front it goes at {front} m/s instead of {before} m/s");
    for (from, until) in [(PUSHED_FROM_BEHIND, PUSHED_FROM_THE_FRONT), (PUSHED_FROM_THE_FRONT, FREED)] {
        let steps = steps(from, until);
        assert!(steps.len() >= 4, "{steps:?}");
        // It goes at its own speed again before the next thing happens.
        let speed = forward(until - 1.2, until);
        assert!((0.8..2.0).contains(&speed), "{speed} m/s at {until} s");
    }
}

#[test]
fn it_stays_up_and_in_its_plane_while_it_is_held_there() {
    let hips = path(Node::Hips, 0.0, FREED);
    let lowest = hips.iter().map(|place| place.y).fold(f64::INFINITY, f64::min);
    // Standing they are 1.03 m high, sitting 0.5 m.
    assert!(lowest > 0.85, "the hips come down to {lowest} m");
    let aside = hips.iter().map(|place| place.x.abs()).fold(0.0, f64::max);
    // Rows of a solver: they hold to a millimetre, not exactly.
    assert!(aside < 2e-3, "the hips leave their plane by {aside} m");
    assert_eq!(RAN.report.characters["walker"].resets, 0);
}

#[test]
fn freed_it_walks_on_in_three_dimensions() {
    let steps = steps(FREED, end_secs());
    assert!(steps.len() >= 6, "{steps:?}");
    assert!(alternate(&steps), "{steps:?}");
    let hips = path(Node::Hips, FREED + 0.5, end_secs());
    let lowest = hips.iter().map(|place| place.y).fold(f64::INFINITY, f64::min);
    assert!(lowest > 0.85, "the hips come down to {lowest} m");
    let aside = hips.iter().map(|place| place.x.abs()).fold(0.0, f64::max);
    // It is free: its weight goes from foot to foot. And it keeps its way.
    assert!((0.01..1.0).contains(&aside), "the hips go {aside} m to the side");
}
