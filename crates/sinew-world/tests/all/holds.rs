//! Planes, attachments, switched forces, gravity: the world's modified physics.
#![allow(clippy::unwrap_used, reason = "tests")]

use crate::common;

use crate::common::{adult, fallen, hold, lifted, prone, spec, standing, steps};
use glam::DVec3;
use sinew_body::humanoid::{Node, Pose, exp, log};
use sinew_world::{
    CharacterId, CharacterSpec, Entity, Form, Held, Motion, PropId, PropSpec, Solid, World, WorldSettings,
};

fn held(object: Entity, soft: bool, break_force_n: Option<f64>) -> Held {
    Held { character: CharacterId::first_in(0), node: Node::RightHand, object, soft, break_force_n }
}

/// A world without floor or weight, a standing body, and a ball beside its right hand.
fn with_ball(mass_kg: f64, gravity_m_s2: f64) -> World {
    let body = adult();
    let mut world = World::new(WorldSettings { gravity_m_s2, floor: None, ..WorldSettings::default() });
    world.add_character(spec(&body, Pose::STANDING)).unwrap();
    let hand = world.frame().characters[0].part(Node::RightHand).position;
    let ball = Solid::new(Form::Ball { radius_m: 0.1 });
    let place = hand + DVec3::new(-0.15, -0.05, 0.0);
    world.add_prop(PropSpec::new(ball, Motion::Dynamic { mass_kg }, place)).unwrap();
    world
}

/// Where the ball is in the hand's frame.
fn in_hand(world: &World) -> DVec3 {
    let hand = world.frame().characters[0].part(Node::RightHand);
    hand.rotation.conjugate() * (world.frame().props[0].position - hand.position)
}

#[test]
fn a_body_in_a_plane_stays_in_it_to_a_millimetre_and_a_fifth_of_a_degree() {
    let body = adult();
    let mut world = World::new(WorldSettings::default());
    let facing = DVec3::new(0.6, 0.0, 0.8);
    let mut pose = common::turned(exp(DVec3::Y * libm::atan2(0.6, 0.8)));
    pose.hips_position.y = standing(&body).hips_position.y;
    world.add_character(CharacterSpec { velocity: facing * 1.2, ..spec(&body, pose) }).unwrap();
    world.hold_to_plane(CharacterId::first_in(0), facing);
    assert!(world.is_held_to_plane(CharacterId::first_in(0)));
    let normal = DVec3::Y.cross(facing);
    let start = world.frame().characters[0].clone();
    let (mut off_m, mut off_rad): (f64, f64) = (0.0, 0.0);
    for step in 0..480 {
        // Pushed across it, too.
        if step < 60 {
            world.push_part(CharacterId::first_in(0), Node::Chest, normal * 80.0, None);
        }
        world.step();
        for node in Node::ALL {
            let (part, before) = (world.frame().characters[0].part(node), start.part(node));
            off_m = off_m.max((part.centre - before.centre).dot(normal).abs());
            let turn = log(part.rotation * before.rotation.conjugate());
            // What is left of the turn after the turn about the normal.
            let axis = part.rotation * before.rotation.conjugate() * normal;
            off_rad = off_rad.max(axis.cross(normal).length());
            assert!(turn.is_finite());
        }
    }
    assert!(world.frame().characters[0].parts[0].position.y < 0.5, "it has fallen");
    assert!(off_m < 1e-3, "{off_m} m across the plane");
    // A tenth while it falls, a fifth when it hits the floor.
    assert!(off_rad.to_degrees() < 0.2, "{} degrees", off_rad.to_degrees());
    world.free_from_plane(CharacterId::first_in(0));
    assert!(!world.is_held_to_plane(CharacterId::first_in(0)));
    world.push_part(CharacterId::first_in(0), Node::Chest, normal * 2000.0, None);
    world.step();
    assert!(world.frame().characters[0].centre_velocity.dot(normal).abs() > 0.02);
}

#[test]
fn a_symmetric_fall_in_a_plane_is_the_fall_without_it() {
    let body = adult();
    let fall = |plane: bool| {
        let mut world = World::new(WorldSettings::default());
        world.add_character(CharacterSpec { velocity: DVec3::Z * -1.0, ..spec(&body, standing(&body)) }).unwrap();
        hold(&mut world, CharacterId::first_in(0), 3.0);
        if plane {
            world.hold_to_plane(CharacterId::first_in(0), DVec3::Z);
        }
        (0..140)
            .map(|_| {
                world.step();
                world.frame().characters[0].part(Node::Head).position
            })
            .collect::<Vec<_>>()
    };
    let (flat, free) = (fall(true), fall(false));
    let apart = flat.iter().zip(&free).map(|(a, b)| (*a - *b).length()).fold(0.0, f64::max);
    let way = (free[139] - free[0]).length();
    // Free, the two sides differ by the order in which the solver takes them.
    assert!(way > 0.3, "{way}");
    assert!(apart < 0.03 * way, "{apart} m apart on a way of {way} m");
}

