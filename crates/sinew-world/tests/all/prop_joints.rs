//! Joints of props do what their kinds say.

#![allow(clippy::unwrap_used, clippy::disallowed_methods, reason = "tests")]

use glam::DVec3;
use sinew_world::{
    Aim, Entity, Form, Motion, Motor, PropId, PropJointKind, PropJointSpec, PropSpec, Solid, SpecError, World,
    WorldSettings,
};

fn empty(gravity_m_s2: f64) -> World {
    World::new(WorldSettings { floor: None, gravity_m_s2, ..WorldSettings::default() })
}

fn ball(world: &mut World, position: DVec3, mass_kg: f64) -> PropId {
    let solid = Solid::new(Form::Ball { radius_m: 0.1 });
    world.add_prop(PropSpec::new(solid, Motion::Dynamic { mass_kg }, position)).unwrap()
}

fn bar(world: &mut World, position: DVec3) -> PropId {
    let solid = Solid::new(Form::Box { size_m: DVec3::new(0.6, 0.05, 0.1) });
    world.add_prop(PropSpec::new(solid, Motion::Dynamic { mass_kg: 2.0 }, position)).unwrap()
}

fn with_ground(prop: PropId, at: DVec3, kind: PropJointKind) -> PropJointSpec {
    PropJointSpec {
        between: [Entity::Floor, Entity::Prop(prop)],
        anchors: [at; 2],
        kind,
        motor: None,
        break_force_n: None,
        touches: false,
    }
}

fn step_secs(world: &mut World, secs: f64) {
    for _ in 0..(secs * 240.0).round() as usize {
        world.step();
    }
}

#[test]
fn a_pendulum_swings_with_the_period_of_its_length() {
    let mut world = empty(9.81);
    let bob = ball(&mut world, DVec3::new(0.1, -1.0, 0.0), 1.0);
    world.add_prop_joint(with_ground(bob, DVec3::ZERO, PropJointKind::Ball)).unwrap();
    let mut crossings = Vec::new();
    for _ in 0..960 {
        let before = world.frame().props[bob.slot()].position.x;
        world.step();
        if before > 0.0 && world.frame().props[bob.slot()].position.x <= 0.0 {
            crossings.push(world.frame().time_secs);
        }
    }
    // A ball of 0.1 m on 1.005 m: T = 2π √((L² + 2/5 r²) / (g L)) = 2.017 s; a step of 4 ms on both ends.
    let period = crossings[1] - crossings[0];
    assert!((period - 2.017).abs() < 0.01, "{period}");
}

#[test]
fn a_rope_holds_at_its_length_and_pulls_nothing_before() {
    let mut world = empty(9.81);
    let load = ball(&mut world, DVec3::new(0.0, -0.5, 0.0), 50.0);
    let mut rope = with_ground(load, DVec3::ZERO, PropJointKind::Rope { length_m: 1.0 });
    rope.anchors[1] = DVec3::new(0.0, -0.5, 0.0);
    let rope = world.add_prop_joint(rope).unwrap();
    step_secs(&mut world, 0.2);
    let fallen = -0.5 - world.frame().props[load.slot()].position.y;
    assert!((fallen - 0.5 * 9.81 * 0.2 * 0.2).abs() < 0.01, "{fallen}: free while the rope is slack");
    step_secs(&mut world, 3.0);
    let length = world.prop_joint(rope).place;
    // A hundredth of what it holds is its give.
    assert!((length - 1.0).abs() < 0.01, "{length}");
}

#[test]
fn a_rope_breaks_above_its_force_and_not_below() {
    for (break_force_n, holds) in [(80.0, false), (120.0, true)] {
        let mut world = empty(9.81);
        let load = ball(&mut world, DVec3::new(0.0, -1.0, 0.0), 10.0);
        let mut rope = with_ground(load, DVec3::ZERO, PropJointKind::Rope { length_m: 1.0 });
        rope.anchors[1] = DVec3::new(0.0, -1.0, 0.0);
        rope.break_force_n = Some(break_force_n);
        let rope = world.add_prop_joint(rope).unwrap();
        step_secs(&mut world, 1.0);
        // Ten kilograms at rest weigh 98 N.
        assert_eq!(world.prop_joint(rope).is_whole, holds, "{break_force_n}");
    }
}

