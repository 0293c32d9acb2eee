//! The floor, and foot contacts, estimated from joint positions.

use crate::pose::quantile;
use crate::stature::foot_points;
use crate::{Clip, Humanoid, Side, stature};
use glam::DVec3;

/// Speed below which a point of a foot comes into contact, and above which it loses contact \[m/s\], for a stature of
/// 1.7 m.
const SLOW_M_S: [f64; 2] = [0.35, 0.6];
/// Height above its own standing height below which it comes into contact, and above which it loses contact \[m\], for
/// 1.7 m. Capture floors are uneven by 2 cm, and a sole that rolls off lifts the ankle.
const LOW_M: [f64; 2] = [0.055, 0.09];

/// Height of the floor \[m\] under a clip in metres and Y up: that of the lowest points of the feet when they stand.
///
/// In each frame the lowest of ankles, toes and foot tips counts; the floor is at the 10th percentile of those that are
/// no faster than 0.35 m/s, so that neither flight nor single dips move it. Skin and shoe soles are below the joints by
/// some centimetres that no file states.
pub fn floor_height_m(clip: &Clip, humanoid: &Humanoid) -> f64 {
    let feet = Feet::of(clip, humanoid);
    let points = || feet.sides.iter().flatten();
    let slow = SLOW_M_S[0] * feet.scale;
    let lowest = |only_slow: bool| -> Vec<f64> {
        (0..clip.frames())
            .filter_map(|frame| {
                points()
                    .filter(|point| !only_slow || point.speed(frame, clip.fps()) < slow)
                    .map(|point| point.positions[frame].y)
                    .min_by(f64::total_cmp)
            })
            .collect()
    };
    // The slow moments of a foot that is always in the air are no contacts: use only frames in which a low point is
    // slow.
    let all = quantile(lowest(false), 0.5).unwrap_or(0.0);
    let standing: Vec<f64> = lowest(true).into_iter().filter(|&height| height < all + 0.1 * feet.scale).collect();
    quantile(standing, 0.1).or(quantile(lowest(false), 0.1)).unwrap_or(0.0)
}

/// Foot contacts: which foot stands in which frame.
#[derive(Clone, Debug, PartialEq)]
pub struct Contacts {
    /// One entry per frame: whether the left foot carries weight, as estimated from its motion.
    pub left: Vec<bool>,
    /// The same for the right foot.
    pub right: Vec<bool>,
}

impl Contacts {
    /// One side's entries.
    pub fn side(&self, side: Side) -> &[bool] {
        match side {
            Side::Left => &self.left,
            Side::Right => &self.right,
        }
    }

    /// The stretches of frames in which a foot stands, as first and last frame.
    pub fn stances(&self, side: Side) -> Vec<(usize, usize)> {
        runs(self.side(side))
    }
}

/// First and last index of every run of `true`.
pub(crate) fn runs(flags: &[bool]) -> Vec<(usize, usize)> {
    let mut runs: Vec<(usize, usize)> = Vec::new();
    for (at, _) in flags.iter().enumerate().filter(|(_, flag)| **flag) {
        match runs.last_mut() {
            Some((_, last)) if *last + 1 == at => *last = at,
            _ => runs.push((at, at)),
        }
    }
    runs
}

/// Finds the stance of both feet in a clip in metres and Y up, from joint positions alone.
///
/// A foot stands while its ankle, its toes or its tip is both low (within 5.5 cm of that point's own standing height, the 5th percentile
/// over the clip) and slow (below 0.35 m/s); it goes on standing until no point is within 9 cm and below 0.6 m/s. Lengths and
/// speeds scale with stature / 1.7 m. Gaps and stances below 40 ms are dropped.
pub fn contacts(clip: &Clip, humanoid: &Humanoid) -> Contacts {
    let feet = Feet::of(clip, humanoid);
    let fps = clip.fps();
    let shortest = (0.04 * fps).ceil() as usize;
    let [left, right] = feet.sides.each_ref().map(|points| {
        let bases: Vec<f64> = points
            .iter()
            .map(|point| quantile(point.positions.iter().map(|position| position.y).collect(), 0.05).unwrap_or(0.0))
            .collect();
        let mut stands = false;
        let mut flags: Vec<bool> = (0..clip.frames())
            .map(|frame| {
                let level = usize::from(stands);
                stands = points.iter().zip(&bases).any(|(point, base)| {
                    point.positions[frame].y - base < LOW_M[level] * feet.scale
                        && point.speed(frame, fps) < SLOW_M_S[level] * feet.scale
                });
                stands
            })
            .collect();
        for value in [false, true] {
            let mask: Vec<bool> = flags.iter().map(|&flag| flag == value).collect();
            for (from, to) in runs(&mask) {
                if to + 1 - from < shortest && from > 0 && to + 1 < flags.len() {
                    flags[from..=to].fill(!value);
                }
            }
        }
        flags
    });
    Contacts { left, right }
}

/// A point of a foot over the clip.
pub(crate) struct FootPoint {
    pub joint: usize,
    pub positions: Vec<DVec3>,
}

impl FootPoint {
    /// Speed by central difference \[m/s\].
    pub fn speed(&self, frame: usize, fps: f64) -> f64 {
        let (before, after) = (frame.saturating_sub(1), (frame + 1).min(self.positions.len() - 1));
        if before == after {
            0.0
        } else {
            self.positions[before].distance(self.positions[after]) * fps / (after - before) as f64
        }
    }
}

/// Ankles, toes and tips of both feet.
pub(crate) struct Feet {
    pub sides: [Vec<FootPoint>; 2],
    /// Stature / 1.7 m.
    pub scale: f64,
}

impl Feet {
    pub fn of(clip: &Clip, humanoid: &Humanoid) -> Feet {
        let points = [Side::Left, Side::Right].map(|side| {
            let mut points = vec![(humanoid.leg(side)[2], DVec3::ZERO)];
            points.extend(foot_points(clip, humanoid, side));
            points
        });
        let mut sides = points.each_ref().map(|points| {
            points
                .iter()
                .map(|&(joint, _)| FootPoint { joint, positions: Vec::with_capacity(clip.frames()) })
                .collect::<Vec<_>>()
        });
        let mut world = Vec::new();
        for frame in 0..clip.frames() {
            clip.world_into(frame, &mut world);
            for (tracks, points) in sides.iter_mut().zip(&points) {
                for (track, &(joint, point)) in tracks.iter_mut().zip(points) {
                    track.positions.push(world[joint].point(point));
                }
            }
        }
        Feet { sides, scale: (stature(clip, humanoid) / 1.7).max(1e-6) }
    }
}
