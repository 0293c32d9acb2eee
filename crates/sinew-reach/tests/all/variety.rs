//! Twenty seeds are twenty people.

use crate::common::{bodies, goal, reacher};
use glam::DVec3;
use sinew_body::humanoid::{Body, Pose};
use sinew_reach::Style;

/// Farthest that a joint is from where it is in another pose \[m\].
fn apart_m(body: &Body, one: &Pose, other: &Pose) -> f64 {
    let (one, other) = (one.positions(body), other.positions(body));
    one.iter().zip(&other).map(|(one, other)| (*one - *other).length()).fold(0.0, f64::max)
}

#[test]
fn of_twenty_seeds_fifteen_differ_from_each_other_in_way_and_time_for_every_target() {
    let body = &bodies()[0];
    for target in [
        DVec3::new(-0.2, 1.1, 0.7),
        DVec3::new(0.4, 0.4, 0.7),
        DVec3::new(0.7, 0.6, 0.8),
        DVec3::new(0.3, 1.4, 0.5),
        DVec3::new(0.1, 2.1, 0.4),
        DVec3::new(0.0, 0.05, 0.5),
        DVec3::new(0.0, 1.1, -0.7),
        DVec3::new(1.5, 1.0, 2.5),
        DVec3::new(-0.2, 1.3, 0.45),
    ] {
        let ways: Vec<(f64, Vec<Pose>)> = (0..20)
            .map(|seed| {
                let mut reacher = reacher(body, &Style { seed, ..Style::default() });
                let arrives = reacher.reach(&goal(target)).arrives_secs;
                let end = reacher.done_secs();
                (arrives, (0..=10).map(|at| reacher.pose_at(end * f64::from(at) / 10.0)).collect())
            })
            .collect();
        let mut kept: Vec<&(f64, Vec<Pose>)> = Vec::new();
        for way in &ways {
            let differs = |other: &(f64, Vec<Pose>)| {
                // At equal shares of their times, so that a slower one is no other way.
                let apart =
                    way.1.iter().zip(&other.1).map(|(one, other)| apart_m(body, one, other)).fold(0.0, f64::max);
                let (long, short) = (way.0.max(other.0), way.0.min(other.0));
                apart > 0.02 && long > 1.05 * short
            };
            if kept.iter().all(|other| differs(other)) {
                kept.push(way);
            }
        }
        assert!(kept.len() >= 15, "{target}: {} of 20", kept.len());
    }
}
