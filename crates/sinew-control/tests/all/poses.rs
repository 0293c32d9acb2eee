//! Key poses: what files state, what they come to, and how the wanted pose moves between them.

#![allow(clippy::unwrap_used, reason = "a test that fails may panic")]

use glam::{DQuat, DVec3};
use sinew_body::humanoid::{Body, Limb, LimbGoal, Node, Pose, log, solve_limb};
use sinew_control::Wanted;
use sinew_control::ik::Reach;
use sinew_control::pose::{KeyPose, PoseError, PosePlayer, angles_deg, read_poses, resolve_poses, rotation_of};
use sinew_world::{BodyState, CharacterFrame, CharacterId, Frame};
use std::collections::BTreeMap;

fn body() -> Body {
    Body::standard(80.0, 1.7)
}

fn resolved(text: &str) -> Result<BTreeMap<String, KeyPose>, PoseError> {
    resolve_poses(&read_poses(text, "test.toml").unwrap().poses, &body())
}

fn apart(a: DQuat, b: DQuat) -> f64 {
    log(a.conjugate() * b).length()
}

/// A standing character, its left hip a metre from the origin.
fn standing(body: &Body) -> Frame {
    let pose = Pose::from_locals(DVec3::new(1.0, 0.95, 0.0), &[DQuat::IDENTITY; Node::COUNT]);
    let positions = pose.positions(body);
    let parts = Node::ALL.map(|node| BodyState {
        position: positions[node.index()],
        rotation: pose.world[node.index()],
        centre: positions[node.index()] + body.link(node).centre,
        ..BodyState::REST
    });
    let character = CharacterFrame {
        parts,
        centre_of_mass: body.centre_of_mass(&pose),
        centre_velocity: DVec3::ZERO,
        facing: DVec3::Z,
        support: Vec::new(),
        external: CharacterFrame::EMPTY.external,
        was_reset: false,
    };
    Frame::of(vec![character], Vec::new())
}

#[test]
fn a_pose_keeps_what_its_base_says_and_changes_only_what_it_names() {
    let poses = resolved(
        r"
        [poses.low]
        blend_secs = 0.5
        gain = 2.0
        joints.leftLowerLeg = { turn_deg = [40, 0, 0], gain = 0.5 }
        joints.rightLowerLeg = [40, 0, 0]
        [poses.a_lower]
        base = 'low'
        gain = 4.0
        joints.leftLowerLeg = { damping = 3.0 }
        joints.rightLowerLeg = [80, 0, 0]
        ",
    )
    .unwrap();
    let (left, right) = (Node::LeftLowerLeg.index(), Node::RightLowerLeg.index());
    let lower = &poses["a_lower"];
    assert!(apart(lower.rotations[left], rotation_of([40.0, 0.0, 0.0])) < 1e-12);
    assert!(apart(lower.rotations[right], rotation_of([80.0, 0.0, 0.0])) < 1e-12);
    // EQ3: the pose's gain times the joint's.
    assert_eq!((lower.gains[left], lower.gains[right], lower.dampings[left]), (2.0, 4.0, 3.0));
    assert_eq!((lower.blend_secs, poses["low"].gains[left]), (0.5, 1.0));
    assert_eq!(poses["stand"], KeyPose::STAND);
}

#[test]
fn mirroring_twice_is_the_same_pose_and_once_is_the_other_side() {
    let poses = resolved(
        r"
        [poses.one]
        joints.leftUpperArm = [-60, 10, 20]
        joints.chest = [5, 20, -8]
        joints.rightFoot = { gain = 3.0 }
        [poses.other]
        base = 'one'
        mirror = true
        [poses.again]
        base = 'other'
        mirror = true
        ",
    )
    .unwrap();
    assert_eq!(poses["one"], poses["again"]);
    let body = body();
    let place =
        |name: &str, node: Node| Pose::from_locals(DVec3::ZERO, &poses[name].rotations).positions(&body)[node.index()];
    let (left, right) = (place("one", Node::LeftHand), place("other", Node::RightHand));
    assert!((left * DVec3::new(-1.0, 1.0, 1.0) - right).length() < 1e-12, "{left} {right}");
    assert_eq!(poses["other"].gains[Node::LeftFoot.index()], 3.0);
}

#[test]
fn poses_that_start_from_each_other_are_an_error_that_shows_the_way() {
    let error = resolved("[poses.a]\nbase = 'b'\n[poses.b]\nbase = 'c'\n[poses.c]\nbase = 'a'").unwrap_err();
    assert_eq!(
        error.to_string(),
        "pose \"a\" starts from itself: a -> b -> c -> a; let one of them start from \"stand\""
    );
    assert!(matches!(resolved("[poses.a]\nbase = 'a'"), Err(PoseError::Cycle { .. })));
    assert!(matches!(resolved("[poses.a]\nbase = 'no'"), Err(PoseError::UnknownBase { .. })));
    // Long chains end, too.
    let chain: String = (0..500).map(|n| format!("[poses.p{n:03}]\nbase = 'p{:03}'\n", n + 1)).collect();
    assert!(matches!(resolved(&chain), Err(PoseError::TooMany { .. })));
}

