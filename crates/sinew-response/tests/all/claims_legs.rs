//! Hips and legs under a push: nothing jumps, no knee snaps, feet stay.

use crate::seen::{Seen, kinds, scenes};
use sinew_body::humanoid::Node;
use sinew_body::measure::{Changed, largest_angular_acceleration};
use sinew_testkit::{none_of, work};
use std::sync::OnceLock;

/// Largest change of the hips' offset in 1/60 s \[m\]: 0.3 m/s, less than hips in a walk.
const HIPS_STEP_M: f64 = 5e-3;

/// Largest change of a leg joint's deflection in 1/60 s \[deg\]: above it eyes see a knee snap.
const LEG_STEP_DEG: f64 = 2.0;

/// The same from one frame of a clip of 120 frames a second to the next: no two halves of a step need to be alike.
const LEG_FRAME_DEG: f64 = 1.5;

/// Largest angular acceleration of a lower leg, relative to the input's own largest.
const LEG_ACCELERATION: f64 = 1.5;

/// The ankles of the 18 bodies come out of the source's own, which are exact, through mean lengths of its bones.
const ANKLE_M: f64 = 1e-3;

const LEG_NODES: [Node; 6] =
    [Node::LeftUpperLeg, Node::LeftLowerLeg, Node::LeftFoot, Node::RightUpperLeg, Node::RightLowerLeg, Node::RightFoot];

struct Figures {
    name: String,
    hips_step_m: f64,
    leg_step_deg: f64,
    leg_frame_deg: f64,
    acceleration: f64,
    ankle_m: f64,
}

fn figures(seen: &Seen) -> Figures {
    let (changed, after) = (seen.changed(), seen.after(0.0));
    let leg_deg = |changed: Changed| {
        let steps = changed.largest_deflection_steps(seen.after(0.1));
        LEG_NODES.map(|node| steps[node.index()]).into_iter().fold(0.0, f64::max).to_degrees()
    };
    // As if each frame lasted 1/60 s: from one to the next.
    let by_frame = Changed { frame_secs: 1.0 / 60.0, ..changed };
    let acceleration = [Node::LeftLowerLeg, Node::RightLowerLeg].map(|node| {
        let of = |poses, range| largest_angular_acceleration(poses, seen.scene.frame_secs(), node, range);
        of(&seen.ours, seen.after(0.1)) / of(&seen.scene.input, seen.scene.prepared.first_frame()..usize::MAX)
    });
    let gap = |frame: usize| {
        let [ours, input] = [&seen.ours, &seen.scene.input].map(|poses| poses[frame].positions(&seen.scene.body));
        [Node::LeftFoot, Node::RightFoot].map(|foot| (ours[foot.index()] - input[foot.index()]).length())
    };
    Figures {
        name: seen.name(),
        hips_step_m: changed.largest_hips_step_m(after.clone()),
        leg_step_deg: leg_deg(changed),
        leg_frame_deg: if seen.scene.frame_secs() < 0.009 { leg_deg(by_frame) } else { 0.0 },
        acceleration: acceleration[0].max(acceleration[1]),
        ankle_m: after.flat_map(gap).fold(0.0, f64::max),
    }
}

fn all() -> &'static [Figures] {
    static ALL: OnceLock<Vec<Figures>> = OnceLock::new();
    ALL.get_or_init(|| {
        let scenes = scenes();
        let runs: Vec<_> = scenes.iter().flat_map(|scene| kinds().into_iter().map(move |kind| (scene, kind))).collect();
        work(&runs, |(scene, kind)| figures(&scene.push(*kind)))
    })
}

fn hold(of: impl Fn(&Figures) -> f64, most: f64) {
    let all = all();
    let mut worst: Vec<&Figures> = all.iter().collect();
    worst.sort_by(|a, b| of(b).total_cmp(&of(a)));
    let said = |figures: &&Figures| format!("{}: {:.3e}", figures.name, of(figures));
    eprintln!("largest: {}", worst.first().map(said).unwrap_or_default());
    let failures: Vec<String> =
        worst.iter().filter(|figures| of(figures).is_nan() || of(figures) > most).map(said).collect();
    none_of(all.len(), &failures);
}

#[test]
fn hips_never_jump_after_a_push() {
    hold(|figures| figures.hips_step_m, HIPS_STEP_M);
}

#[test]
fn no_leg_joint_snaps_after_a_push() {
    hold(|figures| figures.leg_step_deg, LEG_STEP_DEG);
    hold(|figures| figures.leg_frame_deg, LEG_FRAME_DEG);
}

#[test]
fn lower_legs_accelerate_no_harder_than_one_and_a_half_times_the_inputs() {
    hold(|figures| figures.acceleration, LEG_ACCELERATION);
}

#[test]
fn feet_stay_where_the_input_has_them_within_a_millimetre() {
    hold(|figures| figures.ankle_m, ANKLE_M);
}
