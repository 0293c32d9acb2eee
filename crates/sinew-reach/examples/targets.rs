//! Ten thousand random targets for two bodies, counted: `cargo run --release -p sinew-reach --example targets -- [N]`. It ends with
//! an error when a claim fails. The test `targets.rs` makes the same checks on a few hundred.
#![allow(missing_docs, reason = "an example")]

#[path = "../tests/common/mod.rs"]
mod common;

use common::{any_target, bodies, measure};
use sinew_reach::{Dice, Style};
use std::collections::BTreeMap;

fn main() {
    let count: u64 = std::env::args().nth(1).map_or(10_000, |text| text.parse().expect("give a number of targets"));
    let mut failures = 0;
    for body in bodies() {
        let mut reasons: BTreeMap<String, u64> = BTreeMap::new();
        let (mut error, mut gap, mut excess, mut slip, mut margin): (f64, f64, f64, f64, f64) =
            (0.0, 0.0, 0.0, 0.0, f64::INFINITY);
        for seed in 0..count {
            let target = any_target(&mut Dice::new(seed), body.stature_m());
            let one = measure(&body, &Style { seed, ..Style::default() }, target, 60.0);
            let reason = one.outcome.reason.map_or("reached".to_owned(), |reason| format!("{reason:?}"));
            *reasons.entry(reason).or_default() += 1;
            match one.outcome.reason {
                None => error = error.max(one.error_m),
                Some(_) => gap = gap.max((one.error_m - one.outcome.gap_m).abs()),
            }
            excess = excess.max(one.excess_rad);
            slip = slip.max(one.slip_m);
            margin = margin.min(one.margin_m);
            let is_sound = one.finite
                && one.excess_rad < 0.0175
                && one.slip_m < 1e-3
                && one.margin_m > 0.0
                && (one.outcome.reason.is_some() || one.error_m < 1e-3)
                && (one.outcome.reason.is_none() || (one.error_m - one.outcome.gap_m).abs() < 1e-3);
            if !is_sound {
                failures += 1;
                if failures <= 20 {
                    println!(
                        "  seed {seed}: {target:.3}: error {:.5}, gap {:.5} {:?}, excess {:.4} {:?}, slip {:.5}, margin {:.4}, steps {:?}",
                        one.error_m,
                        one.outcome.gap_m,
                        one.outcome.reason,
                        one.excess_rad,
                        one.excess_of,
                        one.slip_m,
                        one.margin_m,
                        one.outcome.steps.len()
                    );
                }
            }
        }
        println!(
            "{:.1} m: {reasons:?}; worst error {:.4} mm, worst end of the unreachable against the plan {:.4} mm, limits exceeded by {:.3}°, \
             planted feet move {:.4} mm, least margin {:.1} mm",
            body.stature_m(),
            error * 1e3,
            gap * 1e3,
            excess.to_degrees(),
            slip * 1e3,
            margin * 1e3
        );
    }
    println!("{failures} failures of {}", 2 * count);
    if failures > 0 {
        std::process::exit(1);
    }
}
