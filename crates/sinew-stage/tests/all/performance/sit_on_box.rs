//! The support moves from the ground to a box and back, which Nguyen et al. 2010, section 7, name as what their system cannot do.

use super::stage::{borne, centre, character, lower_ankle_m, of, prop, shipped, until};
use glam::DVec3;
use sinew_body::humanoid::Node;
use sinew_stage::{Scene, Stage};
use sinew_world::{CharacterId, Entity};
use std::collections::BTreeMap;

/// Mean force that box and ground give the sitter over half a second \[N\].
fn supports(stage: &mut Stage, until_secs: f64) -> (f64, f64) {
    until(stage, until_secs - 0.5, |_| ());
    let the_box = Entity::Prop(prop(stage, "box"));
    let (mut on_box, mut on_ground) = (0.0, 0.0);
    until(stage, until_secs, |stage| {
        on_box += borne(stage, "sitter", |entity| entity == the_box);
        on_ground += borne(stage, "sitter", |entity| entity == Entity::Floor);
    });
    (on_box / 0.5, on_ground / 0.5)
}

#[test]
fn the_box_bears_who_sits_on_it_and_the_ground_who_stands() {
    let mut stage = shipped("sit_on_box", &[]);
    let feet = [Node::LeftFoot, Node::RightFoot].map(|foot| centre(&stage, "sitter", foot));
    let seated = supports(&mut stage, 4.2);
    let weight_n = 80.0 * 9.81;
    // Next to nothing holds it but box and ground: a fiftieth of what held it before.
    let both = seated.0 + seated.1;
    assert!(seated.0 > 0.5 * weight_n && both > 0.9 * weight_n && both < 1.1 * weight_n, "{seated:?} N of {weight_n}");
    let hips = character(&stage, "sitter").part(Node::Hips).position;
    assert!((0.55..0.72).contains(&hips.y), "{hips}");
    let up = character(&stage, "sitter").part(Node::Chest).rotation * DVec3::Y;
    assert!(up.y > 0.9, "it sits upright: {up}");
    // Its feet have not slid: the hips went back instead.
    for (foot, before) in [Node::LeftFoot, Node::RightFoot].into_iter().zip(feet) {
        let slid = centre(&stage, "sitter", foot) - before;
        assert!(slid.length() < 0.06, "{slid}");
    }
    let stands = supports(&mut stage, 8.0);
    assert_eq!(stands.0, 0.0);
    let head = centre(&stage, "sitter", Node::Head);
    assert!(head.y > 1.45 && lower_ankle_m(&stage, "sitter") < 0.13, "{head}");
}

/// The clip is a woman who sits down on a stool and rises; the stool is put where she sits.
#[test]
fn a_captured_performer_sits_down_on_a_box_and_it_bears_her() {
    let Some(mocap) = sinew_testkit::mocap() else { return };
    let clip = std::fs::read(mocap.join("cmu_bvh_60hz_trimmed/113_15_sit.bvh")).unwrap();
    let text = |tracker: &str, more: &str| {
        format!(
            "format = 1\n[stage]\nduration_secs = 5\n[characters.sitter]\nsource = {{ clip = \"sit.bvh\", repeat = false }}\ntracker = \"{tracker}\"\n{more}"
        )
    };
    let scene = |text: String| {
        let files =
            BTreeMap::from([("scene.toml".to_owned(), text.into_bytes()), ("sit.bvh".to_owned(), clip.clone())]);
        Scene::from_files("scene.toml", files).unwrap_or_else(|error| panic!("{error}"))
    };
    // Where she sits when nothing is there.
    let mut shown = of(scene(text("kd", "")));
    until(&mut shown, 3.0, |_| ());
    let hips = character(&shown, "sitter").part(Node::Hips).centre;
    // Its top is where the undersides of her thighs are, 7 cm below their middle; a centimetre makes her rest on it.
    let height = centre(&shown, "sitter", Node::LeftUpperLeg).y - 0.06;
    let more = format!(
        "[props.box]\nbox_m = [0.6, {height}, 0.5]\nposition_m = [{}, {}, {}]\nfixed = true\n",
        hips.x,
        height / 2.0,
        hips.z - 0.08,
    );
    let mut stage = of(scene(text("kd", &more)));
    let seated = supports(&mut stage, 3.6);
    let weight_n = stage.world().body(CharacterId::first_in(0)).unwrap().mass_kg() * 9.81;
    assert!(seated.0 > 0.4 * weight_n && seated.0 < 1.15 * weight_n, "the box bears {} N of {weight_n}", seated.0);
    let up = character(&stage, "sitter").part(Node::Chest).rotation * DVec3::Y;
    assert!(up.y > 0.8, "she sits upright: {up}");
    until(&mut stage, 5.0, |_| ());
    let lag = character(&stage, "sitter").part(Node::Hips).position.y;
    assert!(lag > 0.75, "she rises again: hips at {lag} m");
}
