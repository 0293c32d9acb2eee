//! Ten thousand random targets for two bodies, counted: `cargo run --release -p sinew-reach --example targets -- [N] [HZ]`. It ends
//! with an error when a claim fails. With HZ velocities and accelerations are tried too, at that many and at four times as many
//! instants a second. The test `targets.rs` makes the same checks on a few hundred.
#![allow(missing_docs, reason = "an example")]

#[path = "../tests/all/common/mod.rs"]
mod common;

use common::{any_target, bodies, goal, jump, measure, reacher};
use sinew_reach::{Rng, Style};
use std::collections::BTreeMap;

fn main() {
    let number = |index: usize| std::env::args().nth(index).map(|text| text.parse::<u32>().expect("give a number"));
    let count = u64::from(number(1).unwrap_or(10_000));
    let hz = number(2).map(f64::from);
    let mut failures = 0;
    for body in bodies() {
        let mut reasons: BTreeMap<String, u64> = BTreeMap::new();
        let (mut error, mut gap, mut excess, mut slip, mut heel, mut margin): (f64, f64, f64, f64, f64, f64) =
            (0.0, 0.0, 0.0, 0.0, 0.0, f64::INFINITY);
        for seed in 0..count {
            let target = any_target(&mut Rng::new(seed), body.stature_m());
            let style = Style { seed, ..Style::default() };
            let one = measure(&body, &style, target, 60.0);
            let reason = one.outcome.reason.map_or("reached".to_owned(), |reason| format!("{reason:?}"));
            *reasons.entry(reason).or_default() += 1;
            match one.outcome.reason {
                None => error = error.max(one.error_m),
                Some(_) => gap = gap.max((one.error_m - one.outcome.gap_m).abs()),
            }
            excess = excess.max(one.excess_rad);
            slip = slip.max(one.slip_m);
            heel = heel.max(one.heel_m);
            margin = margin.min(one.margin_m);
            let jumps = hz.and_then(|hz| {
                let goal = goal(target);
                let mut reacher = reacher(&body, &style);
                reacher.reach(&goal);
                // A fast turn may look like a jump to long steps: then shorter ones decide.
                let jumps = |hz: f64| jump(&body, &reacher, goal.right.is_some(), hz);
                jumps(hz).and_then(|_| jumps(4.0 * hz)).and_then(|_| jumps(16.0 * hz))
            });
            let fault = one.fault().map(str::to_owned).or(jumps);
            if let Some(fault) = fault {
                failures += 1;
                if failures <= 20 {
                    println!("  {:.1} m, seed {seed}, {target:.3}: {fault}: {one:?}", body.stature_m());
                }
            }
        }
        println!(
            "{:.1} m: {reasons:?}; worst error {:.4} mm, worst end of the unreachable against the plan {:.4} mm, limits exceeded by \
             {:.3}°, planted feet move {:.4} mm, their heels rise to {:.0} mm, least margin {:.1} mm",
            body.stature_m(),
            error * 1e3,
            gap * 1e3,
            excess.to_degrees(),
            slip * 1e3,
            heel * 1e3,
            margin * 1e3
        );
    }
    println!("{failures} failures of {}", 2 * count);
    if failures > 0 {
        std::process::exit(1);
    }
}
