//! The time of a sender's frames, when its own clock can be used and when not.

/// The largest time that is used \[s\]: beyond 18 hours single precision has steps of 8 ms, half a frame.
const MAX_TOLD_SECS: f64 = 65_536.0;

/// Frames in a row with the same time, after the first, that show a clock that stands still. Duplicates come in twos.
const SAME: u32 = 3;

/// Time that must have passed at arrival meanwhile \[s\]: copies that a network makes come together.
const STILL_SECS: f64 = 0.03;

/// Follows the sender's clock, and once that cannot be used, the arrival.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct SenderClock {
    /// The last usable time, and its arrival \[s\].
    last: Option<(f64, f64)>,
    /// Frames since then without a new usable time.
    same: u32,
    goes_by_arrival: bool,
}

impl SenderClock {
    pub fn goes_by_arrival(&self) -> bool {
        self.goes_by_arrival
    }

    /// The time of a frame \[s\]. Where it changes over to the arrival, it goes on without a jump, and never goes back.
    pub fn time_secs(&mut self, told_secs: f64, arrival_secs: f64) -> f64 {
        let is_far = told_secs.is_finite() && told_secs.abs() >= MAX_TOLD_SECS;
        let (base_secs, since_secs) = match self.last {
            None if is_far => {
                self.goes_by_arrival = true;
                *self.last.insert((arrival_secs, arrival_secs))
            }
            None => *self.last.insert((told_secs, arrival_secs)),
            Some(last) if self.goes_by_arrival => last,
            Some((before, since)) => {
                if !is_far && told_secs.is_finite() && told_secs != before {
                    self.same = 0;
                    self.last = Some((told_secs, arrival_secs));
                    return told_secs;
                }
                self.same += 1;
                self.goes_by_arrival = self.same >= SAME && arrival_secs - since > STILL_SECS;
                (before, since)
            }
        };
        if self.goes_by_arrival { base_secs + (arrival_secs - since_secs) } else { told_secs }
    }
}
