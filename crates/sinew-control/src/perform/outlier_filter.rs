//! The outlier filter: which samples are valid and plausible.

use super::buffer::{Buffer, distance};
use super::numbers::Numbers;
use super::{PerformCounters, PerformerSample, SampleStatus};
use sinew_body::humanoid::Pose;
use sinew_snapshot::snapshot;

/// Maximum difference of a sample's time stamp from the present time \[s\].
const STALE_SECS: f64 = 1.0;

/// Tolerance of a quaternion's length: single precision and a sender's own rounding stay far below.
const UNIT_ERROR: f64 = 0.01;

/// Maximum angular speed of a joint \[rad/s\]: a boxer's forearm has about 25.
const MAX_RAD_S: f64 = 40.0;

/// Additional tolerance of a joint's rotation, independent of time \[rad\].
const SPARE_RAD: f64 = 0.35;

/// Maximum speed of the hips \[m/s\]: a sprinter's reach at most 12.
const MAX_M_S: f64 = 12.0;

/// Additional tolerance of the hips' displacement, independent of time \[m\].
const SPARE_M: f64 = 0.15;

/// Number of consecutive samples, consistent with each other but not with the earlier ones, after which the stream
/// counts as restarted.
const NEW_BEGINNING: u32 = 10;

/// Verdict on a sample.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Verdict {
    /// Accepted into the buffer.
    Use,
    /// Accepted into an emptied buffer: the stream restarts.
    Begin,
    /// Late: only the clock uses it.
    Late,
    /// Rejected.
    Drop,
}

/// The filter, updated by every sample.
#[derive(Clone, Debug)]
pub(super) struct OutlierFilter {
    numbers: Numbers,
    counters: PerformCounters,
    /// The last rejected sample, and the number of consecutive samples consistent with it.
    odd: Option<(f64, Pose)>,
    odd_in_a_row: u32,
    newest_arrival_secs: f64,
}

/// The context for checking a sample.
pub(super) struct Around<'a> {
    pub arrival_secs: f64,
    /// Sender's time of the playhead; `None` before the first sample.
    pub playhead_secs: Option<f64>,
    pub buffer: &'a Buffer,
    /// The sample as a pose of the character, and metres of it per metre of the performer.
    pub pose: &'a Pose,
    pub scale: f64,
}

snapshot!(OutlierFilter { numbers, counters, odd, odd_in_a_row, newest_arrival_secs }
    valid |filter| filter.odd_in_a_row <= u32::MAX / 2);

impl OutlierFilter {
    pub fn new() -> OutlierFilter {
        OutlierFilter {
            numbers: Numbers::new(),
            counters: PerformCounters::default(),
            odd: None,
            odd_in_a_row: 0,
            newest_arrival_secs: 0.0,
        }
    }

    pub fn counters(&self) -> PerformCounters {
        let mut counters = self.counters;
        counters.lost_is_estimate = !self.numbers.any();
        if self.numbers.any() {
            counters.lost = self.numbers.lost();
        }
        counters
    }

    /// Checks of the sample alone. False rejects it.
    pub fn is_sound(&mut self, sample: &PerformerSample) -> bool {
        self.counters.received += 1;
        let count = match sample.status {
            SampleStatus::NonFinite => &mut self.counters.non_finite,
            SampleStatus::Untracked => &mut self.counters.untracked,
            SampleStatus::Tracked if sample.unit_error() > UNIT_ERROR => &mut self.counters.non_unit,
            SampleStatus::Tracked => return true,
        };
        *count += 1;
        if let Some(number) = sample.number {
            self.numbers.take(number);
        }
        false
    }

    /// Checks against neighbouring samples.
    pub fn judge(&mut self, sample: &PerformerSample, around: &Around) -> Verdict {
        let verdict = self.verdict(sample, around);
        match verdict {
            Verdict::Use | Verdict::Begin => {
                self.counters.used += 1;
                let is_behind = around.buffer.newest().is_some_and(|newest| sample.time_secs < newest.time_secs);
                self.counters.reordered += u64::from(verdict == Verdict::Use && is_behind);
                self.odd = None;
                self.odd_in_a_row = 0;
                self.newest_arrival_secs = around.arrival_secs;
            }
            Verdict::Late => self.counters.late += 1,
            Verdict::Drop => {}
        }
        verdict
    }

    fn verdict(&mut self, sample: &PerformerSample, around: &Around) -> Verdict {
        let time = sample.time_secs;
        let buffer = around.buffer;
        let Some(newest) = buffer.newest() else {
            return match sample.number.is_some_and(|number| !self.numbers.take(number)) {
                true => self.duplicate(),
                false => Verdict::Begin,
            };
        };
        let ahead = time - newest.time_secs;
        let passed = (around.arrival_secs - self.newest_arrival_secs).max(0.0);
        if ahead < -STALE_SECS || ahead - passed > STALE_SECS {
            // A restarted stream continues in its new time.
            let goes_on = |(before, _): (f64, Pose)| (0.0..STALE_SECS).contains(&(time - before)) && time > before;
            if self.is_new_beginning(time, around.pose, goes_on) {
                if let Some(number) = sample.number {
                    self.numbers.restart(number);
                }
                return Verdict::Begin;
            }
            if let Some(number) = sample.number {
                self.numbers.take(number);
            }
            self.counters.stale += 1;
            return Verdict::Drop;
        }
        let is_new = match sample.number {
            Some(number) => self.numbers.take(number),
            None => buffer.nearest(time).is_none_or(|nearest| nearest.time_secs != time),
        };
        if !is_new {
            return self.duplicate();
        }
        if around.playhead_secs.is_some_and(|playhead| time <= playhead) {
            return Verdict::Late;
        }
        let Some(nearest) = buffer.nearest(time) else { return Verdict::Begin };
        let scale = around.scale;
        let fits = |(before, pose): (f64, Pose)| {
            let gap = (time - before).abs();
            let (turn, way) = distance(&pose, around.pose);
            turn <= SPARE_RAD + MAX_RAD_S * gap && way <= scale * (SPARE_M + MAX_M_S * gap)
        };
        if fits((nearest.time_secs, nearest.pose)) {
            return Verdict::Use;
        }
        if self.is_new_beginning(time, around.pose, fits) {
            return Verdict::Begin;
        }
        self.counters.jumps += 1;
        Verdict::Drop
    }

    fn duplicate(&mut self) -> Verdict {
        self.counters.duplicates += 1;
        Verdict::Drop
    }

    fn is_new_beginning(&mut self, time: f64, pose: &Pose, fits: impl Fn((f64, Pose)) -> bool) -> bool {
        self.odd_in_a_row = if self.odd.is_some_and(fits) { self.odd_in_a_row + 1 } else { 0 };
        self.odd = Some((time, *pose));
        self.odd_in_a_row >= NEW_BEGINNING
    }

    /// Estimated number of samples lost between two that arrived, for a sender without sequence numbers.
    pub fn estimate_lost(&mut self, gap_secs: f64, interval_secs: f64) {
        if gap_secs < STALE_SECS {
            self.counters.lost += ((gap_secs / interval_secs).round() as u64).saturating_sub(1);
        }
    }
}
