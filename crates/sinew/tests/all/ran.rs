//! A shipped scene, run to its end, and what was seen of it.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]
#![allow(dead_code, reason = "tests of several programs use a part each")]

use glam::DVec3;
use sinew::body::humanoid::Node;
use sinew::jobs::run::{Ran, RunJob, run};
use sinew::stage::{Cause, CharacterEffect, Effect, RecordedCharacter, Scene};

/// Runs a shipped scene, with values changed by their paths.
pub fn play(name: &str, sets: &[(&str, &str)]) -> Ran {
    let file = sinew_testkit::repository(&format!("scenes/{name}.toml"));
    let mut scene = Scene::read(&file).unwrap_or_else(|error| panic!("{error}"));
    for (path, value) in sets {
        scene.set(path, value).unwrap();
    }
    let job = RunJob { host: crate::host(), ..RunJob::default() };
    run(scene, &job, &mut []).unwrap_or_else(|error| panic!("{name}: {error}"))
}

pub fn character<'a>(ran: &'a Ran, name: &str) -> &'a RecordedCharacter {
    ran.recording.characters.iter().find(|character| character.name == name).unwrap()
}

pub fn prop(ran: &Ran, name: &str) -> Vec<DVec3> {
    let prop = ran.recording.props.iter().find(|prop| prop.name == name).unwrap();
    prop.places.iter().map(|(place, _)| *place).collect()
}

pub fn frame(ran: &Ran, secs: f64) -> usize {
    (secs * ran.recording.motion_hz).round() as usize
}

/// Where a part's joint is in every frame \[m\].
pub fn path(ran: &Ran, name: &str, node: Node) -> Vec<DVec3> {
    let one = character(ran, name);
    one.poses.iter().map(|pose| pose.positions(&one.body)[node.index()]).collect()
}

/// When this first happened because of this \[s\].
pub fn event(ran: &Ran, is: impl Fn(&CharacterEffect) -> bool, because: impl Fn(&Cause) -> bool) -> f64 {
    let is_it = |effect: &Effect| matches!(effect, Effect::Character { effect, .. } if is(effect));
    let found = ran.report.events.iter().find(|event| is_it(&event.effect) && because(&event.cause));
    found.unwrap_or_else(|| panic!("no such event in {:#?}", ran.report.events)).time_secs
}

/// When a hand first took hold of the ball because it touched it \[s\].
pub fn holds(ran: &Ran, node: Node, object: &str, because: impl Fn(&Cause) -> bool) -> f64 {
    event(ran, |effect| *effect == CharacterEffect::Holds { node, object: object.into() }, because)
}
