//! What holds a body from outside is metered: force and power, by part.

#![allow(clippy::unwrap_used, reason = "helpers of tests")]

use crate::common;

use crate::common::{adult, spec, standing};
use glam::DVec3;
use sinew_body::humanoid::Node;
use sinew_world::{
    CharacterFrame, CharacterId, Entity, ExternalForce, ExternalForces, Form, Held, Motion, Pin, PropId, PropSpec,
    Solid, World, WorldSettings,
};

fn sum(character: &CharacterFrame, of: impl Fn(&ExternalForces) -> ExternalForce) -> (DVec3, f64) {
    let force = character.external.iter().map(|spent| of(spent).force).sum();
    (force, character.external.iter().map(|spent| of(spent).power_w).sum())
}

fn floating(gravity_m_s2: f64) -> World {
    let body = adult();
    let mut world = World::new(WorldSettings { floor: None, gravity_m_s2, ..WorldSettings::default() });
    world.add_character(spec(&body, standing(&body))).unwrap();
    world
}

/// 80 kg.
const WEIGHT_N: f64 = 80.0 * 9.81;

/// Lets the body hang by what holds it, joints held by springs that damp its swinging.
fn settle(world: &mut World) {
    common::hold(world, CharacterId::first_in(0), 4.0);
    common::steps(world, 8.0);
}

#[test]
fn pins_that_carry_a_body_spend_its_weight_and_no_power() {
    let mut world = floating(9.81);
    let positions = standing(&adult()).positions(&adult());
    for node in Node::ALL {
        let pin = Pin {
            position: positions[node.index()],
            stiffness: 160.0,
            damping: 25.0,
            gravity_share: 1.0,
            ..Pin::LOOSE
        };
        world.set_pin(CharacterId::first_in(0), node, Some(pin));
    }
    common::steps(&mut world, 2.0);
    let (force, power_w) = sum(&world.frame().characters[0], |spent| spent.pin);
    // It is at rest to micrometres.
    assert!((force - DVec3::Y * WEIGHT_N).length() < 0.01 * WEIGHT_N, "{force}");
    assert!(power_w.abs() < 0.1, "{power_w} W");
    assert_eq!(sum(&world.frame().characters[0], |spent| spent.held), (DVec3::ZERO, 0.0));
}

/// A body over a plank of 60 kg that its pins push off from; they hold it `ahead_m` ahead of where it is.
fn over_a_plank(gravity_m_s2: f64, ahead_m: f64) -> (World, PropId) {
    let mut world = floating(gravity_m_s2);
    let plank = Solid::new(Form::Box { size_m: DVec3::new(2.0, 0.1, 2.0) });
    let plank = PropSpec::new(plank, Motion::Dynamic { mass_kg: 60.0 }, DVec3::Y * -0.5);
    let plank = world.add_prop(plank).unwrap();
    world.set_reaction_body(CharacterId::first_in(0), Some(plank));
    for (node, position) in Node::ALL.into_iter().zip(standing(&adult()).positions(&adult())) {
        let position = position + DVec3::Z * ahead_m;
        let pin = Pin { position, stiffness: 160.0, damping: 25.0, gravity_share: 1.0, ..Pin::LOOSE };
        world.set_pin(CharacterId::first_in(0), node, Some(pin));
    }
    (world, plank)
}

#[test]
fn a_footing_goes_back_by_what_its_pins_push_the_body_ahead() {
    let (mut world, plank) = over_a_plank(0.0, 0.05);
    let body_before = world.frame().characters[0].centre_of_mass.z;
    common::steps(&mut world, 1.0);
    let (body, prop) = (&world.frame().characters[0], &world.frame().props[plank.slot()]);
    let momentum = body.centre_velocity * 80.0 + prop.velocity * 60.0;
    let (ahead, back) = ((body.centre_of_mass.z - body_before) * 80.0, prop.centre.z * 60.0);
    assert!(ahead > 3.0 && (ahead + back).abs() < 0.2, "{ahead} kg m ahead, {back} back");
    // As the body comes to rest so does the plank, but for what it feels a few steps late.
    assert!(momentum.length() < 0.5, "{momentum}");
}

#[test]
fn a_footing_bears_the_body_that_its_pins_carry() {
    let (mut world, plank) = over_a_plank(9.81, 0.0);
    for step in 0..180 {
        let lift_n = if step < 120 { (80.0 + 60.0) * 9.81 } else { 60.0 * 9.81 };
        world.push_prop(plank, DVec3::Y * lift_n, None);
        world.step();
        let fell_m = -0.5 - world.frame().props[plank.slot()].centre.y;
        match step {
            // Late by two steps, it has begun to rise at 6 cm/s.
            0..120 => assert!(fell_m.abs() < 0.05, "{fell_m}"),
            // Lifted by its own weight alone it goes down with 785 N on 60 kg: 13 m/s².
            179 => assert!((fell_m - 0.5 * 13.08 * 0.0625).abs() < 0.06, "{fell_m}"),
            _ => {}
        }
    }
}

