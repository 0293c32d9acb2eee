//! Two sources layered with a weight over time.

#![allow(clippy::unwrap_used, clippy::disallowed_methods, reason = "tests")]

use glam::DVec3;
use sinew_body::humanoid::Node;
use sinew_stage::{Scene, Stage};

fn scene(blend: &str) -> Result<Scene, String> {
    let poses = "[poses.low]\njoints.chest = [10, 0, 0]\n[poses.high]\njoints.leftUpperArm = [0, 0, 90]\njoints.chest = [-10, 0, 0]\n";
    let text = format!(
        "format = 1\n[characters.one]\ntracker = \"kinematic\"\npose = \"low\"\n[characters.one.source.blend]\n{blend}\n{poses}"
    );
    Scene::from_text(&text).map_err(|error| error.to_string())
}

const LAYERS: &str =
    "base = { pose = \"low\" }\nover = { pose = \"high\" }\nweight = [[1, 0], [2, 1], [3, 1], [4, 0]]\n";

/// How far the left arm is raised to the side \[degrees\], seen from the chest, and how far the chest is bent forward.
fn angles(stage: &Stage) -> [f64; 2] {
    let pose = stage.frame().characters[0].pose();
    let arm = pose.local(Node::LeftUpperArm) * DVec3::NEG_Y;
    let chest = pose.local(Node::Chest) * DVec3::Y;
    [libm::atan2(arm.x, -arm.y).to_degrees(), libm::atan2(chest.z, chest.y).to_degrees()]
}

#[test]
fn a_blend_is_its_base_at_weight_0_the_layer_at_1_and_moves_without_a_jump_between() {
    let mut stage = Stage::new(scene(LAYERS).unwrap(), None).unwrap();
    let mut before = angles(&stage)[0];
    let (mut step, mut run_to) = (0, |stage: &mut Stage, until: usize| {
        for _ in 0..until {
            stage.step();
            let arm = angles(stage)[0];
            // 90 degrees in a second on a cubic are at most 135 degrees a second, 0.56 in a step, and the tracker's interpolation.
            assert!((arm - before).abs() < 0.7, "{before} to {arm}");
            before = arm;
        }
        angles(stage)
    });
    for (at, arm, chest) in
        [(240, 0.0, 10.0), (360, 45.0, 0.0), (480, 90.0, -10.0), (720, 90.0, -10.0), (1200, 0.0, 10.0)]
    {
        let [seen_arm, seen_chest] = run_to(&mut stage, at - step);
        step = at;
        // The tracker shows a pose at the end of the motion frame for which it was wanted: a step of physics or two of 0.56 degrees.
        assert!(
            (seen_arm - arm).abs() < 2.0 && (seen_chest - chest).abs() < 1.0,
            "{seen_arm}, {seen_chest} in step {at}"
        );
    }
}

#[test]
fn parts_that_are_not_layered_stay_with_the_base() {
    let mut stage = Stage::new(scene(&format!("{LAYERS}parts = [\"leftUpperArm\"]")).unwrap(), None).unwrap();
    for _ in 0..600 {
        stage.step();
    }
    let [arm, chest] = angles(&stage);
    // At rest there is nothing but rounding and what a key pose's own blend leaves.
    assert!((arm - 90.0).abs() < 0.1 && (chest - 10.0).abs() < 0.1, "{arm}, {chest}");
}

#[test]
fn a_blend_that_cannot_be_is_refused_at_its_key() {
    for (blend, place, hint) in [
        ("base = { pose = \"low\" }\nover = { live = {} }", "blend.over", "beside blend"),
        ("base = { pose = \"low\" }\nover = { pose = \"hgh\" }", "blend.over.pose", "high"),
        ("base = { pose = \"low\" }", "blend.over", "no source"),
        ("base = { pose = \"low\" }\nover = { pose = \"high\" }\nweight = [[1, 0], [0, 1]]", "blend.weight", "sort"),
        ("base = { pose = \"low\" }\nover = { pose = \"high\" }\nweight = [[1, 2]]", "blend.weight", "0 to 1"),
        ("base = { pose = \"low\" }\nover = { pose = \"high\" }\nparts = [\"tail\"]", "blend.parts", "no part"),
    ] {
        let problem = scene(blend).unwrap_err();
        assert!(problem.contains(place) && problem.contains(hint), "{problem}");
    }
}

/// How far the lower ankle slides over the floor at most, from its touch to its lift, in the second from a time on \[m\].
fn slide_m(stage: &mut Stage, from_secs: f64) -> f64 {
    while stage.frame().time_secs < from_secs {
        stage.step();
    }
    let (mut standing, mut at, mut worst) = (Node::LeftFoot, DVec3::INFINITY, 0f64);
    for step in 0..240 {
        stage.step();
        let character = &stage.frame().characters[0];
        let [left, right] = [Node::LeftFoot, Node::RightFoot].map(|foot| character.part(foot).position);
        let (foot, place) = if left.y < right.y { (Node::LeftFoot, left) } else { (Node::RightFoot, right) };
        if step == 0 || foot != standing {
            (standing, at) = (foot, place);
        }
        worst = worst.max((place - at).with_y(0.0).length());
    }
    worst
}

#[test]
fn a_clip_that_takes_over_from_a_walk_begins_in_its_phase() {
    let walk = std::fs::read(concat!(env!("CARGO_MANIFEST_DIR"), "/../../samples/walk.bvh")).unwrap();
    let mut slides = Vec::new();
    for tenth in 0..12 {
        let secs = 2.0 + 0.1 * f64::from(tenth);
        let run = |more: &str| {
            let text = format!(
                "format = 1\n[stage]\nduration_secs = 6\n[characters.one]\ntracker = \"kinematic\"\nsource = {{ clip = \"walk.bvh\" }}\n{more}"
            );
            let files = [("scene.toml".to_owned(), text.into_bytes()), ("walk.bvh".to_owned(), walk.clone())];
            let mut stage = Stage::new(Scene::from_files("scene.toml", files.into()).unwrap(), None).unwrap();
            slide_m(&mut stage, secs)
        };
        let undisturbed = run("");
        let handed_over = run(&format!(
            "[[at]]\ntime_secs = {secs}\ncharacter = \"one\"\ndo = \"source\"\nsource = {{ clip = \"walk.bvh\" }}\n"
        ));
        slides.push((undisturbed, handed_over));
    }
    // An ankle rolls over its foot. Half a frame's difference of phase is a centimetre at a walk's speed; with the clip's beginning in
    // place of its phase a foot slid by up to 0.56 m, undisturbed by 0.24 m.
    assert!(slides.iter().all(|(undisturbed, handed_over)| handed_over - undisturbed < 0.05), "{slides:.3?}");
}
