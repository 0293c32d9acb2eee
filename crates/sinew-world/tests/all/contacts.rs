//! What touches is told, with whom and how hard.
#![allow(clippy::unwrap_used, reason = "tests")]

use crate::common::{adult, fallen, floor_impulse, hold, lifted, prone, spec, standing, steps, supine};
use glam::DVec3;
use sinew_body::humanoid::{Node, support_margin_m};
use sinew_world::{
    CharacterId, Entity, Form, Motion, PartShape, PropId, PropSpec, Solid, Surface, World, WorldSettings,
};

fn crate_of(mass_kg: f64, position: DVec3) -> PropSpec {
    let solid = Solid::new(Form::Box { size_m: DVec3::splat(0.5) });
    PropSpec::new(solid, Motion::Dynamic { mass_kg }, position)
}

#[test]
fn what_lies_is_borne_by_its_contacts() {
    let body = adult();
    for pose in [supine(), prone()] {
        let mut world = fallen(&body, lifted(&body, pose, 0.02), DVec3::ZERO);
        steps(&mut world, 1.0);
        let mut borne = 0.0;
        for _ in 0..24 {
            world.step();
            borne += floor_impulse(&world, CharacterId::first_in(0));
        }
        let weight = body.mass_kg() * 9.81 * 0.1;
        // It still settles by a millimetre.
        assert!((borne - weight).abs() < 0.03 * weight, "{borne} N s against {weight}");
    }
}

#[test]
fn the_impulse_of_an_impact_is_the_momentum_that_it_ends() {
    let mut world = World::new(WorldSettings::default());
    world.add_prop(crate_of(10.0, DVec3::new(0.0, 1.25, 0.0))).unwrap();
    let mut given = 0.0;
    for _ in 0..240 {
        world.step();
        given += world.frame().contacts.iter().map(|contact| contact.impulse.y).sum::<f64>();
    }
    // It has fallen and come to rest: the floor gave what gravity gave in that second.
    let momentum = world.frame().props[0].velocity.y * 10.0;
    assert!((given - 98.1 - momentum).abs() < 1.0, "{given} N s");
    let contact = world.frame().contacts[0];
    assert_eq!((contact.a, contact.b), (Entity::Floor, Entity::Prop(PropId::first_in(0))));
    assert!(
        contact.point.y.abs() < 0.01 && contact.point.length() < 0.05,
        "in the middle of its sole: {}",
        contact.point
    );
}

#[test]
fn a_touch_begins_once_and_only_what_touches_is_told() {
    let mut world = World::new(WorldSettings::default());
    world.add_prop(crate_of(10.0, DVec3::new(0.0, 0.35, 0.0))).unwrap();
    world.add_prop(crate_of(10.0, DVec3::new(3.0, 2.0, 0.0))).unwrap();
    let mut begins = 0;
    for _ in 0..100 {
        world.step();
        begins += world.frame().touching(Entity::Prop(PropId::first_in(0))).filter(|contact| contact.begins).count();
    }
    assert_eq!(begins, 1);
    assert!(world.frame().are_touching(Entity::Prop(PropId::first_in(0)), Entity::Floor));
    assert!(!world.frame().are_touching(Entity::Prop(PropId::first_in(1)), Entity::Floor));
    assert!(!world.frame().are_touching(Entity::Prop(PropId::first_in(0)), Entity::Prop(PropId::first_in(1))));
    // Adding something does not make old touches new.
    world.add_prop(crate_of(1.0, DVec3::new(9.0, 2.0, 0.0))).unwrap();
    world.step();
    assert!(world.frame().touching(Entity::Prop(PropId::first_in(0))).all(|contact| !contact.begins));
}

#[test]
fn a_standing_body_touches_the_floor_with_its_feet_alone_and_stands_on_their_hull() {
    let body = adult();
    let mut world = World::new(WorldSettings::default());
    world.add_character(spec(&body, standing(&body))).unwrap();
    hold(&mut world, CharacterId::first_in(0), 3.0);
    steps(&mut world, 1.0);
    for contact in &world.frame().contacts {
        assert!(
            matches!(contact.b, Entity::Part(id, Node::LeftFoot | Node::RightFoot) if id == CharacterId::first_in(0)),
            "{contact:?}"
        );
    }
    let one = &world.frame().characters[0];
    assert!(one.support.len() >= 4, "{:?}", one.support);
    let inside = support_margin_m(&one.support, one.centre_of_mass);
    // The ankle stands a quarter of the foot's length before the heel.
    assert!(inside > 0.02, "margin {inside} m");
}

