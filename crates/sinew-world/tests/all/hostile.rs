//! Nothing that is stated from outside makes the world panic, hang or return NaN or infinity.
#![allow(clippy::unwrap_used, reason = "tests")]

use crate::common::{adult, hold, spec, standing, steps, supine};
use glam::{DQuat, DVec3};
use sinew_body::humanoid::{Body, Node};
use sinew_world::{
    CharacterId, CharacterSpec, Drive, Entity, Form, Frame, Held, MAX_FORCE_N, Motion, PartShape, Pin, PropId,
    PropSpec, Solid, SpecError, Surface, World, WorldSettings,
};

/// Numbers that no file should contain.
const BAD: [f64; 7] = [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 1e300, -1e300, f64::MAX, 5e-324];

fn assert_finite(frame: &Frame) {
    let parts = frame.characters.iter().flat_map(|one| &one.parts);
    for body in parts.chain(&frame.props) {
        let sound = body.position.is_finite()
            && body.rotation.is_finite()
            && body.centre.is_finite()
            && body.velocity.is_finite()
            && body.angular_velocity.is_finite();
        assert!(sound, "{body:?} at step {}", frame.step);
        assert!(body.position.length() < 2e4, "{body:?}");
    }
    for one in &frame.characters {
        assert!(one.centre_of_mass.is_finite() && one.centre_velocity.is_finite() && one.facing.is_finite());
        assert!(one.support.iter().all(|corner| corner.is_finite()));
    }
    for contact in &frame.contacts {
        assert!(contact.point.is_finite() && contact.impulse.is_finite(), "{contact:?}");
    }
}

fn pin(position: DVec3) -> Pin {
    Pin {
        position,
        stiffness: 1e3,
        damping: 50.0,
        turn_stiffness: 1e3,
        turn_damping: 50.0,
        gravity_share: 1.0,
        max_force_n: 1e4,
        ..Pin::LOOSE
    }
}

/// A world with a standing character, another far away, and a ball.
fn two() -> World {
    let body = adult();
    let mut world = World::new(WorldSettings::default());
    world.add_character(spec(&body, standing(&body))).unwrap();
    let mut far = standing(&body);
    // Farther than anything gets in a second.
    far.hips_position += DVec3::new(-3000.0, 0.0, 3000.0);
    world.add_character(CharacterSpec { velocity: DVec3::Z * 1.4, ..spec(&body, far) }).unwrap();
    let ball = Solid::new(Form::Ball { radius_m: 0.12 });
    world.add_prop(PropSpec::new(ball, Motion::Dynamic { mass_kg: 0.6 }, DVec3::new(0.0, 1.0, 1.0))).unwrap();
    hold(&mut world, CharacterId::first_in(0), 3.0);
    world
}

/// Bits of the second character.
fn far_bits(world: &World) -> Vec<u64> {
    let parts = &world.frame().characters[1].parts;
    parts.iter().flat_map(|part| [part.position, part.velocity]).flat_map(|v| v.to_array().map(f64::to_bits)).collect()
}

/// Steps that a hostile input is given, and all steps of its run.
const WRONG_STEPS: u32 = 40;
const ALL_STEPS: u32 = 100;

/// Does something to the first character or the ball at every step for a while; all stays finite, and the second character goes
/// its way as if nothing had been.
fn survives(name: &str, mut wrong: impl FnMut(&mut World, u32)) {
    static CALM: std::sync::OnceLock<Vec<Vec<u64>>> = std::sync::OnceLock::new();
    let calm = CALM.get_or_init(|| {
        let mut world = two();
        let step = |_| {
            world.step();
            far_bits(&world)
        };
        (0..ALL_STEPS).map(step).collect()
    });
    let mut world = two();
    for step in 0..ALL_STEPS {
        if step < WRONG_STEPS {
            wrong(&mut world, step);
        }
        world.step();
        assert_finite(world.frame());
        assert!(!world.frame().characters[1].was_reset, "{name}");
        assert!(
            far_bits(&world) == calm[step as usize],
            "{name}: the other character moved differently at step {step}"
        );
    }
}

