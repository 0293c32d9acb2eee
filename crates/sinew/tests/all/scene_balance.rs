//! Standing balance and the session with keys.

#![allow(clippy::unwrap_used, reason = "tests")]

use sinew::body::humanoid::Node;
use sinew::control::Layer;
use sinew::jobs::run::{Ran, RunJob, replay, run};
use sinew::stage::{CharacterEffect as Did, Effect, Scene};
use std::path::Path;

fn scene(name: &str) -> Scene {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes").join(format!("{name}.toml"));
    Scene::read(&path).unwrap()
}

/// How far the feet are at the end from where they began \[m\].
fn feet_moved_m(ran: &Ran) -> f64 {
    let one = &ran.recording.characters[0];
    let [first, last] = [one.poses.first(), one.poses.last()].map(|pose| pose.unwrap().positions(&one.body));
    let moved = |node: Node| (first[node.index()] - last[node.index()]).length();
    moved(Node::LeftFoot).max(moved(Node::RightFoot))
}

#[test]
fn who_balances_is_pushed_from_four_sides_and_stands_where_it_stood() {
    let balanced = run(scene("balance"), &RunJob::default(), &mut []).unwrap();
    let one = &balanced.report.characters["one"];
    assert_eq!(balanced.report.events.len(), 4);
    // Standing hips are at 1.04 m.
    assert!(one.hips_height_min_m > 1.0, "{}", one.hips_height_min_m);
    assert!(feet_moved_m(&balanced) < 0.05, "{}", feet_moved_m(&balanced));
    assert!(one.com_margin_end_m.unwrap() > 0.05);

    let mut without = scene("balance");
    without.set("characters.one.reflexes", "[]").unwrap();
    let without = run(without, &RunJob::default(), &mut []).unwrap();
    assert!(without.report.characters["one"].hips_height_min_m < 0.5, "the pushes fell who does not balance");
}

#[test]
fn keys_choose_poses_pushes_and_layers_and_the_take_replays_them() {
    let press = |secs: f64, key: &str| (secs, key.to_owned());
    let presses = vec![press(1.0, "g"), press(2.0, "p"), press(4.0, "l"), press(4.2, "k"), press(6.0, "n")];
    let job = RunJob { presses, ..RunJob::default() };
    let ran = run(scene("interactive"), &job, &mut []).unwrap();
    let effect = |effect: &Effect| match effect.on("hero").cloned().unwrap() {
        // By its facing, which is a unit vector but for rounding.
        Did::Pushed { node, force_n, for_secs } => Did::Pushed { node, force_n: force_n.round(), for_secs },
        other => other,
    };
    let effects: Vec<Did> = ran.report.events.iter().map(|event| effect(&event.effect)).collect();
    let did = [
        Did::Pose { pose: "guard".to_owned() },
        Did::Pushed { node: Node::Chest, force_n: 150.0, for_secs: 0.1 },
        Did::Layer { layer: Layer::Poses, on: false },
        Did::Layer { layer: Layer::Poses, on: true },
        Did::Layer { layer: Layer::Reflexes, on: false },
    ];
    assert_eq!(effects, did);
    let poses = &ran.recording.characters[0].poses;
    // Between two frames of a sixtieth no joint jumps: 15 rad/s is a fast arm.
    for pair in poses.windows(2) {
        for node in Node::ALL {
            assert!(pair[0].local(node).angle_between(pair[1].local(node)) < 15.0 / 60.0, "{node:?}");
        }
    }
    let again = replay(&ran.take, &[], None, None, &mut []).unwrap();
    assert_eq!(again.take.hash, ran.take.hash);
}
