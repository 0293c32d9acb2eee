//! The poses that are shipped.

#![allow(clippy::unwrap_used, reason = "a test that fails may panic")]
#![allow(clippy::disallowed_methods, reason = "tests may use the platform's mathematics")]

use glam::{DQuat, DVec3};
use sinew_body::humanoid::{Body, Node, Pose};
use sinew_control::pose::{KeyPose, read_poses, resolve_poses};
use std::collections::BTreeMap;

fn shipped() -> BTreeMap<String, KeyPose> {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../scenes/poses/basic.toml");
    let text = std::fs::read_to_string(path).unwrap();
    let file = read_poses(&text, "basic.toml").unwrap();
    resolve_poses(&file.poses, &Body::standard(80.0, 1.7)).unwrap()
}

/// The pose with the left foot flat, the hips tilted as the legs have it.
fn on_the_ground(pose: &KeyPose) -> Pose {
    let flat = Pose::from_locals(DVec3::ZERO, &pose.rotations);
    let foot = flat.world[Node::LeftFoot.index()];
    let pitch = 2.0 * foot.x.atan2(foot.w);
    let mut locals = pose.rotations;
    locals[0] = DQuat::from_rotation_x(-pitch);
    Pose::from_locals(DVec3::ZERO, &locals)
}

#[test]
fn the_shipped_poses_lie_within_the_limits_of_a_human() {
    let poses = shipped();
    for name in [
        "stand",
        "ready",
        "guard",
        "reach_up",
        "PrepareDunk",
        "Landing",
        "punch_right_back",
        "punch_right",
        "kick_right_up",
        "kick_right",
        "crouch",
        "hop_push",
        "hop_tuck",
        "lean_back",
        "pick_up_reach",
    ] {
        assert!(poses.contains_key(name), "{name}");
    }
}

#[test]
fn poses_on_two_feet_have_their_weight_over_them() {
    let (poses, body) = (shipped(), Body::standard(80.0, 1.7));
    for name in [
        "stand",
        "ready",
        "guard",
        "reach_up",
        "Landing",
        "punch_right_back",
        "punch_right",
        "crouch",
        "lean_back",
        "pick_up_reach",
    ] {
        let pose = on_the_ground(&poses[name]);
        let ahead = body.centre_of_mass(&pose).z - pose.positions(&body)[Node::LeftFoot.index()].z;
        // Ahead of the ankle; the sole reaches from 7 cm behind it to 18 cm before it.
        println!("{name}: {ahead:.3}");
        assert!((-0.03..0.13).contains(&ahead), "{name}: {ahead}");
    }
}
