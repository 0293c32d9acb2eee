//! The gait cycle of a walk or run.
//!
//! A stride is searched between events that every gait has: the moments when a foot is farthest ahead of the hips in
//! the direction of travel. Two such moments of one foot with one of the other foot between them bound a stride; the
//! best is the one whose two ends agree best in pose. The moment is close to the contact of that foot, and unlike a
//! contact it is sharp in backward, sneaking and running gaits alike.

use crate::defects::moves_from;
use crate::facing::facings;
use crate::filter::LowPass;
use crate::{Clip, Humanoid, Side, stature};
use glam::{DQuat, DVec3};

/// Minimum and maximum duration of a stride \[s\]: a sprinter's is 0.45 s, a sneak's 2.5 s.
const PERIOD_SECS: std::ops::RangeInclusive<f64> = 0.4..=3.2;
/// Minimum displacement of a stride as a share of stature: less is stepping on the spot.
const MIN_STRIDE: f64 = 0.25;
/// The other foot's moment comes at this share of the stride.
const OTHER_FOOT: std::ops::RangeInclusive<f64> = 0.25..=0.75;
/// Maximum difference between the ends of a cycle \[deg\].
const MAX_GAP_DEG: f64 = 20.0;
/// Maximum difference between the ends of a loop \[deg\].
const LOOP_GAP_DEG: f64 = 3.0;
/// Minimum autocorrelation of the legs for a cycle.
const MIN_PERIODICITY: f64 = 0.5;

/// One stride: two steps, from one moment of a foot to the next.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cycle {
    /// First frame, from 0.
    pub first: usize,
    /// Last frame, from 0: the same moment one stride later.
    pub last: usize,
    /// Duration of the stride \[s\].
    pub period_secs: f64,
    /// The foot that is farthest ahead in the first and last frame.
    pub foot: Side,
    /// Root mean square over the joints of the angle between both ends \[deg\].
    pub pose_gap_deg: f64,
    /// How well the legs around the first end repeat themselves one stride later: 1 exactly, 0 not at all.
    pub periodicity: f64,
    /// How far the hips go \[m\], horizontally.
    pub stride_m: f64,
}

/// Finds the stride whose ends agree best, in a clip in metres and Y up; `None` if the clip does not walk or run.
///
/// A clip that is one loop, as games have them, is a cycle as a whole, also on the spot: its ends agree within 3° and its legs
/// take turns.
pub fn find_cycle(clip: &Clip, humanoid: &Humanoid) -> Option<Cycle> {
    let legs = Legs::of(clip, humanoid)?;
    let mut best: Option<Cycle> = None;
    for side in [Side::Left, Side::Right] {
        let (own, other) = (&legs.moments[side as usize], &legs.moments[1 - side as usize]);
        for pair in own.windows(2) {
            if let Some(cycle) = legs.cycle(clip, humanoid, side, [pair[0], pair[1]], other)
                && best.is_none_or(|best| cycle.pose_gap_deg < best.pose_gap_deg)
            {
                best = Some(cycle);
            }
        }
    }
    best.or_else(|| legs.loop_of(clip, humanoid))
}

/// What the legs do, frame by frame.
struct Legs {
    from: usize,
    hips: Vec<DVec3>,
    /// Directions of thighs and shins in the facing frame.
    directions: Vec<[DVec3; 4]>,
    /// Frames in which the left and the right foot is farthest ahead.
    moments: [Vec<usize>; 2],
    stature_m: f64,
    /// How far ahead of the hips each foot is \[m\].
    ahead: [Vec<f64>; 2],
}

