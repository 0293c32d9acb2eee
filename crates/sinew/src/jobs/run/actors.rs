//! Statistics of live performers in a run.

use serde::Serialize;
use sinew_control::perform::PerformCounters;
use sinew_live::Performers;
use sinew_stage::Stage;
use std::collections::BTreeMap;

/// One live performer. Malformed samples count as rejected.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct ActorReport {
    /// Samples that arrived, malformed ones included.
    pub received: u64,
    /// Of these, those that arrived too late to be used.
    pub late: u64,
    /// Of these, those that the outlier filter rejected: duplicates, stale and invalid ones.
    pub rejected: u64,
    /// Those that never arrived, as far as is known.
    pub lost: u64,
    /// Whether that was estimated from time stamps.
    pub lost_is_estimate: bool,
    /// From the arrival of a sample until a frame with it is out; null in a replay.
    pub latency_ms: Option<LatencyReport>,
    /// Delay of the jitter buffer at the end \[ms\].
    pub delay_ms: f64,
    /// All counters.
    pub counters: PerformCounters,
    /// Malformed datagrams or lines.
    pub malformed: u64,
    /// Datagrams with bones of another performer.
    pub foreign: u64,
    /// Datagrams without bones from elsewhere than the performer, such as a face's.
    pub beside: u64,
    /// Whether samples were timed by their arrival, because the sender's clock stood still or was out of range.
    pub goes_by_arrival: bool,
    /// Samples dropped because they arrived faster than the stage takes them.
    pub overflown: u64,
}

/// A latency's distribution.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct LatencyReport {
    /// Half of all stay below this \[ms\].
    pub p50: f64,
    /// 99 of 100 stay below this \[ms\].
    pub p99: f64,
}

/// Every character that has a performer.
pub(super) fn of(stage: &Stage) -> BTreeMap<String, ActorReport> {
    let reports = stage.cast().characters().filter_map(|(id, name)| {
        let source = stage.state_of(id)?.performance()?;
        let counters = source.counters();
        let report = ActorReport {
            received: counters.received,
            late: counters.late,
            rejected: counters.rejected(),
            lost: counters.lost,
            lost_is_estimate: counters.lost_is_estimate,
            delay_ms: source.delay_secs() * 1e3,
            counters,
            ..ActorReport::default()
        };
        Some((name.to_owned(), report))
    });
    reports.collect()
}

/// Adds what only the ports know.
pub(super) fn add_ports(reports: &mut BTreeMap<String, ActorReport>, performers: &Performers) {
    for (name, report) in reports {
        let Some((port, latency)) = performers.of(name) else { continue };
        report.malformed = port.malformed;
        report.foreign = port.foreign;
        report.beside = port.beside;
        report.goes_by_arrival = port.goes_by_arrival;
        report.overflown = port.overflown;
        report.received += port.malformed;
        report.rejected += port.malformed;
        let quantile = |share| latency.quantile_ms(share);
        report.latency_ms = quantile(0.5).zip(quantile(0.99)).map(|(p50, p99)| LatencyReport { p50, p99 });
    }
}
