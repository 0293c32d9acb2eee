//! The same motion as exporters, printers and cameras leave it.

use glam::{DQuat, DVec3};
use sinew_body::humanoid::exp;
use sinew_motion::Clip;

/// A clip whose keys are thinned: of each joint and of what moves, those are left out between which straight lines are within
/// about a millimetre at every joint below.
pub fn thinned(clip: &Clip) -> Clip {
    let joints = clip.skeleton().joints();
    let rest = clip.skeleton().rest_world();
    let mut out = clip.clone();
    let frames = clip.frames();
    for joint in 0..joints.len() {
        let below = |other: usize| clip.skeleton().is_ancestor(joint, other);
        let reach_m = (0..joints.len())
            .filter(|&other| below(other))
            .map(|other| (rest[other].translation - rest[joint].translation).length())
            .fold(0.05, f64::max);
        let rotation = |frame: usize| clip.rotation(frame, joint);
        let bent = |from: usize, to: usize, at: usize| {
            let share = (at - from) as f64 / (to - from) as f64;
            rotation(from).slerp(rotation(to), share)
        };
        for (from, to) in
            kept(frames, &|from, to, at| bent(from, to, at).angle_between(rotation(at)) * reach_m > TOLERANCE_M)
        {
            for at in from + 1..to {
                out.set_rotation(at, joint, bent(from, to, at));
            }
        }
        if clip.moving().contains(&joint) {
            let place = |frame: usize| clip.translation(frame, joint);
            let line = |from: usize, to: usize, at: usize| {
                place(from).lerp(place(to), (at - from) as f64 / (to - from) as f64)
            };
            for (from, to) in kept(frames, &|from, to, at| line(from, to, at).distance(place(at)) > TOLERANCE_M) {
                for at in from + 1..to {
                    out.set_translation(at, joint, line(from, to, at));
                }
            }
        }
    }
    out
}

/// Of one joint, so that several above each other stay within a millimetre.
const TOLERANCE_M: f64 = 0.5e-3;

/// Stretches of frames between two keys that follow each other, split at the worst frame until none is off (Ramer, Douglas,
/// Peucker in time).
fn kept(frames: usize, is_off: &dyn Fn(usize, usize, usize) -> bool) -> Vec<(usize, usize)> {
    let mut stretches = Vec::new();
    let mut from = 0;
    while from + 1 < frames {
        // The longest stretch that stays within the tolerance, at most a second at 120 Hz.
        let mut to = from + 1;
        while to + 1 < frames && to - from < 120 && !(from + 1..=to).any(|at| is_off(from, to + 1, at)) {
            to += 1;
        }
        stretches.push((from, to));
        from = to;
    }
    stretches
}

/// A clip as a file prints it: angles to a hundredth of a degree, positions to a tenth of a millimetre.
pub fn printed(clip: &Clip) -> Clip {
    let mut out = clip.clone();
    for frame in 0..clip.frames() {
        for joint in 0..clip.skeleton().len() {
            let (a, b, c) = clip.rotation(frame, joint).to_euler(glam::EulerRot::ZXY);
            let round = |angle: f64| (angle.to_degrees() * 100.0).round().to_radians() / 100.0;
            out.set_rotation(frame, joint, DQuat::from_euler(glam::EulerRot::ZXY, round(a), round(b), round(c)));
        }
        for &joint in clip.moving() {
            out.set_translation(frame, joint, (clip.translation(frame, joint) * 1e4).round() / 1e4);
        }
    }
    out
}

/// A clip whose joints jitter: each end of a bone of 25 cm by up to half a millimetre about any axis, the root as well.
pub fn jittered(clip: &Clip) -> Clip {
    let mut out = clip.clone();
    let mut seed = 1_u64;
    let mut random = || {
        seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (seed >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    };
    let mut vector = |size: f64| DVec3::new(random(), random(), random()) * size;
    for frame in 0..clip.frames() {
        for joint in 0..clip.skeleton().len() {
            out.set_rotation(frame, joint, clip.rotation(frame, joint) * exp(vector(0.5e-3 / 0.25)));
        }
        for &joint in clip.moving() {
            out.set_translation(frame, joint, clip.translation(frame, joint) + vector(0.5e-3));
        }
    }
    out
}
