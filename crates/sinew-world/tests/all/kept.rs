//! Worlds that are kept and put back, and things that come and go.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use super::common;
use common::{Rng, adult, hold, lifted, odd_pose, spec, standing};
use glam::DVec3;
use sinew_body::humanoid::Node;
use sinew_snapshot::FrameKind;
use sinew_world::{
    Aim, CharacterId, Entity, Form, Held, Motion, Motor, PartShape, PropId, PropJointId, PropJointKind, PropJointSpec,
    PropSpec, Solid, SpecError, World, WorldSettings,
};

fn ball(position: DVec3) -> PropSpec {
    PropSpec::new(Solid::new(Form::Ball { radius_m: 0.12 }), Motion::Dynamic { mass_kg: 0.6 }, position)
}

fn slab(position: DVec3, motion: Motion) -> PropSpec {
    PropSpec::new(Solid::new(Form::Box { size_m: DVec3::new(1.0, 0.2, 1.0) }), motion, position)
}

fn fastened(between: [Entity; 2], at: DVec3, kind: PropJointKind) -> PropJointSpec {
    PropJointSpec { between, anchors: [at; 2], kind, motor: None, break_force_n: None, touches: false }
}

const KIND: FrameKind = FrameKind { magic: *b"TEST", version: 1 };

/// Characters that stand, fall, lie in a plane and hold; joints that turn, bear and break; shapes, a sensor, a vacant slot.
fn busy() -> World {
    let mut world = unstepped();
    (0..30).for_each(|_| world.step());
    world.remove_character(CharacterId::first_in(1)).unwrap();
    world
}

fn unstepped() -> World {
    let body = adult();
    let mut world = World::new(WorldSettings::default());
    let one = world.add_character(spec(&body, standing(&body))).unwrap();
    hold(&mut world, one, 3.0);
    world.add_character(spec(&body, lifted(&body, odd_pose(&body, 1, 0.7), 2.0))).unwrap();
    let mut aside = lifted(&body, odd_pose(&body, 2, 0.7), 0.4);
    aside.hips_position.x += 0.3;
    let two = world.add_character(spec(&body, aside)).unwrap();
    let mut flat = standing(&body);
    flat.hips_position.x = -3.0;
    let three = world.add_character(spec(&body, flat)).unwrap();
    world.hold_to_plane(three, DVec3::new(0.3, 0.0, 1.0));
    let hand = world.frame().character(one).unwrap().part(Node::LeftHand).position;
    let bag = world.add_prop(ball(hand - DVec3::Y * 0.3)).unwrap();
    world.attach(Held {
        character: one,
        node: Node::LeftHand,
        object: Entity::Prop(bag),
        soft: true,
        break_force_n: None,
    });
    let sensor = PropSpec { is_sensor: true, ..slab(DVec3::Y * 0.5, Motion::Fixed) };
    world.add_prop(sensor).unwrap();
    let wheel = world.add_prop(slab(DVec3::new(3.0, 2.0, 0.0), Motion::Dynamic { mass_kg: 2.0 })).unwrap();
    let hinge = PropJointKind::Hinge { axis: DVec3::Z, range: None };
    let driven = PropJointSpec {
        motor: Some(Motor { aim: Aim::Speed(3.0), strength: 20.0 }),
        ..fastened([Entity::Floor, Entity::Prop(wheel)], DVec3::new(3.0, 2.0, 0.0), hinge)
    };
    world.add_prop_joint(driven).unwrap();
    let bob = world.add_prop(ball(DVec3::new(4.0, 3.0, 0.0))).unwrap();
    let weak = fastened([Entity::Floor, Entity::Prop(bob)], DVec3::new(4.5, 3.0, 0.0), PropJointKind::Ball);
    world.add_prop_joint(PropJointSpec { break_force_n: Some(12.0), ..weak }).unwrap();
    world.add_shape(two, Node::RightHand, "racket", &Solid::new(Form::Ball { radius_m: 0.15 })).unwrap();
    world.set_forces(two, Node::Hips, false);
    world
}

/// Steps on, with things happening; the hash of every step.
fn run(world: &mut World, steps: usize) -> Vec<u64> {
    let hash = |at: usize| {
        if at == 20 {
            world.set_forces(CharacterId::first_in(2), Node::Hips, true);
        }
        world.push_part(CharacterId::first_in(0), Node::Chest, DVec3::new(150.0, 0.0, 0.0), None);
        world.step();
        world.hash()
    };
    (0..steps).map(hash).collect()
}