#[test]
fn the_work_of_a_pin_is_the_energy_that_the_body_gains() {
    let mut world = floating(0.0);
    let far = Pin { position: DVec3::new(0.0, 1.2, 50.0), stiffness: 1e3, max_force_n: 100.0, ..Pin::LOOSE };
    world.set_pin(CharacterId::first_in(0), Node::Chest, Some(far));
    let (mut work_j, step_secs) = (0.0, world.settings().step_secs());
    for _ in 0..120 {
        world.step();
        work_j += sum(&world.frame().characters[0], |spent| spent.pin).1 * step_secs;
    }
    let gained_j = world.energy_j(CharacterId::first_in(0));
    // Limp joints rub, as the arms and legs that are left behind turn.
    let share = gained_j / work_j;
    assert!(gained_j > 10.0 && (0.8..1.005).contains(&share), "{work_j} J of work, {gained_j} J gained");
}

#[test]
fn a_part_that_physics_does_not_move_bears_what_hangs_from_it() {
    let mut world = floating(9.81);
    world.set_forces(CharacterId::first_in(0), Node::Hips, false);
    settle(&mut world);
    let held = world.frame().characters[0].external[Node::Hips.index()].held;
    // The joints' impulses are those of the last sub-step.
    assert!((held.force - DVec3::Y * WEIGHT_N).length() < 0.05 * WEIGHT_N, "{held:?}");
    assert!(held.power_w.abs() < 1.0, "{held:?}");
}

#[test]
fn a_hold_on_a_wall_bears_who_hangs_from_it_and_a_hold_on_a_ball_is_no_help_from_outside() {
    let mut world = floating(9.81);
    let hand = world.frame().characters[0].part(Node::LeftHand).centre;
    let solid = Solid::new(Form::Ball { radius_m: 0.05 });
    let wall = world.add_prop(PropSpec::new(solid.clone(), Motion::Fixed, hand + DVec3::Y * -0.1)).unwrap();
    let right = world.frame().characters[0].part(Node::RightHand).centre;
    let ball = PropSpec::new(solid, Motion::Dynamic { mass_kg: 1.0 }, right + DVec3::Y * -0.1);
    let ball = world.add_prop(ball).unwrap();
    let held = |node: Node, prop: PropId| Held {
        character: CharacterId::first_in(0),
        node,
        object: Entity::Prop(prop),
        soft: false,
        break_force_n: None,
    };
    world.attach(held(Node::LeftHand, wall));
    world.attach(held(Node::RightHand, ball));
    common::hold(&mut world, CharacterId::first_in(0), 4.0);
    // It swings by its hand: the mean counts.
    let (mut bears_n, steps) = (0.0, 2400);
    for _ in 0..steps {
        world.step();
        let spent = &world.frame().characters[0].external;
        bears_n += spent[Node::LeftHand.index()].held.force.y / f64::from(steps);
        assert_eq!(spent[Node::RightHand.index()].held.force, DVec3::ZERO);
    }
    let weight_n = WEIGHT_N + 9.81;
    assert!((bears_n - weight_n).abs() < 0.1 * weight_n, "{bears_n} N");
}

#[test]
fn every_step_of_a_soft_hold_tells_the_force_that_it_bears() {
    let mut world = floating(9.81);
    let hand = world.frame().characters[0].part(Node::LeftHand).centre;
    let solid = Solid::new(Form::Ball { radius_m: 0.05 });
    let wall = world.add_prop(PropSpec::new(solid, Motion::Fixed, hand + DVec3::Y * 0.1)).unwrap();
    let object = Entity::Prop(wall);
    world.attach(Held {
        character: CharacterId::first_in(0),
        node: Node::LeftHand,
        object,
        soft: true,
        break_force_n: None,
    });
    common::hold(&mut world, CharacterId::first_in(0), 4.0);
    common::steps(&mut world, 20.0);
    let mut before = world.frame().characters[0].centre_velocity;
    for step in 0..240 {
        world.step();
        let character = &world.frame().characters[0];
        // What moves the centre of mass of a body that hangs by its hand alone.
        let acceleration = (character.centre_velocity - before) * 240.0;
        let needs = (acceleration + DVec3::Y * 9.81) * 80.0;
        let force = character.external[Node::LeftHand.index()].held.force;
        // The last sub-step alone says half as much again. A tenth: the solver's sweeps leave that of a spring's law.
        assert!((force - needs).length() < 0.1 * WEIGHT_N, "step {step}: {force}, moved by {needs}");
        before = character.centre_velocity;
    }
}

#[test]
fn a_plane_takes_up_what_pushes_across_it() {
    let mut world = floating(0.0);
    world.hold_to_plane(CharacterId::first_in(0), DVec3::Z);
    for _ in 0..60 {
        world.push_part(CharacterId::first_in(0), Node::Chest, DVec3::X * 100.0, None);
        world.step();
    }
    let (force, power_w) = sum(&world.frame().characters[0], |spent| spent.held);
    assert!((force.x + 100.0).abs() < 10.0, "{force}");
    assert!(power_w.abs() < 0.1, "{power_w}");
}
