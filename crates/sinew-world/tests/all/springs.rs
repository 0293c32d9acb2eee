//! Springs of joints and pins hold at any gain.
#![allow(clippy::unwrap_used, reason = "tests")]

use crate::common;

use crate::common::{adult, floor_impulse, hold, spec, standing, steps};
use glam::DVec3;
use sinew_body::humanoid::{Node, exp, log};
use sinew_world::{CharacterId, Drive, Pin, World, WorldSettings};

fn floating() -> World {
    let body = adult();
    let mut world = World::new(WorldSettings { gravity_m_s2: 0.0, floor: None, ..WorldSettings::default() });
    world.add_character(spec(&body, standing(&body))).unwrap();
    world
}

/// The fastest part [m/s].
fn fastest(world: &World) -> f64 {
    world.frame().characters[0].parts.iter().map(|part| part.velocity.length()).fold(0.0, f64::max)
}

#[test]
fn no_gain_that_is_accepted_makes_a_body_explode() {
    let body = adult();
    // A step from standing to a pose half a radian away in every joint.
    for stiffness in [0.0, 1e-3, 1.0, 1e2, 1e4, 1e6, 1e8, 9.9e8] {
        for damping in [0.0, 1e-3, 1.0, 1e2, 1e4, 1e6, 1e8, 9.9e8] {
            let mut world = World::new(WorldSettings::default());
            world.add_character(spec(&body, standing(&body))).unwrap();
            for node in Node::ALL {
                let bend = if common::is_hinge(node) { DVec3::X * 0.5 } else { DVec3::new(-0.3, 0.2, 0.3) };
                world.set_drive(
                    CharacterId::first_in(0),
                    node,
                    Drive { rotation: exp(bend), stiffness, damping, ..Drive::limp(0.0) },
                );
            }
            let (mut peak, mut gap): (f64, f64) = (0.0, 0.0);
            for _ in 0..240 {
                world.step();
                peak = peak.max(fastest(&world));
                gap = gap.max(world.largest_joint_gap_m());
                assert!(!world.frame().characters[0].was_reset, "k {stiffness} d {damping}");
            }
            // Half a radian within a step, 0.9 m from a joint, is 108 m/s; what springs store is spent after that.
            assert!(peak < 120.0, "k {stiffness} d {damping}: a part reached {peak} m/s");
            assert!(fastest(&world) < 15.0, "k {stiffness} d {damping}: still at {} m/s", fastest(&world));
            println!(
                "k {stiffness:e} d {damping:e}: peak {peak:.1} m/s, end {:.2}, gap {:.1} mm",
                fastest(&world),
                gap * 1e3
            );
        }
    }
}

#[test]
fn a_joint_comes_to_its_wanted_turn_and_stays() {
    let mut world = floating();
    hold(&mut world, CharacterId::first_in(0), 4.0);
    let wanted = exp(DVec3::X * -1.2);
    let inertia = world.outboard_inertia(CharacterId::first_in(0), Node::LeftLowerArm);
    let omega = std::f64::consts::TAU * 4.0;
    let drive = Drive {
        rotation: wanted,
        stiffness: inertia * omega * omega,
        damping: 2.0 * inertia * omega,
        ..Drive::limp(0.0)
    };
    world.set_drive(CharacterId::first_in(0), Node::LeftLowerArm, drive);
    steps(&mut world, 2.0);
    let pose = world.frame().characters[0].pose();
    let error = log(pose.local(Node::LeftLowerArm) * wanted.conjugate()).length().to_degrees();
    // Nothing loads it.
    assert!(error < 0.1, "{error} degrees off");
}

#[test]
fn a_spring_under_a_load_sags_by_load_over_stiffness() {
    // The outstretched arm's weight on the shoulder, floating hips pinned.
    let body = adult();
    for (solver_sweeps, share) in [(4, 0.05), (6, 0.03), (16, 0.01)] {
        let mut world = World::new(WorldSettings { floor: None, solver_sweeps, ..WorldSettings::default() });
        let pose = standing(&body);
        world.add_character(spec(&body, pose)).unwrap();
        hold(&mut world, CharacterId::first_in(0), 20.0);
        pin_hips(&mut world, pose.hips_position);
        let stiffness = 300.0;
        let wanted = exp(DVec3::X * -std::f64::consts::FRAC_PI_2);
        world.set_drive(
            CharacterId::first_in(0),
            Node::LeftUpperArm,
            Drive { rotation: wanted, stiffness, damping: 30.0, ..Drive::limp(0.0) },
        );
        steps(&mut world, 4.0);
        let frame = &world.frame().characters[0];
        let arm = [Node::LeftUpperArm, Node::LeftLowerArm, Node::LeftHand];
        let shoulder = frame.part(Node::LeftUpperArm).position;
        let moment: f64 =
            arm.iter().map(|&node| body.link(node).mass_kg * 9.81 * (frame.part(node).centre - shoulder).z).sum();
        let sag = log(frame.pose().local(Node::LeftUpperArm) * wanted.conjugate()).x;
        // The same torque by weights and levers as by the spring's turn. A twentieth of it the solver
        // finds anew in each step, the better the more it sweeps.
        assert!(
            (sag * stiffness - moment).abs() < share * moment,
            "spring {} N m, weight {moment} N m",
            sag * stiffness
        );
    }
}

fn pin_hips(world: &mut World, position: DVec3) {
    let pin = Pin {
        position,
        stiffness: 1e5,
        damping: 1e3,
        turn_stiffness: 1e5,
        turn_damping: 1e3,
        gravity_share: 1.0,
        ..Pin::LOOSE
    };
    world.set_pin(CharacterId::first_in(0), Node::Hips, Some(pin));
}

