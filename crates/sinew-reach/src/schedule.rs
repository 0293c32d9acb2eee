//! The scheduler: when each controller begins and how long it takes.

use crate::compose::Composed;
use crate::hand_path::{HandPath, PRINTED_RATIO, PRINTED_SPEED_M_S};
use crate::minimum_jerk::MinimumJerk;
use crate::plan::Decision;
use crate::reacher::Reacher;
use glam::DVec3;

impl Reacher {
    /// Starts every trajectory: the scheduler's states 0 to 3.
    pub(crate) fn schedule(&mut self, decision: &Decision, composed: &Composed, now: f64) {
        let mut pace = 1.0;
        if let Some(time) = self.style.time_secs {
            let natural = self.timing(decision, composed, now, 1.0).end - now;
            pace = time / natural.max(1e-3);
        }
        let timing = self.timing(decision, composed, now, pace);
        // State 0: step.
        if let Some(walk) = &decision.walk {
            let values = self.frame.values;
            crate::walk::walk(
                &mut self.feet,
                &walk.to,
                walk.first,
                walk.kind,
                now.max(timing.free),
                pace,
                &values,
                &mut self.steps,
            );
        }
        let arms_secs = timing.end - timing.arm;
        let from = |at: f64| (at - now).max(0.0);
        let aim = &decision.aim;
        // State 1: arm, head and twist. By default the head turns first, as people's do.
        let head = if self.style.print { timing.arm } else { now };
        self.look.go(now, 1.0, from(head), timing.head);
        self.gaze.go(now, DVec3::ZERO, 0.0, timing.head.max(0.3));
        self.twist.go(now, aim.twist, from(timing.arm), timing.twist);
        for side in 0..2 {
            let reaches = decision.targets[side].is_some();
            let arm = &mut self.arms[side];
            arm.printed = None;
            if !reaches {
                arm.let_go(now, from(timing.end));
                continue;
            }
            arm.girdle.go(now, aim.arms[side].girdle, from(timing.arm), arms_secs);
            arm.share.go_early(now, 1.0, from(timing.arm), arms_secs);
            (arm.swivel, arm.bow) = (MinimumJerk::rest(aim.arms[side].swivel), MinimumJerk::rest(decision.bow[side]));
            arm.by_joints = MinimumJerk::rest(0.0);
            if self.style.print {
                let speed = self.style.speed_m_s.unwrap_or(PRINTED_SPEED_M_S);
                let path = HandPath::new(composed.hands[side], arm.target, speed, PRINTED_RATIO);
                arm.printed = Some((path, timing.arm));
            }
        }
        // State 2: swing, squat and the balance's lean.
        self.swing.go(now, aim.swing, from(timing.swing), timing.swings);
        self.squat.go(now, aim.squat, from(timing.swing), timing.swings);
        self.lean.go(now, aim.lean, from(timing.swing), timing.swings);
        self.tiptoe.go(now, aim.tiptoe, from(timing.swing), timing.swings);
        // State 3: the arm has arrived.
        self.outcome = decision.outcome(timing.end, &self.steps);
    }

    /// Redirects the body while the hand stays on its path or on its target.
    pub(crate) fn schedule_again(&mut self, decision: &Decision, now: f64) {
        let composed = self.composed_at(now);
        let timing = self.timing(decision, &composed, now, 1.0);
        let mut landed = now;
        if let Some(walk) = &decision.walk {
            let values = self.frame.values;
            let from = now.max(timing.free);
            crate::walk::walk(&mut self.feet, &walk.to, walk.first, walk.kind, from, 1.0, &values, &mut self.steps);
            landed = self.feet.lands_secs().unwrap_or(now);
        }
        let aim = &decision.aim;
        // A body that follows a moving target must be fast enough.
        let lasts = (timing.twist.max(timing.swings)).clamp(0.35, 0.6).max(landed - now);
        self.twist.go(now, aim.twist, 0.0, lasts);
        self.swing.go(now, aim.swing, 0.0, lasts);
        self.squat.go(now, aim.squat, 0.0, lasts);
        self.lean.go(now, aim.lean, 0.0, lasts);
        self.tiptoe.go(now, aim.tiptoe, 0.0, lasts);
        let mut arrives = now;
        for side in 0..2 {
            if decision.targets[side].is_none() {
                continue;
            }
            let arm = &mut self.arms[side];
            arm.swivel.go(now, aim.arms[side].swivel, 0.0, lasts);
            arm.girdle.go(now, aim.arms[side].girdle, 0.0, lasts);
            if arm.share.end_secs() > now {
                let left = (arm.share.end_secs() - now).max(landed - now);
                arm.share.go(now, 1.0, 0.0, left);
            }
            arrives = arm.share.end_secs().max(arrives);
        }
        let before = self.outcome.arrives_secs;
        let arrives = if arrives > now { arrives } else { before };
        self.outcome = decision.outcome(arrives.max(landed), &self.steps);
    }

    /// When each controller begins and how long it takes.
    fn timing(&self, decision: &Decision, composed: &Composed, now: f64, pace: f64) -> Timing {
        let values = &self.frame.values;
        let free = self.feet.lands_secs().unwrap_or(now).max(now);
        let (mut arm, mut landed) = (now, now);
        if let Some(walk) = &decision.walk {
            let mut feet = self.feet.clone();
            let before = feet.strides().len();
            crate::walk::walk(&mut feet, &walk.to, walk.first, walk.kind, free, pace, values, &mut Vec::new());
            landed = feet.lands_secs().unwrap_or(free);
            // Of several steps the last counts.
            let strides = &feet.strides()[before..];
            let last = strides.len().saturating_sub(2);
            let from = strides.get(last).map_or(now, |stride| stride.start_secs);
            arm = from + self.style.overlap_step * (landed - from);
        }
        let turn = (decision.aim.twist - self.twist.at(now)).abs();
        let twist = pace * (0.35 + turn / 1.6);
        let swing = if turn > 0.01 { arm + self.style.overlap_twist * twist } else { arm };
        let bend = (decision.aim.swing - self.swing.at(now)).length();
        let sink = (decision.aim.squat - self.squat.at(now)).abs() / values.leg_m;
        let rise = (decision.aim.tiptoe - self.tiptoe.at(now)).abs();
        let swings = pace * (0.45 + (bend / 1.7).max(sink / 0.42).max(rise / 1.3));
        let mut hands: f64 = 0.0;
        for side in 0..2 {
            if decision.targets[side].is_some() {
                let way = decision.ways_m[side];
                let printed = 2.0 * (composed.hands[side] - self.arms[side].target).length()
                    / (self.style.speed_m_s.unwrap_or(PRINTED_SPEED_M_S) * (1.0 + PRINTED_RATIO));
                hands = hands.max(if self.style.print { printed } else { values.hand_secs(way, &self.style) });
            }
        }
        let settled = self.hips[0].end_secs();
        let mut end = (arm + pace * hands).max(arm + twist).max(swing + swings).max(landed + 0.05);
        if self.style.time_secs.is_none() {
            end = end.max(settled);
        }
        let look = decision.turns_head_rad / self.style.head_speed_rad_s;
        Timing { free, arm, swing, end, twist, swings, head: pace * look.max(0.25) }
    }
}

struct Timing {
    /// Time from which new steps can begin \[s\].
    free: f64,
    /// Times at which arm and twist begin, the swing begins, and the hand arrives \[s\].
    arm: f64,
    swing: f64,
    end: f64,
    /// Durations of twist, swing and the head's rotation \[s\].
    twist: f64,
    swings: f64,
    head: f64,
}
