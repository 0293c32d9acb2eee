//! Moving targets: the hand follows at once, the body is replanned from time to time.

use crate::reacher::{Goal, Reacher};
use glam::DVec3;

/// Distance that a target moves before the body is replanned \[m\], and the minimum time between two plans \[s\].
const MOVED_M: f64 = 0.015;
const EVERY_SECS: f64 = 0.1;

/// Time by which the body's plan predicts the target's motion \[s\].
const AHEAD_SECS: f64 = 0.5;

impl Reacher {
    /// Sets the present positions of moving targets. Call it for every frame while they move; a hand without a target
    /// needs [`Reacher::reach`] first. The hand stays on a target that moves smoothly; for one that jumps call
    /// [`Reacher::reach`], which moves there smoothly.
    pub fn follow(&mut self, goal: &Goal) {
        let now = self.now_secs;
        let targets = [goal.left, goal.right];
        for side in 0..2 {
            let (Some(target), true) = (targets[side].filter(|target| target.is_finite()), self.goal[side].is_some())
            else {
                continue;
            };
            if let Some((before, secs)) = &self.followed
                && let Some(before) = before[side]
                && now > *secs
            {
                let velocity = (target - before) / (now - secs);
                self.velocity[side] = velocity.clamp_length_max(5.0);
            }
            self.arms[side].target = target;
            self.goal[side] = Some(target);
        }
        self.followed = Some((self.goal, now));
        if now - self.replanned_secs >= EVERY_SECS && self.has_moved() {
            self.plan_again(now);
        }
    }

    fn has_moved(&self) -> bool {
        (0..2).any(|side| match (self.goal[side], self.planned[side]) {
            (Some(here), Some(planned)) => (here + self.velocity[side] * AHEAD_SECS - planned).length() > MOVED_M,
            _ => false,
        })
    }

    fn plan_again(&mut self, now: f64) {
        let ahead = (self.done_secs() - now).clamp(0.0, AHEAD_SECS);
        let ahead: [Option<DVec3>; 2] = [0, 1].map(|side| Some(self.goal[side]? + self.velocity[side] * ahead));
        let mut rng = self.rng;
        let decision = self.decide(ahead, &mut rng, true);
        self.rng = rng;
        self.planned = ahead;
        self.replanned_secs = now;
        self.schedule_again(&decision, now);
    }
}
