//! A rate limit (token bucket): a maximum burst, and a maximum rate in the long run.

use std::time::{Duration, Instant};

/// A token bucket that fills at a constant rate.
#[derive(Clone, Debug)]
pub(super) struct RateLimit {
    per_sec: f64,
    capacity: f64,
    left: f64,
    filled: Instant,
}

impl RateLimit {
    /// A bucket of `per_sec` tokens a second, full at first, that holds one second's worth.
    pub(super) fn new(per_sec: f64, now: Instant) -> RateLimit {
        RateLimit { per_sec, capacity: per_sec, left: per_sec, filled: now }
    }

    /// Takes a token.
    ///
    /// # Errors
    /// The time until there is one.
    pub(super) fn take(&mut self, now: Instant) -> Result<(), Duration> {
        let passed = now.saturating_duration_since(self.filled).as_secs_f64();
        self.filled = now;
        self.left = (self.left + passed * self.per_sec).min(self.capacity);
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
        let mut limit = RateLimit::new(10.0, begin);
        let mut passed = 0;
        for millis in 0..5000 {
            passed += u32::from(limit.take(begin + Duration::from_millis(millis)).is_ok());
        }
        // Ten at once, then ten a second for five seconds; the last may be a rounding away.
        assert!((58..=60).contains(&passed), "{passed}");
    }
}
