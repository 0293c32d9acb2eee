//! How much somebody may send: so much at once, so much a second in the long run.

use std::time::{Duration, Instant};

/// A bucket that fills at a rate.
#[derive(Clone, Debug)]
pub(super) struct Pace {
    per_sec: f64,
    most: f64,
    left: f64,
    filled: Instant,
}

impl Pace {
    /// A second's worth may come at once.
    pub(super) fn new(per_sec: f64, now: Instant) -> Pace {
        Pace { per_sec, most: per_sec, left: per_sec, filled: now }
    }

    /// Takes one if there is one; else says how long until there is.
    pub(super) fn take(&mut self, now: Instant) -> Result<(), Duration> {
        let passed = now.saturating_duration_since(self.filled).as_secs_f64();
        self.filled = now;
        self.left = (self.left + passed * self.per_sec).min(self.most);
        if self.left >= 1.0 {
            self.left -= 1.0;
            Ok(())
        } else {
            Err(Duration::from_secs_f64((1.0 - self.left) / self.per_sec))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_flood_passes_at_the_rate_and_no_faster() {
        let begin = Instant::now();
        let mut pace = Pace::new(10.0, begin);
        let mut passed = 0;
        for millis in 0..5000 {
            passed += u32::from(pace.take(begin + Duration::from_millis(millis)).is_ok());
        }
        // Ten at once, then ten a second for five seconds; the last may be a rounding away.
        assert!((58..=60).contains(&passed), "{passed}");
    }
}