#[test]
fn a_ball_joint_breaks_above_its_force_and_not_below() {
    for (break_force_n, holds) in [(80.0, false), (120.0, true)] {
        let mut world = empty(9.81);
        let load = ball(&mut world, DVec3::new(0.0, -1.0, 0.0), 10.0);
        let mut joint = with_ground(load, DVec3::new(0.0, -0.9, 0.0), PropJointKind::Ball);
        joint.break_force_n = Some(break_force_n);
        let joint = world.add_prop_joint(joint).unwrap();
        step_secs(&mut world, 1.0);
        assert_eq!(world.prop_joint(joint).is_whole, holds, "{break_force_n}");
    }
}

#[test]
fn a_spring_stretches_by_weight_over_stiffness() {
    let mut world = empty(9.81);
    let load = ball(&mut world, DVec3::new(0.0, -1.0, 0.0), 2.0);
    let kind = PropJointKind::Spring { length_m: 1.0, stiffness_n_m: 200.0, damping_n_s_m: 20.0 };
    let mut spring = with_ground(load, DVec3::ZERO, kind);
    spring.anchors[1] = DVec3::new(0.0, -1.0, 0.0);
    world.add_prop_joint(spring).unwrap();
    step_secs(&mut world, 5.0);
    let stretch = -1.0 - world.frame().props[load.slot()].position.y;
    assert!((stretch - 2.0 * 9.81 / 200.0).abs() < 1e-3, "{stretch}");
}

#[test]
fn a_hinge_turns_with_its_motors_speed_for_ever() {
    let mut world = empty(0.0);
    let wheel = bar(&mut world, DVec3::ZERO);
    let kind = PropJointKind::Hinge { axis: DVec3::Z, range: None };
    let mut hinge = with_ground(wheel, DVec3::ZERO, kind);
    hinge.motor = Some(Motor { aim: Aim::Speed(5.0), strength: 10.0 });
    let hinge = world.add_prop_joint(hinge).unwrap();
    step_secs(&mut world, 3.0);
    let spin = world.frame().props[wheel.slot()].angular_velocity;
    assert!((spin - DVec3::Z * 5.0).length() < 0.05, "{spin}");
    assert!((world.prop_joint(hinge).speed - 5.0).abs() < 0.05);
    world.set_prop_motor(hinge, None);
    step_secs(&mut world, 1.0);
    // It coasts: nothing brakes it.
    assert!((world.frame().props[wheel.slot()].angular_velocity.z - 5.0).abs() < 0.1);
}

#[test]
fn a_motor_is_no_stronger_than_it_is() {
    let mut world = empty(0.0);
    let wheel = bar(&mut world, DVec3::ZERO);
    let mut hinge = with_ground(wheel, DVec3::ZERO, PropJointKind::Hinge { axis: DVec3::Z, range: None });
    hinge.motor = Some(Motor { aim: Aim::Speed(100.0), strength: 0.5 });
    world.add_prop_joint(hinge).unwrap();
    step_secs(&mut world, 1.0);
    let inertia = 2.0 * (0.6 * 0.6 + 0.05 * 0.05) / 12.0;
    let speed = world.frame().props[wheel.slot()].angular_velocity.z;
    assert!((speed - 0.5 / inertia).abs() < 0.02 * speed, "{speed}, {}", 0.5 / inertia);
}

