//! The way of a hand looked at before it is gone: joints within their limits, arms clear of what is in the way. Where they are
//! not, the way is bowed and the elbow swung aside; where that does not do, the hand stops before it touches.

use crate::compose::{ARMS, Composed};
use crate::glide::Glide;
use crate::outcome::Reason;
use crate::reacher::Reacher;
use glam::DVec3;
use sinew_body::humanoid::Node;

/// Moments looked at on the way.
const LOOKS: usize = 24;

/// How far an arm is to stay clear \[m\], and how near to its target what is there does not count: it is what is reached for.
const CLEAR_M: f64 = 0.012;
const AT_TARGET_M: f64 = 0.11;

/// How far limits may be exceeded on the way, against the narrowed ones that plans keep \[rad\].
const EXCESS_RAD: f64 = 0.028;

/// Ways of bowing tried, in turn: up, out, in, forward, back, down, by shares of the arm.
const BOWS: [f64; 3] = [0.2, 0.4, 0.6];
const SWIVELS: [f64; 6] = [0.4, -0.4, 0.8, -0.8, 1.3, -1.3];

/// What is wrong with a way.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Fault {
    /// How deep the arm is in what it must not touch, at worst \[m\].
    deep_m: f64,
    /// How far joints are beyond their limits, at worst \[rad\].
    excess_rad: f64,
    /// When the arm first touches \[s\].
    touches_secs: Option<f64>,
}

impl Fault {
    fn is_none(&self) -> bool {
        self.deep_m <= 0.0 && self.excess_rad <= EXCESS_RAD
    }

    fn price(&self) -> f64 {
        10.0 * self.deep_m + (self.excess_rad - EXCESS_RAD).max(0.0)
    }
}

impl Reacher {
    /// What is in the way of arms from now on: looked at when the next goal is given.
    pub fn set_obstacles(&mut self, obstacles: &[crate::Obstacle]) {
        self.obstacles = obstacles.iter().copied().filter(crate::Obstacle::is_finite).take(MOST_OBSTACLES).collect();
    }

    /// Looks at the planned way and mends it where simple means do.
    pub(crate) fn mend_way(&mut self, now: f64) {
        for side in 0..2 {
            if self.goal[side].is_some() {
                self.mend_arm(side, now);
            }
        }
    }

    fn mend_arm(&mut self, side: usize, now: f64) {
        let mut least = self.look_at_way(side, now);
        if least.is_none() {
            return;
        }
        let usual = (self.arms[side].bow, self.arms[side].swivel);
        let mut best = usual;
        let is_new = self.arms[side].share.at(now) <= 0.0;
        let (bow, swivel) = (usual.0.goal(), usual.1.goal());
        let outward = if side == 0 { 1.0 } else { -1.0 };
        let turn = glam::DQuat::from_rotation_y(self.feet.support(now).yaw_rad);
        let ways = [DVec3::Y, DVec3::X * outward, DVec3::Z, DVec3::X * -outward, -DVec3::Z, -DVec3::Y];
        let arm_m = self.frame.values.arm_m;
        let bows = BOWS.iter().flat_map(|share| ways.map(|way| bow + turn * way * (share * arm_m)));
        let bows: Vec<DVec3> = std::iter::once(bow).chain(std::iter::once(DVec3::ZERO)).chain(bows).collect();
        'all: for swung in std::iter::once(0.0).chain(SWIVELS) {
            for bow in &bows {
                let end = self.outcome.arrives_secs;
                let arm = &mut self.arms[side];
                if is_new {
                    (arm.bow, arm.swivel) = (Glide::rest(*bow), Glide::rest(swivel + swung));
                } else {
                    (arm.bow, arm.swivel) = usual;
                    arm.bow.go(now, *bow, 0.0, end - now);
                    arm.swivel.go(now, swivel + swung, 0.0, end - now);
                }
                let fault = self.look_at_way(side, now);
                if fault.price() < least.price() - 1e-9 {
                    (least, best) = (fault, (self.arms[side].bow, self.arms[side].swivel));
                    if least.is_none() {
                        break 'all;
                    }
                }
            }
        }
        (self.arms[side].bow, self.arms[side].swivel) = best;
        if let Some(secs) = least.touches_secs
            && least.deep_m > 0.0
        {
            self.stop_before(side, secs, now);
        }
    }

    /// The hand goes as far as is clear.
    fn stop_before(&mut self, side: usize, secs: f64, now: f64) {
        let end = self.outcome.arrives_secs;
        let share = self.arms[side].share.at((secs - (end - now) / LOOKS as f64).max(now));
        let from = (self.arms[side].share.end_secs() - now).max(0.2);
        self.arms[side].share.go(now, share.clamp(0.0, 1.0), 0.0, from);
        self.outcome.reason = Some(Reason::Blocked);
    }

    fn look_at_way(&self, side: usize, now: f64) -> Fault {
        let end = self.outcome.arrives_secs;
        let mut fault = Fault::default();
        let at_start = self.fault_at(side, &self.composed_at(now), now);
        for index in 1..=LOOKS {
            let secs = now + (end - now) * index as f64 / LOOKS as f64;
            let composed = self.composed_at(secs);
            let there = self.fault_at(side, &composed, secs);
            // Whoever begins beyond a limit or touching something may go on from there.
            let deep = there.deep_m.min((there.deep_m - at_start.deep_m).max(0.0));
            if deep > 0.0 && fault.touches_secs.is_none() {
                fault.touches_secs = Some(secs);
            }
            fault.deep_m = fault.deep_m.max(deep);
            fault.excess_rad = fault.excess_rad.max(there.excess_rad - at_start.excess_rad);
        }
        fault
    }

    fn fault_at(&self, side: usize, composed: &Composed, _secs: f64) -> Fault {
        let pose = &composed.pose;
        let tight = &self.frame.tight;
        let excess =
            ARMS[side].iter().map(|node| tight.link(*node).limit.excess(pose.local(*node))).fold(0.0, f64::max);
        let mut fault = Fault { excess_rad: excess, ..Fault::default() };
        if self.obstacles.is_empty() {
            return fault;
        }
        let body = &self.frame.body;
        let at = pose.positions(body);
        let [_, upper, lower, hand] = ARMS[side];
        let target = self.goal[side].unwrap_or(composed.hands[side]);
        let bone = |node: Node, from: DVec3, to: DVec3, fault: &mut Fault| {
            let shape = &body.link(node).shape;
            for index in 0..=4 {
                let share = f64::from(index) / 4.0;
                let point = from.lerp(to, share);
                if (point - target).length() < AT_TARGET_M {
                    continue;
                }
                let radius = shape.from_radius_m + (shape.to_radius_m - shape.from_radius_m) * share;
                for obstacle in &self.obstacles {
                    fault.deep_m = fault.deep_m.max(radius + CLEAR_M - obstacle.distance(point));
                }
            }
        };
        let tip = at[hand.index()] + pose.world[hand.index()] * body.link(hand).tip;
        bone(upper, at[upper.index()], at[lower.index()], &mut fault);
        bone(lower, at[lower.index()], at[hand.index()], &mut fault);
        bone(hand, at[hand.index()], tip, &mut fault);
        fault
    }
}

/// Obstacles that are looked at; more are passed over.
pub const MOST_OBSTACLES: usize = 64;