impl Legs {
    fn of(clip: &Clip, humanoid: &Humanoid) -> Option<Legs> {
        let from = moves_from(clip, humanoid);
        let frames = clip.frames();
        if frames < from + 8 {
            return None;
        }
        let stature_m = stature(clip, humanoid);
        let legs = [Side::Left, Side::Right].map(|side| humanoid.leg(side));
        let faces = facings(clip, humanoid);
        let mut hips = Vec::with_capacity(frames);
        let mut feet = Vec::with_capacity(frames);
        let mut directions = Vec::with_capacity(frames);
        let mut world = Vec::new();
        for (frame, &forward) in faces.iter().enumerate() {
            clip.world_into(frame, &mut world);
            let at = |joint: usize| world[joint].translation;
            hips.push(at(humanoid.hips()));
            feet.push(legs.map(|leg| at(leg[2])));
            let left = DVec3::Y.cross(forward);
            let in_facing =
                |vector: DVec3| DVec3::new(vector.dot(left), vector.y, vector.dot(forward)).normalize_or_zero();
            let bone = |leg: [usize; 3], bone: usize| in_facing(at(leg[bone + 1]) - at(leg[bone]));
            directions.push([bone(legs[0], 0), bone(legs[1], 0), bone(legs[0], 1), bone(legs[1], 1)]);
        }
        let ways = ways(&hips[from..], &faces[from..], clip.fps(), stature_m);
        let ahead = [0, 1].map(|side| -> Vec<f64> {
            ways.iter().enumerate().map(|(at, way)| (feet[from + at][side] - hips[from + at]).dot(*way)).collect()
        });
        let moments =
            ahead.each_ref().map(|ahead| peaks(ahead, clip.fps(), stature_m).into_iter().map(|at| from + at).collect());
        Some(Legs { from, hips, directions, moments, stature_m, ahead })
    }

    /// The clip as a whole, when it is a loop in which the legs take turns.
    fn loop_of(&self, clip: &Clip, humanoid: &Humanoid) -> Option<Cycle> {
        let (first, last) = (self.from, clip.frames() - 1);
        let period_secs = (last - first) as f64 * clip.frame_time_secs();
        let pose_gap_deg = pose_gap(clip, humanoid, first, last).to_degrees();
        let centred = self.ahead.each_ref().map(|ahead| {
            let mean = ahead.iter().sum::<f64>() / ahead.len() as f64;
            ahead.iter().map(|value| value - mean).collect::<Vec<f64>>()
        });
        let product = |a: usize, b: usize| {
            centred[a].iter().zip(&centred[b]).map(|(a, b)| a * b).sum::<f64>() / self.ahead[a].len() as f64
        };
        let (left, right) = (product(0, 0).sqrt(), product(1, 1).sqrt());
        let step = MIN_STRIDE * self.stature_m;
        let walks = left.min(right) > 0.15 * step && product(0, 1) < -0.3 * left * right;
        if !PERIOD_SECS.contains(&period_secs) || pose_gap_deg > LOOP_GAP_DEG || !walks {
            return None;
        }
        let moved = self.hips[last] - self.hips[first];
        let stride_m = DVec3::new(moved.x, 0.0, moved.z).length();
        let foot = if self.ahead[0][0] >= self.ahead[1][0] { Side::Left } else { Side::Right };
        Some(Cycle { first, last, period_secs, foot, pose_gap_deg, periodicity: 1.0, stride_m })
    }

    fn cycle(
        &self,
        clip: &Clip,
        humanoid: &Humanoid,
        foot: Side,
        [first, last]: [usize; 2],
        other: &[usize],
    ) -> Option<Cycle> {
        let period_secs = (last - first) as f64 * clip.frame_time_secs();
        let mut between = other.iter().filter(|&&at| (first..last).contains(&at));
        let share = |at: usize| (at - first) as f64 / (last - first) as f64;
        let alternates =
            matches!((between.next(), between.next()), (Some(&at), None) if OTHER_FOOT.contains(&share(at)));
        let moved = self.hips[last] - self.hips[first];
        let stride_m = DVec3::new(moved.x, 0.0, moved.z).length();
        if !PERIOD_SECS.contains(&period_secs) || !alternates || stride_m < MIN_STRIDE * self.stature_m {
            return None;
        }
        let pose_gap_deg = pose_gap(clip, humanoid, first, last).to_degrees();
        let periodicity = self.periodicity(first, last);
        let close = pose_gap_deg <= MAX_GAP_DEG && periodicity >= MIN_PERIODICITY;
        close.then_some(Cycle { first, last, period_secs, foot, pose_gap_deg, periodicity, stride_m })
    }

