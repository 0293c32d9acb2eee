//! The limb flexed to a distance and rotated towards its target, before the swivel.

use super::LimbGoal;
use super::hinge::{Hinge, Side};
use super::sweep::Sweep;
use crate::humanoid::Limit;
use crate::humanoid::rotation::exp;
use glam::{DQuat, DVec3};

/// Halvings of the last percent of the reach, where the upper joint's limit asks for it: to a thousandth of a millimetre.
const STRAIGHTENINGS: u32 = 13;

/// The target relative to the limb's first joint, and the effector that is to reach it.
pub(super) struct Aim {
    near: DQuat,
    elbow: DVec3,
    in_lower: DVec3,
    /// From the joint to the target, in the parent's frame \[m\].
    pub line: DVec3,
    /// Its length \[m\].
    pub distance: f64,
}

/// A limb that points at its target.
#[derive(Clone, Copy)]
pub(super) struct Flexed {
    /// The lower bone's turn about X alone.
    pub flexion: DQuat,
    /// The same with its turn about itself.
    pub lower: DQuat,
    /// The effector in the upper bone's frame \[m\].
    pub reach: DVec3,
    /// The line about which it swivels, in the parent's frame.
    pub to: DVec3,
    /// The upper bone's turn, before any swivel.
    pub straight: DQuat,
}

impl Aim {
    pub fn new(goal: &LimbGoal, elbow: DVec3, in_lower: DVec3) -> Aim {
        let line = goal.world_from_parent.conjugate() * (goal.target - goal.joint);
        Aim { near: goal.near[0].normalize(), elbow, in_lower, line, distance: line.length() }
    }

    /// The limb flexed for a distance and turned to the target the short way.
    pub fn flexed(&self, hinge: &Hinge, side: Side, distance: f64) -> Option<Flexed> {
        let flexion = hinge.at_distance(distance, side)?;
        let lower = (flexion * hinge.twist).normalize();
        let reach = self.elbow + lower * self.in_lower;
        let from = (self.near * reach).try_normalize()?;
        // A target in the joint itself says nothing about the direction.
        let to = self.line.try_normalize().unwrap_or(from);
        let straight = (DQuat::from_rotation_arc(from, to) * self.near).normalize();
        Some(Flexed { flexion, lower, reach, to, straight })
    }

    /// Near full stretch, where a limb bent more than the distance asks for does not fit its limits: bent as little less as it
    /// takes, and the swivel.
    pub fn straighter(&self, hinge: &Hinge, soft: f64, fits: impl Fn(&Flexed) -> Option<f64>) -> Option<(f64, Flexed)> {
        let longest = self.distance.min(hinge.longest());
        if soft >= longest {
            return None;
        }
        [Side::Bent, Side::Back].into_iter().find_map(|side| {
            let fits = |distance: f64| {
                let way = self.flexed(hinge, side, distance)?;
                Some((fits(&way)?, way))
            };
            let (mut short, mut long) = (soft, longest);
            let mut found = fits(long)?;
            for _ in 0..STRAIGHTENINGS {
                let middle = 0.5 * (short + long);
                match fits(middle) {
                    Some(way) => (found, long) = (way, middle),
                    None => short = middle,
                }
            }
            Some(found)
        })
    }

    /// Outside the limits: from the upper bone's turn, cut back to its range, the flexion that comes nearest to the target, and
    /// the upper bone turned to the target once more as far as its range lets it. Returns both bones' turns.
    pub fn neared(&self, hinge: &Hinge, limit: &Limit, upper: DQuat) -> (DQuat, DQuat) {
        let seen = upper.conjugate() * self.line - self.elbow;
        let lower = (hinge.nearest_to(seen, self.in_lower) * hinge.twist).normalize();
        let reach = upper * (self.elbow + lower * self.in_lower);
        let (Some(from), Some(to)) = (reach.try_normalize(), self.line.try_normalize()) else { return (upper, lower) };
        (limit.clamp((DQuat::from_rotation_arc(from, to) * upper).normalize()), lower)
    }
}

impl Flexed {
    pub fn upper_sweep(&self, limit: &Limit) -> Sweep {
        Sweep::new(limit.centre.conjugate(), self.to, self.straight, &limit.swing, limit.twist)
    }

    pub fn swivelled(&self, angle: f64) -> DQuat {
        (exp(self.to * angle) * self.straight).normalize()
    }
}
