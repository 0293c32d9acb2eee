//! Bodies, poses and worlds that the claims share.
#![allow(dead_code, reason = "each file of claims uses its own share")]
#![allow(clippy::unwrap_used, reason = "tests")]

use glam::{DQuat, DVec3};
use sinew_body::humanoid::{Body, Node, Pose, exp};
use sinew_world::{CharacterId, CharacterSpec, Drive, Entity, Surface, World, WorldSettings, hips_over_soles_m};

/// 80 kg, 1.7 m.
pub fn adult() -> Body {
    Body::standard(80.0, 1.7)
}

/// Numbers from 0 to 1 that are the same on every machine.
pub struct Rng(u64);

impl Rng {
    pub fn new(seed: u64) -> Rng {
        Rng(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1)
    }

    pub fn unit(&mut self) -> f64 {
        // Xorshift (Marsaglia 2003), 53 bits of it.
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 11) as f64 / (1u64 << 53) as f64
    }

    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.unit()
    }

    pub fn vector(&mut self) -> DVec3 {
        DVec3::new(self.between(-1.0, 1.0), self.between(-1.0, 1.0), self.between(-1.0, 1.0))
    }
}

/// Knees turn about X alone.
pub fn is_hinge(node: Node) -> bool {
    matches!(node, Node::LeftLowerLeg | Node::RightLowerLeg)
}

/// A joint's turn somewhere inside its limit: `reach` of the way from the middle of its range to the edge, at most.
pub fn within(body: &Body, node: Node, rng: &mut Rng, reach: f64) -> DQuat {
    let limit = body.link(node).limit;
    // Knees are hinges: their swing is about X alone.
    let hinge = is_hinge(node);
    let angle = if hinge {
        [0.0, 0.5][usize::from(rng.unit() > 0.5)] * std::f64::consts::TAU
    } else {
        rng.between(0.0, std::f64::consts::TAU)
    };
    let (sin, cos) = libm::sincos(angle);
    let (sin, cos) = if hinge { (0.0, cos) } else { (sin, cos) };
    let ratio = limit.swing_ratio(cos, sin);
    let swing = DVec3::new(cos, 0.0, sin) / ratio * rng.between(0.0, reach);
    let twist = if hinge {
        0.0
    } else {
        let middle = (limit.twist.0 + limit.twist.1) / 2.0;
        middle + (limit.twist.1 - limit.twist.0) / 2.0 * rng.between(-reach, reach)
    };
    limit.centre * exp(swing) * exp(DVec3::Y * twist)
}

/// A pose of turns inside the limits, the whole body turned anyhow.
pub fn odd_pose(body: &Body, seed: u64, reach: f64) -> Pose {
    let mut rng = Rng::new(seed);
    let mut locals = [DQuat::IDENTITY; Node::COUNT];
    for node in Node::ALL.into_iter().skip(1) {
        locals[node.index()] = within(body, node, &mut rng, reach);
    }
    locals[0] = exp(rng.vector() * 3.0);
    Pose::from_locals(DVec3::ZERO, &locals)
}

/// Lying on the back, the arms a little apart.
pub fn supine() -> Pose {
    turned(exp(DVec3::X * -std::f64::consts::FRAC_PI_2))
}

/// Lying on the belly.
pub fn prone() -> Pose {
    turned(exp(DVec3::X * std::f64::consts::FRAC_PI_2))
}

/// Standing, the whole body turned.
pub fn turned(rotation: DQuat) -> Pose {
    Pose { hips_position: DVec3::ZERO, world: Pose::STANDING.world.map(|own| rotation * own) }
}

/// The pose, lifted until its lowest point is this high.
pub fn lifted(body: &Body, mut pose: Pose, height_m: f64) -> Pose {
    let positions = pose.positions(body);
    let mut lowest = f64::INFINITY;
    for node in Node::ALL {
        let shape = body.link(node).shape;
        for (end, radius) in [(shape.from, shape.from_radius_m), (shape.to, shape.to_radius_m)] {
            let end = positions[node.index()] + pose.world[node.index()] * end;
            lowest = lowest.min(end.y - radius.max(0.06));
        }
    }
    pose.hips_position.y += height_m - lowest;
    pose
}

/// Standing on the floor.
pub fn standing(body: &Body) -> Pose {
    let mut pose = Pose::STANDING;
    pose.hips_position.y = hips_over_soles_m(body, &pose);
    pose
}

pub fn spec(body: &Body, pose: Pose) -> CharacterSpec {
    CharacterSpec { body: body.clone(), pose, velocity: DVec3::ZERO, surface: Surface::BODY }
}

/// One limp character in a world of its own.
pub fn fallen(body: &Body, pose: Pose, velocity: DVec3) -> World {
    let mut world = World::new(WorldSettings::default());
    world.add_character(CharacterSpec { velocity, ..spec(body, pose) }).unwrap();
    world
}

pub fn steps(world: &mut World, secs: f64) {
    for _ in 0..(secs * world.settings().physics_hz) as usize {
        world.step();
    }
}

/// Springs on all joints of a character towards standing straight: frequency \[Hz\] of the outboard inertia, and ζ = 1.
pub fn hold(world: &mut World, character: CharacterId, frequency_hz: f64) {
    let omega = std::f64::consts::TAU * frequency_hz;
    let body = world.body(character).unwrap().clone();
    for node in Node::ALL {
        // Legs carry the body above them.
        let inertia = if node.is_leg() { body.mass_kg() * 1.0 } else { world.outboard_inertia(character, node) };
        let drive = Drive {
            rotation: DQuat::IDENTITY,
            velocity: DVec3::ZERO,
            stiffness: inertia * omega * omega,
            damping: 2.0 * inertia * omega,
            torque: DVec3::ZERO,
        };
        world.set_drive(character, node, drive);
    }
}

/// How far the worst joint of a character is beyond its limit \[degrees\], and which.
pub fn worst_excess_deg(world: &World, character: CharacterId) -> (f64, Node) {
    let pose = world.frame().characters[character.slot()].pose();
    let body = world.body(character).unwrap();
    let mut worst = (0.0, Node::Hips);
    for node in Node::ALL {
        let excess = body.link(node).limit.excess(pose.local(node)).to_degrees();
        if excess > worst.0 {
            worst = (excess, node);
        }
    }
    worst
}

/// Momentum \[kg m/s\] and angular momentum about the centre of mass \[kg m²/s\].
pub fn momenta(world: &World, character: CharacterId) -> (DVec3, DVec3) {
    let frame = &world.frame().characters[character.slot()];
    let body = world.body(character).unwrap();
    let (mut linear, mut angular) = (DVec3::ZERO, DVec3::ZERO);
    for node in Node::ALL {
        let (part, link) = (frame.part(node), body.link(node));
        linear += part.velocity * link.mass_kg;
        let spin =
            part.rotation * (world.part_inertia(character, node) * (part.rotation.conjugate() * part.angular_velocity));
        angular +=
            spin + (part.centre - frame.centre_of_mass).cross(part.velocity - frame.centre_velocity) * link.mass_kg;
    }
    (linear, angular)
}

/// Impulse that the floor gives a character in this step, upwards \[N s\].
pub fn floor_impulse(world: &World, character: CharacterId) -> f64 {
    world
        .frame()
        .contacts
        .iter()
        .filter(|contact| contact.a == Entity::Floor && matches!(contact.b, Entity::Part(one, _) if one == character))
        .map(|contact| contact.impulse.y)
        .sum()
}
