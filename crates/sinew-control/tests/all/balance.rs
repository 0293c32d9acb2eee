//! Claims about standing balance.

#![allow(clippy::disallowed_methods, reason = "tests may use the platform's mathematics")]

use crate::pushed::{GUARD, KNEES_BENT, Outcome, PUSH_AT_SECS, Place, Push, STRIDE, Standing, Turns, outcome};
use glam::DVec3;
use sinew_body::humanoid::{Body, Node, log};
use sinew_control::reflex::{BalanceSettings, NAMES, by_name};
use sinew_world::{Form, Motion, PropSpec, Solid};

const EIGHT: [f64; 8] = [0.0, 45.0, 90.0, 135.0, 180.0, 225.0, 270.0, 315.0];

fn standing(mass_kg: f64, stature_m: f64, turns: Turns) -> Standing {
    Standing::new(Body::standard(mass_kg, stature_m), turns, BalanceSettings::default())
}

/// Pushes on the hips at the height of the centre of mass for 0.1 s, with a share of what a body could stand without a step.
fn stands(make: &dyn Fn() -> Standing, share: f64, azimuths_deg: &[f64], place: Place) {
    let mut quiet = make();
    quiet.run(PUSH_AT_SECS, None);
    for &azimuth_deg in azimuths_deg {
        let mut push = Push { azimuth_deg, impulse_n_s: 0.0, for_secs: 0.1, place };
        push.impulse_n_s = share * quiet.bound_n_s(push.direction());
        let end = outcome(make, &push);
        assert_eq!(end, Outcome::Stands, "{azimuth_deg}° with {:.1} N s", push.impulse_n_s);
    }
}

#[test]
fn pushed_from_eight_directions_it_stands_what_a_body_could_without_a_step() {
    // Seven tenths are asked for; it falls between 1.0 and 1.15.
    for share in [0.7, 0.95] {
        stands(&|| standing(80.0, 1.7, &[]), share, &EIGHT, Place::Centre);
    }
}

#[test]
fn pushed_on_the_chest_it_stands_three_quarters() {
    // Three tenths of a metre over the centre of mass: the trunk is thrown the wrong way first.
    stands(&|| standing(80.0, 1.7, &[]), 0.75, &EIGHT, Place::Chest);
}

#[test]
fn light_and_heavy_bodies_stand_it_too() {
    for (mass_kg, stature_m) in [(40.0, 1.5), (100.0, 1.9)] {
        stands(&|| standing(mass_kg, stature_m, &[]), 0.95, &[0.0, 135.0, 270.0], Place::Centre);
    }
}

#[test]
fn bent_knees_a_stride_and_a_guard_stand_too() {
    for turns in [KNEES_BENT, STRIDE, GUARD] {
        stands(&|| standing(80.0, 1.7, turns), 0.9, &[0.0, 90.0, 180.0], Place::Centre);
    }
}

#[test]
fn undisturbed_it_stands_for_twenty_seconds_without_drift() {
    let mut standing = standing(80.0, 1.7, &[]);
    standing.run(PUSH_AT_SECS, None);
    let me = &standing.world.frame().characters[0];
    let (centre, facing, feet) = (me.centre_of_mass, me.facing, standing.feet());
    standing.run(20.0, None);
    let me = &standing.world.frame().characters[0];
    // A centimetre is what people sway by; the solver's friction creeps by a millimetre or two.
    assert!((me.centre_of_mass - centre).length() < 0.01, "{}", me.centre_of_mass - centre);
    assert!(me.centre_velocity.length() < 0.002, "{}", me.centre_velocity);
    // 1.5 degrees.
    assert!(me.facing.dot(facing) > 0.99966, "{}", me.facing);
    for (now, before) in standing.feet().into_iter().zip(feet) {
        assert!((now - before).length() < 0.005, "{}", now - before);
    }
    // As upright as it began: no folding that stays.
    for node in [Node::Hips, Node::Chest, Node::LeftUpperLeg, Node::RightUpperLeg] {
        assert!(log(me.pose().local(node)).length() < 0.1, "{node:?} {}", log(me.pose().local(node)));
    }
}

#[test]
fn pushed_it_comes_back_upright_and_never_bends_a_knee_back() {
    let mut standing = standing(80.0, 1.7, &[]);
    let push = Push { azimuth_deg: 20.0, impulse_n_s: 25.0, for_secs: 0.1, place: Place::Centre };
    let mut lean: f64 = 0.0;
    for _ in 0..240 * 6 {
        standing.step(Some(&push));
        let me = &standing.world.frame().characters[0];
        lean = lean.max((me.part(Node::Chest).rotation * DVec3::Y).angle_between(DVec3::Y));
        for knee in [Node::LeftLowerLeg, Node::RightLowerLeg] {
            // The limit is at -5 degrees, and its spring gives way by one and a half.
            assert!(log(me.pose().local(knee)).x > -0.115);
        }
    }
    // The trunk goes with the fall, and is back within 2 degrees.
    let me = &standing.world.frame().characters[0];
    assert!(lean > 0.1, "{lean}");
    assert!((me.part(Node::Chest).rotation * DVec3::Y).angle_between(DVec3::Y) < 0.035);
}

