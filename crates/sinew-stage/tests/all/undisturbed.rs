//! The tracker `response` leaves a motion alone that nothing disturbs.

#![allow(clippy::unwrap_used, clippy::disallowed_methods, reason = "tests")]

use sinew_body::humanoid::Node;
use sinew_stage::{Scene, Stage, sample_walk_bvh};
use sinew_testkit::mocap;
use sinew_world::BodyState;
use std::collections::BTreeMap;

/// Walks of the captured set that are BVH files, of both sources.
const WALKS: [&str; 14] = [
    "accad_bvh/Female1_B03_Walk1.bvh",
    "accad_bvh/Female1_B05_WalkBackwards.bvh",
    "accad_bvh/Female1_B20_WalkWithBox.bvh",
    "accad_bvh/Female1_B22_SideStepLeft.bvh",
    "cmu_bvh_motionbuilder/02_01.bvh",
    "cmu_bvh_motionbuilder/06_01.bvh",
    "cmu_bvh_motionbuilder/06_02.bvh",
    "cmu_bvh_motionbuilder/06_06.bvh",
    "cmu_bvh_motionbuilder/07_01.bvh",
    "cmu_bvh_motionbuilder/08_01.bvh",
    "cmu_bvh_motionbuilder/08_11.bvh",
    "cmu_bvh_motionbuilder/12_01.bvh",
    "cmu_bvh_60hz_trimmed/35_01_walk.bvh",
    "cmu_bvh_60hz_trimmed/120_08_sneak.bvh",
];

/// A part that turns faster is a defect of the capture, as no muscle does it \[rad/s\]; it is left out for the next fifth of a second.
const FLIPS_RAD_S: f64 = 40.0;

/// The places of all parts, 60 times a second.
fn parts(bytes: &[u8], tracker: &str, source: &str, secs: usize) -> Vec<[BodyState; Node::COUNT]> {
    let text = format!(
        "format = 1\n[stage]\nduration_secs = {secs}\n[characters.walker]\ntracker = \"{tracker}\"\nsource = {{ clip = \"walk.bvh\"{source} }}\n"
    );
    let files = BTreeMap::from([("scene.toml".to_owned(), text.into_bytes()), ("walk.bvh".to_owned(), bytes.to_vec())]);
    let mut stage = Stage::new(Scene::from_files("scene.toml", files).unwrap(), None).unwrap();
    (0..secs * 60)
        .map(|_| {
            (0..4).for_each(|_| stage.step());
            stage.frame().characters[0].parts
        })
        .collect()
}

/// How far the tracker `response` has any part from where the tracker `kinematic` shows it [m, degrees], and which part.
fn worst(name: &str, bytes: &[u8], source: &str, secs: usize) -> (f64, f64) {
    let (ours, shown) = (parts(bytes, "response", source, secs), parts(bytes, "kinematic", source, secs));
    let mut worst = [(0.0_f64, Node::Hips, 0), (0.0_f64, Node::Hips, 0)];
    let mut flipped = [0; Node::COUNT];
    for (frame, (ours, shown)) in ours.iter().zip(&shown).enumerate() {
        for node in Node::ALL {
            // One clip has feet that flip to and fro by 40° from frame to frame.
            if shown[node.index()].angular_velocity.length() > FLIPS_RAD_S {
                flipped[node.index()] = frame;
            }
            if flipped[node.index()] + 12 > frame && flipped[node.index()] > 0 {
                continue;
            }
            let (a, b) = (&ours[node.index()], &shown[node.index()]);
            let apart = [a.position.distance(b.position), a.rotation.angle_between(b.rotation).to_degrees()];
            for (worst, apart) in worst.iter_mut().zip(apart) {
                if apart > worst.0 {
                    *worst = (apart, node, frame);
                }
            }
        }
    }
    let [(far, at, when), (turned, which, then)] = worst;
    println!("{name}{source}: {:.1} mm ({at:?}, frame {when}), {turned:.2}° ({which:?}, frame {then})", far * 1e3);
    (far, turned)
}

/// Twenty millimetres and three degrees: half of the thickness of a sole, and what nobody sees.
fn is_left_alone(name: &str, bytes: &[u8], source: &str, secs: usize) -> bool {
    let (far, turned) = worst(name, bytes, source, secs);
    far < 0.020 && turned < 3.0
}

#[test]
fn the_sample_walk_is_left_alone_once_and_repeated() {
    let walk = sample_walk_bvh().unwrap();
    let once = is_left_alone("sample walk", &walk, "", 5);
    let repeated = is_left_alone("sample walk", &walk, ", repeat = true", 8);
    assert!(once && repeated);
}

#[test]
fn captured_walks_are_left_alone() {
    let Some(mocap) = mocap() else { return };
    let moved = WALKS.iter().filter(|walk| {
        let bytes = std::fs::read(mocap.join(walk)).unwrap();
        !is_left_alone(walk, &bytes, "", 5)
    });
    let moved: Vec<_> = moved.collect();
    assert!(moved.is_empty(), "{moved:?}");
}