#[test]
fn a_hinge_comes_to_its_place_and_stops_at_its_range() {
    for (aim, end) in [(0.5, 0.5), (-1.0, -0.8)] {
        let mut world = empty(9.81);
        let arm = bar(&mut world, DVec3::new(0.3, 0.0, 0.0));
        let kind = PropJointKind::Hinge { axis: DVec3::Z, range: Some([-0.8, 0.8]) };
        let mut hinge = with_ground(arm, DVec3::ZERO, kind);
        hinge.motor = Some(Motor { aim: Aim::Place(aim), strength: 60.0 });
        let hinge = world.add_prop_joint(hinge).unwrap();
        step_secs(&mut world, 2.0);
        let place = world.prop_joint(hinge).place;
        // The weight, 6 N m of 60, sags it by a tenth of 0.1 rad.
        assert!((place - end).abs() < 0.015, "{place} where {end} was wanted");
    }
}

#[test]
fn a_slider_moves_along_its_axis_alone() {
    let mut world = empty(9.81);
    let drawer = bar(&mut world, DVec3::ZERO);
    let kind = PropJointKind::Slider { axis: DVec3::Z, range: Some([0.0, 0.4]) };
    let mut slider = with_ground(drawer, DVec3::ZERO, kind);
    slider.motor = Some(Motor { aim: Aim::Speed(1.0), strength: 50.0 });
    let slider = world.add_prop_joint(slider).unwrap();
    step_secs(&mut world, 0.2);
    assert!((world.prop_joint(slider).speed - 1.0).abs() < 0.02);
    step_secs(&mut world, 1.0);
    let place = world.frame().props[drawer.slot()].position;
    assert!((place - DVec3::Z * 0.4).length() < 0.01, "{place}");
}

#[test]
fn what_is_cut_is_free() {
    let mut world = empty(9.81);
    let bob = ball(&mut world, DVec3::new(0.0, -1.0, 0.0), 1.0);
    let joint = world.add_prop_joint(with_ground(bob, DVec3::ZERO, PropJointKind::Ball)).unwrap();
    step_secs(&mut world, 0.5);
    assert!(world.cut_prop_joint(joint));
    assert!(!world.cut_prop_joint(joint), "there is nothing left to cut");
    step_secs(&mut world, 1.0);
    assert!(world.frame().props[bob.slot()].position.y < -5.0);
    assert!(!world.prop_joint(joint).is_whole);
}

#[test]
fn joints_that_are_none_are_refused() {
    let mut world = empty(9.81);
    let bob = ball(&mut world, DVec3::ZERO, 1.0);
    let good = with_ground(bob, DVec3::ZERO, PropJointKind::Ball);
    let mut specs = vec![
        PropJointSpec { between: [Entity::Prop(bob); 2], ..good.clone() },
        PropJointSpec { between: [Entity::Prop(PropId::first_in(7)), Entity::Floor], ..good.clone() },
        PropJointSpec { anchors: [DVec3::NAN; 2], ..good.clone() },
        PropJointSpec { motor: Some(Motor { aim: Aim::Speed(1.0), strength: 1.0 }), ..good.clone() },
        PropJointSpec { break_force_n: Some(f64::NAN), ..good.clone() },
    ];
    for kind in [
        PropJointKind::Hinge { axis: DVec3::ZERO, range: None },
        PropJointKind::Hinge { axis: DVec3::X, range: Some([-4.0, 0.0]) },
        PropJointKind::Slider { axis: DVec3::X, range: Some([0.5, 1.0]) },
        PropJointKind::Rope { length_m: 0.0 },
        PropJointKind::Spring { length_m: 1.0, stiffness_n_m: f64::INFINITY, damping_n_s_m: 0.0 },
    ] {
        specs.push(PropJointSpec { kind, ..good.clone() });
    }
    for spec in specs {
        let error = match spec.between[0] {
            Entity::Prop(prop) if world.frame().prop(prop).is_none() => SpecError::StaleProp(prop),
            _ => SpecError::NoJoint,
        };
        assert_eq!(world.add_prop_joint(spec.clone()), Err(error), "{spec:?}");
    }
    assert!(world.add_prop_joint(good).is_ok());
}
