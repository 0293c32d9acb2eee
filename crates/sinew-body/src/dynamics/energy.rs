//! Sums over the whole body: centre of mass, momentum, energy.

use super::kinematics::world_mass;
use super::{Base, Links, Real, Tree, V3};

/// The centre of mass \[m\], world.
pub fn centre_of_mass<S: Real>(tree: &Tree<S>, links: &Links<S>) -> V3<S> {
    let (mass, first) = first_moment(tree, links);
    links.reference + first * mass.recip()
}

fn first_moment<S: Real>(tree: &Tree<S>, links: &Links<S>) -> (S, V3<S>) {
    let mut sum = (S::ZERO, V3::ZERO);
    for (node, placed) in tree.nodes.iter().zip(&links.placed[1..]) {
        sum.0 += node.mass;
        sum.1 = sum.1.plus(placed.origin + placed.rotation * node.centre, node.mass);
    }
    sum
}

/// Momentum of a body.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Momentum<S: Real> {
    /// Linear \[kg m/s\], world axes.
    pub linear: V3<S>,
    /// Angular, about the centre of mass \[kg m²/s\], world axes.
    pub angular: V3<S>,
}

/// The momentum of all links together. Needs the velocities that [`kinematics`](super::kinematics()) fills.
pub fn momentum<S: Real>(tree: &Tree<S>, links: &Links<S>) -> Momentum<S> {
    let (mass, first) = first_moment(tree, links);
    let centre_of_mass = first * mass.recip();
    let mut sum = Momentum::default();
    for (node, placed) in tree.nodes.iter().zip(&links.placed[1..]) {
        let (arm, second) = world_mass(node, placed);
        let omega = placed.angular_velocity;
        let linear = (placed.velocity + omega.cross(arm)) * node.mass;
        let spin = omega * second.trace() - second * omega;
        sum.linear += linear;
        sum.angular += spin + (placed.origin + arm - centre_of_mass).cross(linear);
    }
    sum
}

/// Kinetic energy \[J\]. Needs the velocities that [`kinematics`](super::kinematics()) fills.
pub fn kinetic_energy<S: Real>(tree: &Tree<S>, links: &Links<S>) -> S {
    let mut twice = S::ZERO;
    for (node, placed) in tree.nodes.iter().zip(&links.placed[1..]) {
        let (arm, second) = world_mass(node, placed);
        let omega = placed.angular_velocity;
        let velocity = placed.velocity + omega.cross(arm);
        let spin = omega * second.trace() - second * omega;
        twice += node.mass * velocity.dot(velocity) + omega.dot(spin);
    }
    twice * S::splat(0.5)
}

/// Potential energy in the base's gravity \[J\], zero when the centre of mass is at the world's origin.
pub fn potential_energy<S: Real>(tree: &Tree<S>, base: &Base<S>, links: &Links<S>) -> S {
    let (mass, first) = first_moment(tree, links);
    -(base.gravity.dot(first) + base.gravity.dot(links.reference) * mass)
}
