#![allow(clippy::disallowed_methods, reason = "tests may use the platform's mathematics")]

use super::hinge::EXACT_REACH;
use super::limb_random::Random;
use super::*;
use crate::humanoid::Pose;
use crate::humanoid::exp;

/// Where a limb's effector is, by the body's own forward kinematics.
fn forward(body: &Body, limb: Limb, base: &Pose, upper: DQuat, lower: DQuat, end: DQuat, effector: DVec3) -> DVec3 {
    let mut locals = Node::ALL.map(|node| base.local(node));
    for (node, turn) in limb.nodes().into_iter().zip([upper, lower, end]) {
        locals[node.index()] = turn;
    }
    let pose = Pose::from_locals(base.hips_position, &locals);
    let node = limb.nodes()[2];
    pose.positions(body)[node.index()] + pose.world[node.index()] * effector
}

fn goal(body: &Body, limb: Limb, base: &Pose, target: DVec3) -> LimbGoal {
    let [upper, _, end] = limb.nodes();
    LimbGoal {
        joint: base.positions(body)[upper.index()],
        world_from_parent: base.world[upper.parent().map_or(0, Node::index)],
        end: DQuat::IDENTITY,
        effector: body.link(end).centre,
        target,
        near: [DQuat::IDENTITY; 2],
    }
}

/// A body somewhere, turned as a whole.
fn base(random: &mut Random) -> Pose {
    let mut locals = [DQuat::IDENTITY; Node::COUNT];
    locals[0] = random.rotation();
    Pose::from_locals(DVec3::new(random.between(-5.0, 5.0), 1.0, random.between(-5.0, 5.0)), &locals)
}

#[test]
fn ten_thousand_targets_that_a_limb_can_have_are_met_within_the_limits() {
    let mut random = Random(7);
    let body = Body::standard(80.0, 1.7);
    let (mut solved, mut stretched) = (0, 0);
    while solved < 10_000 {
        let limb = Limb::ALL[solved % 4];
        let [upper, lower, end] = limb.nodes();
        let base = base(&mut random);
        // Wrists turn; feet point along their own line, as a bent ankle changes the plane in which the knee has to lie.
        let end_turn = if limb.is_leg() { DQuat::IDENTITY } else { random.within(&body.link(end).limit, true) };
        let effector = if limb.is_leg() { DVec3::ZERO } else { body.link(end).centre };
        let (flexion, twist) = if limb.is_leg() {
            (random.between(0.0, 2.6), 0.0)
        } else {
            (random.between(-2.6, 0.0), random.between(-1.7, 1.7))
        };
        let lower_turn = exp(DVec3::X * flexion) * exp(DVec3::Y * twist);
        let upper_turn = random.within(&body.link(upper).limit, true);
        let target = forward(&body, limb, &base, upper_turn, lower_turn, end_turn, effector);
        let near = [DQuat::IDENTITY, exp(DVec3::Y * twist)];
        let goal = LimbGoal { end: end_turn, effector, near, ..goal(&body, limb, &base, target) };
        let turns = solve_limb(&body, limb, &goal).unwrap();
        let in_lower = body.link(end).offset + end_turn * effector;
        let longest = Hinge::new(&body.link(lower).limit, limb, near[1], body.link(lower).offset, in_lower).longest();
        if (target - goal.joint).length() > EXACT_REACH * longest {
            // The smooth end of the reach: at most 1 % of it times 1/e.
            assert!(turns.miss_m < 0.0038 * longest, "{limb:?} {}", turns.miss_m);
            stretched += 1;
            continue;
        }
        let arrived = forward(&body, limb, &base, turns.upper, turns.lower, end_turn, effector);
        assert!((arrived - target).length() < 1e-6, "{limb:?}: {} of {}", (arrived - target).length(), turns.miss_m);
        // Limits are found by sampling; a range narrower than half a degree may be met only by its nearest point.
        assert!(turns.excess_rad < 1e-3, "{limb:?}: {} rad beyond", turns.excess_rad);
        assert!(body.link(lower).limit.excess(turns.lower) < 1e-9);
        solved += 1;
    }
    assert!(stretched < 3_000, "{stretched}");
}

