//! Sliding friction is Coulomb's: μ N against the slip, whichever way a body slides.
#![allow(clippy::unwrap_used, clippy::disallowed_methods, reason = "tests")]

use glam::DVec3;
use sinew_world::{Form, Motion, PropId, PropSpec, Solid, Surface, World, WorldSettings};

const GRAVITY_M_S2: f64 = 9.81;

fn on_floor(floor: f64, size_m: DVec3, friction: f64) -> World {
    let surface = Surface { friction: floor, bounce: 0.0 };
    let mut world = World::new(WorldSettings { floor: Some(surface), ..WorldSettings::default() });
    let solid = Solid::new(Form::Box { size_m });
    let place = DVec3::Y * (size_m.y / 2.0);
    let spec = PropSpec::new(solid, Motion::Dynamic { mass_kg: 20.0 }, place);
    world.add_prop(PropSpec { surface: Surface { friction, bounce: 0.0 }, ..spec }).unwrap();
    for _ in 0..60 {
        world.step();
    }
    world
}

/// Sends the box off at 4 m/s; its mean braking over a quarter of a second \[m/s²\] and its heading after half a second, both from X to
/// Z \[degrees\].
fn sent_off(mut world: World, heading_deg: f64) -> (f64, f64) {
    let (sin, cos) = heading_deg.to_radians().sin_cos();
    let prop = PropId::first_in(0);
    world.place_prop(prop, None, Some(DVec3::new(cos, 0.0, sin) * 4.0));
    let start = world.frame().props[0].position;
    let speed = |world: &World| world.frame().props[0].velocity.with_y(0.0).length();
    (0..6).for_each(|_| world.step());
    let from = speed(&world);
    (0..60).for_each(|_| world.step());
    let braking = (from - speed(&world)) * 4.0;
    (0..54).for_each(|_| world.step());
    let way = world.frame().props[0].position - start;
    (braking, way.z.atan2(way.x).to_degrees())
}

#[test]
fn a_box_is_braked_by_friction_times_weight_and_keeps_its_heading_whichever_way_it_slides() {
    for size_m in [DVec3::splat(0.5), DVec3::new(1.2, 0.3, 0.3), DVec3::new(0.3, 0.1, 0.8)] {
        for friction in [0.3, 0.7] {
            for heading_deg in [0.0, 22.5, 45.0, 70.0, 90.0] {
                let (braking, heading) = sent_off(on_floor(friction, size_m, friction), heading_deg);
                let share = braking / (friction * GRAVITY_M_S2);
                println!("{size_m}, {friction}, {heading_deg}°: {share:.4} μ g, {heading:.2}°");
                assert!((share - 1.0).abs() < 0.01, "{size_m} {friction} {heading_deg}: {share} μ g");
                assert!((heading - heading_deg).abs() < 0.5, "{size_m} {friction} {heading_deg}: {heading}");
            }
        }
    }
}

#[test]
fn two_surfaces_combine_to_the_root_of_their_product_and_ice_is_ice() {
    for (floor, own) in [(0.9, 0.5), (0.4, 0.4), (0.0, 0.9), (0.9, 0.0)] {
        let (braking, _) = sent_off(on_floor(floor, DVec3::splat(0.5), own), 30.0);
        let expected = (floor * own).sqrt() * GRAVITY_M_S2;
        assert!(
            (braking - expected).abs() < 0.01 * expected + 1e-6,
            "{floor} and {own}: {braking} for {expected} m/s²"
        );
    }
}

#[test]
fn a_box_that_slides_comes_to_rest_and_stays() {
    let mut world = on_floor(0.6, DVec3::new(1.2, 0.3, 0.3), 0.6);
    world.place_prop(PropId::first_in(0), None, Some(DVec3::new(1.0, 0.0, 1.0)));
    for _ in 0..240 {
        world.step();
    }
    let rest = world.frame().props[0].position;
    for _ in 0..240 {
        world.step();
    }
    let state = world.frame().props[0];
    // v² / 2 μ g, and half a step of the solver's.
    let way = rest.with_y(0.0).length();
    assert!((way - 2.0 / (2.0 * 0.6 * GRAVITY_M_S2)).abs() < 0.006, "{way} m");
    assert!(state.velocity.length() < 1e-4 && state.position.distance(rest) < 1e-4, "{}", state.velocity);
}
