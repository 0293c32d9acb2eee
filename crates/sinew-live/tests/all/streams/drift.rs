//! A long session: clocks drift, and neither delay nor memory grows.

use super::rehearsal::{Rehearsal, WALK, player};
use sinew_live::Impairment;

#[test]
fn eight_actors_with_clocks_100_ppm_fast_and_slow_keep_their_delay_for_five_minutes() {
    let Some(player) = player(WALK, 60.0) else { return };
    let rates = [1e-4, -1e-4, 5e-5, -5e-5, 1e-4, -1e-4, 0.0, 2e-5];
    let mut actors: Vec<Rehearsal> = (0..8)
        .map(|seed| {
            let impairment = Impairment { jitter_secs: 0.01, loss: 0.02, seed, ..Impairment::default() };
            let mut actor = Rehearsal::new(&player, impairment);
            actor.clock = 1.0 + rates[seed as usize];
            actor
        })
        .collect();
    for actor in &mut actors {
        // Lags in the first and the last half minute after settling.
        let (mut early, mut late, mut most_waiting) = (Vec::new(), Vec::new(), 0);
        while actor.now_secs() < 300.0 {
            actor.step();
            let lag = actor.source.lag_secs(actor.now_secs()).unwrap_or(0.0);
            match actor.now_secs() {
                secs if (30.0..60.0).contains(&secs) => early.push(lag),
                secs if secs >= 270.0 => late.push(lag),
                _ => {}
            }
            most_waiting = most_waiting.max(actor.source.waiting());
        }
        let mean = |lags: &[f64]| lags.iter().sum::<f64>() / lags.len() as f64;
        let grown = mean(&late) - mean(&early);
        // 100 ppm over four minutes are 24 ms; a clock that is followed leaves what the jitter's estimate wanders.
        assert!(grown.abs() < 0.003, "clock {}: the delay grew by {:.1} ms", actor.clock, grown * 1e3);
        // The interval, the jitter and two steps.
        assert!(mean(&late) < 0.045, "{:.1} ms", mean(&late) * 1e3);
        // A tenth of a second's worth.
        assert!(most_waiting < 10, "{most_waiting} samples wait");
        let counters = actor.source.counters();
        assert!(counters.late < counters.received / 20, "{counters:?}");
    }
}
