//! Clock synchronisation: offset of the sender's clock to the stage's, drift, and network jitter.
//!
//! The minimum difference between arrival and time stamp in the last seconds is the offset of the clocks plus the
//! minimum latency. It expires after that time, so that clock drift is followed: 100 ppm make 0.4 ms in four seconds.

use sinew_snapshot::snapshot;

/// Buckets of the sliding minimum.
const BUCKETS: usize = 16;

/// Length of a bucket \[s\].
const BUCKET_SECS: f64 = 0.25;

/// Target share of samples that arrive in time \[1\].
const IN_TIME: f64 = 0.97;

/// Step by which one sample moves the estimate of the jitter \[s\].
const STEP_SECS: f64 = 1e-3;

/// Number of late samples in a row that indicate a permanently larger latency.
const MAX_LATE: u32 = 6;

/// Number of intervals whose median is the sender's interval.
const INTERVALS: usize = 32;

/// An estimate of the sender's clock.
#[derive(Clone, Debug)]
pub(super) struct Clock {
    minima: [f64; BUCKETS],
    bucket: u64,
    begun: bool,
    jitter_secs: f64,
    most_jitter_secs: f64,
    late_in_a_row: u32,
    intervals: [f64; INTERVALS],
    known: usize,
    next: usize,
    interval_secs: f64,
}

snapshot!(Clock { minima, bucket, begun, jitter_secs, late_in_a_row, intervals, known, next, interval_secs }
    fixed { most_jitter_secs }
    valid |clock| clock.late_in_a_row < MAX_LATE && clock.known <= INTERVALS && clock.next < INTERVALS && clock.bucket < u64::MAX);

impl Clock {
    pub fn new(most_jitter_secs: f64) -> Clock {
        Clock {
            minima: [f64::INFINITY; BUCKETS],
            bucket: 0,
            begun: false,
            jitter_secs: FIRST_JITTER_SECS.min(most_jitter_secs),
            most_jitter_secs,
            late_in_a_row: 0,
            intervals: [0.0; INTERVALS],
            known: 0,
            next: 0,
            interval_secs: FIRST_INTERVAL_SECS,
        }
    }

    /// Resets for a restarted sender.
    pub fn restart(&mut self) {
        self.minima = [f64::INFINITY; BUCKETS];
        self.begun = false;
        self.late_in_a_row = 0;
    }

    /// Updates with a sample. `is_late`: it arrived too late to be used.
    pub fn observe(&mut self, arrival_secs: f64, time_secs: f64, is_late: bool) {
        let bucket = (arrival_secs.max(0.0) / BUCKET_SECS) as u64;
        if !self.begun || bucket.saturating_sub(self.bucket) >= BUCKETS as u64 {
            self.minima = [f64::INFINITY; BUCKETS];
        } else {
            for passed in self.bucket + 1..=bucket {
                self.minima[(passed % BUCKETS as u64) as usize] = f64::INFINITY;
            }
        }
        self.bucket = if self.begun { self.bucket.max(bucket) } else { bucket };
        self.begun = true;
        let slot = &mut self.minima[(self.bucket % BUCKETS as u64) as usize];
        let difference = arrival_secs - time_secs;
        *slot = slot.min(difference);
        let way = difference - self.offset_secs();
        let step = if way > self.jitter_secs { IN_TIME } else { IN_TIME - 1.0 };
        self.jitter_secs += STEP_SECS * step;
        self.late_in_a_row = if is_late { self.late_in_a_row + 1 } else { 0 };
        if self.late_in_a_row >= MAX_LATE {
            self.jitter_secs = self.jitter_secs.max(way);
            if way > self.most_jitter_secs {
                // Longer than the maximum delay: the previous minimum is obsolete.
                self.minima = [f64::INFINITY; BUCKETS];
                self.minima[(self.bucket % BUCKETS as u64) as usize] = difference;
                self.jitter_secs = FIRST_JITTER_SECS;
            }
            self.late_in_a_row = 0;
        }
        self.jitter_secs = self.jitter_secs.clamp(0.0, self.most_jitter_secs);
    }

    /// Time between two neighbouring samples, by the sender's clock \[s\].
    pub fn interval(&mut self, secs: f64) {
        if !(1e-4..=0.5).contains(&secs) {
            return;
        }
        self.intervals[self.next] = secs;
        self.next = (self.next + 1) % INTERVALS;
        self.known = (self.known + 1).min(INTERVALS);
        let mut sorted = self.intervals;
        let sorted = &mut sorted[..self.known];
        sorted.sort_unstable_by(f64::total_cmp);
        self.interval_secs = sorted[self.known / 2];
    }

    /// Stage time minus sender time, at the minimum latency of the last seconds \[s\].
    pub fn offset_secs(&self) -> f64 {
        self.minima.iter().copied().fold(f64::INFINITY, f64::min)
    }

    /// Delay of the buffer beyond the minimum latency \[s\]: one interval plus jitter.
    pub fn delay_secs(&self) -> f64 {
        self.interval_secs + self.jitter_secs
    }

    /// The sender's median interval \[s\].
    pub fn interval_secs(&self) -> f64 {
        self.interval_secs
    }
}

/// Initial estimate of the jitter \[s\].
const FIRST_JITTER_SECS: f64 = 0.01;

/// Initial estimate of the interval \[s\].
const FIRST_INTERVAL_SECS: f64 = 1.0 / 60.0;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_clock_that_runs_fast_is_followed() {
        let mut clock = Clock::new(0.12);
        for frame in 0..18_000 {
            let arrival = f64::from(frame) / 60.0;
            clock.observe(arrival, arrival * 1.0001 + 7.0, false);
        }
        let (now, offset) = (18_000.0 / 60.0, clock.offset_secs());
        // A window of four seconds at 100 ppm, and a bucket more.
        assert!((now - now * 1.0001 - 7.0 - offset).abs() < 5e-4);
    }

    #[test]
    fn a_way_that_has_become_longer_is_believed_after_a_few_samples() {
        let mut clock = Clock::new(0.12);
        for frame in 0..60 {
            clock.observe(f64::from(frame) / 60.0, f64::from(frame) / 60.0, false);
        }
        for frame in 60..70 {
            clock.observe(f64::from(frame) / 60.0 + 1.0, f64::from(frame) / 60.0, true);
        }
        assert!((clock.offset_secs() - 1.0).abs() < 0.01);
    }
}
