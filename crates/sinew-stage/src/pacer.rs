//! The pace of the clock.

use std::time::{Duration, Instant};

/// Keeps a stage at the pace of the clock. Steps are due at fixed times from the beginning, so that waiting a little too long
/// once delays nothing after it; when the machine falls far behind, the time lost is given up.
#[derive(Clone, Debug)]
pub struct Pacer {
    began: Instant,
    step: Duration,
    /// Steps before `began`.
    from_step: u64,
    /// Times that time was given up.
    lapses: u64,
}

/// How far behind the clock a stage tries to catch up.
const MAX_BEHIND: Duration = Duration::from_millis(250);

impl Pacer {
    /// The step after `step` is due now, each of the others `step_secs` after the one before it \[s\]. A length that is negative,
    /// NaN or too long for a clock counts as 0: nothing is waited for.
    pub fn new(step: u64, step_secs: f64) -> Pacer {
        let length = Duration::try_from_secs_f64(step_secs).unwrap_or_default();
        Pacer { began: Instant::now(), step: length, from_step: step, lapses: 0 }
    }

    /// Waits until the step after `step` is due.
    pub fn wait(&mut self, step: u64) {
        let due = self.began + self.step.mul_f64(step.saturating_sub(self.from_step) as f64);
        let now = Instant::now();
        if let Some(wait) = due.checked_duration_since(now) {
            std::thread::sleep(wait);
        } else if now - due > MAX_BEHIND {
            self.lapses += 1;
            (self.began, self.from_step) = (now, step);
        }
    }

    /// Times that the machine fell more than a quarter of a second behind the clock, and the time lost was given up.
    pub fn lapses(&self) -> u64 {
        self.lapses
    }
}
