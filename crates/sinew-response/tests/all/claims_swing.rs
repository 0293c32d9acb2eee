//! How a pushed body comes back: the head stays level, the chest is back within a second or so, arms swing through, necks are
//! not cut off.

use crate::seen::{Kind, Scene, Seen, scenes};
use glam::DVec3;
use sinew_body::humanoid::Node;
use sinew_body::measure::deflections;
use sinew_motion::Part;
use sinew_testkit::{none_of, work};
use std::sync::OnceLock;

/// Of the chest's turn in the world, the most that the head takes over from 0.15 s after the push's beginning on.
const HEAD_SHARE: f64 = 0.7;

/// Turns that nobody sees \[deg\].
const UNSEEN_DEG: f64 = 1.0;

/// From the end of a push until the chest is within a tenth of its peak \[s\].
const CHEST_SECS: f64 = 1.2;

/// Mean of how far arms swing through, relative to their peak.
const SWING: [f64; 2] = [0.1, 0.3];

/// Longest that a neck stays within a hundredth of its peak \[s\]: a swing is that slow at its turning point, a stop is longer.
const FLAT_SECS: f64 = 0.15;

fn runs(pushes: &[(Part, f64)]) -> Vec<Seen<'static>> {
    static SCENES: OnceLock<Vec<Scene>> = OnceLock::new();
    let scenes = SCENES.get_or_init(scenes);
    let kinds: Vec<(&Scene, Kind)> = scenes
        .iter()
        .flat_map(|scene| {
            pushes
                .iter()
                .map(move |&(part, newtons)| (scene, Kind { part, force_n: DVec3::NEG_Z * newtons, for_secs: 0.1 }))
        })
        .collect();
    work(&kinds, |(scene, kind)| scene.push(*kind))
}

/// A node's deflection, frame by frame \[rad\], and the frame of its peak.
fn deflection(seen: &Seen, node: Node) -> (Vec<DVec3>, usize) {
    let all: Vec<DVec3> =
        seen.ours.iter().zip(&seen.scene.input).map(|(ours, input)| deflections(ours, input)[node.index()]).collect();
    let peak = (0..all.len()).max_by(|&a, &b| all[a].length().total_cmp(&all[b].length())).unwrap_or(0);
    (all, peak)
}

#[test]
fn the_head_turns_at_most_seven_tenths_as_much_as_a_pushed_chest() {
    let runs = runs(&[(Part::Chest, 300.0), (Part::Chest, 1000.0), (Part::RightHand, 100.0), (Part::RightHand, 300.0)]);
    let failures: Vec<String> = runs
        .iter()
        .filter_map(|seen| {
            let from = ((seen.scene.at_secs + 0.15) / seen.scene.frame_secs()).ceil() as usize;
            let beyond = |frame: usize| seen.turned(frame, Node::Head) - HEAD_SHARE * seen.turned(frame, Node::Chest);
            let most = (from..seen.ours.len()).map(beyond).fold(0.0, f64::max).to_degrees();
            (most > UNSEEN_DEG).then(|| format!("{}: {most:.1} degrees more", seen.name()))
        })
        .collect();
    none_of(runs.len(), &failures);
}

#[test]
fn a_pushed_chest_is_within_a_tenth_of_its_peak_after_a_second_or_so() {
    let runs = runs(&[(Part::Chest, 300.0), (Part::Chest, 1000.0)]);
    let failures: Vec<String> = runs
        .iter()
        // She bends down to the floor and up with a box in these seconds: the chest hangs, and gravity keeps what a push gave it.
        .filter(|seen| !seen.scene.name.ends_with("A06_LiftBox.bvh"))
        .filter_map(|seen| {
            let (all, peak) = deflection(seen, Node::Chest);
            let away = all.iter().rposition(|turn| turn.length() > 0.1 * all[peak].length())?;
            let secs = (away + 1) as f64 * seen.scene.frame_secs() - seen.scene.at_secs - seen.kind.for_secs;
            let degrees = all[peak].length().to_degrees();
            (degrees > 3.0 && secs > CHEST_SECS).then(|| format!("{}: {degrees:.1} degrees, {secs:.2} s", seen.name()))
        })
        .collect();
    none_of(runs.len(), &failures);
}

#[test]
fn arms_that_come_back_swing_through_by_a_tenth_to_three_tenths_on_average() {
    let runs = runs(&[(Part::RightHand, 100.0), (Part::RightHand, 300.0)]);
    let swings: Vec<f64> = runs
        .iter()
        .flat_map(|seen| [Node::RightUpperArm, Node::RightLowerArm].map(|node| deflection(seen, node)))
        .filter(|(all, peak)| all[*peak].length().to_degrees() > 3.0)
        .map(|(all, peak)| {
            let (size, axis) = (all[peak].length(), all[peak].normalize());
            all[peak..].iter().map(|turn| -turn.dot(axis)).fold(0.0, f64::max) / size
        })
        .collect();
    let mean = swings.iter().sum::<f64>() / swings.len() as f64;
    eprintln!("arms swing through by {:.1} % on average, {} of them", mean * 100.0, swings.len());
    assert!(swings.len() > 20 && (SWING[0]..SWING[1]).contains(&mean), "{mean:.3} of {}", swings.len());
}

#[test]
fn a_pushed_head_is_not_cut_off_at_the_necks_limit() {
    let runs = runs(&[(Part::Head, 100.0), (Part::Head, 300.0), (Part::Head, 1000.0)]);
    let failures: Vec<String> = runs
        .iter()
        .filter_map(|seen| {
            let (all, peak) = deflection(seen, Node::Neck);
            let flat = all.iter().filter(|turn| turn.length() > 0.99 * all[peak].length()).count();
            let secs = flat as f64 * seen.scene.frame_secs();
            (secs > FLAT_SECS)
                .then(|| format!("{}: {secs:.2} s at {:.1} degrees", seen.name(), all[peak].length().to_degrees()))
        })
        .collect();
    none_of(runs.len(), &failures);
}
