//! Responding walks on the stage show what their scenes say.

#![allow(clippy::unwrap_used, clippy::disallowed_methods, reason = "tests")]

use glam::{DQuat, DVec3};
use sinew::body::humanoid::{Node, Pose};
use sinew::jobs::respond::{RespondJob, respond};
use sinew::jobs::run::{Ran, RunJob, run};
use sinew::motion::Part;
use sinew::motion::formats::{MotionFile, ReadOptions};
use sinew::response::{Push, PushFrame};
use sinew::stage::Scene;
use std::path::Path;

fn scene(name: &str) -> Scene {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes").join(format!("{name}.toml"));
    Scene::read(&path).unwrap_or_else(|error| panic!("{error}"))
}

fn ran(scene: Scene) -> Ran {
    run(scene, &RunJob::default(), &mut []).unwrap()
}

fn poses<'a>(ran: &'a Ran, name: &str) -> &'a [Pose] {
    &ran.recording.characters.iter().find(|character| character.name == name).unwrap().poses
}

/// Largest angle of a joint between two runs in a stretch of time \[deg\].
fn apart_deg(one: &[Pose], other: &[Pose], node: Node, from_secs: f64, to_secs: f64) -> f64 {
    let (from, to) = ((from_secs * 60.0) as usize, (to_secs * 60.0) as usize);
    let angle = |frame: usize| one[frame].local(node).angle_between(other[frame].local(node)).to_degrees();
    (from..=to).map(angle).fold(0.0, f64::max)
}

#[test]
fn balls_move_what_they_hit_and_the_walk_comes_back() {
    let hit = ran(scene("respond_balls"));
    let mut quiet = scene("respond_balls");
    // The same walk with the balls at rest far away.
    for ball in ["medicine_ball", "football", "dodge_ball"] {
        quiet.set(&format!("props.{ball}.position_m"), "[50, 0.2, 50]").unwrap();
        quiet.set(&format!("props.{ball}.velocity_m_s"), "[0, 0, 0]").unwrap();
    }
    let quiet = ran(quiet);
    let (one, other) = (poses(&hit, "walker"), poses(&quiet, "walker"));
    // Until the first ball comes both are one walk, but for the order in which the solver adds up.
    assert!(Node::ALL.iter().all(|&node| apart_deg(one, other, node, 0.0, 0.9) < 1e-3));
    let arm = [Node::LeftShoulder, Node::LeftUpperArm, Node::LeftLowerArm];
    let hit_arm = arm.iter().map(|&node| apart_deg(one, other, node, 1.0, 1.6)).fold(0.0, f64::max);
    // 4 kg at 7 m/s: what a push of some 150 N for a tenth of a second does.
    assert!(hit_arm > 8.0, "{hit_arm}");
    let head = [Node::Head, Node::Neck].iter().map(|&node| apart_deg(one, other, node, 3.35, 3.8)).fold(0.0, f64::max);
    assert!(head > 3.0, "{head}");
    // Two and a half seconds after the last ball every joint is within the 2° that count as recovered.
    for node in Node::ALL.into_iter().skip(1) {
        assert!(apart_deg(one, other, node, 5.9, 6.0) < 2.0, "{node:?}");
    }
    assert!(hit.report.characters["walker"].hit_impulse_max_n_s > 5.0);
}

#[test]
fn a_cup_that_is_known_to_be_one_stays_upright() {
    let ran = ran(scene("respond_cup"));
    let tilt_deg = |name: &str| {
        let prop = ran.recording.props.iter().find(|prop| prop.name == name).unwrap();
        let tilt = |&(_, rotation): &(DVec3, DQuat)| (rotation * DVec3::Y).angle_between(DVec3::Y).to_degrees();
        prop.places.iter().map(tilt).fold(0.0, f64::max)
    };
    let (careful, careless) = (tilt_deg("cup_careful"), tilt_deg("cup_careless"));
    // A full cup spills at about 15°; arms swing by 50° and more.
    assert!(careful < 10.0, "{careful}");
    assert!(careless > 30.0, "{careless}");
}