#[test]
fn a_hard_hold_keeps_its_place_in_the_hand_and_weighs() {
    let mut world = with_ball(3.0, 9.81);
    let before = in_hand(&world);
    world.attach(held(Entity::Prop(PropId::first_in(0)), false, None));
    assert!(world.is_attached(CharacterId::first_in(0), Node::RightHand, Entity::Prop(PropId::first_in(0))));
    // Attached twice is attached once.
    world.attach(held(Entity::Prop(PropId::first_in(0)), false, None));
    assert_eq!(world.held().count(), 1);
    let mut gap: f64 = 0.0;
    for step in 0..480 {
        if step % 100 < 20 {
            world.push_prop(PropId::first_in(0), DVec3::new(60.0, 0.0, 60.0), None);
        }
        world.step();
        gap = gap.max((in_hand(&world) - before).length());
    }
    // As much as the joints of a body in a fall.
    assert!(gap < 0.01, "the ball moved in the hand by {gap} m");
    world.detach(CharacterId::first_in(0), Node::RightHand, Entity::Prop(PropId::first_in(0)));
    assert!(!world.is_attached(CharacterId::first_in(0), Node::RightHand, Entity::Prop(PropId::first_in(0))));
    for _ in 0..48 {
        world.push_prop(PropId::first_in(0), DVec3::X * -100.0, None);
        world.step();
    }
    assert!((in_hand(&world) - before).length() > 0.1, "it is free again");
}

#[test]
fn a_soft_hold_gives_and_comes_back() {
    let mut world = with_ball(1.0, 0.0);
    let before = in_hand(&world);
    world.attach(held(Entity::Prop(PropId::first_in(0)), true, None));
    let mut farthest: f64 = 0.0;
    for step in 0..720 {
        if step < 24 {
            world.push_prop(PropId::first_in(0), DVec3::X * -30.0, None);
        }
        world.step();
        farthest = farthest.max((in_hand(&world) - before).length());
    }
    // 30 N on 1 kg at 4 Hz: 5 cm when it hangs, more for the swing of the arm.
    assert!(farthest > 0.01 && farthest < 0.15, "{farthest} m");
    assert!((in_hand(&world) - before).length() < 0.01, "{}", in_hand(&world) - before);
}

#[test]
fn a_hold_breaks_above_its_force_and_not_below() {
    // The hand stands still, so the hold bears the pull, which grows within half a second.
    let pull = |force: f64, soft: bool| {
        let mut world = with_ball(0.2, 0.0);
        world.set_forces(CharacterId::first_in(0), Node::RightHand, false);
        world.attach(held(Entity::Prop(PropId::first_in(0)), soft, Some(100.0)));
        for step in 0..240 {
            world.push_prop(PropId::first_in(0), DVec3::Y * -force * (f64::from(step) / 120.0).min(1.0), None);
            world.step();
        }
        !world.is_attached(CharacterId::first_in(0), Node::RightHand, Entity::Prop(PropId::first_in(0)))
    };
    for soft in [false, true] {
        assert!(!pull(95.0, soft), "soft {soft}: breaks at 95 N");
        assert!(pull(105.0, soft), "soft {soft}: holds 105 N");
    }
}

#[test]
fn a_part_can_hold_another_characters_part() {
    let body = adult();
    let mut world = World::new(WorldSettings { gravity_m_s2: 0.0, floor: None, ..WorldSettings::default() });
    world.add_character(spec(&body, Pose::STANDING)).unwrap();
    let mut beside = Pose::STANDING;
    beside.hips_position = DVec3::new(-0.65, 0.0, 0.0);
    world.add_character(spec(&body, beside)).unwrap();
    let object = Entity::Part(CharacterId::first_in(1), Node::LeftHand);
    world.attach(held(object, false, None));
    for _ in 0..600 {
        world.push_part(CharacterId::first_in(0), Node::Hips, DVec3::X * 50.0, None);
        world.step();
    }
    // The second is drawn along, and the hands stay together.
    let [one, other] = [0, 1].map(|index| &world.frame().characters[index]);
    println!("{} {}", one.centre_velocity, other.centre_velocity);
    assert!(other.centre_of_mass.x > -0.6, "{}", other.centre_of_mass);
}

