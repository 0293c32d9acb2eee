//! Inverse dynamics by the recursive Newton-Euler algorithm (Luh, Walker, Paul 1980; Featherstone 2008, 5.3).
//!
//! Outwards: each link's acceleration follows from its parent's, and with it the force that the link needs
//! (Newton, Euler). Inwards: a joint carries what its link and everything beyond needs. In world axes about one common
//! point the inward sums are plain additions.

use super::inertia::newton_euler;
use super::kinematics::{place, place_base, world_mass};
use super::tree::Node;
use super::{Base, Freedom, Placed, PointForce, Real, State, Tree, V3, Workspace, Wrench};

/// The accelerations for inverse dynamics.
#[derive(Clone, Copy, Debug)]
pub enum Accelerations<'a, S> {
    /// The relative accelerations of the [`State`], as they stand: prescribed ones, or zero second derivatives.
    Relative,
    /// One second derivative per degree of freedom \[rad/s² or m/s²\], on top of the state's.
    Coordinates(&'a [S]),
}

/// The generalised forces `tau` (one per degree of freedom, \[N m\] or \[N\]) that produce the given accelerations
/// against gravity and external forces: τ = M q̈ + h − Jᵀ f.
///
/// # Panics
/// If an argument was made for another tree, or a force acts on a link that does not exist.
pub fn rnea<S: Real>(
    tree: &Tree<S>,
    base: &Base<S>,
    state: &State<S>,
    accelerations: Accelerations<'_, S>,
    forces: &[PointForce<S>],
    workspace: &mut Workspace<S>,
    tau: &mut [S],
) {
    assert_eq!(tau.len(), tree.dofs(), "one generalised force per degree of freedom");
    link_wrenches(tree, base, state, accelerations, forces, workspace);
    let Workspace { links, wrenches, .. } = workspace;
    for (index, (node, motion)) in tree.nodes.iter().zip(&state.motions).enumerate().rev() {
        let (wrenches, wrench) = wrenches.split_at_mut(index + 1);
        let wrench = &wrench[0];
        let along = motion.axes * joint_load(node, &links.placed[index + 1], wrench);
        put(along, node, tau);
        wrenches[node.parent_slot] += wrench;
    }
}

/// Forward kinematics of every link, and the wrench that each requires by itself.
#[inline(always)]
pub(super) fn link_wrenches<S: Real>(
    tree: &Tree<S>,
    base: &Base<S>,
    state: &State<S>,
    accelerations: Accelerations<'_, S>,
    forces: &[PointForce<S>],
    workspace: &mut Workspace<S>,
) {
    workspace.check(tree);
    assert_eq!(state.motions.len(), tree.nodes.len(), "one motion per link");
    let Workspace { links, wrenches, .. } = workspace;
    links.reference = place_base(tree, base, state, &mut links.placed[0]);
    wrenches[0] = Wrench::ZERO;
    for (index, (node, motion)) in tree.nodes.iter().zip(&state.motions).enumerate() {
        let acceleration = match accelerations {
            Accelerations::Relative => motion.acceleration,
            Accelerations::Coordinates(second) => motion.acceleration + motion.axes.transpose_times(get(node, second)),
        };
        let (before, placed) = links.placed.split_at_mut(index + 1);
        let placed = &mut placed[0];
        place(&before[node.parent_slot], node, motion, acceleration, placed);
        wrenches[index + 1] = own_wrench(node, placed);
    }
    take_forces(links.reference, forces, wrenches);
}

/// What a link's axes have of one number per degree of freedom. Unrolled, as a loop over at most three would become a
/// call of `memcpy`.
#[inline(always)]
pub(super) fn get<S: Real>(node: &Node<S>, numbers: &[S]) -> V3<S> {
    let from = &numbers[node.first_dof..node.first_dof + node.axes];
    match *from {
        [a, b, c] => V3::new(a, b, c),
        [a, b] => V3::new(a, b, S::ZERO),
        [a] => V3::new(a, S::ZERO, S::ZERO),
        _ => V3::ZERO,
    }
}

/// Writes one number per axis of a link.
#[inline(always)]
pub(super) fn put<S: Real>(along: V3<S>, node: &Node<S>, numbers: &mut [S]) {
    let to = &mut numbers[node.first_dof..node.first_dof + node.axes];
    let [x, y, z] = along.to_array();
    match to {
        [a, b, c] => (*a, *b, *c) = (x, y, z),
        [a, b] => (*a, *b) = (x, y),
        [a] => *a = x,
        _ => {}
    }
}

/// The wrench required by a link's own motion.
#[inline(always)]
fn own_wrench<S: Real>(node: &Node<S>, placed: &Placed<S>) -> Wrench<S> {
    let (centre, second) = world_mass(node, placed);
    let acceleration = placed.acceleration + placed.gradient * centre;
    newton_euler(node.mass, placed.origin + centre, &second, acceleration, &placed.gradient)
}

/// An external force reduces what the joint must transmit.
#[inline(always)]
pub(super) fn take_forces<S: Real>(reference: V3<S>, forces: &[PointForce<S>], wrenches: &mut [Wrench<S>]) {
    for push in forces {
        let wrench = &mut wrenches[push.link + 1];
        wrench.force -= push.force;
        wrench.moment -= (push.point - reference).cross(push.force);
    }
}

/// What a joint carries, in the link's axes: the moment about a joint that turns \[N m\], the force through one that
/// slides \[N\].
#[inline(always)]
pub(super) fn joint_load<S: Real>(node: &Node<S>, placed: &Placed<S>, wrench: &Wrench<S>) -> V3<S> {
    match node.freedom {
        Freedom::Turn => placed.rotation.transpose_times(wrench.moment_about(placed.origin)),
        Freedom::Slide => placed.rotation.transpose_times(wrench.force),
    }
}
