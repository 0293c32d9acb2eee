//! What holds a body from outside is metered: force and power, by part.

#![allow(clippy::unwrap_used, reason = "helpers of tests")]

mod common;

use common::{adult, spec, standing};
use glam::DVec3;
use sinew_body::humanoid::Node;
use sinew_world::{
    CharacterFrame, Effort, Entity, Form, Held, Motion, Pin, PropSpec, Solid, Spent, World, WorldSettings,
};

fn sum(character: &CharacterFrame, of: impl Fn(&Spent) -> Effort) -> (DVec3, f64) {
    let force = character.spent.iter().map(|spent| of(spent).force).sum();
    (force, character.spent.iter().map(|spent| of(spent).power_w).sum())
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
    common::hold(world, 0, 4.0);
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
        world.set_pin(0, node, Some(pin));
    }
    common::steps(&mut world, 2.0);
    let (force, power_w) = sum(&world.frame().characters[0], |spent| spent.pin);
    // It is at rest to micrometres.
    assert!((force - DVec3::Y * WEIGHT_N).length() < 0.01 * WEIGHT_N, "{force}");
    assert!(power_w.abs() < 0.1, "{power_w} W");
    assert_eq!(sum(&world.frame().characters[0], |spent| spent.held), (DVec3::ZERO, 0.0));
}

#[test]
fn the_work_of_a_pin_is_the_energy_that_the_body_gains() {
    let mut world = floating(0.0);
    let far = Pin { position: DVec3::new(0.0, 1.2, 50.0), stiffness: 1e3, max_force_n: 100.0, ..Pin::LOOSE };
    world.set_pin(0, Node::Chest, Some(far));
    let (mut work_j, step_secs) = (0.0, world.settings().step_secs());
    for _ in 0..120 {
        world.step();
        work_j += sum(&world.frame().characters[0], |spent| spent.pin).1 * step_secs;
    }
    let gained_j = world.energy_j(0);
    // Limp joints rub, as the arms and legs that are left behind turn.
    let share = gained_j / work_j;
    assert!(gained_j > 10.0 && (0.8..1.005).contains(&share), "{work_j} J of work, {gained_j} J gained");
}

#[test]
fn a_part_that_physics_does_not_move_bears_what_hangs_from_it() {
    let mut world = floating(9.81);
    world.set_forces(0, Node::Hips, false);
    settle(&mut world);
    let held = world.frame().characters[0].spent[Node::Hips.index()].held;
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
    let held = |node: Node, prop: usize| Held {
        character: 0,
        node,
        object: Entity::Prop(prop),
        soft: false,
        break_force_n: None,
    };
    world.attach(held(Node::LeftHand, wall));
    world.attach(held(Node::RightHand, ball));
    common::hold(&mut world, 0, 4.0);
    // It swings by its hand: the mean counts.
    let (mut bears_n, steps) = (0.0, 2400);
    for _ in 0..steps {
        world.step();
        let spent = &world.frame().characters[0].spent;
        bears_n += spent[Node::LeftHand.index()].held.force.y / f64::from(steps);
        assert_eq!(spent[Node::RightHand.index()].held.force, DVec3::ZERO);
    }
    let weight_n = WEIGHT_N + 9.81;
    assert!((bears_n - weight_n).abs() < 0.1 * weight_n, "{bears_n} N");
}

#[test]
fn a_plane_takes_up_what_pushes_across_it() {
    let mut world = floating(0.0);
    world.hold_to_plane(0, DVec3::Z);
    for _ in 0..60 {
        world.push_part(0, Node::Chest, DVec3::X * 100.0, None);
        world.step();
    }
    let (force, power_w) = sum(&world.frame().characters[0], |spent| spent.held);
    assert!((force.x + 100.0).abs() < 10.0, "{force}");
    assert!(power_w.abs() < 0.1, "{power_w}");
}