    /// 1 − (mean square difference of the legs one stride apart) / (twice their variance over the stride), over as much of a
    /// quarter stride to both sides of the first end as the clip has.
    fn periodicity(&self, first: usize, last: usize) -> f64 {
        let lag = last - first;
        let from = self.from.max(first.saturating_sub(lag / 4));
        let to = (first + lag / 4).min(self.directions.len() - lag);
        let square =
            |a: &[DVec3; 4], b: &[DVec3; 4]| -> f64 { a.iter().zip(b).map(|(a, b)| a.distance_squared(*b)).sum() };
        let difference = (from..to).map(|at| square(&self.directions[at], &self.directions[at + lag])).sum::<f64>()
            / (to - from).max(1) as f64;
        let stride = &self.directions[first..=last];
        let mean = [0, 1, 2, 3].map(|bone| stride.iter().map(|bones| bones[bone]).sum::<DVec3>() / stride.len() as f64);
        let variance = stride.iter().map(|bones| square(bones, &mean)).sum::<f64>() / stride.len() as f64;
        1.0 - difference / (2.0 * variance).max(1e-12)
    }
}

/// The horizontal direction in which the hips travel in each frame, smoothed over about a stride; the facing where they
/// hardly do.
fn ways(hips: &[DVec3], faces: &[DVec3], fps: f64, stature_m: f64) -> Vec<DVec3> {
    let mut smooth: Vec<[f64; 2]> = hips.iter().map(|hips| [hips.x, hips.z]).collect();
    LowPass::new(0.6, fps).zero_phase(&mut smooth);
    let last = smooth.len() - 1;
    (0..=last)
        .map(|at| {
            let (before, after) = (at.saturating_sub(1), (at + 1).min(last));
            let moved = DVec3::new(smooth[after][0] - smooth[before][0], 0.0, smooth[after][1] - smooth[before][1]);
            let speed = moved.length() * fps / (after - before).max(1) as f64;
            if speed > 0.1 * stature_m { moved.normalize() } else { faces[at] }
        })
        .collect()
}

/// The frames at the tops of a signal, of hills that rise above both valleys beside them by a good part of a step. Half
/// hills at the ends of the clip do not count.
fn peaks(signal: &[f64], fps: f64, stature_m: f64) -> Vec<usize> {
    let mut smooth: Vec<[f64; 1]> = signal.iter().map(|&value| [value]).collect();
    LowPass::new(6.0, fps).zero_phase(&mut smooth);
    let rise = 0.06 * stature_m;
    let mut peaks = Vec::new();
    let mut top: Option<usize> = None;
    let mut valley = smooth.first().map_or(0.0, |value| value[0]);
    for (at, &[value]) in smooth.iter().enumerate() {
        match top {
            None => {
                valley = valley.min(value);
                if value > valley + rise {
                    top = Some(at);
                }
            }
            Some(best) if value > smooth[best][0] => top = Some(at),
            Some(best) if value < smooth[best][0] - rise => {
                peaks.push(best);
                top = None;
                valley = value;
            }
            Some(_) => {}
        }
    }
    peaks
}

/// Root mean square over the mapped joints of the angle between two frames \[rad\]; the hips count without their heading.
pub(crate) fn pose_gap(clip: &Clip, humanoid: &Humanoid, a: usize, b: usize) -> f64 {
    let mut sum = 0.0;
    let mut count = 0;
    for (_, joint) in humanoid.parts() {
        let between = if joint == humanoid.hips() {
            let tilt = |frame: usize| -> DQuat {
                let rotation = clip.world(frame)[joint].rotation;
                // The twist about Y is the heading.
                let heading = DQuat::from_xyzw(0.0, rotation.y, 0.0, rotation.w);
                if heading.length_squared() > 1e-9 { heading.normalize().conjugate() * rotation } else { rotation }
            };
            tilt(a).angle_between(tilt(b))
        } else {
            clip.rotation(a, joint).angle_between(clip.rotation(b, joint))
        };
        sum += between * between;
        count += 1;
    }
    (sum / f64::from(count.max(1))).sqrt()
}