#[test]
fn a_joint_beyond_its_limit_is_named_with_its_excess() {
    let error = resolved("[poses.a]\njoints.rightLowerLeg = [-25, 0, 0]").unwrap_err();
    // The knee's range ends at 5 degrees backward.
    let PoseError::Limit { joint, excess_deg, .. } = &error else { panic!("{error}") };
    assert_eq!(joint.0, Node::RightLowerLeg);
    assert!((excess_deg - 20.0).abs() < 1e-6, "{error}");
    assert!(matches!(resolved("[poses.a]\njoints.hips = [5, 0, 0]"), Err(PoseError::Root { .. })));
}

#[test]
fn hostile_files_are_errors_that_name_the_line() {
    let deep = format!("[poses.a]\nx = {}", "[".repeat(100_000));
    let long = format!("[poses.a]\njoints.{} = [0, 0, 0]", "x".repeat(100_000));
    for (text, line, word) in [
        ("[poses.a]\njoints.leftElbow = [1, 2, 3]", 2, "leftUpperArm"),
        ("[poses.a]\n\njoints.chest = [nan, 0, 0]", 3, "-360"),
        ("[poses.a]\njoints.chest = [1e300, 0, 0]", 2, "-360"),
        ("[poses.a]\njoints.chest = [0, 0]", 2, "3"),
        ("[poses.a]\njoints.chest = 'straight'", 2, "three angles"),
        ("[poses.a]\njoints.chest = { turn = [0, 0, 0] }", 2, "turn_deg"),
        ("[poses.a]\ngain = -1", 2, "0 to 1000"),
        ("[poses.a]\ngain = inf", 2, "0 to 1000"),
        ("[poses.a]\nblend_secs = 1e9", 2, "3600"),
        ("[poses.a]\nblend_sec = 1", 2, "blend_secs"),
        ("[poses.a]\nik = [{ link = 'leftHand', target_m = [0, nan, 0] }]", 2, "metres"),
        ("[poses.a]\n[poses.a]", 2, "duplicate"),
        ("[pose.a]", 1, "poses"),
        (deep.as_str(), 2, ""),
        (long.as_str(), 2, "leftUpperArm"),
    ] {
        let error = read_poses(text, "bad.toml").expect_err(&text[..text.len().min(80)]).to_string();
        assert!(error.starts_with(&format!("bad.toml, line {line}: ")), "{error}");
        assert!(error.contains(word) && error.len() < 800, "{error}");
    }
    assert!(read_poses(&" ".repeat(2_000_000), "bad.toml").is_err());
}

#[test]
fn angles_come_back_from_the_rotation() {
    for x in [-170.0, -90.0, 0.0, 35.0, 120.0] {
        for y in [-89.0, -30.0, 0.0, 60.0, 90.0] {
            for z in [-150.0, -10.0, 0.0, 80.0] {
                let rotation = rotation_of([x, y, z]);
                // Near a quarter turn of Y the arc tangents lose half the digits.
                assert!(apart(rotation, rotation_of(angles_deg(rotation))) < 1e-7, "{x} {y} {z}");
            }
        }
    }
}

#[test]
fn a_pose_found_with_ik_can_be_saved_and_read_again() {
    let poses = resolved(
        r"
        [poses.block]
        gain = 1.5
        ik = [ { link = 'leftHand', target_m = [0.15, 1.45, 0.35] }, { link = 'rightFoot', target_m = [-0.1, 0.3, 0.3] } ]
        ",
    )
    .unwrap();
    let body = body();
    let hips = DVec3::Y * sinew_world::hips_over_soles_m(&body, &Pose::STANDING);
    let pose = Pose::from_locals(hips, &poses["block"].rotations);
    for (node, target) in
        [(Node::LeftHand, DVec3::new(0.15, 1.45, 0.35)), (Node::RightFoot, DVec3::new(-0.1, 0.3, 0.3))]
    {
        let centre = pose.positions(&body)[node.index()] + pose.world[node.index()] * body.link(node).centre;
        assert!((centre - target).length() < 1e-9, "{node:?} {centre}");
    }
    let spec = poses["block"].to_spec();
    let text = toml::to_string(&BTreeMap::from([("poses", BTreeMap::from([("saved", spec)]))])).unwrap();
    let again = resolved(&text).unwrap();
    for node in Node::ALL {
        let at = node.index();
        assert!(apart(again["saved"].rotations[at], poses["block"].rotations[at]) < 1e-7, "{text}");
    }
    assert_eq!(again["saved"].gains, poses["block"].gains);
    let far = resolved("[poses.a]\nik = [{ link = 'leftHand', target_m = [0, 1, 3] }]").unwrap_err();
    assert!(matches!(far, PoseError::OutOfReach { .. }), "{far}");
    let none = resolved("[poses.a]\nik = [{ link = 'chest', target_m = [0, 1, 0] }]").unwrap_err();
    assert!(matches!(none, PoseError::NoLimb { .. }), "{none}");
}