#[test]
fn a_clone_that_is_put_back_gives_the_same_hash_at_every_step() {
    let mut world = busy();
    for _ in 0..4 {
        let kept = world.clone();
        let once = run(&mut world, 60);
        // The world goes somewhere else before it is put back.
        world.set_limp(CharacterId::first_in(0));
        world.remove_prop(PropId::first_in(0)).unwrap();
        (0..10).for_each(|_| world.step());
        world = kept;
        assert_eq!(once, run(&mut world, 60));
    }
    assert!(!world.prop_joint(PropJointId::first_in(1)).is_whole, "the weak joint broke on the way");
}

#[test]
fn bytes_put_into_another_world_that_was_built_alike_give_the_same_hash_at_every_step() {
    // Before the first step, in the middle, and right after a joint broke and a shape was changed.
    let mut world = unstepped();
    world.set_shape(CharacterId::first_in(0), Node::Head, PartShape::None).unwrap();
    let mut last = world.frame().step;
    for steps in [0, 1, 40, 40, 40, 40, 40] {
        (0..steps).for_each(|_| world.step());
        if steps == 1 {
            world.remove_character(CharacterId::first_in(1)).unwrap();
            world.step();
        }
        let was_whole = world.prop_joint(PropJointId::first_in(1)).is_whole;
        let bytes = KIND.save(&world);
        let mut other = unstepped();
        (0..last % 7).for_each(|_| other.step());
        KIND.restore(&mut other, &bytes).unwrap();
        assert_eq!(other.frame(), world.frame());
        assert!(KIND.save(&other) == bytes, "what was restored is saved to the same bytes");
        assert_eq!(run(&mut other, 90), run(&mut world.clone(), 90), "from step {}", world.frame().step);
        last = world.frame().step;
        assert!(steps != 40 || was_whole || !world.prop_joint(PropJointId::first_in(1)).is_whole);
        world
            .add_shape(CharacterId::first_in(0), Node::Head, "hat", &Solid::new(Form::Ball { radius_m: 0.2 }))
            .unwrap();
    }
    assert!(!world.prop_joint(PropJointId::first_in(1)).is_whole, "the weak joint broke on the way");
}

#[test]
fn bytes_of_the_step_in_which_a_joint_breaks_give_the_same_hash_at_every_step() {
    let mut world = unstepped();
    while world.prop_joint(PropJointId::first_in(1)).is_whole {
        assert!(world.frame().step < 400, "it breaks");
        world.step();
    }
    let mut other = unstepped();
    KIND.restore(&mut other, &KIND.save(&world)).unwrap();
    // Until what was held has come to rest: islands that stayed joined would keep it awake.
    assert_eq!(run(&mut other, 1200), run(&mut world, 1200));
}

#[test]
fn what_is_removed_is_let_go_of_and_its_id_is_stale() {
    let mut world = busy();
    let (one, bag) = (CharacterId::first_in(0), PropId::first_in(0));
    let hinge = PropJointId::first_in(0);
    world.remove_prop(bag).unwrap();
    assert_eq!(world.held().count(), 0);
    assert_eq!(world.remove_prop(bag), Err(SpecError::StaleProp(bag)));
    assert!(world.prop_joint(hinge).is_whole);
    world.remove_prop(PropId::first_in(2)).unwrap();
    assert!(!world.prop_joint(hinge).is_whole, "what it fastened is gone");
    world.remove_prop_joint(hinge).unwrap();
    assert_eq!(world.remove_prop_joint(hinge), Err(SpecError::StalePropJoint(hinge)));
    world.remove_character(one).unwrap();
    assert!(world.frame().character(one).is_none() && world.body(one).is_none());
    let parts = |entity: Entity| matches!(entity, Entity::Part(owner, _) if owner == one);
    assert!(world.frame().contacts.iter().all(|contact| !parts(contact.a) && !parts(contact.b)));
    world.set_limp(one);
    assert_eq!(world.stale_calls(), 1);
    (0..60).for_each(|_| world.step());
    let body = adult();
    let again = world.add_character(spec(&body, standing(&body))).unwrap();
    assert_eq!((again.slot(), again.generation()), (0, 1));
    world.step();
    assert!(world.frame().character(one).is_none() && world.frame().character(again).is_some());
}