#[test]
fn arms_that_hang_swing_and_arms_that_are_about_something_stay() {
    let swing = |turns: Turns| {
        let mut standing = standing(80.0, 1.7, turns);
        let push = Push { azimuth_deg: 0.0, impulse_n_s: 30.0, for_secs: 0.1, place: Place::Centre };
        standing.run(PUSH_AT_SECS, None);
        let arm = |standing: &Standing| standing.target.joint(Node::LeftUpperArm).rotation;
        let before = arm(&standing);
        let mut most: f64 = 0.0;
        for _ in 0..240 {
            standing.step(Some(&push));
            most = most.max(log(arm(&standing) * before.conjugate()).length());
        }
        most
    };
    // In radians: half of what the settings allow, and hardly to be seen.
    assert!(swing(&[]) > 0.4);
    assert!(swing(GUARD) < 0.15);
}

#[test]
fn it_stands_wherever_it_is_and_whichever_way_it_faces() {
    let body = Body::standard(80.0, 1.7);
    let place = DVec3::new(300.0, 0.0, -120.0);
    let make = || Standing::placed(body.clone(), STRIDE, BalanceSettings::default(), place, 2.0);
    stands(&make, 0.9, &[60.0, 200.0, 340.0], Place::Centre);
}

#[test]
fn it_lands_from_a_hand_above_the_ground_and_stands() {
    let body = Body::standard(80.0, 1.7);
    let place = DVec3::Y * 0.1;
    let mut standing = Standing::placed(body, KNEES_BENT, BalanceSettings::default(), place, 0.0);
    standing.run(4.0, None);
    let me = &standing.world.frame().characters[0];
    assert!(me.centre_of_mass.y > 0.9 && me.centre_velocity.length() < 0.01, "{}", me.centre_of_mass);
}

#[test]
fn it_stands_on_a_platform_that_starts_and_glides_on() {
    let body = Body::standard(80.0, 1.7);
    let mut standing = Standing::placed(body, &[], BalanceSettings::default(), DVec3::Y * 0.2, 0.0);
    let solid = Solid::new(Form::Box { size_m: DVec3::new(4.0, 0.2, 4.0) });
    let platform = PropSpec::new(solid, Motion::Moving, DVec3::Y * 0.1);
    let platform = standing.world.add_prop(platform).expect("a box");
    standing.run(1.0, None);
    standing.world.accelerate_prop(platform, DVec3::new(0.4, 0.0, 0.4));
    standing.run(0.5, None);
    standing.world.accelerate_prop(platform, DVec3::ZERO);
    standing.run(4.0, None);
    let me = &standing.world.frame().characters[0];
    assert!(me.centre_of_mass.y > 1.1, "{}", me.centre_of_mass);
    // It goes along at 0.28 m/s.
    let gliding = me.centre_velocity - standing.world.frame().props[platform.slot()].velocity;
    assert!(gliding.length() < 0.01, "{gliding}");
}

#[test]
fn alone_it_holds_a_body_whose_pose_is_let_go() {
    let mut standing = standing(80.0, 1.7, &[]);
    for joint in &mut standing.wanted.joints {
        joint.gain = 0.0;
    }
    standing.run(6.0, None);
    let me = &standing.world.frame().characters[0];
    assert!(me.centre_of_mass.y > 0.95 && me.centre_velocity.length() < 0.01, "{}", me.centre_of_mass);
}

#[test]
fn a_fall_that_is_beyond_it_is_let_go_without_a_wrong_number() {
    for azimuth_deg in [0.0, 90.0, 180.0] {
        let mut standing = standing(80.0, 1.7, &[]);
        let push = Push { azimuth_deg, impulse_n_s: 150.0, for_secs: 0.1, place: Place::Chest };
        for _ in 0..240 * 6 {
            standing.step(Some(&push));
            let target = &standing.target;
            assert!(target.joints.iter().all(|joint| joint.rotation.is_finite() && joint.torque.is_finite()));
            assert!(!standing.world.frame().characters[0].was_reset);
        }
        let me = &standing.world.frame().characters[0];
        assert!(me.centre_of_mass.y < 0.4, "it lies");
        // It does not thrash about: whoever lies on the ground is left to other reflexes.
        assert!(me.centre_velocity.length() < 0.3, "{}", me.centre_velocity);
        assert!(standing.target.joints.iter().all(|joint| joint.torque == DVec3::ZERO));
    }
}

#[test]
fn it_is_found_by_its_name() {
    let body = Body::standard(80.0, 1.7);
    for name in NAMES {
        assert_eq!(by_name(name, &body).map(|reflex| reflex.name()), Some(*name));
    }
    assert!(by_name("balanced", &body).is_none());
}
