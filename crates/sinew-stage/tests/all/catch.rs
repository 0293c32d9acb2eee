//! A thrown ball is met where it will be.

#![allow(clippy::unwrap_used, reason = "tests")]

use glam::DVec3;
use sinew_body::humanoid::Node;
use sinew_stage::{Scene, Stage};

/// How far the ball is from the middle of the hand, and how high, two seconds after it was thrown \[m\].
fn caught(tracker: &str, hand: &str, at: [f64; 3], velocity: [f64; 3]) -> (f64, f64) {
    let text = format!(
        "format = 1\n[characters.one]\ntracker = \"{tracker}\"\n\
         source = {{ reach = {{ object = \"ball\", hand = \"{hand}\", grasp = true }} }}\n\
         [props.ball]\nball_radius_m = 0.04\nmass_kg = 0.15\nposition_m = {at:?}\nvelocity_m_s = {velocity:?}\n"
    );
    let mut stage = Stage::new(Scene::from_text(&text).unwrap(), None).unwrap();
    for _ in 0..480 {
        stage.step();
    }
    let frame = stage.frame();
    let node = if hand == "left" { Node::LeftHand } else { Node::RightHand };
    let ball: DVec3 = frame.props[0].centre;
    ((frame.characters[0].part(node).centre - ball).length(), ball.y)
}

#[test]
fn a_ball_that_is_thrown_to_somebody_is_held_at_the_end() {
    for (hand, at, velocity) in [
        // From four metres in front, to the chest, beside it, and high.
        ("right", [-0.2, 1.3, 4.0], [0.0, 2.5, -5.5]),
        ("right", [0.3, 1.2, 4.0], [-0.7, 3.4, -5.0]),
        ("left", [0.4, 1.6, 3.5], [0.1, 2.0, -5.0]),
        // Slow and from the side.
        ("left", [3.0, 1.4, 1.0], [-3.5, 3.0, -0.5]),
    ] {
        for tracker in ["kinematic", "kd"] {
            let (gap, height) = caught(tracker, hand, at, velocity);
            // A radius and half a hand, and what it flies on between the moment of the meeting and the next step.
            assert!(gap < 0.16 && height > 0.4, "{tracker}, {hand}, from {at:?}: {gap} m away, {height} m up");
        }
    }
}
