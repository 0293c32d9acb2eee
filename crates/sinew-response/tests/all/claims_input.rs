//! Without a disturbance the output is the input.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use crate::pushing::Case;
use sinew_body::humanoid::{Node, Pose, log};
use sinew_motion::Part;
use sinew_response::{Disturbances, Push, PushFrame, Settings, Track};
use sinew_testkit::{EVERY_CLIP, mocap, none_of, work};

/// The largest angle between two runs [rad].
fn largest_angle(ours: &[Pose], theirs: &[Pose]) -> f64 {
    let angle = |ours: &Pose, theirs: &Pose, node| log(theirs.local(node).conjugate() * ours.local(node)).length();
    ours.iter()
        .zip(theirs)
        .flat_map(|(ours, theirs)| Node::ALL.map(|node| angle(ours, theirs, node)))
        .fold(0.0, |largest, angle| if angle > largest || angle.is_nan() { angle } else { largest })
}

#[test]
fn without_a_push_the_output_is_the_input_on_every_clip() {
    let Some(mocap) = mocap() else { return };
    let failures: Vec<String> = work(&EVERY_CLIP, |name| {
        let case = Case::load(&mocap, name, 8.0);
        let (settings, input) = (case.stable(Settings::default()), case.motion().poses());
        let track = Track::run(case.body(), case.basis(), &settings, case.motion(), Disturbances::default());
        let angle = largest_angle(track.poses(), input).to_degrees();
        let residual = track.reports().iter().map(|report| report.residual_n_m).fold(0.0, f64::max);
        // Torques here reach a hundred newton metres: this is their last digits.
        let good = angle < 1e-3 && residual < 1e-6 && track.poses().len() == input.len();
        (!good).then(|| format!("{name}: {angle:e} degrees, residual {residual:e} N m"))
    })
    .into_iter()
    .flatten()
    .collect();
    none_of(EVERY_CLIP.len(), &failures);
}

/// Without a push the response computes the same torque twice, so that its residual is 0 to the last bit, as if nobody
/// had solved. Under a nanonewton, which nothing that looks for pushes could mistake for one, it is not: the solver runs
/// in every frame, and what it finds is the input.
#[test]
fn the_solver_runs_without_a_push_too_as_its_residual_shows() {
    let Some(mocap) = mocap() else { return };
    let failures: Vec<String> = work(&EVERY_CLIP, |name| {
        let case = Case::load(&mocap, name, 3.0);
        let (settings, input) = (case.stable(Settings::default()), case.motion().poses());
        let nothing = Push {
            part: Part::Head,
            point: None,
            force_n: glam::DVec3::new(1e-9, 0.0, 0.0),
            at_secs: 0.0,
            for_secs: 1e6,
            frame: PushFrame::Facing,
        };
        let happens = Disturbances { pushes: &[nothing], ground: &[] };
        let track = Track::run(case.body(), case.basis(), &settings, case.motion(), happens);
        let angle = largest_angle(track.poses(), input).to_degrees();
        let residuals = || track.reports()[1..].iter().map(|report| report.residual_n_m);
        let (least, most) = (residuals().fold(f64::INFINITY, f64::min), residuals().fold(0.0, f64::max));
        let good = angle < 1e-3 && least > 0.0 && most < 1e-6;
        (!good).then(|| format!("{name}: {angle:e} degrees, residual {least:e} to {most:e} N m"))
    })
    .into_iter()
    .flatten()
    .collect();
    none_of(EVERY_CLIP.len(), &failures);
}
