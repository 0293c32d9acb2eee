//! Random targets in, near and beyond reach, for two bodies. The long program `examples/targets.rs` runs ten thousand for each; here
//! is every sixtieth.

use crate::common::{any_target, bodies, goal, jump, measure, reacher};
use glam::DVec3;
use sinew_reach::{Reason, Rng, Style};

/// Of the ten thousand targets every so many-th is tried here.
const EVERY: usize = 60;

#[test]
fn whatever_is_reachable_is_reached_within_limits_on_still_feet_and_in_balance() {
    let (mut reached, mut count) = (0, 0);
    for body in bodies() {
        for seed in (0..10_000).step_by(EVERY) {
            let target = any_target(&mut Rng::new(seed), body.stature_m());
            let one = measure(&body, &Style { seed, ..Style::default() }, target, 60.0);
            assert_eq!(one.fault(), None, "{:.1} m, seed {seed}, {target}: {one:?}", body.stature_m());
            count += 1;
            reached += usize::from(one.outcome.reason.is_none());
        }
    }
    // Of all of them 87 of 100 are.
    assert!(reached > count * 80 / 100, "{reached} of {count}");
}

#[test]
fn hands_and_joints_move_without_a_jump_in_velocity_or_acceleration() {
    let body = &bodies()[0];
    for seed in (0..10_000).step_by(400) {
        let target = any_target(&mut Rng::new(seed), body.stature_m());
        let goal = goal(target);
        let mut reacher = reacher(body, &Style { seed, ..Style::default() });
        reacher.reach(&goal);
        assert_eq!(jump(body, &reacher, goal.right.is_some(), 480.0), None, "seed {seed}, {target}");
    }
}

#[test]
fn what_is_too_high_ends_at_the_nearest_point_with_the_reason() {
    for body in bodies() {
        let target = DVec3::new(-0.15, 1.6 * body.stature_m(), 0.3);
        let one = measure(&body, &Style::default(), target, 60.0);
        assert_eq!(one.outcome.reason, Some(Reason::TooHigh));
        // A stretched arm, a lifted shoulder: 1.15 statures is what a standing body reaches with the middle of its hand; on its toes
        // 0.06 more.
        let reach = target.y - one.error_m;
        assert!((1.15..1.3).contains(&(reach / body.stature_m())), "{}", reach / body.stature_m());
    }
}

#[test]
fn what_lies_under_the_floor_is_too_low() {
    let body = &bodies()[0];
    let one = measure(body, &Style::default(), DVec3::new(-0.2, -0.6, 0.4), 60.0);
    assert_eq!(one.outcome.reason, Some(Reason::TooLow));
    assert!((one.error_m - one.outcome.gap_m).abs() < 1e-3);
}

#[test]
fn the_same_seed_gives_the_same_bits_and_another_one_another_way() {
    let body = &bodies()[0];
    let target = DVec3::new(-0.2, 1.1, 0.7);
    let pose = |seed: u64| {
        let mut reacher = reacher(body, &Style { seed, ..Style::default() });
        reacher.reach(&goal(target));
        reacher.pose_at(0.8)
    };
    assert_eq!(pose(3), pose(3));
    let different = (0..20).filter(|seed| pose(*seed) != pose(0)).count();
    assert!(different > 5, "{different}");
}