#[test]
fn neighbours_do_not_collide_and_a_standing_body_touches_itself_nowhere() {
    let body = adult();
    let mut world = World::new(WorldSettings { gravity_m_s2: 0.0, floor: None, ..WorldSettings::default() });
    world.add_character(spec(&body, standing(&body))).unwrap();
    steps(&mut world, 1.0);
    assert!(world.frame().contacts.is_empty(), "{:?}", world.frame().contacts);
    let still = world.frame().characters[0].parts.iter().map(|part| part.velocity.length()).fold(0.0, f64::max);
    assert!(still < 1e-9, "nothing pushes its parts apart: {still} m/s");
}

#[test]
fn arms_do_not_pass_through_the_trunk() {
    let body = adult();
    let mut world = World::new(WorldSettings { gravity_m_s2: 0.0, floor: None, ..WorldSettings::default() });
    world.add_character(spec(&body, standing(&body))).unwrap();
    // Both forearms pulled through the chest from the front.
    for _ in 0..240 {
        for node in [Node::LeftHand, Node::RightHand] {
            let (hand, chest) = (
                world.frame().characters[0].part(node).position,
                world.frame().characters[0].part(Node::Chest).centre + DVec3::Z * 0.0,
            );
            world.push_part(CharacterId::first_in(0), node, (chest - hand).normalize_or_zero() * 60.0, None);
            world.push_part(CharacterId::first_in(0), Node::Chest, (hand - chest).normalize_or_zero() * 60.0, None);
        }
        world.step();
    }
    let one = &world.frame().characters[0];
    for node in [Node::LeftHand, Node::RightHand] {
        let chest = one.part(Node::Chest);
        let local = chest.rotation.conjugate() * (one.part(node).centre - chest.position);
        let across = DVec3::new(local.x, 0.0, local.z).length();
        // The chest's radius is 12 cm, the hand's 3 cm; soft contacts give a centimetre.
        assert!(across > 0.12 || local.y > 0.3 || local.y < -0.1, "{node:?} is in the chest, {across} m from its axis");
    }
}

#[test]
fn a_sensor_tells_who_is_in_it_and_pushes_nobody() {
    let mut world = World::new(WorldSettings::default());
    let zone = Solid::new(Form::Box { size_m: DVec3::new(2.0, 0.2, 2.0) });
    let sensor = PropSpec { is_sensor: true, ..PropSpec::new(zone, Motion::Fixed, DVec3::new(0.0, 1.5, 0.0)) };
    world.add_prop(sensor).unwrap();
    world.add_prop(crate_of(5.0, DVec3::new(0.0, 3.0, 0.0))).unwrap();
    let mut free = World::new(WorldSettings::default());
    free.add_prop(crate_of(5.0, DVec3::new(0.0, 3.0, 0.0))).unwrap();
    let (mut inside, mut begins) = (0, 0);
    for _ in 0..240 {
        world.step();
        free.step();
        let told = world.frame().are_touching(Entity::Prop(PropId::first_in(0)), Entity::Prop(PropId::first_in(1)));
        let height = world.frame().props[1].position.y;
        inside += u32::from(told);
        begins += world
            .frame()
            .contacts
            .iter()
            .filter(|touch| touch.a == Entity::Prop(PropId::first_in(0)) && touch.begins)
            .count();
        // Half the box and half the zone; within a step's fall.
        if (height - 1.5).abs() < 0.32 {
            assert!(told, "not told at {height} m");
        } else if (height - 1.5).abs() > 0.38 {
            assert!(!told, "told at {height} m");
        }
        assert_eq!(world.frame().props[1].position, free.frame().props[0].position);
    }
    assert!(inside > 10);
    assert_eq!(begins, 1);
}

#[test]
fn smooth_feet_slide_and_rough_ones_stay() {
    let body = adult();
    let slide = |friction: f64| {
        let mut world =
            World::new(WorldSettings { floor: Some(Surface { friction, bounce: 0.0 }), ..WorldSettings::default() });
        let spec =
            sinew_world::CharacterSpec { surface: Surface { friction, bounce: 0.0 }, ..spec(&body, standing(&body)) };
        world.add_character(spec).unwrap();
        hold(&mut world, CharacterId::first_in(0), 4.0);
        steps(&mut world, 0.5);
        let start = world.frame().characters[0].part(Node::LeftFoot).position;
        for _ in 0..60 {
            world.push_part(CharacterId::first_in(0), Node::Hips, DVec3::X * 120.0, None);
            world.step();
        }
        (world.frame().characters[0].part(Node::LeftFoot).position - start).x
    };
    // 120 N on 785 N: a friction of 0.05 bears 39 N, one of 0.9 all of it.
    assert!(slide(0.05) > 0.015, "{}", slide(0.05));
    assert!(slide(0.9) < 0.005, "{}", slide(0.9));
}