#[test]
fn drives_of_any_numbers_leave_the_frame_finite_and_others_alone() {
    for bad in BAD {
        survives(&format!("rotation {bad}"), |world, _| {
            let rotation = DQuat::from_xyzw(bad, 0.0, 0.0, 1.0);
            world.set_drive(
                CharacterId::first_in(0),
                Node::Chest,
                Drive { rotation, stiffness: 100.0, ..Drive::limp(1.0) },
            );
        });
        survives(&format!("velocity {bad}"), |world, _| {
            world.set_drive(
                CharacterId::first_in(0),
                Node::LeftHand,
                Drive { velocity: DVec3::splat(bad), ..Drive::limp(10.0) },
            );
        });
        survives(&format!("torque {bad}"), |world, _| {
            world.set_drive(
                CharacterId::first_in(0),
                Node::Head,
                Drive { torque: DVec3::new(0.0, bad, 0.0), ..Drive::limp(1.0) },
            );
        });
        survives(&format!("gains {bad}"), |world, _| {
            world.set_drive(
                CharacterId::first_in(0),
                Node::RightFoot,
                Drive { stiffness: bad, damping: bad, ..Drive::limp(1.0) },
            );
        });
    }
    survives("rotation of length nothing", |world, _| {
        let rotation = DQuat::from_xyzw(0.0, 0.0, 0.0, 0.0);
        world.set_drive(CharacterId::first_in(0), Node::Chest, Drive { rotation, stiffness: 1e8, ..Drive::limp(1.0) });
    });
    survives("gains near the top, waving", |world, step| {
        for node in Node::ALL {
            let rotation = DQuat::from_rotation_x(if step % 2 == 0 { 3.0 } else { -3.0 });
            world.set_drive(CharacterId::first_in(0), node, Drive { rotation, stiffness: 9e8, ..Drive::limp(0.0) });
        }
    });
}

#[test]
fn pins_of_any_numbers_leave_the_frame_finite_and_others_alone() {
    for bad in BAD {
        survives(&format!("position {bad}"), |world, _| {
            world.set_pin(CharacterId::first_in(0), Node::Hips, Some(pin(DVec3::splat(bad))))
        });
        survives(&format!("velocity {bad}"), |world, _| {
            let pin = Pin { velocity: DVec3::X * bad, angular_velocity: DVec3::Y * bad, ..pin(DVec3::Y) };
            world.set_pin(CharacterId::first_in(0), Node::LeftHand, Some(pin));
        });
        survives(&format!("gains {bad}"), |world, _| {
            let pin = Pin { stiffness: bad, damping: bad, gravity_share: bad, max_force_n: bad, ..pin(DVec3::Y) };
            world.set_pin(CharacterId::first_in(0), Node::Chest, Some(pin));
        });
        survives(&format!("fed forward {bad}"), |world, _| {
            let pin = Pin { acceleration: DVec3::Y * bad, torque: DVec3::X * bad, ..pin(DVec3::Y) };
            world.set_pin(CharacterId::first_in(0), Node::Chest, Some(pin));
        });
    }
    survives("pulled about at any gain", |world, step| {
        let place = DVec3::new(if step % 2 == 0 { 900.0 } else { -900.0 }, 1.0, 0.0);
        world.set_pin(
            CharacterId::first_in(0),
            Node::Hips,
            Some(Pin { stiffness: 9e8, turn_stiffness: 9e8, max_force_n: f64::INFINITY, ..pin(place) }),
        );
    });
}

#[test]
fn forces_places_and_factors_of_any_numbers_leave_the_frame_finite_and_others_alone() {
    for bad in BAD {
        survives(&format!("push {bad}"), |world, _| {
            world.push_part(CharacterId::first_in(0), Node::Head, DVec3::new(bad, 1.0, 0.0), None);
            world.push_part(CharacterId::first_in(0), Node::Head, DVec3::X, Some(DVec3::splat(bad)));
            world.push_prop(PropId::first_in(0), DVec3::Y * bad, Some(DVec3::Y * bad));
        });
        survives(&format!("place {bad}"), |world, _| {
            world.place_prop(PropId::first_in(0), Some(DVec3::X * bad), None);
            world.place_prop(PropId::first_in(0), None, Some(DVec3::Y * bad));
            world.accelerate_prop(PropId::first_in(0), DVec3::Y * bad);
        });
        survives(&format!("move {bad}"), |world, _| {
            world.move_part(CharacterId::first_in(0), Node::Hips, DVec3::Z * bad, DQuat::IDENTITY);
            world.move_part(CharacterId::first_in(0), Node::Hips, DVec3::Y, DQuat::from_xyzw(bad, bad, 0.0, 0.0));
        });
        survives(&format!("gravity {bad}"), |world, _| {
            world.set_gravity(CharacterId::first_in(0), bad);
            world.set_prop_gravity(PropId::first_in(0), bad);
        });
        survives(&format!("plane {bad}"), |world, _| {
            world.hold_to_plane(CharacterId::first_in(0), DVec3::new(bad, 0.0, bad))
        });
        survives(&format!("spin {bad}"), |world, step| {
            if step == 0 {
                world.spin_character(CharacterId::first_in(0), DVec3::splat(bad));
            }
        });
    }
    survives("forces at the cap", |world, _| {
        for node in Node::ALL {
            world.push_part(CharacterId::first_in(0), node, DVec3::new(1.0, 1.0, 0.3) * MAX_FORCE_N, None);
        }
    });
    survives("a hand at the cap, back and forth", |world, step| {
        let sign = if step % 2 == 0 { 1.0 } else { -1.0 };
        world.push_part(CharacterId::first_in(0), Node::LeftHand, DVec3::X * sign * MAX_FORCE_N, None);
    });
    survives("a part moved far off while its neighbours are free", |world, step| {
        world.move_part(
            CharacterId::first_in(0),
            Node::Hips,
            DVec3::new(0.0, 1.0, f64::from(step % 2) * 200.0),
            DQuat::IDENTITY,
        );
    });
}

