//! Each shipped skill does what its scene says.

#![allow(clippy::unwrap_used, clippy::disallowed_methods, reason = "tests")]

use crate::ran::{character, event, frame, holds, path, play, prop};
use glam::DVec3;
use sinew::body::humanoid::{Node, Pose};
use sinew::jobs::run::Ran;
use sinew::stage::{Cause, CharacterEffect};

fn highest(places: &[DVec3]) -> f64 {
    places.iter().map(|place| place.y).fold(f64::NEG_INFINITY, f64::max)
}

/// How far a part leans back from the vertical \[degrees\].
fn leans_back_deg(pose: &Pose, node: Node) -> f64 {
    let up = pose.world[node.index()] * DVec3::Y;
    f64::atan2(-up.z, up.y).to_degrees()
}

/// A standing body of 1.7 m has its hips 1.03 m above the ground; one that sits or lies, below 0.4 m.
fn stands(ran: &Ran, name: &str, secs: f64) -> bool {
    path(ran, name, Node::Hips)[frame(ran, secs)].y > 0.85
}

fn lies(ran: &Ran, name: &str, secs: f64) -> bool {
    path(ran, name, Node::Hips)[frame(ran, secs)].y < 0.4
}

/// When a graph first went so because of this \[s\].
fn transition(ran: &Ran, graph: &str, from: &str, to: &str, because: impl Fn(&Cause) -> bool) -> f64 {
    let wanted = CharacterEffect::Transition { graph: graph.into(), from: from.into(), to: to.into() };
    event(ran, |effect| *effect == wanted, because)
}

/// Whether one touches the other, or any part of it.
fn touch<'a>(one: &'a str, other: &'a str) -> impl Fn(&Cause) -> bool + 'a {
    move |cause| match cause {
        Cause::GraphTouch { touched: [a, b], .. } => a == one && b.starts_with(other),
        Cause::Reaction { touching: [a, b], .. } => a == one && b == other,
        _ => false,
    }
}

fn timer(cause: &Cause) -> bool {
    *cause == Cause::GraphTimer
}

fn sensor(cause: &Cause) -> bool {
    matches!(cause, Cause::GraphSensor { .. })
}

#[test]
fn skis_hold_up_who_leans_too_far_for_its_feet_until_they_are_lost() {
    let ran = play("ski", &[]);
    let end = ran.report.duration_s;
    assert!(stands(&ran, "on_skis", end));
    assert!(lies(&ran, "on_feet", 2.0));
    assert!(stands(&ran, "loses_skis", 2.0));
    assert!(lies(&ran, "loses_skis", end));
    let lost = event(
        &ran,
        |effect| *effect == CharacterEffect::OwnShape { node: Node::LeftFoot },
        |cause| *cause == Cause::TimeOver,
    );
    assert!((lost - 2.0).abs() < 1e-9);
    // Own feet could not carry this: the centre of mass lies before the toes, which end 0.18 m before the ankle.
    let one = character(&ran, "on_skis");
    let pose = one.poses.last().unwrap();
    let ahead = one.body.centre_of_mass(pose).z - pose.positions(&one.body)[Node::LeftFoot.index()].z;
    assert!(ahead > 0.18, "{ahead}");
    // Skis lie on the ground, not in it: the ankle stands 9 cm above their undersides.
    let lowest = path(&ran, "on_skis", Node::LeftFoot).iter().map(|place| place.y).fold(f64::INFINITY, f64::min);
    assert!(lowest > 0.08, "{lowest}");
    // Undersides are level: no shape lifts or drops anybody. Two frames of falling freely would be 5 mm.
    for (name, secs) in [("on_skis", 0.0), ("loses_skis", 0.0), ("loses_skis", lost)] {
        let ankle = path(&ran, name, Node::LeftFoot);
        let (before, after) = (ankle[frame(&ran, secs)], ankle[frame(&ran, secs) + 2]);
        assert!((after.y - before.y).abs() < 5e-3, "{name} at {secs}: {before} to {after}");
    }
}

#[test]
fn who_blocks_without_forces_on_its_hips_stays_up_and_still_shows_the_hit() {
    let ran = play("block", &[]);
    let end = ran.report.duration_s;
    assert!(lies(&ran, "left", end));
    assert!(stands(&ran, "right", end));
    let forces =
        |on| move |effect: &CharacterEffect| *effect == CharacterEffect::Forces { nodes: vec![Node::Hips], on };
    let off = event(&ran, forces(false), touch("ball_right", "right"));
    let on = event(&ran, forces(true), |cause| *cause == Cause::TimeOver);
    assert!((on - off - 1.0).abs() < 1e-9);
    transition(&ran, "block_right", "wait", "hit", touch("ball_right", "right"));
    transition(&ran, "block_right", "hit", "again", timer);
    let right = character(&ran, "right");
    let leans = |secs: f64| leans_back_deg(&right.poses[frame(&ran, secs)], Node::Chest);
    // The chest goes with the hit; the hips hardly do.
    assert!(leans(off + 0.2) - leans(off) > 10.0, "{} to {}", leans(off), leans(off + 0.2));
    let hips = path(&ran, "right", Node::Hips);
    let moved = (hips[frame(&ran, off + 0.9)] - hips[frame(&ran, off)]).length();
    assert!(moved < 0.03, "{moved}");
    // Both balls brought the same; the left's hips were thrown back.
    assert!(path(&ran, "left", Node::Hips)[frame(&ran, off + 0.4)].z < -0.1);
}

