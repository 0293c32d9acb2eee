//! Time of one limb's inverse kinematics, by what it asks for.
//!
//! `direct`: the limb is near enough that its swivel stays. `searched`: the swivel has to leave where it was, because a
//! joint would pass its limit. `outside`: within the distance that the limb can reach, but no swivel keeps the limits.
//! `turned`: the turn of the hand or foot is given too, and most swivels have to be looked for. A shoulder's range is round,
//! which needs no search at all, a hip's is not.
//!
//! With ozz-animation's two-bone job (single precision, the swivel given, no limits; timed on the same machine when idle) as 1: `direct` 1.9, `searched`
//! 3.2 (arm) and 4.5 (leg), `turned` 8.5 and 6.7, `outside` 15.

#[path = "../src/humanoid/limb/limb_random.rs"]
mod limb_random;

use std::hint::black_box;

use criterion::{Criterion, criterion_group, criterion_main};
use glam::{DQuat, DVec3};
use limb_random::Random;
use sinew_body::humanoid::{Body, Limb, LimbGoal, exp, solve_limb, solve_limb_turned};

const CASES: usize = 64;

#[derive(Clone, Copy, PartialEq)]
enum Kind {
    Direct,
    Searched,
    Outside,
}

/// A goal of any kind, and which kind it turned out to be.
fn any_goal(body: &Body, limb: Limb, random: &mut Random) -> (LimbGoal, Kind) {
    let [upper, lower, end] = limb.nodes();
    let sign = if limb.is_leg() { 1.0 } else { -1.0 };
    let flexed = |random: &mut Random| exp(DVec3::X * sign * random.between(0.4, 2.3));
    let world_from_parent = random.rotation();
    let joint = DVec3::new(0.2, 1.4, 0.0);
    let effector = body.link(end).centre;
    let near = [random.within(&body.link(upper).limit, true), flexed(random)];
    let direction = random.rotation() * DVec3::X;
    let in_lower = body.link(end).offset + effector;
    let there = body.link(lower).offset + flexed(random) * in_lower;
    let goal = LimbGoal {
        joint,
        world_from_parent,
        end: DQuat::IDENTITY,
        effector,
        target: joint + direction * there.length(),
        near,
    };
    let turns = solve_limb(body, limb, &goal).expect("a sound goal");
    let from = (near[0] * (body.link(lower).offset + turns.lower * in_lower)).normalize();
    let straight = DQuat::from_rotation_arc(from, world_from_parent.conjugate() * direction) * near[0];
    let kind = if body.link(upper).limit.excess(straight) <= 0.0 {
        Kind::Direct
    } else if turns.excess_rad <= 1e-6 {
        Kind::Searched
    } else {
        Kind::Outside
    };
    (goal, kind)
}

fn goals(body: &Body, limb: Limb, wanted: Kind) -> Vec<LimbGoal> {
    let mut random = Random(5);
    let mut goals = Vec::new();
    while goals.len() < CASES {
        let (goal, kind) = any_goal(body, limb, &mut random);
        if kind == wanted {
            goals.push(goal);
        }
    }
    goals
}

/// Hands and feet where the limb can have them, the limb anywhere before.
fn turned_goals(body: &Body, limb: Limb) -> Vec<(LimbGoal, DQuat)> {
    let mut random = Random(6);
    let [upper, lower, end] = limb.nodes();
    let sign = if limb.is_leg() { 1.0 } else { -1.0 };
    (0..CASES)
        .map(|_| {
            let (goal, _) = any_goal(body, limb, &mut random);
            let turn = random.within(&body.link(upper).limit, true);
            let elbow = turn * exp(DVec3::X * sign * random.between(0.4, 2.3));
            let hand = elbow * random.within(&body.link(end).limit, true);
            let offsets = (body.link(lower).offset, body.link(end).offset);
            let line = turn * offsets.0 + elbow * offsets.1 + hand * goal.effector;
            let target = goal.joint + goal.world_from_parent * line;
            (LimbGoal { target, ..goal }, goal.world_from_parent * hand)
        })
        .collect()
}

fn limbs(criterion: &mut Criterion) {
    let body = Body::standard(80.0, 1.7);
    for (limb, limb_name) in [(Limb::LeftArm, "arm"), (Limb::LeftLeg, "leg")] {
        for (kind, name) in [(Kind::Direct, "direct"), (Kind::Searched, "searched"), (Kind::Outside, "outside")] {
            let goals = goals(&body, limb, kind);
            let mut at = 0;
            criterion.bench_function(&format!("limb/{limb_name}/{name}"), |bencher| {
                bencher.iter(|| {
                    at = (at + 1) % CASES;
                    solve_limb(black_box(&body), limb, black_box(&goals[at]))
                });
            });
        }
        let goals = turned_goals(&body, limb);
        let mut at = 0;
        criterion.bench_function(&format!("limb/{limb_name}/turned"), |bencher| {
            bencher.iter(|| {
                at = (at + 1) % CASES;
                let (goal, turn) = &goals[at];
                solve_limb_turned(black_box(&body), limb, black_box(goal), *turn)
            });
        });
    }
}

criterion_group! {
    name = benches;
    config = Criterion::default().warm_up_time(std::time::Duration::from_millis(500)).measurement_time(std::time::Duration::from_secs(2));
    targets = limbs
}
criterion_main!(benches);
