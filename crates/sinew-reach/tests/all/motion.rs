//! How reaches look: no jump at the start, calm hips, head and knees, walks that do not stop between their steps.

use crate::common::motion::{apart_deg, frames, knees, roughness, slowest_share};
use crate::common::{any_target, bodies, goal, reacher};
use glam::DVec3;
use sinew_body::humanoid::Body;
use sinew_reach::{Goal, Reacher, Rng, Style};

/// A reach to look at.
struct Case {
    body: Body,
    goal: Goal,
    style: Style,
}

impl Case {
    fn reaches(&self) -> Reacher {
        let mut reacher = reacher(&self.body, &self.style);
        reacher.reach(&self.goal);
        reacher
    }
}

fn right(x: f64, y: f64, z: f64) -> Goal {
    Goal { right: Some(DVec3::new(x, y, z)), ..Goal::default() }
}

/// Near and far, high and low, in front and behind, with both hands, in a hurry, with stiff legs; and forty at random.
fn cases() -> Vec<Case> {
    let [tall, short] = bodies();
    let plain = Style::default();
    let of = |x: f64, y: f64, z: f64| goal(DVec3::new(x, y, z));
    let both = Goal { left: Some(DVec3::new(0.2, 0.3, 0.5)), right: Some(DVec3::new(-0.2, 0.3, 0.5)) };
    let mut all: Vec<Case> = [
        (of(0.4, 1.9, 0.5), Style { seed: 7, ..plain }),
        (of(0.1, 2.1, 0.4), plain),
        (of(0.0, 0.05, 0.5), plain),
        (of(0.6, 0.02, 0.1), plain),
        (of(0.0, 1.1, -0.7), plain),
        (of(-0.3, 0.3, -0.8), plain),
        (right(0.5, 1.1, 0.3), plain),
        (of(1.5, 1.0, 2.5), plain),
        (right(0.0, 1.0, 0.12), plain),
        (both, plain),
        (of(0.0, 2.4, 0.0), plain),
        (of(-0.3, 1.2, 0.6), plain),
        (of(0.3, 1.4, 0.5), Style { time_secs: Some(0.35), ..plain }),
        (of(0.1, 0.1, -0.2), plain),
        (of(0.0, 0.5, 1.2), Style { flexibility: 0.3, ..plain }),
        (of(-0.3, 1.3, 0.9), plain),
    ]
    .map(|(goal, style)| Case { body: tall.clone(), goal, style })
    .into();
    for seed in 0..40 {
        let body = if seed % 2 == 0 { &tall } else { &short };
        let target = any_target(&mut Rng::new(1000 + seed), body.stature_m());
        all.push(Case { body: body.clone(), goal: goal(target), style: Style { seed, ..plain } });
    }
    all
}

#[test]
fn a_reach_begins_in_the_pose_before_it() {
    for case in cases() {
        let still = reacher(&case.body, &case.style).pose_at(0.0);
        let poses = frames(&case.reaches(), 0.0);
        let standing = sinew_reach::standing(&case.body, DVec3::ZERO, 0.0);
        // Half a degree in a frame is 30 degrees a second: nobody sees that begin. Knees straight as pillars give way first.
        assert!(apart_deg(&standing, &still) < 0.01 && knees(&still)[0] < 0.01, "{:?}", case.goal);
        assert!(apart_deg(&standing, &poses[0]) < 0.01, "{:?}", case.goal);
        assert!(apart_deg(&poses[0], &poses[1]) < 0.5, "{:?}: {}", case.goal, apart_deg(&poses[0], &poses[1]));
        assert!((poses[0].hips_position - standing.hips_position).length() < 1e-4, "{:?}", case.goal);
    }
}

#[test]
fn hips_head_and_knees_are_calm_on_every_way() {
    for case in cases() {
        let worst = roughness(&frames(&case.reaches(), 0.0));
        let what = format!("{:?}, seed {}: {worst:?}", case.goal, case.style.seed);
        // What people do: a big gaze shift peaks at some 400 degrees a second; walking hips brake by some 3 m/s², twice that is a jolt.
        assert!(worst.hips_m_s2 <= 6.0, "{what}");
        assert!(worst.head_deg_s <= 400.0, "{what}");
        assert!(worst.knee_deg <= 5.0, "{what}");
        // Eyes and chest do the rest of a gaze shift.
        assert!(worst.neck_deg < 45.0, "{what}");
    }
}

#[test]
fn who_walks_to_a_target_does_not_stop_between_the_steps() {
    let mut walks = 0;
    for case in cases() {
        let reacher = case.reaches();
        let strides = reacher.feet().strides();
        let way = reacher.pose_at(reacher.done_secs()).hips_position - reacher.pose_at(0.0).hips_position;
        // With two strides there is nothing between them; who turns round on the spot goes nowhere.
        if strides.len() < 3 || way.with_y(0.0).length() < 0.5 {
            continue;
        }
        walks += 1;
        let poses = frames(&reacher, 0.0);
        let slowest = slowest_share(&poses, strides[0].lands_secs(), strides[strides.len() - 1].start_secs);
        assert!(slowest > 0.6, "{:?}: {slowest}", case.goal);
    }
    assert!(walks > 15, "{walks}");
}

#[test]
fn a_target_almost_three_metres_away_is_reached_in_three_and_a_half_seconds() {
    let case = Case { body: bodies()[0].clone(), goal: goal(DVec3::new(1.5, 1.0, 2.5)), style: Style::default() };
    let reacher = case.reaches();
    // At a walk of 1 m/s, with setting out and stopping.
    assert!(reacher.outcome().is_reached() && reacher.outcome().arrives_secs <= 3.5, "{:?}", reacher.outcome());
}

#[test]
fn half_a_turn_takes_three_steps_at_most() {
    for target in [DVec3::new(0.0, 1.1, -0.7), DVec3::new(0.1, 0.1, -0.2), DVec3::new(-0.1, 1.2, -0.6)] {
        for seed in 0..10 {
            let style = Style { seed, ..Style::default() };
            let reacher = Case { body: bodies()[0].clone(), goal: goal(target), style }.reaches();
            let strides = reacher.feet().strides();
            assert!(reacher.outcome().is_reached() && strides.len() <= 3, "{target}, seed {seed}: {}", strides.len());
        }
    }
}

#[test]
fn a_time_that_no_body_can_is_answered_with_the_least_one() {
    let body = &bodies()[0];
    let target = goal(DVec3::new(1.5, 1.0, 2.5));
    let reaches = |time: f64| {
        Case { body: body.clone(), goal: target, style: Style { time_secs: Some(time), ..Style::default() } }.reaches()
    };
    let hurried = reaches(0.5);
    assert!(hurried.outcome().is_late && hurried.outcome().is_reached());
    let worst = roughness(&frames(&hurried, 0.0));
    // Walking people change to a run at a Froude number of a half: 2.04 m/s for these legs.
    assert!(worst.hips_m_s < 2.04, "{worst:?}");
    let least = hurried.outcome().arrives_secs;
    assert!((1.5..3.0).contains(&least), "{least}");
    // What can be had is had, to the microsecond.
    let calm = reaches(4.0);
    assert!(!calm.outcome().is_late && (calm.outcome().arrives_secs - 4.0).abs() < 1e-6);
}
