//! The walk as functions of the phase: how the mean walk's angles become legs that stand.
//!
//! Three steps. (1) The measured angles alone move the hips: whichever foot stands, its point of contact (heel, sole, ball) is
//! held still, and the hips go where the leg then puts them; while both stand, the weight goes smoothly from one to the
//! other. The result is smoothed to harmonics, which a symmetric walk has in even or odd numbers only. (2) A standing foot
//! gets a place on the floor and rolls there, over the heel's ball, the sole and the ball of the foot; the leg reaches
//! its ankle by two-bone inverse kinematics, a matter of a centimetre or two. (3) A swinging foot takes its measured path, bent by
//! polynomials of fifth degree so that it leaves and lands at the standing foot's place, speed and change of speed.
//!
//! Everything is told for the left leg. The right one is its mirror image half a stride later.

use super::measured::{measured, measured_leg};
use super::series::{Jet, ORDER, Series, Waves, project, quintic};
use super::skeleton::WalkSkeleton;
use super::stance::{LANDS, LEAVES, roll, standing, weight};
use crate::humanoid::{LegPose, Node, OffLine, exp, log, smoothstep, solve_leg_beside};
use glam::{DQuat, DVec3};

/// Phase at which the toes, bent by the push, are relaxed, and their bend then \[rad\].
const RELAXED: (f64, f64) = (0.82, -0.12);
/// A foot leaves for its measured path, and comes from it to its place, within this \[strides\].
const FADE: f64 = 0.2;
/// Phases looked at for the path of the hips.
const SAMPLES: usize = 128;
/// Least bend of a knee that a leg is left with \[rad\]: 9°. The mean walk's own least is 12°, and the straighter a knee, the
/// harder it turns for a millimetre that its ankle is moved.
const MIN_FLEXION_RAD: f64 = 0.16;
/// Least height of a swinging foot's lowest point above the floor in mid swing, in a 1.70 m body \[m\].
const CLEARANCE_M: f64 = 0.010;
/// Step of difference quotients \[strides\].
const STEP: f64 = 1e-3;

/// A symmetric walk of a body, by phase.
#[derive(Clone, Debug)]
pub(super) struct Gait {
    pub skeleton: WalkSkeleton,
    /// Swing of the angles relative to the mean walk's.
    gain: f64,
    pub stride_m: f64,
    /// The hips beside their even progress \[m\]: left, up, forward.
    path: [Series; 3],
    /// Left ankle while flat \[m\].
    plant: DVec3,
    /// What the swinging left foot's ankle \[m\] and turn \[rad\] differ by from the measured, at its start and end.
    swing: [[Jet<DVec3>; 2]; 2],
    /// The toes' bend \[rad\], likewise.
    toes: [Jet<f64>; 2],
    /// How much the foot is lifted in mid swing \[m\].
    lift_m: f64,
}

/// A leg as it is shown: `world_from_node` of its bodies, the bend of the toes, the ankle's place in the world.
#[derive(Clone, Copy, Debug)]
pub(super) struct ShownLeg {
    pub thigh: DQuat,
    pub shank: DQuat,
    pub foot: DQuat,
    pub toes: DQuat,
    pub ankle: DVec3,
}

fn jet<V>(value: impl Fn(f64) -> V, at: f64) -> Jet<V>
where
    V: Copy + std::ops::Add<Output = V> + std::ops::Sub<Output = V> + std::ops::Mul<f64, Output = V>,
{
    let (before, here, after) = (value(at - STEP), value(at), value(at + STEP));
    [here, (after - before) * (0.5 / STEP), here * 0.0]
}

/// The hips' path that the standing feet dictate: stride \[m\] and the series beside the even progress.
fn path(skeleton: &WalkSkeleton, gain: f64) -> (f64, [Series; 3]) {
    // From the hips to the foot's place on the floor.
    let held =
        |phase: f64| standing(skeleton, roll(skeleton, phase, gain)).1 - measured_leg(skeleton, phase, gain).ankle;
    let at = |index: usize| index as f64 / SAMPLES as f64;
    // One foot's share of the hips' speed, and of their height.
    let shares: Vec<(DVec3, f64)> = (0..SAMPLES)
        .map(|index| {
            let phase = at(index);
            let weight = weight(phase);
            if weight == 0.0 {
                return (DVec3::ZERO, 0.0);
            }
            let [place, speed, _] = jet(held, phase);
            (speed * weight, (place.y + skeleton.foot.ankle_m) * weight)
        })
        .collect();
    let both = |value: &dyn Fn(&(DVec3, f64)) -> f64, mirror: f64| -> Vec<f64> {
        (0..SAMPLES).map(|i| value(&shares[i]) + mirror * value(&shares[(i + SAMPLES / 2) % SAMPLES])).collect()
    };
    let integral = |speeds: Series| {
        let mut path = [0.0; 11];
        for k in 1..=ORDER {
            let rate = std::f64::consts::TAU * k as f64;
            (path[2 * k - 1], path[2 * k]) = (-speeds[2 * k] / rate, speeds[2 * k - 1] / rate);
        }
        path
    };
    let sideways = project(&both(&|share| share.0.x, -1.0), |harmonic| harmonic % 2 == 1 && harmonic < 4);
    let height = project(&both(&|share| share.1, 1.0), |harmonic| harmonic % 2 == 0);
    let forward = project(&both(&|share| share.0.z, 1.0), |harmonic| harmonic % 2 == 0);
    (forward[0], [integral(sideways), height, integral(forward)])
}