#[test]
fn skis_hold_up_a_body_that_falls_without_them() {
    let body = adult();
    let lean = |skis: bool| {
        let mut world = World::new(WorldSettings::default());
        world.add_character(spec(&body, standing(&body))).unwrap();
        hold(&mut world, CharacterId::first_in(0), 6.0);
        if skis {
            for node in [Node::LeftFoot, Node::RightFoot] {
                let ski = Solid::new(Form::Box { size_m: DVec3::new(0.12, 0.03, 1.8) });
                let under = DVec3::new(0.0, -sinew_world::sole_m(&body, node) + 0.015, 0.05);
                world.set_shape(CharacterId::first_in(0), node, PartShape::Other(ski.at(under))).unwrap();
            }
        }
        steps(&mut world, 0.5);
        for _ in 0..120 {
            world.push_part(CharacterId::first_in(0), Node::Chest, DVec3::Z * 160.0, None);
            world.step();
        }
        steps(&mut world, 2.0);
        world.frame().characters[0].part(Node::Head).position.y
    };
    // Half a second of 160 N is 1 m/s, which carries a centre of mass 0.3 m on: beyond the toes, not beyond 0.9 m of ski.
    assert!(lean(true) > 1.3, "with skis the head is at {} m", lean(true));
    assert!(lean(false) < 0.9, "without it is at {} m", lean(false));
}

#[test]
fn a_part_without_a_shape_passes_through_and_its_own_comes_back() {
    let body = adult();
    let mut world = World::new(WorldSettings::default());
    world.add_character(spec(&body, standing(&body))).unwrap();
    hold(&mut world, CharacterId::first_in(0), 3.0);
    world.set_shape(CharacterId::first_in(0), Node::LeftFoot, PartShape::None).unwrap();
    steps(&mut world, 0.1);
    let touching = |world: &World| {
        world.frame().are_touching(Entity::Floor, Entity::Part(CharacterId::first_in(0), Node::LeftFoot))
    };
    assert!(!touching(&world));
    world.set_shape(CharacterId::first_in(0), Node::LeftFoot, PartShape::Own).unwrap();
    steps(&mut world, 0.2);
    assert!(touching(&world));
}

#[test]
fn a_platform_carries_what_lies_on_it_and_wakes_it() {
    let body = adult();
    let mut world = World::new(WorldSettings { floor: None, ..WorldSettings::default() });
    let deck = Solid::new(Form::Box { size_m: DVec3::new(6.0, 0.2, 6.0) });
    let surface = Surface { friction: 0.9, bounce: 0.0 };
    world.add_prop(PropSpec { surface, ..PropSpec::new(deck, Motion::Moving, DVec3::new(0.0, -0.1, 0.0)) }).unwrap();
    world.add_prop(PropSpec { surface, ..crate_of(20.0, DVec3::new(2.0, 0.26, 0.0)) }).unwrap();
    world.add_character(spec(&body, lifted(&body, supine(), 0.02))).unwrap();
    steps(&mut world, 5.0);
    assert!(world.is_asleep(CharacterId::first_in(0)));
    let place = |world: &World| {
        let (deck, one) = (&world.frame().props[0], &world.frame().characters[0]);
        (one.centre_of_mass - deck.position, world.frame().props[1].position - deck.position)
    };
    let (body_before, crate_before) = place(&world);
    // 2 m/s² ask for a friction of 0.2.
    world.accelerate_prop(PropId::first_in(0), DVec3::Z * 2.0);
    steps(&mut world, 0.5);
    world.accelerate_prop(PropId::first_in(0), DVec3::ZERO);
    steps(&mut world, 1.0);
    let (body_after, crate_after) = place(&world);
    let speed = world.frame().characters[0].centre_velocity;
    assert!((speed - DVec3::Z).length() < 0.02, "{speed}");
    // The limbs give a little when it starts.
    assert!((body_after - body_before).length() < 0.03, "{body_before} {body_after}");
    assert!((crate_after - crate_before).length() < 0.005, "{crate_before} {crate_after}");
}