#[test]
fn stale_ids_change_nothing_and_are_an_error_or_counted() {
    let mut world = two();
    let hash = world.hash();
    world.set_drive(CharacterId::first_in(9), Node::Head, Drive::limp(1.0));
    world.set_pin(CharacterId::first_in(9), Node::Head, None);
    world.set_limp(CharacterId::first_in(9));
    world.set_forces(CharacterId::first_in(9), Node::Head, false);
    world.move_part(CharacterId::first_in(9), Node::Head, DVec3::ZERO, DQuat::IDENTITY);
    world.push_part(CharacterId::first_in(9), Node::Head, DVec3::X, None);
    world.push_prop(PropId::first_in(9), DVec3::X, None);
    world.place_prop(PropId::first_in(9), Some(DVec3::X), None);
    world.set_gravity(CharacterId::first_in(9), 0.0);
    world.set_prop_gravity(PropId::first_in(9), 0.0);
    world.hold_to_plane(CharacterId::first_in(9), DVec3::Z);
    world.free_from_plane(CharacterId::first_in(9));
    world.spin_character(CharacterId::first_in(9), DVec3::X);
    let held = Held {
        character: CharacterId::first_in(0),
        node: Node::LeftHand,
        object: Entity::Prop(PropId::first_in(9)),
        soft: false,
        break_force_n: None,
    };
    world.attach(held);
    world.attach(Held { character: CharacterId::first_in(9), object: Entity::Prop(PropId::first_in(0)), ..held });
    world.attach(Held { object: Entity::Part(CharacterId::first_in(0), Node::LeftHand), ..held });
    world.detach(CharacterId::first_in(9), Node::Head, Entity::Prop(PropId::first_in(9)));
    // All of the seventeen but one: that a part cannot hold itself has nothing to do with its id.
    assert_eq!(world.stale_calls(), 16);
    let stale = SpecError::StaleCharacter(CharacterId::first_in(9));
    assert_eq!(world.set_shape(CharacterId::first_in(9), Node::Head, PartShape::None), Err(stale));
    assert_eq!(world.held().count(), 0);
    assert_eq!(world.hash(), hash);
    assert!(world.body(CharacterId::first_in(9)).is_none());
    assert!(!world.is_asleep(CharacterId::first_in(9)));
    assert!(world.energy_j(CharacterId::first_in(9)) == 0.0);
    steps(&mut world, 0.1);
    assert_finite(world.frame());
}

#[test]
fn a_drop_from_a_kilometre_ends_on_the_floor() {
    let body = adult();
    let mut world = World::new(WorldSettings::default());
    let mut pose = supine();
    pose.hips_position.y = 1000.0;
    world.add_character(spec(&body, pose)).unwrap();
    for _ in 0..240 * 22 {
        world.step();
        assert_finite(world.frame());
    }
    let one = &world.frame().characters[0];
    // It fell for 14.3 s, hit with 140 m/s and had 7 s to come to rest.
    assert!(one.parts.iter().all(|part| part.centre.y > 0.0 && part.centre.y < 0.6), "{:?}", one.parts[0]);
    assert!(world.largest_joint_gap_m() < 1e-3);
}

#[test]
fn a_body_that_goes_wrong_is_reported_put_back_and_goes_on() {
    let body = adult();
    let mut world = World::new(WorldSettings { floor: None, gravity_m_s2: 0.0, ..WorldSettings::default() });
    let mut pose = standing(&body);
    pose.hips_position.x = 9_998.0;
    world.add_character(CharacterSpec { velocity: DVec3::X * 40.0, ..spec(&body, pose) }).unwrap();
    let mut resets = Vec::new();
    for _ in 0..240 {
        world.step();
        assert_finite(world.frame());
        if world.frame().characters[0].was_reset {
            resets.push(world.frame().step);
        }
    }
    // It left the world's 10 km after a twentieth of a second, and was put back once, at rest.
    assert_eq!(resets.len(), 1, "{resets:?}");
    assert!(world.frame().characters[0].centre_velocity.length() < 1e-6);
    assert!(world.frame().characters[0].parts[0].position.x < 1e4);
    world.push_part(CharacterId::first_in(0), Node::Chest, DVec3::X * -500.0, None);
    world.step();
    assert!(world.frame().characters[0].centre_velocity.x < -0.02, "it can be pushed again");
}

