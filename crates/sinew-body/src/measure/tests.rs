//! The measures on made input.
#![allow(clippy::disallowed_methods, reason = "tests may use the standard functions")]

use super::overlap::distance;
use super::*;
use crate::humanoid::{Body, Node, Pose, exp};
use glam::DVec3;
use std::f64::consts::TAU;

fn bent(node: Node, angle: f64) -> Pose {
    let mut locals = Node::ALL.map(|node| Pose::STANDING.local(node));
    locals[node.index()] = exp(DVec3::X * angle);
    Pose::from_locals(DVec3::Y, &locals)
}

#[test]
fn a_step_is_a_change_over_a_sixtieth_at_any_rate() {
    // A knee that bends away from its input by 90 degrees a second: 1.5 degrees in a sixtieth.
    for fps in [30.0, 60.0, 120.0] {
        let frames = 0..fps as usize;
        let ours: Vec<Pose> =
            frames.clone().map(|frame| bent(Node::LeftLowerLeg, frame as f64 / fps * TAU / 4.0)).collect();
        let input = vec![bent(Node::LeftLowerLeg, 0.0); ours.len()];
        let changed = Changed { ours: &ours, input: &input, frame_secs: 1.0 / fps };
        let steps = changed.largest_deflection_steps(frames.clone());
        assert!((steps[Node::LeftLowerLeg.index()].to_degrees() - 1.5).abs() < 1e-9, "{fps}");
        assert!(steps[Node::RightLowerLeg.index()] < 1e-12 && changed.largest_hips_step_m(frames) < 1e-12);
    }
}

#[test]
fn a_step_is_the_deflections_not_the_inputs() {
    let ours: Vec<Pose> = (0..9).map(|frame| bent(Node::Chest, f64::from(frame) * 0.2 + 0.1)).collect();
    let input: Vec<Pose> = (0..9).map(|frame| bent(Node::Chest, f64::from(frame) * 0.2)).collect();
    let changed = Changed { ours: &ours, input: &input, frame_secs: 1.0 / 60.0 };
    assert!(changed.largest_deflection_steps(0..9)[Node::Chest.index()] < 1e-12);
    assert!((deflections(&ours[3], &input[3])[Node::Chest.index()] - DVec3::X * 0.1).length() < 1e-12);
}

#[test]
fn a_swinging_segment_has_its_sines_acceleration() {
    let swing = |frame: usize| 0.3 * (TAU * frame as f64 / 60.0).sin();
    let poses: Vec<Pose> = (0..120).map(|frame| bent(Node::LeftUpperLeg, swing(frame))).collect();
    let largest = largest_angular_acceleration(&poses, 1.0 / 60.0, Node::LeftLowerLeg, 0..120);
    // Second differences of a sine are smaller by (sin(x) / x)² of half a step's phase: a thousandth here.
    assert!((largest / (0.3 * TAU * TAU) - 1.0).abs() < 2e-3, "{largest}");
}

#[test]
fn segments_are_as_far_apart_as_their_nearest_points() {
    let line = |a: [f64; 3], b: [f64; 3]| [DVec3::from(a), DVec3::from(b)];
    let one = line([0.0; 3], [1.0, 0.0, 0.0]);
    assert!((distance(one, line([0.5, 2.0, -1.0], [0.5, 2.0, 1.0])) - 2.0).abs() < 1e-12, "crossing");
    assert!((distance(one, line([2.0, 0.0, 0.0], [3.0, 0.0, 0.0])) - 1.0).abs() < 1e-12, "in a row");
    assert!((distance(one, line([0.2, 0.3, 0.0], [0.8, 0.3, 0.0])) - 0.3).abs() < 1e-12, "parallel");
    assert!((distance(one, line([-3.0, 4.0, 0.0], [-3.0, 4.0, 0.0])) - 5.0).abs() < 1e-12, "a point");
}

#[test]
fn an_arm_across_the_belly_is_in_the_trunk_and_a_hanging_one_is_clear() {
    let body = Body::standard(80.0, 1.7);
    let standing = Pose { hips_position: DVec3::Y, ..Pose::STANDING };
    for overlaps in overlaps(&body, &standing, 0.0) {
        assert!(overlaps.trunk_m < 0.0 && overlaps.head_m < 0.0 && overlaps.floor_m < 0.0, "{overlaps:?}");
    }
    let mut locals = Node::ALL.map(|node| standing.local(node));
    // The right forearm bends by a right angle and turns inward: through the belly.
    locals[Node::RightLowerArm.index()] = exp(DVec3::Y * (TAU / 4.0)) * exp(DVec3::X * (-TAU / 4.0));
    let across = Pose::from_locals(DVec3::Y, &locals);
    let [left, right] = overlaps(&body, &across, 0.0);
    assert!(right.trunk_m > 0.1 && left.trunk_m < 0.0, "{right:?}");
    // A floor that is raised comes to the hands first.
    assert!(overlaps(&body, &standing, 0.9)[0].floor_m > 0.0);
}

#[test]
fn hands_come_apart_by_what_an_arm_turns() {
    let body = Body::standard(80.0, 1.7);
    let standing = hands_apart_m(&body, &Pose::STANDING);
    assert!((standing - 2.0 * (0.025 + 0.163)).abs() < 1e-9, "{standing}");
    let ahead = hands_apart_m(&body, &bent(Node::LeftUpperArm, -TAU / 4.0));
    let long = 0.286 + 0.254 + 0.0935;
    assert!((ahead * ahead - standing * standing - 2.0 * long * long).abs() < 1e-9, "{ahead}");
}

#[test]
fn the_centre_of_mass_moves_with_the_body_and_by_a_legs_share() {
    let body = Body::standard(80.0, 1.7);
    let from = centre_of_mass(&body, &Pose::STANDING);
    let shifted = Pose { hips_position: DVec3::new(0.3, 1.0, -2.0), ..Pose::STANDING };
    assert!((centre_of_mass(&body, &shifted) - from - shifted.hips_position).length() < 1e-12);
    // A shank raised by a right angle: shank and foot, 0.061 of the mass, move.
    let raised = centre_of_mass(&body, &bent(Node::LeftLowerLeg, TAU / 4.0)) - DVec3::Y - from;
    let (shank, foot) = (0.436 * 0.433 * 0.0465, (0.436 + 0.03) * 0.0145);
    assert!((raised.y - (shank + foot - 0.085 * 0.0145)).abs() < 1e-9, "{raised}");
}
