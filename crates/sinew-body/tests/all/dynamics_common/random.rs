//! Numbers that look random and are the same in every run (xorshift, Marsaglia 2003).

use glam::{DMat3, DVec3};
use sinew_body::dynamics::{Base, Coordinates, Freedom, Joint, Letter, Link, Sym3, V3};

use super::bodies::{Body, joined};

pub struct Random(u64);

impl Random {
    pub fn new(seed: u64) -> Random {
        Random(seed.wrapping_mul(0x9E37_79B9_7F4A_7C15) | 1)
    }

    /// Between −1 and 1.
    pub fn next(&mut self) -> f64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }

    pub fn vector(&mut self, scale: f64) -> glam::DVec3 {
        glam::DVec3::new(self.next(), self.next(), self.next()) * scale
    }

    pub fn rotation(&mut self) -> glam::DQuat {
        loop {
            let q = glam::DQuat::from_xyzw(self.next(), self.next(), self.next(), self.next());
            if q.length_squared() > 0.01 {
                return q.normalize();
            }
        }
    }

    pub fn numbers(&mut self, count: usize, scale: f64) -> Vec<f64> {
        (0..count).map(|_| self.next() * scale).collect()
    }
}

/// Positions at random: angles and lengths up to `scale`, quaternions of any rotation.
pub fn positions(random: &mut Random, coordinates: &Coordinates<f64>, scale: f64) -> Vec<f64> {
    let mut q = Vec::with_capacity(coordinates.positions());
    for joint in coordinates.joints() {
        match joint {
            Joint::Spherical => q.extend(random.rotation().to_array()),
            Joint::Prescribed => {}
            Joint::Revolute(_) | Joint::Prismatic(_) => q.push(random.next() * scale),
            Joint::Turns(run) | Joint::Slides(run) => q.extend(random.numbers(run.len(), scale)),
        }
    }
    q
}

/// A tree with joints of every kind, links with any centre and any inertia, branches anywhere.
pub fn tree(random: &mut Random, links: usize) -> Body {
    let (mut tree, mut joints) = (Vec::new(), Vec::new());
    for index in 0..links {
        let letter = |random: &mut Random| match (random.next() * 1.5 + 1.5) as usize {
            0 => Letter::X,
            1 => Letter::Y,
            _ => Letter::Z,
        };
        let count = 1 + ((random.next() + 1.0) * 1.5) as usize % 3;
        // Consecutive turns about different axes, so that no joint is singular when all angles are zero.
        let first = letter(random) as usize;
        let run: Vec<Letter> = (0..count).map(|k| [Letter::X, Letter::Y, Letter::Z][(first + k) % 3]).collect();
        let axis = V3::from(random.rotation() * DVec3::X);
        let joint = match ((random.next() + 1.0) * 2.5) as usize {
            0 => Joint::Revolute(axis),
            1 => Joint::Prismatic(axis),
            2 => Joint::Slides(run),
            3 => Joint::Spherical,
            _ => Joint::Turns(run),
        };
        let (freedom, axes) = match &joint {
            Joint::Revolute(_) => (Freedom::Turn, 1),
            Joint::Prismatic(_) => (Freedom::Slide, 1),
            Joint::Slides(run) => (Freedom::Slide, run.len()),
            Joint::Turns(run) => (Freedom::Turn, run.len()),
            Joint::Spherical => (Freedom::Turn, 3),
            Joint::Prescribed => unreachable!("never chosen"),
        };
        // Turned principal moments that a real body could have: sums of squares.
        let square = random.vector(0.3);
        let [x, y, z] = (square * square).to_array();
        let principal = DMat3::from_diagonal(DVec3::new(y + z + 0.02, z + x + 0.02, x + y + 0.02));
        let turn = DMat3::from_quat(random.rotation());
        let inertia = turn * principal * turn.transpose();
        let parent = ((random.next() + 1.0) * 0.5 * (index + 1) as f64) as usize;
        tree.push(Link {
            parent: parent.checked_sub(1),
            offset: random.vector(0.5).into(),
            freedom,
            axes,
            mass: 1.5 + random.next(),
            centre: random.vector(0.3).into(),
            inertia: Sym3::from_lanes(|_| inertia),
        });
        joints.push(joint);
    }
    joined(tree, joints)
}

/// A base that moves in every way.
pub fn base(random: &mut Random) -> Base<f64> {
    Base {
        rotation: random.rotation().into(),
        origin: random.vector(1.0).into(),
        angular_velocity: random.vector(2.0).into(),
        velocity: random.vector(2.0).into(),
        angular_acceleration: random.vector(5.0).into(),
        acceleration: random.vector(5.0).into(),
        gravity: random.vector(9.81).into(),
    }
}
