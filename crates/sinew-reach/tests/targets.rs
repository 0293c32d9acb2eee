//! Random targets in, near and beyond reach, for two bodies. The long program `examples/targets.rs` runs ten thousand; here are a
//! few hundred of them.

mod common;

use common::{any_target, bodies, goal, jumps, measure, reacher};
use glam::DVec3;
use sinew_reach::{Dice, Reason, Style};

/// Targets of each body.
const TARGETS: u64 = 150;

#[test]
fn whatever_is_reachable_is_reached_within_limits_on_still_feet_and_in_balance() {
    let mut reached = 0;
    for body in bodies() {
        for seed in 0..TARGETS {
            let target = any_target(&mut Dice::new(seed), body.stature_m());
            let style = Style { seed, ..Style::default() };
            let one = measure(&body, &style, target, 60.0);
            let place = format!("{:.1} m, seed {seed}, {target}: {:?}", body.stature_m(), one);
            assert!(one.finite, "{place}");
            match one.outcome.reason {
                None => {
                    reached += 1;
                    assert!(one.error_m < 1e-3, "{place}");
                }
                // The plan knows where the hand ends: within a millimetre.
                Some(_) => assert!((one.error_m - one.outcome.gap_m).abs() < 1e-3, "{place}"),
            }
            // A degree, which a foot that stays flat behind a long step may take; a table of ranges means no less.
            assert!(one.excess_rad < 0.0175, "{place}");
            assert!(one.slip_m < 1e-3, "{place}");
            assert!(one.margin_m > 0.0, "{place}");
        }
    }
    // Nine in ten of these targets lie where people reach.
    assert!(reached > 2 * TARGETS * 8 / 10, "{reached} of {}", 2 * TARGETS);
}

#[test]
fn hands_and_joints_move_without_a_jump_in_velocity_or_acceleration() {
    // Sampled four times as finely, a continuous acceleration changes by a quarter from sample to sample; one that jumps
    // changes by the same, one after a jump in velocity by four times as much.
    let body = &bodies()[0];
    for seed in 0..25 {
        let target = any_target(&mut Dice::new(seed), body.stature_m());
        let goal = goal(target);
        let mut reacher = reacher(body, &Style { seed, ..Style::default() });
        reacher.reach(&goal);
        let end = reacher.done_secs() + 0.1;
        let coarse = jumps(body, &reacher, goal.right.is_some(), -0.05, end, 480.0);
        let fine = jumps(body, &reacher, goal.right.is_some(), -0.05, end, 1920.0);
        for (what, fine, coarse) in [
            ("the hand's velocity", fine.hand[0], coarse.hand[0]),
            ("the hand's acceleration", fine.hand[1], coarse.hand[1]),
            ("a joint's velocity", fine.joint[0], coarse.joint[0]),
            ("a joint's acceleration", fine.joint[1], coarse.joint[1]),
        ] {
            assert!(fine < 0.5 * coarse + 1e-3, "seed {seed}, {target}: {what}: {fine} after {coarse}");
        }
    }
}

#[test]
fn what_is_too_high_ends_at_the_nearest_point_with_the_reason() {
    for body in bodies() {
        let target = DVec3::new(-0.15, 1.6 * body.stature_m(), 0.3);
        let one = measure(&body, &Style::default(), target, 60.0);
        assert_eq!(one.outcome.reason, Some(Reason::TooHigh));
        // A stretched arm, a lifted shoulder: 1.15 statures is what a standing body reaches with the middle of its hand.
        let reach = target.y - one.error_m;
        assert!((1.05..1.25).contains(&(reach / body.stature_m())), "{}", reach / body.stature_m());
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
