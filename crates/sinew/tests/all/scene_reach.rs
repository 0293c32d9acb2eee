//! Scenes in which somebody reaches.

use crate::ran::{path, play};
use sinew::body::humanoid::Node;
use sinew::jobs::reach::ReachReport;
use sinew::jobs::run::Ran;

/// Figure 4 of Huang et al. (2011).
const FIGURE: [&str; 8] = [
    "reach_a_apple",
    "reach_b_basketball",
    "reach_c_full_step",
    "reach_d_half_step",
    "reach_e_stoop",
    "reach_f_squat",
    "reach_g_low_ball",
    "reach_h_high_apple",
];

fn reaches<'a>(ran: &'a Ran, name: &str) -> &'a [ReachReport] {
    &ran.report.characters[name].reaches
}

fn kinds(report: &ReachReport) -> Vec<&'static str> {
    report.steps.iter().map(|step| step.kind).collect()
}

#[test]
fn the_eight_scenes_of_the_papers_figure_are_what_their_captions_say() {
    let reports = FIGURE.map(|name| {
        let ran = play(name, &[]);
        let [report] = reaches(&ran, "reacher") else { panic!("{name}: one reach is expected") };
        // The kinematic tracker shows the reach itself: what is asked of any target in reach.
        assert!(report.reached && report.hand_error_m < 1e-3, "{name}: {report:?}");
        assert!(report.planted_slip_m < 1e-3, "{name}: {report:?}");
        assert!(report.com_margin_m.unwrap() > 0.0, "{name}: {report:?}");
        report.clone()
    });
    let [apple, basketball, full, half, stoop, squat, low, high] = &reports;
    assert_eq!(apple.hands, ["left"]);
    // To the left and up: the trunk turns by more than what arms alone would need, and nobody steps.
    assert!(apple.twist_deg.abs() > 10.0 && apple.steps.is_empty(), "{apple:?}");
    assert!(basketball.swing_deg > 20.0 && basketball.steps.is_empty(), "{basketball:?}");
    assert_eq!((kinds(full), kinds(half)), (vec!["full"], vec!["half"]));
    // The same target: stiff legs leave it to the trunk, supple ones sink by more than a third of a leg's 0.85 m.
    assert!(stoop.squat_m < 0.1 && stoop.swing_deg > 50.0, "{stoop:?}");
    assert!(squat.squat_m > 0.3 && squat.swing_deg < stoop.swing_deg - 20.0, "{squat:?}");
    assert!(low.squat_m > 0.2 && !low.steps.is_empty(), "{low:?}");
    assert!(high.squat_m < 0.05 && !high.steps.is_empty(), "{high:?}");
}

#[test]
fn forces_and_responses_carry_the_figures_reaches_out_too() {
    for name in FIGURE {
        for tracker in ["kd", "response"] {
            let ran = play(name, &[("characters.reacher.tracker", &format!("\"{tracker}\""))]);
            let [report] = reaches(&ran, "reacher") else { panic!("{name}: one reach is expected") };
            // Pins and springs give way by millimetres, and the hand rests on what it touches.
            assert!(report.hand_error_m < 0.01, "{name}, {tracker}: {report:?}");
            assert!(report.planted_slip_m < 0.01, "{name}, {tracker}: {report:?}");
        }
    }
}

/// How far the right hand is from the same run without the bag, at its most, and at the end \[m\].
fn deflections(name: &str) -> (f64, f64) {
    let away = [("props.bag.position_m", "[-0.6, 1.2, 9]"), ("joints.rope.anchor_m", "[-0.6, 2.9, 9]")];
    let (hit, quiet) = (play(name, &[]), play(name, &away));
    let (hit, quiet) = (path(&hit, "reacher", Node::RightHand), path(&quiet, "reacher", Node::RightHand));
    let apart: Vec<f64> = hit.iter().zip(&quiet).map(|(hit, quiet)| (*hit - *quiet).length()).collect();
    (apart.iter().copied().fold(0.0, f64::max), *apart.last().unwrap())
}

#[test]
fn a_bumped_reach_yields_and_still_arrives() {
    for name in ["reach_bag", "reach_bag_kd"] {
        let ran = play(name, &[]);
        assert!(ran.report.characters["reacher"].hit_impulse_max_n_s > 1.0, "{name}");
        let (most, end) = deflections(name);
        // Nobody overlooks 5 cm; springs are back within the 1 cm in which kd holds any part after a hit.
        assert!(most > 0.05, "{name}: {most}");
        assert!(end < 0.01, "{name}: {end}");
        let [report] = reaches(&ran, "reacher") else { panic!("{name}: one reach is expected") };
        assert!(report.reached && report.hand_error_m < 0.01, "{name}: {report:?}");
        assert!(report.planted_slip_m < 0.01, "{name}: {report:?}");
    }
}

#[test]
fn who_walks_by_stops_to_reach_and_walks_on() {
    let ran = play("reach_walk", &[]);
    let [report] = reaches(&ran, "walker") else { panic!("one reach is expected") };
    assert!(report.reached && report.hand_error_m < 1e-3, "{report:?}");
    let hips = path(&ran, "walker", Node::Hips);
    // Coming to stand from a walk takes knees, not a crouch: walking hips themselves go up and down by 4 cm.
    let lowest = hips.iter().map(|place| place.y).fold(f64::INFINITY, f64::min);
    assert!(lowest > hips[0].y - 0.12, "{lowest} of {}", hips[0].y);
    // Whoever stops from 1.2 m/s in one step brakes by that in a tenth of a second, not by more.
    let speed = |at: usize| ((hips[at + 1] - hips[at]) * 60.0).with_y(0.0);
    for at in 0..hips.len() - 7 {
        assert!((speed(at + 6) - speed(at)).length() < 1.3, "at {}", at as f64 / 60.0);
    }
    // It sets out again no faster than it walks, 1.55 m/s at most.
    let fastest = (216..hips.len() - 1).map(|at| speed(at).length()).fold(0.0, f64::max);
    assert!(fastest < 1.65, "{fastest}");
    // It walks again: more than a metre in the last second and a half.
    let last = hips.len() - 1;
    assert!((hips[last] - hips[last - 90]).with_y(0.0).length() > 1.0);
}