#[test]
fn the_punched_one_feels_it_and_the_attacker_stays_up() {
    let ran = play("duel", &[]);
    let end = ran.report.duration_s;
    transition(&ran, "punch", "wait", "draw", |cause| *cause == Cause::GraphSignal);
    let hit = transition(&ran, "punch", "strike", "follow_through", touch("attacker.rightHand", "victim"));
    assert!(stands(&ran, "attacker", end));
    // A fist and forearm of 1.8 kg at some 6 m/s have 11 N s; a part of it comes in one step.
    let felt = ran.report.characters["victim"].hit_impulse_max_n_s;
    assert!((2.0..30.0).contains(&felt), "{felt}");
    // Before the blow the victim sways by millimetres.
    let chest = path(&ran, "victim", Node::Chest);
    let moved = chest[frame(&ran, hit + 0.3)].z - chest[frame(&ran, hit)].z;
    assert!(moved > 0.04, "{moved}");
}

#[test]
fn a_hop_leaves_the_ground_with_both_feet_and_ends_standing() {
    let ran = play("hop", &[]);
    transition(&ran, "hop", "crouch", "push", timer);
    let rises = transition(&ran, "hop", "push", "rise", sensor);
    let lands = transition(&ran, "hop", "fall", "land", touch("ground", "hopper"));
    // A second in the air would be a jump of 1.2 m.
    assert!((0.3..0.7).contains(&(lands - rises)), "{rises} to {lands}");
    let (left, right) = (path(&ran, "hopper", Node::LeftFoot), path(&ran, "hopper", Node::RightFoot));
    let clearance =
        left.iter().zip(&right).map(|(left, right)| left.y.min(right.y) - left_standing_m(&ran)).fold(0.0, f64::max);
    assert!((0.2..0.6).contains(&clearance), "{clearance}");
    assert!(stands(&ran, "hopper", ran.report.duration_s));
}

fn left_standing_m(ran: &Ran) -> f64 {
    path(ran, "hopper", Node::LeftFoot)[0].y
}

#[test]
fn a_punch_is_fast_and_knocks_the_highest_box_off_the_others() {
    let ran = play("punch", &[]);
    let hit = transition(&ran, "punch", "strike", "follow_through", touch("box_high", "boxer.rightHand"));
    let fist = path(&ran, "boxer", Node::RightHand);
    let speed = |at: usize| (fist[at] - fist[at - 1]).length() * ran.recording.motion_hz;
    let fastest = (1..=frame(&ran, hit)).map(speed).fold(0.0, f64::max);
    // Boxers reach 6 to 10 m/s; a body that only pushed would have 1 or 2.
    assert!((4.0..12.0).contains(&fastest), "{fastest}");
    let (high, middle) = (prop(&ran, "box_high"), prop(&ran, "box_middle"));
    // It lies on the ground: half of its shortest edge, or of its longest where it stands on end.
    assert!(high.last().unwrap().y < 0.35, "{:?}", high.last());
    assert!((*middle.last().unwrap() - middle[0]).length() < 0.03, "{:?}", middle.last());
    assert!(stands(&ran, "boxer", ran.report.duration_s));
}

#[test]
fn a_kick_goes_higher_than_the_hips_sends_the_ball_off_and_comes_back_to_stand() {
    let ran = play("kick", &[]);
    transition(&ran, "kick", "kick", "back", sensor);
    let (foot, hips) = (path(&ran, "kicker", Node::RightFoot), path(&ran, "kicker", Node::Hips));
    let over = foot.iter().zip(&hips).map(|(foot, hips)| foot.y - hips.y).fold(f64::NEG_INFINITY, f64::max);
    assert!(over > 0.1, "{over}");
    let ball = prop(&ran, "ball");
    // It lay at 1.1 m, 1.06 m ahead.
    assert!(highest(&ball) > 1.5 && ball.last().unwrap().z > 3.0, "{:?}", ball.last());
    let end = ran.report.duration_s;
    assert!(stands(&ran, "kicker", end));
    // Both soles are down: an ankle is 0.09 m above its sole.
    assert!(foot.last().unwrap().y < 0.11, "{:?}", foot.last());
}

#[test]
fn who_leans_back_is_missed_and_who_does_not_is_hit() {
    let ran = play("lean_back", &[]);
    transition(&ran, "dodge", "wait", "lean", sensor);
    assert_eq!(ran.report.characters["leaning"].hit_impulse_max_n_s, 0.0);
    assert!(ran.report.characters["upright"].hit_impulse_max_n_s > 0.5);
    let leaning = character(&ran, "leaning");
    let most = leaning.poses.iter().map(|pose| leans_back_deg(pose, Node::Chest)).fold(0.0, f64::max);
    assert!((30.0..60.0).contains(&most), "{most}");
    let end = ran.report.duration_s;
    assert!(stands(&ran, "leaning", end) && stands(&ran, "upright", end));
    // It stands as straight again as before.
    assert!(leans_back_deg(leaning.poses.last().unwrap(), Node::Chest).abs() < 5.0);
}

#[test]
fn a_ball_is_picked_up_with_both_hands_and_carried_up() {
    let ran = play("pick_up", &[]);
    let left = holds(&ran, Node::LeftHand, "ball", touch("carrier.leftHand", "ball"));
    let right = holds(&ran, Node::RightHand, "ball", touch("carrier.rightHand", "ball"));
    let lift = transition(&ran, "pick_up", "down", "lift", touch("ball", "carrier.leftHand"));
    assert!((right - left).abs() < 0.2 && (lift - left).abs() < 0.2);
    let hips = path(&ran, "carrier", Node::Hips);
    let lowest = hips.iter().map(|place| place.y).fold(f64::INFINITY, f64::min);
    assert!(lowest < 0.75, "{lowest}");
    let ball = prop(&ran, "ball");
    let lifted = ball.last().unwrap().y - ball[0].y;
    assert!(lifted > 0.7, "{lifted}");
    assert!(stands(&ran, "carrier", ran.report.duration_s));
}
