//! Where the feet are, and when they stand flat.

use crate::humanoid::{Body, Node, Pose, Sole, log};
use glam::{DQuat, DVec3};

/// The feet.
pub(super) const FEET: [Node; 2] = [Node::LeftFoot, Node::RightFoot];

/// Speed at which a foot counts half as standing \[m/s\], for a stature of 1.7 m.
const STANDS_M_S: f64 = 0.15;

/// Rate of turning at which it counts half as standing flat \[rad/s\].
const FLAT_RAD_S: f64 = 0.5;

/// Up to here a foot counts as not standing at all.
const UNSURE: f64 = 0.1;

/// Speeds are taken over so long \[s\]: jitter is averaged out.
const SPEED_SECS: f64 = 0.05;

/// Heights of the heel above the lowest one around, between which a foot ceases to count as standing \[m\], for 1.7 m.
const LOW_M: [f64; 2] = [0.03, 0.07];

/// Height from which on a heel counts as raised \[m\], for 1.7 m.
const RAISED_M: f64 = 0.01;

/// The lowest heel is looked for within so long before and after \[s\]: any step is shorter.
const AROUND_SECS: f64 = 0.6;

/// Paths of the feet over a motion.
///
/// What a skeleton calls ankle and toes lies somewhere in a foot, and soles have no edges that a file tells; so a foot is looked at
/// where nothing depends on its shape: while it neither moves nor turns.
#[derive(Clone)]
pub(super) struct Feet {
    /// Edge of the heel and joint of the toes: `points[foot][point][frame]`, in the world \[m\]. A foot rolls about them.
    pub points: [[Vec<DVec3>; 2]; 2],
    /// `world_from_foot`: `turns[foot][frame]`.
    turns: [Vec<DQuat>; 2],
    pub fps: f64,
    /// Stature / 1.7 m.
    pub scale: f64,
}

/// How surely a foot stands flat from a frame to the next, from 0 to 1: `stands[foot][frame]`.
pub(super) type Stands = [Vec<f64>; 2];

impl Feet {
    pub fn of(body: &Body, poses: &[Pose], fps: f64) -> Feet {
        let mut feet =
            Feet { points: Default::default(), turns: Default::default(), fps, scale: body.stature_m() / 1.7 };
        let heels = FEET.map(|foot| {
            let sole = Sole::of(body, foot);
            DVec3::new(0.0, -sole.ankle_m, sole.heel_m)
        });
        for pose in poses {
            let at = pose.positions(body);
            for (foot, node) in FEET.into_iter().enumerate() {
                let (ankle, turn) = (at[node.index()], pose.world[node.index()]);
                feet.points[foot][0].push(ankle + turn * heels[foot]);
                feet.points[foot][1].push(ankle + turn * body.link(node).tip);
                feet.turns[foot].push(turn);
            }
        }
        feet
    }

    pub fn frames(&self) -> usize {
        self.turns[0].len()
    }

    /// The same with every foot shifted.
    #[must_use]
    pub fn shifted(mut self, by: impl Fn(usize, usize) -> DVec3) -> Feet {
        for (foot, points) in self.points.iter_mut().enumerate() {
            for path in points {
                path.iter_mut().enumerate().for_each(|(frame, at)| *at += by(foot, frame));
            }
        }
        self
    }

    /// Where a foot is as a whole: between heel and toes.
    pub fn middle(&self, foot: usize, frame: usize) -> DVec3 {
        (self.points[foot][0][frame] + self.points[foot][1][frame]) * 0.5
    }

    /// How deep heel or toes are in the floor \[m\], negative above it. `standing_m` are their heights when the foot stands. Toes under a
    /// raised heel bend, which a foot of one piece does not: they count as on the floor.
    pub fn depth_m(&self, foot: usize, point: usize, frame: usize, standing_m: [f64; 2]) -> f64 {
        let depth = |point: usize| standing_m[point] - self.points[foot][point][frame].y;
        let bends = point == 1 && depth(0) < -RAISED_M * self.scale;
        if bends { depth(1).min(0.0) } else { depth(point) }
    }