#[test]
fn a_body_stands_on_a_platform_that_rises() {
    let body = adult();
    let mut world = World::new(WorldSettings { floor: None, ..WorldSettings::default() });
    let deck = Solid::new(Form::Box { size_m: DVec3::new(4.0, 0.2, 4.0) });
    world.add_prop(PropSpec::new(deck, Motion::Moving, DVec3::new(0.0, -0.1, 0.0))).unwrap();
    world.add_character(spec(&body, standing(&body))).unwrap();
    hold(&mut world, CharacterId::first_in(0), 4.0);
    steps(&mut world, 0.5);
    world.accelerate_prop(PropId::first_in(0), DVec3::Y * 2.0);
    steps(&mut world, 0.5);
    // The deck bears the weight and what lifts it.
    let mut borne = 0.0;
    for _ in 0..24 {
        world.step();
        borne += world.frame().touching(Entity::Prop(PropId::first_in(0))).map(|touch| touch.impulse.y).sum::<f64>();
    }
    let expected = body.mass_kg() * (9.81 + 2.0) * 0.1;
    assert!((borne - expected).abs() < 0.05 * expected, "{borne} N s against {expected}");
    let (deck, one) = (&world.frame().props[0], &world.frame().characters[0]);
    assert!((one.part(Node::LeftFoot).velocity - deck.velocity).length() < 0.05);
    assert!(one.part(Node::Head).position.y - deck.position.y > 1.4, "it still stands");
}

#[test]
fn a_fast_ball_does_not_pass_through_a_thin_wall_or_a_body() {
    let body = adult();
    let mut world = World::new(WorldSettings::default());
    let wall = Solid::new(Form::Box { size_m: DVec3::new(4.0, 4.0, 0.02) });
    world.add_prop(PropSpec::new(wall, Motion::Fixed, DVec3::new(0.0, 1.0, -5.0))).unwrap();
    let ball = Solid::new(Form::Ball { radius_m: 0.05 });
    let shot = PropSpec {
        velocity: DVec3::Z * -80.0,
        ..PropSpec::new(ball.clone(), Motion::Dynamic { mass_kg: 0.1 }, DVec3::new(0.0, 1.0, 0.0))
    };
    world.add_prop(shot).unwrap();
    world
        .add_character(spec(&body, {
            let mut pose = standing(&body);
            pose.hips_position.x = 5.0;
            pose
        }))
        .unwrap();
    let thrown = PropSpec {
        velocity: DVec3::Z * -40.0,
        ..PropSpec::new(ball, Motion::Dynamic { mass_kg: 0.4 }, DVec3::new(5.0, 1.25, 3.0))
    };
    world.add_prop(thrown).unwrap();
    let mut felt = 0.0;
    for _ in 0..60 {
        world.step();
        felt +=
            world.frame().touching(Entity::Prop(PropId::first_in(2))).map(|touch| touch.impulse.length()).sum::<f64>();
    }
    assert!(world.frame().props[1].position.z > -5.0, "{}", world.frame().props[1].position);
    assert!(world.frame().props[2].position.z > -0.1, "{}", world.frame().props[2].position);
    // 0.4 kg at 40 m/s are 16 N s, and a little more as it bounces.
    assert!(felt > 12.0 && felt < 26.0, "the chest feels {felt} N s");
}

#[test]
fn a_hand_passes_through_a_prop_that_it_still_touches() {
    let body = adult();
    let mut world = World::new(WorldSettings { gravity_m_s2: 0.0, ..WorldSettings::default() });
    world.add_character(spec(&body, standing(&body))).unwrap();
    let hand = world.frame().characters[0].part(Node::LeftHand).centre;
    // Beside the hand's middle, deep in it.
    let ball = Solid::new(Form::Ball { radius_m: 0.05 });
    let place = hand + DVec3::X * 0.03;
    world.add_prop(PropSpec::new(ball, Motion::Dynamic { mass_kg: 0.3 }, place)).unwrap();
    world.set_passes_prop(CharacterId::first_in(0), Node::LeftHand, PropId::first_in(0), true);
    steps(&mut world, 0.2);
    // To the last bit: nothing acts on it.
    assert_eq!(world.frame().props[0].position, place);
    assert!(
        world
            .frame()
            .are_touching(Entity::Part(CharacterId::first_in(0), Node::LeftHand), Entity::Prop(PropId::first_in(0)))
    );
}
