//! The scheduler: starts every controller at its time.

use crate::compose::Composed;
use crate::hand_path::{HandPath, PRINTED_RATIO, PRINTED_SPEED_M_S};
use crate::head::gaze_rotation;
use crate::minimum_jerk::MinimumJerk;
use crate::plan::Decision;
use crate::reacher::Reacher;
use crate::solve::Aim;
use crate::timing::{LEANS_SECS, Timing};
use sinew_body::humanoid::Node;

/// How far carried arms are held away from the body \[rad\], and in what time \[s\].
const CLEAR_RAD: f64 = 0.15;
const CLEARS_SECS: f64 = 0.5;

/// A bend of less than this \[rad\] is none.
const BARELY: f64 = 0.1;

/// Share of a squat's time in which the weight moves over the toes \[1\].
const LEANS_FIRST: f64 = 0.55;

/// Speed at which the head follows what it faces, beside that at which it turns there \[1\]: the two may add up.
const HEAD_FOLLOWS: f64 = 0.65;

impl Reacher {
    /// Starts every trajectory: the scheduler's states 0 to 3.
    pub(crate) fn schedule(&mut self, decision: &Decision, composed: &Composed, now: f64) {
        let (mut timing, pace, is_late) = self.paced(decision, composed, now);
        // State 0: step.
        self.set_off(&mut timing);
        let arms_secs = timing.end - timing.arm;
        let from = |at: f64| (at - now).max(0.0);
        let aim = &decision.aim;
        // State 1: arm, head and twist. By default the head turns first, as people's do.
        let waits = if self.style.print { from(timing.arm) } else { self.manner.gaze_secs };
        self.turn_head(decision, composed, now, waits, &timing);
        self.twist.go(now, aim.twist, from(timing.arm), timing.twist);
        let clear = self.clearance(decision.walk.is_some(), aim);
        for side in 0..2 {
            let reaches = decision.targets[side].is_some();
            let arm = &mut self.arms[side];
            arm.printed = None;
            if !reaches {
                arm.let_go(now, from(timing.end));
                arm.clear.go(now, clear, 0.0, CLEARS_SECS);
                continue;
            }
            arm.clear.go(now, clear, 0.0, CLEARS_SECS);
            arm.girdle.go(now, aim.arms[side].girdle, from(timing.arm), arms_secs);
            arm.share.go_early(now, 1.0, from(timing.arm), arms_secs);
            (arm.swivel, arm.bow) = (MinimumJerk::rest(aim.arms[side].swivel), MinimumJerk::rest(decision.bow[side]));
            arm.wrist = MinimumJerk::rest(aim.arms[side].wrist);
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
        // The weight is over the toes before the heels rise.
        let leans = (LEANS_SECS * pace).min(0.5 * timing.swings);
        let forward = if aim.tiptoe > 0.0 { 2.0 * leans } else { LEANS_FIRST * timing.swings };
        self.onto_toes.go(now, decision.onto_toes, from(timing.swing), forward);
        self.tiptoe.go(now, aim.tiptoe, from(timing.swing) + leans, timing.swings - leans);
        // State 3: the arm has arrived.
        self.outcome = decision.outcome(timing.end, &self.steps);
        self.outcome.is_late = is_late;
    }

    /// Redirects the body while the hand stays on its path or on its target.
    pub(crate) fn schedule_again(&mut self, decision: &Decision, now: f64) {
        let composed = self.composed_at(now);
        let mut timing = self.timing(decision, &composed, now, 1.0);
        self.set_off(&mut timing);
        let landed = timing.landed;
        let aim = &decision.aim;
        // A body that follows a moving target must be fast enough.
        let lasts = (timing.twist.max(timing.swings)).clamp(0.35, 0.6).max(landed - now);
        self.twist.go(now, aim.twist, 0.0, lasts);
        self.swing.go(now, aim.swing, 0.0, lasts);
        self.squat.go(now, aim.squat, 0.0, lasts);
        self.lean.go(now, aim.lean, 0.0, lasts);
        self.tiptoe.go(now, aim.tiptoe, 0.0, lasts);
        self.onto_toes.go(now, decision.onto_toes, 0.0, lasts);
        let turns = (decision.gaze - self.gaze.at(now)).length() / (HEAD_FOLLOWS * self.style.head_speed_rad_s);
        self.gaze.go(now, decision.gaze, 0.0, lasts.max(turns));
        let mut arrives = now;
        for side in 0..2 {
            if decision.targets[side].is_none() {
                continue;
            }
            let arm = &mut self.arms[side];
            arm.swivel.go(now, aim.arms[side].swivel, 0.0, lasts);
            arm.girdle.go(now, aim.arms[side].girdle, 0.0, lasts);
            arm.wrist.go(now, aim.arms[side].wrist, 0.0, lasts);
            if arm.share.end_secs() > now {
                let left = (arm.share.end_secs() - now).max(landed - now);
                arm.share.go(now, 1.0, 0.0, left);
            }
            arrives = arm.share.end_secs().max(arrives);
        }
        let before = self.outcome.arrives_secs;
        let arrives = if arrives > now { arrives } else { before };
        let is_late = self.outcome.is_late;
        self.outcome = decision.outcome(arrives.max(landed), &self.steps);
        self.outcome.is_late = is_late;
    }

    /// How far carried arms are held away from a body that walks or bends \[rad\]: thighs come up beside them.
    fn clearance(&self, walks: bool, aim: &Aim) -> f64 {
        let bends = aim.swing.length() + aim.squat / self.frame.values.leg_m;
        if self.style.print || !walks && bends < BARELY { 0.0 } else { CLEAR_RAD }
    }

    /// Takes the strides of a plan over.
    fn set_off(&mut self, timing: &mut Timing) {
        if let Some((feet, steps)) = timing.walked.take() {
            self.feet = feet;
            self.steps.extend(steps);
        }
    }

    /// The head turns to where the target is seen now, `after_secs` from now, then keeps facing it while trunk and feet turn.
    fn turn_head(&mut self, decision: &Decision, composed: &Composed, now: f64, after_secs: f64, timing: &Timing) {
        let speed = self.style.head_speed_rad_s;
        if self.gaze_weight.at(now) == 0.0
            && let Some(target) = crate::reacher::middle_of(decision.targets)
        {
            let pose = &composed.pose;
            let neck = pose.positions(&self.frame.body)[Node::Neck.index()];
            self.gaze = MinimumJerk::rest(gaze_rotation(pose.world[Node::Chest.index()].conjugate() * (target - neck)));
        }
        let seen = self.gaze.at(now);
        let lasts = (seen.length().max(decision.gaze.length()) / speed).max(0.25);
        self.gaze_weight.go(now, 1.0, after_secs, lasts);
        let turns = (decision.gaze - seen).length() / (HEAD_FOLLOWS * speed);
        let begins = (timing.arm - now).max(after_secs + 0.6 * lasts);
        self.gaze.go(now, decision.gaze, begins, (timing.end - now - begins).max(turns).max(0.25));
    }
}
