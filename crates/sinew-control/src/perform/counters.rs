//! What came of a performer's samples.

use serde::Serialize;
use sinew_snapshot::snapshot;

/// Samples by their fate. All but [`lost`](PerformCounters::lost) are exact; every received sample is counted in exactly one of
/// `used`, `late`, `duplicates`, `stale`, `untracked`, `non_finite`, `non_unit` and `jumps`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct PerformCounters {
    /// Samples that arrived.
    pub received: u64,
    /// Of these, those that found their way into the pose.
    pub used: u64,
    /// Of the used ones, those that arrived after a later one.
    pub reordered: u64,
    /// Arrived when their time was over.
    pub late: u64,
    /// Arrived before.
    pub duplicates: u64,
    /// Of another time altogether: a second and more before or after the others.
    pub stale: u64,
    /// The sender did not see its performer.
    pub untracked: u64,
    /// With numbers that are none.
    pub non_finite: u64,
    /// With turns that are no rotations.
    pub non_unit: u64,
    /// Farther from their neighbours than a body can move.
    pub jumps: u64,
    /// Never arrived, as far as is known.
    pub lost: u64,
    /// Whether `lost` was estimated from time stamps, because the sender does not number its samples.
    pub lost_is_estimate: bool,
}

snapshot!(PerformCounters {
    received, used, reordered, late, duplicates, stale, untracked, non_finite, non_unit, jumps, lost, lost_is_estimate,
} valid |counters| counters.received.max(counters.rejected()).max(counters.lost) <= u64::MAX / 2);

impl PerformCounters {
    /// Samples thrown out for what they are: duplicates, stale ones and bad ones.
    pub fn rejected(&self) -> u64 {
        self.duplicates + self.stale + self.non_finite + self.non_unit + self.jumps
    }
}