#[test]
fn feet_keep_to_a_jerked_platform_while_the_trunk_lags() {
    let ran = ran(scene("respond_platform"));
    let platform = &ran.recording.props[0].places;
    let still = {
        let mut still = scene("respond_platform");
        still.set("at", "[]").unwrap();
        self::ran(still)
    };
    let (jerked, quiet) = (poses(&ran, "walker"), poses(&still, "walker"));
    let body = &ran.recording.characters[0].body;
    let mut foot_gap: f64 = 0.0;
    let mut lag: f64 = 0.0;
    for frame in 0..quiet.len() {
        let shift = platform[frame].0 - platform[0].0;
        let (one, other) = (jerked[frame].positions(body), quiet[frame].positions(body));
        for foot in [Node::LeftFoot, Node::RightFoot] {
            foot_gap = foot_gap.max((one[foot.index()] - shift - other[foot.index()]).length());
        }
        lag = lag.max((other[Node::Head.index()] - (one[Node::Head.index()] - shift)).x);
    }
    // The pins' give under 5 m/s², and the step from still to moving.
    assert!(foot_gap < 0.03, "{foot_gap}");
    // The head is left behind by a few centimetres.
    assert!(lag > 0.02, "{lag}");
}

#[test]
fn who_avoids_posts_touches_them_less() {
    let careful = ran(scene("respond_obstacles"));
    let mut blind = scene("respond_obstacles");
    blind.set("characters.walker.response.avoid", "[]").unwrap();
    let blind = ran(blind);
    let impulse = |ran: &Ran| ran.report.characters["walker"].hit_impulse_max_n_s;
    println!("avoiding {:.2} N s, blind {:.2} N s", impulse(&careful), impulse(&blind));
    assert!(impulse(&careful) < 0.5 * impulse(&blind), "{} {}", impulse(&careful), impulse(&blind));
}

/// Largest angle by which a part turns away from the unpushed run, within a second and a half of a push at 1 s [deg].
fn peak_deg(pushed: &[Pose], unpushed: &[Pose], node: Node) -> f64 {
    let angle =
        |(one, other): (&Pose, &Pose)| one.world[node.index()].angle_between(other.world[node.index()]).to_degrees();
    pushed.iter().zip(unpushed).take(150).map(angle).fold(0.0, f64::max)
}

#[test]
fn a_push_on_a_stage_does_what_it_does_on_the_command_line() {
    let walk = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../samples/walk.bvh");
    let file = MotionFile::read(&walk, &ReadOptions::default()).unwrap();
    let on_stage = |push: &str| {
        let text = format!(
            "format = 1\n[stage]\nduration_secs = 2.6\n[characters.walker]\ntracker = \"response\"\nsource = {{ clip = \"walk.bvh\" }}\n{push}"
        );
        let files = [("scene.toml", text.into_bytes()), ("walk.bvh", std::fs::read(&walk).unwrap())];
        let files = files.into_iter().map(|(name, bytes)| (name.to_owned(), bytes)).collect();
        ran(Scene::from_files("scene.toml", files).unwrap())
    };
    let still = on_stage("");
    let mut apart = Vec::new();
    // The pushed part, and what it turns most.
    for (part, seen) in [
        (Part::Chest, Node::Chest),
        (Part::Head, Node::Head),
        (Part::Head, Node::Chest),
        (Part::LeftHand, Node::LeftUpperArm),
    ] {
        for force_n in [100.0, 300.0, 1000.0] {
            let push = Push {
                part,
                point: None,
                force_n: DVec3::new(0.0, 0.0, -force_n),
                frame: PushFrame::Facing,
                at_secs: 1.0,
                for_secs: 0.1,
            };
            let answer = respond(&file, &RespondJob { pushes: vec![push], ..RespondJob::default() }, None).unwrap();
            let theirs = peak_deg(answer.pushed.poses(), answer.unpushed.poses(), seen);
            let pushed = on_stage(&format!(
                "[[at]]\ntime_secs = 1.0\ncharacter = \"walker\"\ndo = \"push\"\non = \"{}\"\nforce_n = [0, 0, -{force_n}]\nfor_secs = 0.1\nfacing = true\n",
                part.name()
            ));
            let ours = peak_deg(poses(&pushed, "walker"), poses(&still, "walker"), seen);
            println!("{force_n} N on {part:?}, {seen:?}: command line {theirs:.1}°, stage {ours:.1}°");
            // A fifth, and what the springs of the stage leave of a small angle.
            if (ours - theirs).abs() > 0.2 * theirs {
                apart.push((part, seen, force_n, theirs, ours));
            }
        }
    }
    assert!(apart.is_empty(), "{apart:?}");
}
