//! Forward kinematics: from relative motions to the motion of every link in the world.

use super::tree::Node;
use super::{Axes, Base, Freedom, Inertia, M3, Motion, Real, State, Sym3, Tree, V3};

/// One link in the world. All vectors are in world axes.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Placed<S: Real> {
    /// `world_from_link`.
    pub rotation: M3<S>,
    /// Origin of the link relative to the common reference point \[m\].
    pub origin: V3<S>,
    /// Angular velocity \[rad/s\].
    pub angular_velocity: V3<S>,
    /// Velocity of the origin \[m/s\].
    pub velocity: V3<S>,
    /// Angular acceleration \[rad/s²\].
    pub angular_acceleration: V3<S>,
    /// Acceleration of the origin minus that of free fall \[m/s²\].
    pub acceleration: V3<S>,
    /// ∂ẍ/∂x = \[α\]× + \[ω\]×\[ω\]× \[1/s²\]: a point at x from the origin is accelerated by `gradient`·x more.
    pub gradient: M3<S>,
}

/// Every link in the world, as [`kinematics`] leaves it.
#[derive(Clone, Debug)]
pub struct Links<S: Real> {
    /// The common reference point, the origin of the first link that has mass \[m\], world. All positions are kept
    /// relative to it, so that a character a kilometre from the world's origin keeps all its digits.
    pub reference: V3<S>,
    /// Slot 0 is the base, slot i + 1 is link i.
    pub(super) placed: Vec<Placed<S>>,
}

impl<S: Real> Links<S> {
    /// Allocates the links of a tree.
    pub fn new(tree: &Tree<S>) -> Links<S> {
        Links { reference: V3::ZERO, placed: vec![Placed::default(); tree.nodes.len() + 1] }
    }

    /// One link.
    pub fn link(&self, link: usize) -> &Placed<S> {
        &self.placed[link + 1]
    }

    /// Origin of a link \[m\], world.
    pub fn origin(&self, link: usize) -> V3<S> {
        self.reference + self.link(link).origin
    }

    /// A point given in a link's frame \[m\], in the world.
    pub fn point(&self, link: usize, point_in_link: V3<S>) -> V3<S> {
        let link = self.link(link);
        self.reference + (link.origin + link.rotation * point_in_link)
    }
}

/// Forward kinematics of every link: rotation, origin, velocity, and the acceleration at zero second derivatives of the
/// coordinates.
///
/// # Panics
/// If the state or the links belong to another tree.
pub fn kinematics<S: Real>(tree: &Tree<S>, base: &Base<S>, state: &State<S>, links: &mut Links<S>) {
    assert_eq!(state.motions.len(), tree.nodes.len(), "one motion per link");
    assert_eq!(links.placed.len(), tree.nodes.len() + 1, "room for every link");
    links.reference = place_base(tree, base, state, &mut links.placed[0]);
    for (index, (node, motion)) in tree.nodes.iter().zip(&state.motions).enumerate() {
        let (before, placed) = links.placed.split_at_mut(index + 1);
        let (parent, placed) = (&before[node.parent_slot], &mut placed[0]);
        place(parent, node, motion, motion.acceleration, placed);
        placed.velocity = velocity(parent, node, motion, placed);
    }
}

/// Fills the base's slot and returns the reference point in the world \[m\].
#[inline(always)]
pub(super) fn place_base<S: Real>(tree: &Tree<S>, base: &Base<S>, state: &State<S>, slot: &mut Placed<S>) -> V3<S> {
    let mut rotation = base.rotation;
    let mut way = V3::ZERO;
    for &link in &tree.path_to_reference {
        let (node, motion) = (&tree.nodes[link], &state.motions[link]);
        match node.freedom {
            Freedom::Turn => {
                way += rotation * node.offset;
                rotation = rotation * motion.rotation;
            }
            Freedom::Slide => way += rotation * (node.offset + motion.displacement),
        }
    }
    *slot = Placed {
        rotation: base.rotation,
        origin: -way,
        angular_velocity: base.angular_velocity,
        velocity: base.velocity,
        angular_acceleration: base.angular_acceleration,
        acceleration: base.acceleration - base.gravity,
        gradient: gradient(base.angular_velocity, base.angular_acceleration),
    };
    base.origin + way
}