    /// How surely each foot stands flat. `leniency` 1 is meant for a motion without errors; a larger one lets faster feet pass.
    pub fn stands(&self, leniency: f64) -> Stands {
        let lowest = self.lowest_around(0);
        let slow = STANDS_M_S * self.scale * leniency;
        let [low, high] = LOW_M.map(|height| height * self.scale);
        [0, 1].map(|foot| {
            let stands = |frame: usize| {
                let (speed, turning) = self.speeds(foot, frame);
                let (speed, turning) = (speed / slow, turning / FLAT_RAD_S);
                let height = self.points[foot][0][frame].y - lowest[frame];
                let moves = 1.0 + speed * speed + turning * turning;
                let surely = ((high - height) / (high - low)).clamp(0.0, 1.0) / (moves * moves);
                ((surely - UNSURE) / (1.0 - UNSURE)).max(0.0)
            };
            (0..self.frames()).map(stands).collect()
        })
    }

    /// How surely each foot rolls about its toes, which rest meanwhile, where it does not stand flat.
    pub fn rolls(&self, leniency: f64, stands: &Stands) -> Stands {
        let lowest = self.lowest_around(1);
        let slow = STANDS_M_S * self.scale * leniency;
        let [low, high] = LOW_M.map(|height| height * self.scale);
        [0, 1].map(|foot| {
            let path = &self.points[foot][1];
            let rolls = |frame: usize| {
                let (from, to) = self.around(frame);
                let speed =
                    if to > from { path[to].distance(path[from]) * self.fps / (to - from) as f64 / slow } else { 0.0 };
                let height = ((high - (path[frame].y - lowest[frame])) / (high - low)).clamp(0.0, 1.0);
                let surely = height / ((1.0 + speed * speed) * (1.0 + speed * speed));
                (1.0 - stands[foot][frame]) * ((surely - UNSURE) / (1.0 - UNSURE)).max(0.0)
            };
            (0..self.frames()).map(rolls).collect()
        })
    }

    /// First and last frame over which the speed from a frame to the next is taken.
    fn around(&self, frame: usize) -> (usize, usize) {
        let half = (0.5 * SPEED_SECS * self.fps).round().max(1.0) as usize;
        ((frame + 1).saturating_sub(half), (frame + half).min(self.frames() - 1))
    }

    /// Speed \[m/s\] and rate of turning \[rad/s\] of a foot on its way to the next frame.
    fn speeds(&self, foot: usize, frame: usize) -> (f64, f64) {
        let (from, to) = self.around(frame);
        if to <= from {
            return (0.0, 0.0);
        }
        let per_sec = self.fps / (to - from) as f64;
        let turn = log(self.turns[foot][to] * self.turns[foot][from].conjugate());
        (self.middle(foot, to).distance(self.middle(foot, from)) * per_sec, turn.length() * per_sec)
    }

    /// Height of the lowest heel, or toes, within [`AROUND_SECS`] of each frame \[m\].
    fn lowest_around(&self, point: usize) -> Vec<f64> {
        let [left, right] = &self.points;
        let heights: Vec<f64> =
            left[point].iter().zip(&right[point]).map(|(left, right)| left.y.min(right.y)).collect();
        let around = (AROUND_SECS * self.fps).round() as usize;
        // The least of a sliding window, by a queue of candidates that rises.
        let mut queue = std::collections::VecDeque::new();
        let mut next = 0;
        (0..heights.len())
            .map(|frame| {
                while next < heights.len() && next <= frame + around {
                    while queue.back().is_some_and(|&last: &usize| heights[last] >= heights[next]) {
                        queue.pop_back();
                    }
                    queue.push_back(next);
                    next += 1;
                }
                while queue.front().is_some_and(|&first| first + around < frame) {
                    queue.pop_front();
                }
                queue.front().map_or(0.0, |&first| heights[first])
            })
            .collect()
    }
}
