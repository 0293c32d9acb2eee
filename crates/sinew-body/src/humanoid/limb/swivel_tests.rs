#![allow(clippy::disallowed_methods, reason = "tests may use the platform's mathematics")]

use super::super::limb_random::Random;
use super::*;
use crate::humanoid::{Limit, Node, exp};
use glam::DVec3;

/// Steps of a search all round: a twentieth of a degree.
const FINE: i32 = 3600;

fn fine() -> impl Iterator<Item = f64> {
    (-FINE..FINE).map(|index| f64::from(index) * PI / f64::from(FINE))
}

/// Shoulders are round, hips are not, and the last of these is as crooked as a limit gets that captured motion has widened.
fn limits() -> [Limit; 4] {
    let mut widened = Limit::of(Node::LeftUpperLeg);
    widened.swing.x_negative = 2.6;
    widened.swing.z_positive = 0.3;
    widened.twist = (-3.5, 0.4);
    [Limit::of(Node::LeftUpperArm), Limit::of(Node::RightUpperLeg), Limit::of(Node::LeftHand), widened]
}

#[test]
fn the_nearest_swivel_inside_is_the_one_that_a_fine_search_finds() {
    let mut random = Random(5);
    for (index, limit) in limits().iter().enumerate() {
        let mut found = 0;
        for _ in 0..1500 {
            let (turn, axis) = (random.rotation(), random.rotation() * DVec3::X);
            let excess = |angle: f64| limit.excess((exp(axis * angle) * turn).normalize());
            let sweep = Sweep::new(limit.centre.conjugate(), axis, turn, &limit.swing, limit.twist);
            let searched = fine().filter(|&angle| excess(angle) <= 0.0).min_by(|a, b| a.abs().total_cmp(&b.abs()));
            match (nearest(&[sweep]), searched) {
                (Some(angle), Some(searched)) => {
                    assert_eq!(excess(angle), 0.0, "{index}");
                    // No farther than the search's, and nearer by a step at the most, unless it is a range so narrow that
                    // the search stepped over it.
                    assert!(angle.abs() <= searched.abs() + 1e-6, "{index}: {angle} against {searched}");
                    let step = PI / f64::from(FINE);
                    let passed_over = excess(angle + step) > 0.0 && excess(angle - step) > 0.0;
                    assert!(searched.abs() - angle.abs() <= step || passed_over, "{index}: {angle} against {searched}");
                    found += 1;
                }
                (Some(angle), None) => assert_eq!(excess(angle), 0.0, "{index}"),
                (None, Some(searched)) => panic!("{index}: there is {searched}"),
                (None, None) => {}
            }
        }
        assert!(found > 150, "{index}: {found}");
    }
}

#[test]
fn where_no_swivel_is_inside_the_one_taken_is_about_the_least_outside() {
    let mut random = Random(6);
    for (index, limit) in limits().iter().enumerate().take(3) {
        let (mut cases, mut worse) = (0, 0);
        for _ in 0..1000 {
            let (turn, axis) = (random.rotation(), random.rotation() * DVec3::X);
            let cost = |angle: f64| limit.excess((exp(axis * angle) * turn).normalize()) + PRICE * angle.abs();
            let sweep = Sweep::new(limit.centre.conjugate(), axis, turn, &limit.swing, limit.twist);
            if nearest(&[sweep]).is_some() {
                continue;
            }
            let lowest = fine().map(cost).fold(f64::INFINITY, f64::min);
            let here = cost(least(&[(sweep, 1.0)]));
            cases += 1;
            // Valleys narrower than a sixteenth of a turn are missed now and then.
            worse += usize::from(here > lowest + 0.01);
            assert!(here < lowest + 0.5, "{index}: {here} against {lowest}");
        }
        assert!(worse * 12 <= cases, "{index}: {worse} of {cases}");
    }
}
