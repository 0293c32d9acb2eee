//! Goals that change, move, and are in the way of.

use crate::common::{bodies, goal, hand, reacher};
use glam::{DQuat, DVec3};
use sinew_body::humanoid::{Body, Node, Pose, log};
use sinew_reach::{Goal, Obstacle, Reason, Style};

/// Largest change of a joint's angular velocity from frame to frame \[rad/s\].
fn roughest(poses: &[Pose], hz: f64) -> f64 {
    let mut most: f64 = 0.0;
    for node in Node::ALL {
        let speeds: Vec<DVec3> =
            poses.windows(2).map(|pair| log(pair[0].local(node).conjugate() * pair[1].local(node)) * hz).collect();
        most = speeds.windows(2).map(|pair| (pair[1] - pair[0]).length()).fold(most, f64::max);
    }
    most
}

#[test]
fn a_new_goal_in_the_middle_of_a_reach_is_taken_up_without_a_jump() {
    let body = &bodies()[0];
    let mut reacher = reacher(body, &Style::default());
    let hz = 240.0;
    reacher.reach(&goal(DVec3::new(-0.2, 0.5, 0.5)));
    let mut poses = Vec::new();
    let other = DVec3::new(-0.4, 1.6, 0.3);
    for frame in 0..960 {
        let secs = f64::from(frame) / hz;
        reacher.advance(secs);
        if frame == 120 {
            reacher.reach(&goal(other));
        }
        poses.push(reacher.pose_at(secs));
    }
    assert!((hand(body, &poses[959], true) - other).length() < 1e-3);
    // A jump in place of a hundredth of a radian would be 2.4 rad/s here, one in velocity of half a radian a second 0.5. All the way:
    // the hand does not pass its own shoulder so near that the arm is thrown around.
    let most = roughest(&poses, hz);
    assert!(most < 0.5, "{most}");
}

#[test]
fn a_hand_stays_on_a_target_that_moves() {
    let body = &bodies()[0];
    let mut reacher = reacher(body, &Style::default());
    let at = |secs: f64| DVec3::new(-0.25 + 0.15 * secs, 1.2 + 0.1 * secs, 0.5);
    reacher.reach(&Goal { right: Some(at(0.0)), ..Goal::default() });
    let mut worst: f64 = 0.0;
    for frame in 0..180 {
        let secs = f64::from(frame) / 60.0;
        reacher.advance(secs);
        reacher.follow(&Goal { right: Some(at(secs)), ..Goal::default() });
        if secs > 1.6 {
            worst = worst.max((hand(body, &reacher.pose_at(secs), true) - at(secs)).length());
        }
    }
    // The body is planned anew ten times a second; on the way the arm makes up for it.
    assert!(worst < 2e-3, "{worst}");
}

/// How near an arm's bones come to an obstacle on the way \[m\].
fn nearest(body: &Body, poses: &[Pose], obstacle: &Obstacle) -> f64 {
    let mut least = f64::INFINITY;
    for pose in poses {
        let at = pose.positions(body);
        let tip = at[Node::RightHand.index()] + pose.world[Node::RightHand.index()] * body.link(Node::RightHand).tip;
        let bones =
            [(at[Node::RightLowerArm.index()], at[Node::RightHand.index()]), (at[Node::RightHand.index()], tip)];
        for (from, to) in bones {
            for index in 0..=10 {
                least = least.min(obstacle.distance(from.lerp(to, f64::from(index) / 10.0)));
            }
        }
    }
    least
}

#[test]
fn an_arm_goes_around_what_is_in_its_way() {
    let body = &bodies()[0];
    let target = DVec3::new(-0.2, 1.3, 0.45);
    // A rod across, in the middle of the straight way.
    let rod = Obstacle::Capsule { from: DVec3::new(-0.6, 1.02, 0.3), to: DVec3::new(0.3, 1.02, 0.3), radius_m: 0.03 };
    let poses = |obstacles: &[Obstacle]| {
        let mut reacher = reacher(body, &Style::default());
        reacher.set_obstacles(obstacles);
        let reason = reacher.reach(&goal(target)).reason;
        let end = reacher.done_secs();
        let poses: Vec<Pose> = (0..=60).map(|frame| reacher.pose_at(end * f64::from(frame) / 60.0)).collect();
        (reason, poses)
    };
    let (_, straight) = poses(&[]);
    let (reason, around) = poses(&[rod]);
    assert!(nearest(body, &straight, &rod) < 0.02, "the straight way would touch: {}", nearest(body, &straight, &rod));
    assert_eq!(reason, None);
    // The forearm's own radius is 30 to 42 mm.
    assert!(nearest(body, &around, &rod) > 0.03, "{}", nearest(body, &around, &rod));
    assert!((hand(body, &around[60], true) - target).length() < 1e-3);
}

#[test]
fn a_target_behind_a_wall_is_called_blocked_and_the_hand_stops_short() {
    let body = &bodies()[0];
    let target = DVec3::new(-0.2, 1.2, 0.5);
    let wall =
        Obstacle::Box { centre: DVec3::new(0.0, 1.2, 0.3), turn: DQuat::IDENTITY, half_m: DVec3::new(2.0, 2.0, 0.02) };
    let mut reacher = reacher(body, &Style { seed: 2, ..Style::default() });
    reacher.set_obstacles(&[wall]);
    let outcome = reacher.reach(&goal(target)).clone();
    assert_eq!(outcome.reason, Some(Reason::Blocked));
    let end = reacher.pose_at(reacher.done_secs());
    assert!(hand(body, &end, true).z < 0.3, "{}", hand(body, &end, true));
    assert!(outcome.gap_m > 0.1);
}