#[test]
fn a_limb_that_follows_a_path_never_flips() {
    let body = Body::standard(80.0, 1.7);
    let base = Pose::STANDING;
    for limb in Limb::ALL {
        let mut goal = goal(&body, limb, &base, DVec3::ZERO);
        let side = if limb.nodes()[0].is_right() { -1.0 } else { 1.0 };
        let middle = goal.joint + DVec3::new(0.05 * side, if limb.is_leg() { -0.5 } else { -0.2 }, 0.3);
        let mut before: Option<LimbTurns> = None;
        for step in 0..4000 {
            let angle = f64::from(step) * 0.005;
            // Rings in front of the body that go in and out, a millimetre or so a step.
            let wide = 0.12 + 0.08 * (0.37 * angle).sin();
            goal.target = middle + DVec3::new(wide * angle.cos(), wide * angle.sin(), 0.1 * (0.21 * angle).sin());
            let turns = solve_limb(&body, limb, &goal).unwrap();
            if let Some(before) = before {
                let turned = |a: DQuat, b: DQuat| crate::humanoid::log(a.conjugate() * b).length();
                // A step of 1.2 mm turns a limb of 0.5 m by about 0.01 rad, some times more where it is much bent.
                assert!(turned(before.upper, turns.upper) < 0.06, "{limb:?} at {step}");
                assert!(turned(before.lower, turns.lower) < 0.06, "{limb:?} at {step}");
            }
            goal.near = [turns.upper, turns.lower];
            before = Some(turns);
        }
    }
}

#[test]
fn a_limb_points_at_what_it_cannot_reach() {
    let mut random = Random(3);
    let body = Body::standard(60.0, 1.6);
    for _ in 0..200 {
        let base = base(&mut random);
        for limb in Limb::ALL {
            let mut goal = goal(&body, limb, &base, DVec3::ZERO);
            let away = (random.rotation() * DVec3::X) * random.between(1.5, 30.0);
            goal.target = goal.joint + away;
            let turns = solve_limb(&body, limb, &goal).unwrap();
            let end = forward(&body, limb, &base, turns.upper, turns.lower, goal.end, goal.effector);
            let along = (end - goal.joint).normalize();
            // Directions are computed, not searched: rounding alone. Those that the upper joint cannot have are neared.
            if turns.excess_rad <= 0.0 {
                assert!((along - away.normalize()).length() < 1e-9);
            }
        }
    }
}

#[test]
fn a_limb_already_there_stays_where_it_is() {
    let body = Body::standard(80.0, 1.7);
    let mut random = Random(11);
    for _ in 0..100 {
        let base = base(&mut random);
        let near =
            [random.within(&body.link(Node::LeftUpperArm).limit, true), exp(DVec3::X * random.between(-2.0, -0.4))];
        let mut goal = goal(&body, Limb::LeftArm, &base, DVec3::ZERO);
        goal.near = near;
        goal.target = forward(&body, Limb::LeftArm, &base, near[0], near[1], goal.end, goal.effector);
        let turns = solve_limb(&body, Limb::LeftArm, &goal).unwrap();
        for (turn, near) in [(turns.upper, near[0]), (turns.lower, near[1])] {
            // acos near a bent elbow loses a few digits, no more.
            assert!(crate::humanoid::log(turn.conjugate() * near).length() < 1e-9);
        }
    }
}

#[test]
fn odd_goals_are_no_harm() {
    let body = Body::standard(80.0, 1.7);
    let base = Pose::STANDING;
    let fine = goal(&body, Limb::RightArm, &base, DVec3::new(0.0, 1.0, 0.2));
    for bad in [f64::NAN, f64::INFINITY] {
        assert_eq!(solve_limb(&body, Limb::RightArm, &LimbGoal { target: DVec3::splat(bad), ..fine }), None);
    }
    let own_joint = solve_limb(&body, Limb::RightArm, &LimbGoal { target: fine.joint, ..fine }).unwrap();
    assert!(own_joint.upper.is_finite() && own_joint.miss_m < 0.2);
    let far = solve_limb(&body, Limb::RightArm, &LimbGoal { target: DVec3::splat(1e300), ..fine });
    assert!(far.is_none_or(|turns| turns.upper.is_finite()));
}
