//! Real-time pacing.

use std::time::{Duration, Instant};

/// Runs a stage in real time. Steps are due at fixed times from the start, so that one late step does not delay those
/// after it; when the machine falls more than a quarter of a second behind, the time lost is skipped.
#[derive(Clone, Debug)]
pub struct Pacer {
    began: Instant,
    step: Duration,
    /// Steps before `began`.
    from_step: u64,
    /// Number of times that lost time was skipped.
    lapses: u64,
}

/// Maximum delay behind real time that is caught up.
const MAX_BEHIND: Duration = Duration::from_millis(250);

impl Pacer {
    /// The step after `step` is due now, each later one `step_secs` after the one before it \[s\]. A length that is
    /// negative, NaN or too long for a clock counts as 0: no waiting.
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

    /// Number of times that the machine fell more than a quarter of a second behind real time, and the time lost was
    /// skipped.
    pub fn lapses(&self) -> u64 {
        self.lapses
    }
}
