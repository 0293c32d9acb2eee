//! Statistics of a performer's samples.

use serde::Serialize;
use sinew_snapshot::snapshot;

/// Counts of samples by outcome. All but [`lost`](PerformCounters::lost) are exact; every received sample is counted in
/// exactly one of `used`, `late`, `duplicates`, `stale`, `untracked`, `non_finite`, `non_unit` and `jumps`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct PerformCounters {
    /// Samples that arrived.
    pub received: u64,
    /// Of these, those that were used for the pose.
    pub used: u64,
    /// Of the used ones, those that arrived after a later one.
    pub reordered: u64,
    /// Arrived too late to be used.
    pub late: u64,
    /// Duplicates of earlier samples.
    pub duplicates: u64,
    /// With a time stamp a second or more before or after the others.
    pub stale: u64,
    /// The sender did not track its performer.
    pub untracked: u64,
    /// With NaN or infinite numbers.
    pub non_finite: u64,
    /// With quaternions that are not normalised.
    pub non_unit: u64,
    /// Farther from their neighbours than a body can move.
    pub jumps: u64,
    /// Lost: never arrived, as far as is known.
    pub lost: u64,
    /// Whether `lost` was estimated from time stamps, because the sender does not number its samples.
    pub lost_is_estimate: bool,
}

snapshot!(PerformCounters {
    received, used, reordered, late, duplicates, stale, untracked, non_finite, non_unit, jumps, lost, lost_is_estimate,
} valid |counters| counters.received.max(counters.rejected()).max(counters.lost) <= u64::MAX / 2);

impl PerformCounters {
    /// Samples that the outlier filter rejected: duplicates, stale and invalid ones.
    pub fn rejected(&self) -> u64 {
        self.duplicates + self.stale + self.non_finite + self.non_unit + self.jumps
    }
}
