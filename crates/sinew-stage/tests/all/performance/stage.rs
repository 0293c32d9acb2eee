//! Running a shipped scene step by step.
#![allow(dead_code, reason = "tests of two programs use a part each")]

use glam::DVec3;
use sinew_body::humanoid::Node;
use sinew_stage::{Effect, Scene, Stage};
use sinew_world::{CharacterFrame, Entity, PropId};

/// A shipped scene, with values changed by their paths.
pub fn shipped(name: &str, sets: &[(&str, &str)]) -> Stage {
    let mut scene = Scene::read(&sinew_testkit::repository(&format!("scenes/{name}.toml")))
        .unwrap_or_else(|error| panic!("{error}"));
    for (path, value) in sets {
        scene.set(path, value).unwrap_or_else(|error| panic!("{error}"));
    }
    of(scene)
}

pub fn of(scene: Scene) -> Stage {
    Stage::new(scene, crate::host()).unwrap_or_else(|error| panic!("{error}"))
}

/// Steps until a time \[s\], looking at every frame.
pub fn until(stage: &mut Stage, time_secs: f64, mut look: impl FnMut(&Stage)) {
    while stage.frame().time_secs < time_secs - 1e-9 {
        stage.step();
        look(stage);
    }
    let wrong: Vec<_> = stage
        .events()
        .list()
        .iter()
        .filter(|event| matches!(event.effect, Effect::Refused(_) | Effect::ScriptFailed { .. }))
        .collect();
    assert!(wrong.is_empty(), "{wrong:#?}");
}

pub fn prop(stage: &Stage, name: &str) -> PropId {
    stage.cast().prop(name).unwrap()
}

pub fn prop_centre(stage: &Stage, name: &str) -> DVec3 {
    stage.frame().props[prop(stage, name).slot()].centre
}

pub fn character<'a>(stage: &'a Stage, name: &str) -> &'a CharacterFrame {
    &stage.frame().characters[stage.cast().character(name).unwrap().slot()]
}

pub fn centre(stage: &Stage, name: &str, node: Node) -> DVec3 {
    character(stage, name).part(node).centre
}

/// Upward impulse that a thing gives a character in this step \[N s\].
pub fn borne(stage: &Stage, name: &str, by: impl Fn(Entity) -> bool) -> f64 {
    let who = stage.cast().character(name).unwrap();
    let is_part = |entity| matches!(entity, Entity::Part(character, _) if character == who);
    let contacts = stage.frame().contacts.iter();
    contacts
        .map(|contact| match (is_part(contact.a), is_part(contact.b)) {
            (true, false) if by(contact.b) => -contact.impulse.y,
            (false, true) if by(contact.a) => contact.impulse.y,
            _ => 0.0,
        })
        .sum()
}

/// Height of the lower ankle over the ground \[m\]; about 0.09 standing.
pub fn lower_ankle_m(stage: &Stage, name: &str) -> f64 {
    let frame = character(stage, name);
    frame.part(Node::LeftFoot).position.y.min(frame.part(Node::RightFoot).position.y)
}

/// When something first happened \[s\].
pub fn when(stage: &Stage, effect: &Effect) -> f64 {
    let found = stage.events().list().iter().find(|event| event.effect == *effect);
    found.unwrap_or_else(|| panic!("no `{effect}` in {:#?}", stage.events().list())).time_secs
}