#[test]
fn pins_carry_a_body_at_any_gain_without_exploding() {
    let body = adult();
    let pose = standing(&body);
    let positions = pose.positions(&body);
    for stiffness in [1e-3, 1.0, 160.0, 1e4, 1e6, 1e8] {
        for damping in [0.0, 25.0, 1e3, 1e6, 1e8] {
            let mut world = World::new(WorldSettings::default());
            world.add_character(spec(&body, pose)).unwrap();
            for node in Node::ALL {
                let pin = Pin {
                    position: positions[node.index()] + DVec3::Y * 0.1,
                    stiffness,
                    damping,
                    turn_stiffness: stiffness,
                    turn_damping: damping,
                    gravity_share: 1.0,
                    max_force_n: 1e5,
                    ..Pin::LOOSE
                };
                world.set_pin(CharacterId::first_in(0), node, Some(pin));
            }
            let mut peak: f64 = 0.0;
            for _ in 0..480 {
                world.step();
                peak = peak.max(fastest(&world));
                assert!(!world.frame().characters[0].was_reset, "k {stiffness} d {damping}");
            }
            // A tenth of a metre within a step.
            assert!(peak < 40.0, "k {stiffness} d {damping}: {peak} m/s");
            // At the performance gains and above, where damping lets it arrive, the body hangs where it is wanted.
            if stiffness >= 160.0 && damping > 0.0 && damping <= stiffness * 0.2 {
                let off = (world.frame().characters[0].parts[0].position - positions[0] - DVec3::Y * 0.1).length();
                assert!(off < 0.01, "k {stiffness} d {damping}: hangs {off} m from its place");
            }
        }
    }
}

#[test]
fn a_pin_pulls_no_harder_than_its_largest_force() {
    let mut world = floating();
    let far = Pin {
        position: DVec3::new(100.0, 1.0, 0.0),
        stiffness: 1e4,
        turn_stiffness: 1e4,
        max_force_n: 200.0,
        ..Pin::LOOSE
    };
    world.set_pin(CharacterId::first_in(0), Node::Chest, Some(far));
    steps(&mut world, 0.5);
    // 200 N on 80 kg for half a second, hardly turned by the little that the chest rises or sinks.
    let speed = world.frame().characters[0].centre_velocity.length();
    assert!((speed - 1.25).abs() < 0.02, "{speed} m/s");
}

#[test]
fn a_stiff_body_stands_and_the_floor_bears_its_weight() {
    let body = adult();
    let mut world = World::new(WorldSettings::default());
    world.add_character(spec(&body, standing(&body))).unwrap();
    hold(&mut world, CharacterId::first_in(0), 3.0);
    steps(&mut world, 2.0);
    let mut borne = 0.0;
    for _ in 0..240 {
        world.step();
        borne += floor_impulse(&world, CharacterId::first_in(0));
    }
    let weight = body.mass_kg() * 9.81;
    // Over a second its sway averages out.
    assert!((borne - weight).abs() < 0.01 * weight, "the floor gives {borne} N s in a second, weight is {weight} N");
    assert!(world.frame().characters[0].parts[0].position.y > 0.95 * standing(&body).hips_position.y);
    // Resting contacts hold still.
    assert!(fastest(&world) < 0.01, "{}", fastest(&world));
    assert!(!world.is_asleep(CharacterId::first_in(0)), "what springs hold stays awake");
}

#[test]
fn a_drive_follows_a_turning_target_without_lag_when_it_is_told_the_velocity() {
    let mut world = floating();
    hold(&mut world, CharacterId::first_in(0), 6.0);
    let inertia = world.outboard_inertia(CharacterId::first_in(0), Node::RightLowerArm);
    let omega = std::f64::consts::TAU * 6.0;
    let (stiffness, damping) = (inertia * omega * omega, 2.0 * inertia * omega);
    for (told, largest) in [(true, 1.0), (false, 90.0)] {
        let mut worst: f64 = 0.0;
        for step in 0..240 {
            let time = f64::from(step) / 240.0;
            let angle = -1.0 + 0.5 * libm::cos(time * 6.0);
            let speed = if told { -3.0 * libm::sin(time * 6.0) } else { 0.0 };
            let rotation = exp(DVec3::X * angle);
            let drive = Drive { rotation, velocity: DVec3::X * speed, stiffness, damping, torque: DVec3::ZERO };
            world.set_drive(CharacterId::first_in(0), Node::RightLowerArm, drive);
            world.step();
            if step > 120 {
                let local = world.frame().characters[0].pose().local(Node::RightLowerArm);
                worst = worst.max(log(local * rotation.conjugate()).length().to_degrees());
            }
        }
        println!("told {told}: {worst} degrees");
        // What is left when told is the torque that accelerates the forearm: ω² / Ω² of 29 degrees.
        assert!(worst < largest, "told {told}: {worst} degrees behind");
        if !told {
            assert!(worst > 5.0, "without the velocity the damper holds it back");
        }
    }
}

#[test]
fn a_torque_turns_a_part_against_its_parent() {
    let mut world = floating();
    for _ in 0..20 {
        world.set_drive(CharacterId::first_in(0), Node::Head, Drive { torque: DVec3::Y * 2.0, ..Drive::limp(0.0) });
        world.step();
    }
    let frame = &world.frame().characters[0];
    assert!(frame.part(Node::Head).angular_velocity.y > 1.0);
    let nod = frame.part(Node::Head).angular_velocity - frame.part(Node::Neck).angular_velocity;
    assert!(nod.y > 0.5, "{nod}");
    // The parent takes the opposite: nothing turns as a whole.
    let (momentum, spin) = common::momenta(&world, CharacterId::first_in(0));
    assert!(momentum.length() < 1e-9 && spin.length() < 1e-3, "{momentum} {spin}");
}
