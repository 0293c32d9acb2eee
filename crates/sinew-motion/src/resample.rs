//! A clip at another rate.

use crate::{Clip, Transform};
use glam::{DQuat, DVec3};

/// Between two frames whose joints turn more than this (or whose neighbours do), a cubic would swing over: cos of half of 50°.
const CUBIC_UP_TO: f64 = 0.906;

/// Rates whose ratio is this near to a simple fraction are meant to have it: files round 1/120 s to 0.0083333.
const SAME_RATE: f64 = 2e-4;

/// The clip at `fps` frames per second, from its first frame on, for the clip's duration.
///
/// Frames that fall on frames of the clip keep their bits. Between them, translations follow a Catmull-Rom cubic and
/// rotations the same cubic of their quaternions (signs aligned, normalised), which keeps velocities continuous; across turns of
/// more than 50° per frame they follow the great arc. Before the first and after the last frame the motion counts as going on evenly, so
/// that a constant velocity stays constant up to both ends. A ratio of the rates within 0.02 % of a fraction with small numbers is taken
/// for that fraction. Frames are not filtered: filter first where the rate goes far down.
///
/// ```
/// # use sinew_motion::{Clip, Joint, Skeleton, Transform, resample};
/// # let mut skeleton = Skeleton::new();
/// # skeleton.push(Joint { name: "hips".into(), parent: None, rest: Transform::IDENTITY, tip: None });
/// # let mut clip = Clip::new(skeleton, 0.0083333, vec![0]);
/// # for _ in 0..241 { clip.push(&[Transform::IDENTITY]); }
/// let at_60 = resample(&clip, 60.0);
/// assert_eq!((clip.frames(), at_60.frames()), (241, 121));
/// ```
///
/// # Panics
/// If the rate is not a positive number.
pub fn resample(clip: &Clip, fps: f64) -> Clip {
    assert!(fps.is_finite() && fps > 0.0, "a rate is a positive number");
    let joints = clip.skeleton().len();
    let mut resampled = Clip::new(clip.skeleton().clone(), 1.0 / fps, clip.moving().to_vec());
    if clip.frames() == 0 {
        return resampled;
    }
    let last = clip.frames() - 1;
    let step = Step::of(clip.fps() / fps);
    let mut locals: Vec<Transform> = Vec::with_capacity(joints);
    for frame in 0.. {
        let (at, share) = step.times(frame);
        if at > last || (at == last && share > 0.0) {
            break;
        }
        locals.clear();
        if share == 0.0 {
            locals.extend((0..joints).map(|joint| clip.local(at, joint)));
        } else {
            let frames = [at.saturating_sub(1), at, at + 1, (at + 2).min(last)];
            locals.extend((0..joints).map(|joint| {
                let mut rotations = frames.map(|frame| clip.rotation(frame, joint));
                let mut translations = frames.map(|frame| clip.translation(frame, joint));
                // Beyond the ends the motion goes on evenly: an end frame in place of its neighbour would halve the tangent there.
                if at == 0 {
                    rotations[0] = beyond(rotations[1], rotations[2]);
                    translations[0] = translations[1] * 2.0 - translations[2];
                }
                if at + 1 == last {
                    rotations[3] = beyond(rotations[2], rotations[1]);
                    translations[3] = translations[2] * 2.0 - translations[1];
                }
                Transform::new(between_rotations(rotations, share), between(translations, share))
            }));
        }
        resampled.push(&locals);
    }
    resampled
}

/// How many source frames one new frame is long.
enum Step {
    /// In integers: exact for clips of any length.
    Fraction {
        numerator: usize,
        denominator: usize,
    },
    Real(f64),
}

impl Step {
    fn of(ratio: f64) -> Step {
        for denominator in 1..=16_usize {
            let numerator = (ratio * denominator as f64).round();
            let near = (ratio * denominator as f64 - numerator).abs() <= SAME_RATE * numerator;
            if (1.0..1e6).contains(&numerator) && near {
                return Step::Fraction { numerator: numerator as usize, denominator };
            }
        }
        Step::Real(ratio)
    }

    /// Source frame and share of the way to the next one.
    fn times(&self, frame: usize) -> (usize, f64) {
        match *self {
            Step::Fraction { numerator, denominator } => {
                let ticks = frame.saturating_mul(numerator);
                (ticks / denominator, (ticks % denominator) as f64 / denominator as f64)
            }
            Step::Real(ratio) => {
                let at = frame as f64 * ratio;
                (at.floor() as usize, at - at.floor())
            }
        }
    }
}

/// Catmull-Rom weights of four values at a share of the way from the second to the third.
fn weights(share: f64) -> [f64; 4] {
    let (t, t2, t3) = (share, share * share, share * share * share);
    [0.5 * (-t + 2.0 * t2 - t3), 0.5 * (2.0 - 5.0 * t2 + 3.0 * t3), 0.5 * (t + 4.0 * t2 - 3.0 * t3), 0.5 * (t3 - t2)]
}

/// The rotation as far on from `from` to `end` as these are apart.
fn beyond(end: DQuat, from: DQuat) -> DQuat {
    if end == from { end } else { end * from.conjugate() * end }
}

fn between(points: [DVec3; 4], share: f64) -> DVec3 {
    if points[0] == points[1] && points[1] == points[2] && points[2] == points[3] {
        return points[1];
    }
    weights(share).into_iter().zip(points).map(|(weight, point)| weight * point).sum()
}

fn between_rotations(rotations: [DQuat; 4], share: f64) -> DQuat {
    let mut near = rotations;
    for at in [2, 3, 0] {
        let next = if at == 0 { 1 } else { at - 1 };
        if near[at].dot(near[next]) < 0.0 {
            near[at] = -near[at];
        }
    }
    if near[1] == near[2] && near[0] == near[1] && near[2] == near[3] {
        return rotations[1];
    }
    if near.windows(2).any(|pair| pair[0].dot(pair[1]) < CUBIC_UP_TO) {
        return near[1].slerp(near[2], share);
    }
    let weights = weights(share);
    let sum = near[0] * weights[0] + near[1] * weights[1] + near[2] * weights[2] + near[3] * weights[3];
    sum.normalize()
}