#[test]
fn bodies_props_and_settings_of_any_numbers_are_refused_or_brought_into_bounds() {
    let body = adult();
    let good = standing(&body);
    for bad in BAD {
        let mut world = World::new(WorldSettings {
            physics_hz: bad,
            gravity_m_s2: bad,
            solver_iterations: usize::MAX,
            solver_sweeps: 0,
            floor: Some(Surface { friction: bad, bounce: bad }),
        });
        assert!((60.0..=2000.0).contains(&world.settings().physics_hz));
        let mut pose = good;
        pose.hips_position.y = bad;
        let placed = world.add_character(spec(&body, pose));
        if bad.abs() > 1e4 || bad.is_nan() {
            assert_eq!(placed, Err(SpecError::NotFinite), "{bad}");
        }
        let mut pose = good;
        pose.world[3] = DQuat::from_xyzw(bad, bad, bad, bad);
        assert!(world.add_character(spec(&body, pose)).is_err());
        assert!(world.add_character(spec(&Body::standard(bad, 1.7), good)).is_err(), "mass {bad}");
        assert!(world.add_character(spec(&Body::standard(80.0, bad), good)).is_err(), "stature {bad}");
        for form in [
            Form::Ball { radius_m: bad },
            Form::Box { size_m: DVec3::new(1.0, bad, 1.0) },
            Form::Capsule { radius_m: bad, length_m: 1.0 },
            Form::Ring { radius_m: 1.0, tube_m: bad },
            Form::Mesh { points_m: vec![DVec3::splat(bad); 3], triangles: vec![[0, 1, 2]] },
            Form::Hull { points_m: vec![DVec3::splat(bad); 9] },
        ] {
            let prop = PropSpec::new(Solid::new(form.clone()), Motion::Fixed, DVec3::ZERO);
            // Three points within the smallest number of the origin are a mesh that nothing can touch.
            let tiny = matches!(form, Form::Mesh { .. }) && bad == 5e-324;
            assert!(tiny || world.add_prop(prop).is_err(), "{form:?}");
        }
        let ball = Solid::new(Form::Ball { radius_m: 0.1 });
        assert!(world.add_prop(PropSpec::new(ball.clone(), Motion::Dynamic { mass_kg: bad }, DVec3::Y)).is_err());
        let wrong = PropSpec {
            surface: Surface { friction: bad, bounce: bad },
            ..PropSpec::new(ball, Motion::Dynamic { mass_kg: 1.0 }, DVec3::Y)
        };
        assert!(world.add_prop(PropSpec { gravity_scale: bad, ..wrong.clone() }).is_ok() || !bad.is_finite());
        assert!(world.add_prop(wrong).is_ok());
        let name = format!("{bad}");
        for _ in 0..20 {
            world.step();
            assert_finite(world.frame());
        }
        assert!(world.frame().step == 20, "{name}");
    }
    let mut world = World::new(WorldSettings::default());
    let fixed = |form: Form| PropSpec::new(Solid::new(form), Motion::Fixed, DVec3::ZERO);
    // Flat, straight, single, empty hulls; meshes that point nowhere.
    let flat: Vec<DVec3> = (0..9).map(|at| DVec3::new(f64::from(at % 3), 0.0, f64::from(at / 3))).collect();
    let straight: Vec<DVec3> = (0..9).map(|at| DVec3::splat(f64::from(at))).collect();
    for points_m in [flat.clone(), straight, vec![DVec3::ONE], vec![]] {
        assert_eq!(world.add_prop(fixed(Form::Hull { points_m })), Err(SpecError::NoShape));
    }
    assert_eq!(
        world.add_prop(fixed(Form::Mesh { points_m: flat.clone(), triangles: vec![[0, 1, 99]] })),
        Err(SpecError::NoShape)
    );
    assert_eq!(
        world.add_prop(fixed(Form::Mesh { points_m: flat.clone(), triangles: vec![] })),
        Err(SpecError::NoShape)
    );
    let mesh = Form::Mesh { points_m: flat, triangles: vec![[0, 1, 4], [0, 4, 3]] };
    let dynamic = PropSpec::new(Solid::new(mesh.clone()), Motion::Dynamic { mass_kg: 1.0 }, DVec3::ZERO);
    assert_eq!(world.add_prop(dynamic), Err(SpecError::HollowMesh));
    assert!(world.add_prop(fixed(mesh)).is_ok());
    // A refused shape leaves the part as it was.
    let body = adult();
    world.add_character(spec(&body, standing(&body))).unwrap();
    let none = Solid::new(Form::Ball { radius_m: f64::NAN });
    assert_eq!(
        world.set_shape(CharacterId::first_in(0), Node::LeftFoot, PartShape::Other(none)),
        Err(SpecError::NoShape)
    );
    steps(&mut world, 0.1);
    assert_finite(world.frame());
}