impl Gait {
    /// The gain at which the mean walk makes a stride of this length; `None` when none in reach does.
    pub fn gain_for(skeleton: &WalkSkeleton, stride_m: f64) -> Option<f64> {
        let (mut low, mut high) = (0.3, 1.7);
        if !(path(skeleton, low).0..=path(skeleton, high).0).contains(&stride_m) {
            return None;
        }
        // Strides grow with the gain. 40 halvings end below 1e-11.
        for _ in 0..40 {
            let middle = 0.5 * (low + high);
            if path(skeleton, middle).0 < stride_m { low = middle } else { high = middle }
        }
        Some(0.5 * (low + high))
    }

    pub fn new(skeleton: WalkSkeleton, gain: f64) -> Gait {
        let (stride_m, path) = path(&skeleton, gain);
        let mut gait = Gait {
            skeleton,
            gain,
            stride_m,
            path,
            plant: DVec3::ZERO,
            swing: [[[DVec3::ZERO; 3]; 2]; 2],
            toes: [[0.0; 3]; 2],
            lift_m: 0.0,
        };
        gait.plant = gait.find_plant();
        // Lower hips change the way of the swinging foot a little, so it is looked at again.
        for _ in 0..4 {
            gait.meet_the_floor();
            gait.path[1][0] -= gait.overreach();
        }
        gait.meet_the_floor();
        gait.lift_m = gait.needed_lift();
        gait
    }

    /// The hips' place \[m\] at a phase that may be of any stride.
    pub fn hips(&self, phase: f64) -> DVec3 {
        let waves = Waves::at(phase);
        let [x, y, z] = self.path.each_ref().map(|series| waves.value(series, 1.0));
        DVec3::new(x, y, z + self.stride_m * phase)
    }

    /// `parent_from_node` of the hips, the upper body and the left leg, as measured.
    pub fn measured(&self, node: Node, phase: f64) -> DQuat {
        measured(node, &Waves::at(phase), self.gain)
    }

    fn measured_ankle(&self, phase: f64) -> DVec3 {
        self.hips(phase) + measured_leg(&self.skeleton, phase, self.gain).ankle
    }

    fn standing_ankle(&self, phase: f64) -> DVec3 {
        self.plant + standing(&self.skeleton, roll(&self.skeleton, phase, self.gain)).1
    }

    /// From the measured foot's turn to the standing one's \[rad\].
    fn standing_error(&self, phase: f64) -> DVec3 {
        let turn = standing(&self.skeleton, roll(&self.skeleton, phase, self.gain)).0;
        log(turn * measured_leg(&self.skeleton, phase, self.gain).foot.conjugate())
    }

    fn standing_toes(&self, phase: f64) -> f64 {
        roll(&self.skeleton, phase, self.gain).bend()
    }

    /// Where the left foot stands: where the measured leg holds it in the mean over its stance.
    fn find_plant(&self) -> DVec3 {
        let (mut sum, mut weights) = (DVec3::ZERO, 0.0);
        for index in 0..SAMPLES {
            let phase = LANDS + (LEAVES - LANDS) * (index as f64 + 0.5) / SAMPLES as f64;
            let weight = weight(phase);
            sum += (self.measured_ankle(phase) - self.standing_ankle(phase)) * weight;
            weights += weight;
        }
        let mean = sum / weights;
        DVec3::new(mean.x, self.skeleton.foot.ankle_m, mean.z)
    }

    /// Joins the swing to the stance at both of its ends.
    fn meet_the_floor(&mut self) {
        let ends = [LEAVES, LANDS].map(|phase| {
            let ankle = jet(|phase| self.standing_ankle(phase) - self.measured_ankle(phase), phase);
            let turn = jet(|phase| self.standing_error(phase), phase);
            (ankle, turn)
        });
        self.swing = [[ends[0].0, ends[1].0], [ends[0].1, ends[1].1]];
        self.toes = [LEAVES, LANDS].map(|phase| jet(|phase| self.standing_toes(phase), phase));
    }

    /// How far the hips must come down for the left leg to reach its ankle with a bent knee \[m\].
    fn overreach(&self) -> f64 {
        let length = |node: Node| self.skeleton.body.link(node).offset.length();
        let (thigh, shank) = (length(Node::LeftLowerLeg), length(Node::LeftFoot));
        let longest_squared = thigh * thigh + shank * shank + 2.0 * thigh * shank * libm::cos(MIN_FLEXION_RAD);
        (0..2 * SAMPLES)
            .map(|index| {
                let phase = LANDS + index as f64 / (2 * SAMPLES) as f64;
                let hip = self.hips(phase) + measured_leg(&self.skeleton, phase, self.gain).hip;
                let away = hip - self.left_leg(phase).ankle;
                let level = away.x * away.x + away.z * away.z;
                away.y - (longest_squared - level).max(0.0).sqrt()
            })
            .fold(0.0, f64::max)
    }

