//! The dial: monotone in how far the body yields, and stable over its whole range, on every clip.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use crate::pushing::{Case, DIRECTIONS, PARTS, push, starts};
use sinew_response::Settings;
use sinew_testkit::{EVERY_CLIP, mocap, none_of, work};

/// From stiff to loose.
const DIAL: [f64; 5] = [Settings::MIN_COMPLIANCE, 0.5, 1.0, 2.0, Settings::MAX_COMPLIANCE];

/// Looked at after a push \[s\]; nothing stable takes longer to come back.
const WINDOW_SECS: f64 = 10.0;

/// What 24 pushes at one setting of the dial did: each part at four moments, once in each direction.
struct Yields {
    /// Mean of the largest joint angle \[deg\].
    peak_deg: f64,
    /// What did not come back.
    lost: Vec<String>,
}

fn yields(case: &Case, compliance: f64) -> Yields {
    let settings = case.stable(Settings { compliance, ..Settings::default() });
    let mut unpushed = Vec::new();
    let starts = starts(case, &settings, &case.onsets(4), &mut unpushed);
    let (mut sum, mut count) = (0.0, 0.0);
    let mut lost = Vec::new();
    for (index, (part, node)) in PARTS.into_iter().enumerate() {
        for (phase, start) in starts.iter().enumerate() {
            let (direction, axis) = DIRECTIONS[(index + phase) % 4];
            let outcome = push(start, node, axis * 100.0, 6, WINDOW_SECS);
            sum += outcome.peak();
            count += 1.0;
            // A clip that nobody can repeat may end before the body is back; then it must be on its way.
            let ends = outcome.looked_secs < 6.0;
            let back = outcome.recovered_secs.is_some() || ends && outcome.last_deg < 0.8 * outcome.peak();
            if !outcome.finite || !back {
                lost.push(format!(
                    "{} at {compliance} (used {:.2}): {part} to the {direction} at phase {phase}: {:.1} of {:.1} degrees left after {:.1} s",
                    case.name,
                    settings.compliance,
                    outcome.last_deg,
                    outcome.peak(),
                    outcome.looked_secs
                ));
            }
        }
    }
    Yields { peak_deg: sum / count, lost }
}

#[test]
fn the_compliance_dial_is_monotone_and_stable_over_its_whole_range_on_every_clip() {
    let Some(mocap) = mocap() else { return };
    let failures: Vec<String> = work(&EVERY_CLIP, |name| {
        let case = Case::load(&mocap, name, WINDOW_SECS);
        let yields = DIAL.map(|compliance| yields(&case, compliance));
        let peaks = yields.each_ref().map(|yields| yields.peak_deg);
        eprintln!("{name}: {}", peaks.map(|peak| format!("{peak:.2}")).join(" "));
        let mut failures: Vec<String> = yields.into_iter().flat_map(|yields| yields.lost).collect();
        if peaks.windows(2).any(|pair| pair[1] < pair[0]) || peaks[4] < 1.2 * peaks[0] {
            failures.push(format!("{name}: mean peaks {peaks:.2?} degrees over {DIAL:?}"));
        }
        failures
    })
    .into_iter()
    .flatten()
    .collect();
    none_of(EVERY_CLIP.len() * DIAL.len() * 24, &failures);
}