#[test]
fn what_rested_on_a_removed_prop_falls() {
    let mut world = World::new(WorldSettings::default());
    let under = world.add_prop(slab(DVec3::Y * 0.5, Motion::Fixed)).unwrap();
    let over = world.add_prop(slab(DVec3::Y * 0.7, Motion::Dynamic { mass_kg: 1.0 })).unwrap();
    // Long enough to fall asleep.
    (0..1200).for_each(|_| world.step());
    world.remove_prop(under).unwrap();
    (0..120).for_each(|_| world.step());
    let height_m = world.frame().prop(over).unwrap().position.y;
    // Half its thickness over the floor, and a millimetre of sinking in.
    assert!((height_m - 0.1).abs() < 1e-3, "{height_m}");
}

#[test]
fn things_come_and_go_in_any_order_and_the_rest_goes_on() {
    let body = adult();
    for seed in 0..6 {
        let mut rng = Rng::new(seed + 1);
        let mut world = World::new(WorldSettings::default());
        let stays = world.add_character(spec(&body, standing(&body))).unwrap();
        hold(&mut world, stays, 3.0);
        let (mut characters, mut props) = (Vec::new(), Vec::new());
        for _ in 0..60 {
            let place = rng.vector() * 0.5 + DVec3::new(0.0, 1.2, 0.0);
            match (rng.unit() * 6.0) as usize {
                0 if characters.len() < 4 => {
                    let mut pose = lifted(&body, odd_pose(&body, (rng.unit() * 1e6) as u64, 0.7), 0.3);
                    pose.hips_position += DVec3::new(place.x, 0.0, place.z);
                    characters.push(world.add_character(spec(&body, pose)).unwrap());
                }
                1 => props.push(world.add_prop(ball(place)).unwrap()),
                2 if !characters.is_empty() => {
                    let at = (rng.unit() * characters.len() as f64) as usize;
                    world.remove_character(characters.swap_remove(at)).unwrap();
                }
                3 if !props.is_empty() => {
                    let at = (rng.unit() * props.len() as f64) as usize;
                    world.remove_prop(props.swap_remove(at)).unwrap();
                }
                4 if !props.is_empty() => {
                    let object = Entity::Prop(props[0]);
                    let holder = *characters.first().unwrap_or(&stays);
                    let held =
                        Held { character: holder, node: Node::LeftHand, object, soft: false, break_force_n: None };
                    world.attach(held);
                    let ground = fastened([Entity::Floor, object], place, PropJointKind::Ball);
                    world.add_prop_joint(ground).unwrap();
                }
                _ => {}
            }
            (0..4).for_each(|_| world.step());
            let frame = world.frame();
            assert!(frame.character(stays).unwrap().parts[0].position.is_finite());
            assert_eq!(frame.character_ids.iter().flatten().count(), characters.len() + 1);
            assert_eq!(frame.prop_ids.iter().flatten().count(), props.len());
            for contact in &frame.contacts {
                for entity in [contact.a, contact.b] {
                    match entity {
                        Entity::Floor => {}
                        Entity::Prop(prop) => assert!(frame.prop(prop).is_some(), "{contact:?}"),
                        Entity::Part(owner, _) => assert!(frame.character(owner).is_some(), "{contact:?}"),
                    }
                }
            }
        }
        assert_eq!(world.stale_calls(), 0);
    }
}

#[test]
fn a_world_can_be_sent_and_shared_between_threads() {
    fn is<T: Send + Sync>() {}
    is::<World>();
}

#[test]
fn what_came_and_went_before_the_first_step_changes_no_motion() {
    let body = adult();
    let run = |guest: bool| {
        let mut world = World::new(WorldSettings::default());
        let one = world.add_character(spec(&body, standing(&body))).unwrap();
        hold(&mut world, one, 3.0);
        if guest {
            let character = world.add_character(spec(&body, lifted(&body, odd_pose(&body, 3, 0.7), 0.5))).unwrap();
            let prop = world.add_prop(ball(DVec3::Y * 0.5)).unwrap();
            world.remove_character(character).unwrap();
            world.remove_prop(prop).unwrap();
        }
        world.add_prop(PropSpec { velocity: DVec3::NEG_Z * 4.0, ..ball(DVec3::new(0.0, 1.2, 2.0)) }).unwrap();
        (0..240).for_each(|_| world.step());
        let frame = world.frame();
        let parts = frame.characters[one.slot()].parts.iter().chain(&frame.props[..1]);
        parts.flat_map(|part| part.position.to_array()).map(f64::to_bits).collect::<Vec<_>>()
    };
    assert!(run(false) == run(true));
}