#[test]
fn the_wanted_pose_moves_without_a_jump_even_when_the_aim_changes_half_way() {
    let (body, step) = (body(), 1.0 / 240.0);
    let frame = standing(&body);
    let poses = resolved(
        r"
        [poses.up]
        blend_secs = 0.5
        gain = 5.0
        joints.leftUpperArm = [-90, 0, 20]
        joints.leftLowerArm = [-100, 0, 0]
        [poses.out]
        blend_secs = 0.4
        joints.leftUpperArm = [0, 0, 90]
        ",
    )
    .unwrap();
    let mut player = PosePlayer::new(&poses["stand"]);
    let mut target = Wanted::STANDING;
    let mut before = target.clone();
    for index in 0..300 {
        match index {
            10 => player.aim(&poses["up"]),
            70 => player.aim(&poses["out"]),
            120 => player.ik.reach(Limb::LeftArm, Reach::own(&body, Limb::LeftArm, DVec3::new(1.3, 1.3, 0.4))),
            200 => player.ik.release(Limb::LeftArm),
            _ => {}
        }
        player.write(&frame, CharacterId::first_in(0), &body, step, &mut target);
        for node in Node::ALL {
            let (old, new) = (before.joint(node), target.joint(node));
            // Smoothstep's steepest is 1.5 times the mean: 120 degrees in 0.2 s are 0.065 rad a step.
            assert!(apart(old.rotation, new.rotation) < 0.1, "{node:?} at {index}");
            assert!((old.gain - new.gain).abs() < 0.1);
            assert_eq!(new.velocity, DVec3::ZERO);
        }
        before.clone_from(&target);
    }
    assert!(apart(target.joint(Node::LeftUpperArm).rotation, rotation_of([0.0, 0.0, 90.0])) < 1e-9);
    assert_eq!(player.progress(), 1.0);
}

#[test]
fn with_follow_velocity_the_wanted_velocity_is_that_of_the_blend() {
    let (body, step) = (body(), 1.0 / 240.0);
    let frame = standing(&body);
    let poses =
        resolved("[poses.a]\nfollow_velocity = true\nblend_secs = 0.5\njoints.leftLowerArm = [-90, 0, 0]").unwrap();
    let mut player = PosePlayer::new(&poses["stand"]);
    let mut target = Wanted::STANDING;
    player.write(&frame, CharacterId::first_in(0), &body, step, &mut target);
    player.aim(&poses["a"]);
    let mut turned = DVec3::ZERO;
    for _ in 0..120 {
        player.write(&frame, CharacterId::first_in(0), &body, step, &mut target);
        turned += target.joint(Node::LeftLowerArm).velocity * step;
    }
    // The velocities of a turn about one axis add up to the turn.
    assert!((turned - DVec3::X * -std::f64::consts::FRAC_PI_2).length() < 1e-9, "{turned}");
}

#[test]
fn a_reaching_limb_wants_its_hand_at_the_target_of_the_world() {
    let (body, step) = (body(), 1.0 / 240.0);
    let frame = standing(&body);
    let reach = Reach { target: DVec3::new(1.1, 1.5, 0.35), effector: DVec3::new(0.0, -0.12, 0.11) };
    let mut player = PosePlayer::new(&KeyPose::STAND);
    player.ik.reach(Limb::RightArm, reach);
    let mut target = Wanted::STANDING;
    for _ in 0..240 {
        player.write(&frame, CharacterId::first_in(0), &body, step, &mut target);
    }
    let mut locals = target.joints.map(|joint| joint.rotation);
    locals[0] = DQuat::IDENTITY;
    let pose = Pose::from_locals(frame.characters[0].parts[0].position, &locals);
    let hand = Node::RightHand.index();
    let held = pose.positions(&body)[hand] + pose.world[hand] * reach.effector;
    assert!((held - reach.target).length() < 1e-9, "{held}");
    assert!(player.ik.miss_m(Limb::RightArm) < 1e-9);
    // The same by the limb's own solver, from the same start.
    let goal = LimbGoal {
        joint: frame.characters[0].part(Node::RightUpperArm).position,
        world_from_parent: DQuat::IDENTITY,
        end: DQuat::IDENTITY,
        effector: reach.effector,
        target: reach.target,
        near: [DQuat::IDENTITY; 2],
    };
    let turns = solve_limb(&body, Limb::RightArm, &goal).unwrap();
    assert!(apart(turns.lower, locals[Node::RightLowerArm.index()]) < 1e-9);
}