#[test]
fn without_forces_a_part_drifts_on_and_stops_and_with_them_goes_on_without_a_jump() {
    let body = adult();
    let mut world = World::new(WorldSettings { floor: None, gravity_m_s2: 0.0, ..WorldSettings::default() });
    world.add_character(CharacterSpec { velocity: DVec3::Z * 2.0, ..spec(&body, Pose::STANDING) }).unwrap();
    hold(&mut world, CharacterId::first_in(0), 4.0);
    steps(&mut world, 0.1);
    world.set_forces(CharacterId::first_in(0), Node::Hips, false);
    let mut before = world.frame().characters[0].part(Node::Hips).velocity.z;
    let mut speeds = Vec::new();
    for _ in 0..240 {
        world.step();
        let speed = world.frame().characters[0].part(Node::Hips).velocity.z;
        // The body's swing moves it no more.
        assert!(speed <= before + 1e-9, "{before} {speed}");
        before = speed;
        speeds.push(speed);
    }
    // It falls to 1/e in 0.12 s.
    let ratio = speeds[58] / speeds[0];
    assert!((ratio - libm::exp(-58.0 / 240.0 / 0.12)).abs() < 0.02, "{ratio}");
    assert!(speeds[239] < 0.01);
    let still = world.frame().characters[0].part(Node::Hips).position;
    world.push_part(CharacterId::first_in(0), Node::Hips, DVec3::X * 1000.0, None);
    world.step();
    assert!((world.frame().characters[0].part(Node::Hips).position - still).x.abs() < 1e-6, "no force moves it");
    world.set_forces(CharacterId::first_in(0), Node::Hips, true);
    world.step();
    let part = world.frame().characters[0].part(Node::Hips);
    assert!((part.position - still).length() < 2e-3 && part.velocity.length() < 0.3, "{part:?}");
    world.push_part(CharacterId::first_in(0), Node::Hips, DVec3::X * 1000.0, None);
    world.step();
    assert!(world.frame().characters[0].centre_velocity.x > 0.03, "forces move it again");
}

#[test]
fn a_hung_body_stays_up_while_its_hips_have_no_forces() {
    let body = adult();
    let mut world = World::new(WorldSettings::default());
    world.add_character(spec(&body, lifted(&body, prone(), 1.0))).unwrap();
    world.set_forces(CharacterId::first_in(0), Node::Hips, false);
    steps(&mut world, 2.0);
    assert!(world.frame().characters[0].part(Node::Hips).position.y > 1.0);
    // Its limbs hang on limp joints meanwhile.
    assert!(world.largest_joint_gap_m() < 0.005, "{}", world.largest_joint_gap_m());
    world.set_forces(CharacterId::first_in(0), Node::Hips, true);
    steps(&mut world, 2.0);
    assert!(world.frame().characters[0].part(Node::Hips).position.y < 0.4);
}

#[test]
fn gravity_is_each_characters_own() {
    let body = adult();
    let mut world = World::new(WorldSettings { floor: None, ..WorldSettings::default() });
    for one in 0..3 {
        let mut pose = Pose::STANDING;
        pose.hips_position.x = 5.0 * f64::from(one);
        world.add_character(spec(&body, pose)).unwrap();
    }
    world.set_gravity(CharacterId::first_in(1), 0.0);
    world.set_gravity(CharacterId::first_in(2), -0.5);
    steps(&mut world, 0.5);
    for (index, scale) in [1.0, 0.0, -0.5].into_iter().enumerate() {
        let speed = world.frame().characters[index].centre_velocity.y;
        assert!((speed + 9.81 * 0.5 * scale).abs() < 1e-6, "{index}: {speed}");
    }
    world.set_gravity(CharacterId::first_in(0), 0.0);
    let before = world.frame().characters[0].centre_velocity.y;
    steps(&mut world, 0.25);
    assert!((world.frame().characters[0].centre_velocity.y - before).abs() < 1e-6);
}

#[test]
fn a_moved_part_is_where_it_was_told_and_the_rest_follows() {
    let body = adult();
    let mut world = fallen(&body, Pose::STANDING, DVec3::ZERO);
    world.set_gravity(CharacterId::first_in(0), 0.0);
    for step in 0..240 {
        let place = DVec3::new(0.0, 2.0, f64::from(step) / 240.0);
        world.move_part(CharacterId::first_in(0), Node::Hips, place, exp(DVec3::Y * f64::from(step) * 0.004));
        world.step();
        if step > 0 {
            assert!((world.frame().characters[0].part(Node::Hips).position - place).length() < 1e-9);
        }
    }
    let one = &world.frame().characters[0];
    assert!((one.part(Node::Hips).velocity.z - 1.0).abs() < 0.1, "{}", one.part(Node::Hips).velocity);
    assert!(world.largest_joint_gap_m() < 0.005);
    // Free again it goes on with its speed.
    world.set_forces(CharacterId::first_in(0), Node::Hips, true);
    world.step();
    assert!(world.frame().characters[0].part(Node::Hips).velocity.z > 0.5);
}
