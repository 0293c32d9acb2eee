//! The ragdoll's self-check.
#![allow(clippy::unwrap_used, reason = "tests")]

use crate::common::{adult, spec};
use sinew_body::humanoid::{Body, Node, Pose};
use sinew_world::{SpecError, check_ragdoll};

#[test]
fn an_adult_a_child_and_a_giant_are_sound() {
    for body in [adult(), Body::standard(20.0, 1.1), Body::standard(250.0, 2.6)] {
        let report = check_ragdoll(&spec(&body, Pose::STANDING)).unwrap();
        println!("{report}\n");
        assert!(report.is_sound(), "{report}");
        assert!(report.to_string().contains("sleeps after"));
    }
}

#[test]
fn a_body_with_faults_is_told_what_they_are() {
    let mut body = adult();
    body.link_mut(Node::Neck).mass_kg = 0.05;
    let report = check_ragdoll(&spec(&body, Pose::STANDING)).unwrap();
    assert!(!report.is_sound());
    assert!(report.to_string().contains("fault: neck and its neighbour differ in mass"), "{report}");

    let mut body = adult();
    let limit = &mut body.link_mut(Node::LeftUpperArm).limit;
    limit.twist = (1.0, 1.5);
    let report = check_ragdoll(&spec(&body, Pose::STANDING)).unwrap();
    assert_eq!(report.room_rad.1, Node::LeftUpperArm);
    assert!(report.room_rad.0 < -0.3, "{report}");
    assert!(report.to_string().contains("leftUpperArm rests"), "{report}");

    let mut body = adult();
    body.link_mut(Node::Chest).mass_kg = 0.0;
    assert_eq!(check_ragdoll(&spec(&body, Pose::STANDING)), Err(SpecError::NoMass("chest")));
}
