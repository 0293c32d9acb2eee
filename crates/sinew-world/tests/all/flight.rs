//! What has no support obeys Newton.
#![allow(clippy::unwrap_used, reason = "tests")]

use crate::common;

use crate::common::{adult, fallen, hold, lifted, momenta, odd_pose, standing, steps};
use glam::DVec3;
use sinew_world::{CharacterId, Form, Motion, PropSpec, Solid, World, WorldSettings};

#[test]
fn in_free_flight_the_centre_of_mass_falls_with_g_and_angular_momentum_stays() {
    let body = adult();
    for seed in 0..4 {
        let mut world = fallen(&body, lifted(&body, odd_pose(&body, seed, 0.6), 40.0), DVec3::new(2.0, 3.0, -1.0));
        world.spin_character(CharacterId::first_in(0), DVec3::new(2.0, -1.0, 3.0));
        // The limbs settle against their limits first.
        let (momentum, spin) = momenta(&world, CharacterId::first_in(0));
        let start = world.frame().characters[0].centre_of_mass;
        steps(&mut world, 1.0);
        let time = world.frame().time_secs;
        let gravity = DVec3::Y * -world.settings().gravity_m_s2;
        let (momentum_then, spin_then) = momenta(&world, CharacterId::first_in(0));
        let expected = momentum + gravity * body.mass_kg() * time;
        // The solver's forces are pairs; what is left is rounding.
        assert!((momentum_then - expected).length() < 1e-6 * expected.length(), "{momentum_then} {expected}");
        // Joints and limits are pairs of torques too, but the solver takes a sub-step's correction of joint gaps back with the lever
        // arms of the sub-step's start. What that costs falls with the sub-step; here the limbs flail at 10 rad/s.
        let lost = (spin_then - spin).length() / spin.length();
        println!("seed {seed}: angular momentum lost {lost}");
        assert!(lost < 0.1, "seed {seed}: angular momentum went from {spin} to {spin_then}, by {lost}");
        let fallen = world.frame().characters[0].centre_of_mass;
        let expected = start + momentum / body.mass_kg() * time + gravity * time * time / 2.0;
        // Semi-implicit steps fall ahead of the parabola by g t h / 2, h a sub-step.
        let ahead = world.settings().gravity_m_s2 * time / 2.0 / 240.0;
        assert!((fallen - expected).length() < 1.01 * ahead, "{fallen} {expected}");
    }
}

#[test]
fn springs_and_pushes_inside_a_body_do_not_move_it() {
    let body = adult();
    let mut world = World::new(WorldSettings { gravity_m_s2: 0.0, floor: None, ..WorldSettings::default() });
    world.add_character(common::spec(&body, odd_pose(&body, 3, 0.7))).unwrap();
    hold(&mut world, CharacterId::first_in(0), 4.0);
    let start = world.frame().characters[0].centre_of_mass;
    steps(&mut world, 2.0);
    let (momentum, spin) = momenta(&world, CharacterId::first_in(0));
    // Rounding: the limbs turn by radians within a second.
    assert!(momentum.length() < 1e-6, "{momentum}");
    assert!((world.frame().characters[0].centre_of_mass - start).length() < 1e-3);
    // Of a body whose limbs moved with about 10 kg m²/s.
    assert!(spin.length() < 0.2, "{spin}");
}

#[test]
fn a_force_gives_a_body_its_impulse_and_a_lever_its_turn() {
    let body = adult();
    let mut world = World::new(WorldSettings { gravity_m_s2: 0.0, floor: None, ..WorldSettings::default() });
    world.add_character(common::spec(&body, standing(&body))).unwrap();
    let centre = world.frame().characters[0].centre_of_mass;
    for _ in 0..24 {
        world.push_part(
            CharacterId::first_in(0),
            sinew_body::humanoid::Node::Chest,
            DVec3::X * 100.0,
            Some(centre + DVec3::Y * 0.3),
        );
        world.step();
    }
    let (momentum, spin) = momenta(&world, CharacterId::first_in(0));
    // 100 N for a tenth of a second.
    assert!((momentum - DVec3::X * 10.0).length() < 1e-9, "{momentum}");
    // Lever 0.3 m at the start; the body has moved by a centimetre at the end.
    assert!((spin - DVec3::Z * -3.0).length() < 0.15, "{spin}");
}

#[test]
fn a_ball_falls_with_g_and_bounces_with_its_restitution() {
    for bounce in [0.0, 0.5, 0.8] {
        let mut world = World::new(WorldSettings::default());
        let mut ball = PropSpec::new(
            Solid::new(Form::Ball { radius_m: 0.12 }),
            Motion::Dynamic { mass_kg: 0.6 },
            DVec3::new(0.0, 2.12, 0.0),
        );
        ball.surface.bounce = bounce;
        world.add_prop(ball).unwrap();
        let (mut down, mut up): (f64, f64) = (0.0, 0.0);
        let mut highest: f64 = 0.0;
        // 0.64 s down and at most 0.51 s up.
        for _ in 0..280 {
            world.step();
            let state = &world.frame().props[0];
            down = down.min(state.velocity.y);
            if state.velocity.y > 0.0 {
                up = up.max(state.velocity.y);
                highest = highest.max(state.position.y - 0.12);
            }
        }
        // √(2 g 2 m) = 6.26 m/s; one step of free fall more or less is 0.04.
        assert!((down + 6.26).abs() < 0.05, "hits with {down}");
        // A step of gravity, and the solver's own threshold.
        assert!((up + bounce * down).abs() < 0.1, "bounce {bounce}: {down} becomes {up}");
        assert!((highest - up * up / 2.0 / 9.81).abs() < 0.03, "rises to {highest}");
    }
}
