//! A pushed walk yields and comes back: six parts, four directions, eight phases of the cycle, on every walk.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use crate::pushing::{Case, Kind, PARTS, Run, every_adult, every_child, mean, sweep};
use sinew_response::Settings;
use sinew_testkit::none_of;
use std::sync::OnceLock;

/// How far an ankle of a standing foot may leave the input's \[m\].
const STANCE_M: f64 = 1e-3;

/// The search for where a joint meets its limit ends within 1e-5 of the way \[rad\].
const ON_THE_LIMIT: f64 = 1e-4;

/// 100 N for 0.1 s, all of it.
fn light() -> Option<&'static [Run]> {
    static RUNS: OnceLock<Option<Vec<Run>>> = OnceLock::new();
    let kind = Kind { newtons: 100.0, frames: 6, window_secs: 10.0, all: true };
    RUNS.get_or_init(|| Some(sweep(every_adult()?, Settings::default(), kind))).as_deref()
}

fn comes_back(cases: &[Case], runs: &[Run], within_secs: f64) {
    let failures: Vec<String> = runs
        .iter()
        .filter(|run| !run.outcome.finite || !run.outcome.back_within(within_secs))
        .map(|run| format!("{}: finite {}, {:?}", run.name(cases), run.outcome.finite, run.outcome.recovered_secs))
        .collect();
    none_of(runs.len(), &failures);
}

fn stands_where_the_input_stands(cases: &[Case], runs: &[Run]) {
    let failures: Vec<String> = runs
        .iter()
        .filter(|run| run.outcome.stance_m > STANCE_M)
        .map(|run| format!("{}: {:.2} mm", run.name(cases), run.outcome.stance_m * 1e3))
        .collect();
    none_of(runs.len(), &failures);
}

fn stays_within_limits(cases: &[Case], runs: &[Run]) {
    let failures: Vec<String> = runs
        .iter()
        .filter(|run| run.outcome.excess.0 > ON_THE_LIMIT)
        .map(|run| {
            let (excess, node) = run.outcome.excess;
            format!("{}: {node:?} by {:.2} degrees", run.name(cases), excess.to_degrees())
        })
        .collect();
    none_of(runs.len(), &failures);
}

#[test]
fn every_walk_is_back_within_6_seconds_of_100_newtons_for_a_tenth_of_a_second() {
    let (Some(cases), Some(runs)) = (every_adult(), light()) else { return };
    assert_eq!(runs.len(), cases.len() * 6 * 4 * 8);
    comes_back(cases, runs, 6.0);
}

#[test]
fn stance_ankles_stay_within_a_millimetre_under_100_newtons() {
    let (Some(cases), Some(runs)) = (every_adult(), light()) else { return };
    stands_where_the_input_stands(cases, runs);
}

#[test]
fn no_joint_goes_beyond_its_limit_under_100_newtons() {
    let (Some(cases), Some(runs)) = (every_adult(), light()) else { return };
    stays_within_limits(cases, runs);
}

#[test]
fn a_push_on_the_hand_yields_more_than_one_and_a_half_times_a_push_on_the_shoulder() {
    let (Some(cases), Some(runs)) = (every_adult(), light()) else { return };
    let peak = |case: Option<usize>, part: &str| {
        let of = |run: &&Run| case.is_none_or(|case| case == run.case) && PARTS[run.part].0 == part;
        mean(runs.iter().filter(of), |outcome| outcome.peak())
    };
    for (index, case) in cases.iter().enumerate() {
        let (hand, shoulder) = (peak(Some(index), "hand"), peak(Some(index), "shoulder"));
        eprintln!("{}: hand {hand:.1}, shoulder {shoulder:.1} degrees", case.name);
        assert!(hand > 1.5 * shoulder, "{}: hand {hand:.1}, shoulder {shoulder:.1} degrees", case.name);
    }
    assert!(peak(None, "hand") > 1.5 * peak(None, "shoulder"));
}

#[test]
fn every_walk_is_back_within_8_seconds_of_200_newtons() {
    let Some(cases) = every_adult() else { return };
    let runs = sweep(cases, Settings::default(), Kind { newtons: 200.0, frames: 6, window_secs: 12.0, all: false });
    comes_back(cases, &runs, 8.0);
    stands_where_the_input_stands(cases, &runs);
    stays_within_limits(cases, &runs);
}

#[test]
fn a_blow_of_3000_newtons_stays_finite_and_within_limits_and_is_over_within_10_seconds() {
    let Some(cases) = every_adult() else { return };
    let runs = sweep(cases, Settings::default(), Kind { newtons: 3000.0, frames: 6, window_secs: 13.0, all: false });
    comes_back(cases, &runs, 10.0);
    stays_within_limits(cases, &runs);
}

#[test]
fn a_steady_push_of_200_newtons_for_3_seconds_stays_finite_and_within_limits_and_is_over_within_10_seconds() {
    let Some(cases) = every_adult() else { return };
    let runs = sweep(cases, Settings::default(), Kind { newtons: 200.0, frames: 180, window_secs: 13.0, all: false });
    comes_back(cases, &runs, 10.0);
    stays_within_limits(cases, &runs);
}

#[test]
fn a_child_of_half_the_weight_is_back_within_6_seconds_of_half_the_push() {
    let Some(cases) = every_child() else { return };
    let runs = sweep(cases, Settings::default(), Kind { newtons: 100.0, frames: 6, window_secs: 10.0, all: false });
    comes_back(cases, &runs, 6.0);
    stands_where_the_input_stands(cases, &runs);
    stays_within_limits(cases, &runs);
}

#[test]
fn a_child_of_half_the_weight_is_back_within_8_seconds_of_half_of_200_newtons() {
    let Some(cases) = every_child() else { return };
    let runs = sweep(cases, Settings::default(), Kind { newtons: 200.0, frames: 6, window_secs: 12.0, all: false });
    comes_back(cases, &runs, 8.0);
    stands_where_the_input_stands(cases, &runs);
    stays_within_limits(cases, &runs);
}

#[test]
fn a_child_of_half_the_weight_bears_half_of_a_blow_and_half_of_a_steady_push() {
    let Some(cases) = every_child() else { return };
    for (newtons, frames) in [(3000.0, 6), (200.0, 180)] {
        let runs = sweep(cases, Settings::default(), Kind { newtons, frames, window_secs: 13.0, all: false });
        comes_back(cases, &runs, 10.0);
        stays_within_limits(cases, &runs);
    }
}