    /// The left leg at a phase that may be of any stride.
    pub fn left_leg(&self, phase: f64) -> ShownLeg {
        let stride = (phase - LANDS).floor();
        let local = phase - stride;
        let leg = measured_leg(&self.skeleton, local, self.gain);
        let hips = self.hips(local);
        let (ankle, foot, bend) = if local <= LEAVES {
            let (foot, moved) = standing(&self.skeleton, roll(&self.skeleton, local, self.gain));
            (self.plant + moved, foot, self.standing_toes(local))
        } else {
            let span = 1.0 + LANDS - LEAVES;
            let t = (local - LEAVES) / span;
            let between = |ends: &[Jet<DVec3>; 2]| {
                let none = [DVec3::ZERO; 3];
                if local < LEAVES + FADE {
                    quintic(&ends[0], &none, FADE, (local - LEAVES) / FADE)
                } else {
                    quintic(&none, &ends[1], FADE, ((local - 1.0 - LANDS) / FADE + 1.0).max(0.0))
                }
            };
            let ankle = hips + leg.ankle + between(&self.swing[0]) + DVec3::Y * (self.lift_m * lift(t));
            let foot = exp(between(&self.swing[1])) * leg.foot;
            (ankle, foot, self.swinging_toes(local))
        };
        let input = LegPose {
            hip: hips + leg.hip,
            knee: hips + leg.knee,
            ankle: hips + leg.ankle,
            knee_axis: leg.shank * DVec3::X,
        };
        let thigh_m = (input.knee - input.hip).length();
        let beside = |knee: &OffLine, far_m: f64| forward(knee, thigh_m, far_m);
        let (thigh_turn, shank_turn) = solve_leg_beside(&input, input.hip, ankle, beside);
        let travelled = DVec3::Z * (self.stride_m * stride);
        ShownLeg {
            thigh: thigh_turn * leg.thigh,
            shank: shank_turn * leg.shank,
            foot,
            toes: exp(DVec3::X * bend),
            ankle: ankle + travelled,
        }
    }

    fn swinging_toes(&self, phase: f64) -> f64 {
        let relaxed = [RELAXED.1, 0.0, 0.0];
        let (start, end, from, to) = if phase < RELAXED.0 {
            (&self.toes[0], &relaxed, LEAVES, RELAXED.0)
        } else {
            (&relaxed, &self.toes[1], RELAXED.0, 1.0 + LANDS)
        };
        quintic(start, end, to - from, (phase - from) / (to - from))
    }

    /// Height of the left foot's lowest point above the floor \[m\].
    pub fn left_clearance(&self, phase: f64) -> f64 {
        let leg = self.left_leg(phase);
        let foot = &self.skeleton.foot;
        let ball = leg.ankle + leg.foot * foot.ball;
        let tip = ball + leg.foot * (leg.toes * foot.toe_tip);
        let heel = leg.ankle + leg.foot * foot.heel;
        // The toes' joint stands as high above the floor as their tip hangs below it.
        (heel.y - foot.heel_radius_m).min(ball.y + foot.toe_tip.y).min(tip.y)
    }

    fn needed_lift(&self) -> f64 {
        let span = 1.0 + LANDS - LEAVES;
        (1..SAMPLES)
            .map(|index| {
                let t = index as f64 / SAMPLES as f64;
                let needed = CLEARANCE_M * self.skeleton.scale * lift(t) - self.left_clearance(LEAVES + span * t);
                // Close to the floor's own moments no lift helps; the foot is above it there by its speed.
                if lift(t) > 0.2 { needed / lift(t) } else { 0.0 }
            })
            .fold(0.0, f64::max)
    }
}

/// The shape of a lift over the swing: none at either end, nor speed or change of speed there.
fn lift(t: f64) -> f64 {
    let bow = 4.0 * t * (1.0 - t);
    bow * bow * bow
}

/// Sines of the angle between thigh and line to the ankle between which a measured leg comes to have a side of its own: in a
/// straighter one the knee's side is the mean of noise.
const STRAIGHT: (f64, f64) = (0.005, 0.015);
const BENT: (f64, f64) = (0.04, 0.17);

/// A measured knee further off the leg's line, forward as far as the measured leg is straight.
fn forward(knee: &OffLine, thigh_m: f64, far_m: f64) -> OffLine {
    let sine = (knee.front * knee.front + knee.side * knee.side).sqrt() / thigh_m;
    let own = smoothstep(STRAIGHT.0, STRAIGHT.1, sine) * smoothstep(BENT.0, BENT.1, sine);
    let (sin, cos) = libm::sincos(libm::atan2(knee.side, knee.front) * own);
    OffLine { front: far_m * cos, side: far_m * sin }
}