/// Places a link on its parent; `acceleration` is relative, in the link's axes. Leaves the velocity of the origin
/// alone: no force depends on it.
#[inline(always)]
pub(super) fn place<S: Real>(
    parent: &Placed<S>,
    node: &Node<S>,
    motion: &Motion<S>,
    acceleration: V3<S>,
    placed: &mut Placed<S>,
) {
    match node.freedom {
        Freedom::Turn => {
            let arm = parent.rotation * node.offset;
            placed.rotation = parent.rotation * motion.rotation;
            placed.origin = parent.origin + arm;
            let relative = placed.rotation * motion.velocity;
            placed.angular_velocity = parent.angular_velocity + relative;
            placed.angular_acceleration =
                parent.angular_acceleration + parent.angular_velocity.cross(relative) + placed.rotation * acceleration;
            placed.acceleration = parent.acceleration + parent.gradient * arm;
            placed.gradient = gradient(placed.angular_velocity, placed.angular_acceleration);
        }
        Freedom::Slide => {
            let arm = parent.rotation * (node.offset + motion.displacement);
            let relative = parent.rotation * motion.velocity;
            let coriolis = parent.angular_velocity.cross(relative) * S::splat(2.0);
            placed.rotation = parent.rotation;
            placed.origin = parent.origin + arm;
            placed.angular_velocity = parent.angular_velocity;
            placed.angular_acceleration = parent.angular_acceleration;
            placed.acceleration =
                parent.acceleration + parent.gradient * arm + coriolis + parent.rotation * acceleration;
            placed.gradient = parent.gradient;
        }
    }
}

/// Velocity of a placed link's origin \[m/s\].
#[inline(always)]
fn velocity<S: Real>(parent: &Placed<S>, node: &Node<S>, motion: &Motion<S>, placed: &Placed<S>) -> V3<S> {
    let arm = placed.origin - parent.origin;
    let carried = parent.velocity + parent.angular_velocity.cross(arm);
    match node.freedom {
        Freedom::Turn => carried,
        Freedom::Slide => carried + parent.rotation * motion.velocity,
    }
}

/// Places a link on its parent at rest: rotation and origin only.
#[inline(always)]
pub(super) fn place_still<S: Real>(parent: &Placed<S>, node: &Node<S>, motion: &Motion<S>, placed: &mut Placed<S>) {
    match node.freedom {
        Freedom::Turn => {
            placed.rotation = parent.rotation * motion.rotation;
            placed.origin = parent.origin + parent.rotation * node.offset;
        }
        Freedom::Slide => {
            placed.rotation = parent.rotation;
            placed.origin = parent.origin + parent.rotation * (node.offset + motion.displacement);
        }
    }
}

/// A joint's axes in the world.
#[inline(always)]
pub(super) fn world_axes<S: Real>(node: &Node<S>, motion: &Motion<S>, placed: &Placed<S>) -> Axes<S> {
    // By component, so that turning the axes multiplies from the right: (R S)ᵀ = Sᵀ Rᵀ.
    let turned = motion.axes.times_transpose(&placed.rotation);
    match node.freedom {
        Freedom::Turn => Axes::turning(turned, placed.origin),
        Freedom::Slide => Axes::sliding(turned),
    }
}

/// A link's centre of mass relative to its origin \[m\] and its second moment about it, in world axes.
#[inline(always)]
pub(super) fn world_mass<S: Real>(node: &Node<S>, placed: &Placed<S>) -> (V3<S>, Sym3<S>) {
    (placed.rotation * node.centre, node.second.turned(&placed.rotation))
}

/// A link's inertia about the reference.
#[inline(always)]
pub(super) fn world_inertia<S: Real>(node: &Node<S>, placed: &Placed<S>) -> Inertia<S> {
    let (centre, second) = world_mass(node, placed);
    Inertia::new(node.mass, placed.origin + centre, second)
}

/// \[α\]× + \[ω\]×\[ω\]×, the latter being ω ωᵀ − |ω|².
#[inline(always)]
fn gradient<S: Real>(omega: V3<S>, alpha: V3<S>) -> M3<S> {
    let [x, y, z] = alpha.to_array();
    let minus = -omega.dot(omega);
    M3::new(
        V3::new(minus, z, -y).plus(omega, omega.x()),
        V3::new(-z, minus, x).plus(omega, omega.y()),
        V3::new(y, -x, minus).plus(omega, omega.z()),
    )
}
