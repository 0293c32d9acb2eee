//! Inverse dynamics and the mass matrix in one pass, for a motion that is prescribed.

use super::crba::fill_rows;
use super::inertia::newton_euler;
use super::kinematics::{place, place_base, world_axes, world_mass};
use super::rnea::{joint_load, put, take_forces};
use super::{Base, Inertia, MassMatrix, PointForce, Real, State, Tree, V3, Workspace, Wrench};

/// The result of [`inverse`].
#[derive(Clone, Debug, PartialEq)]
pub struct Inverse<S: Real> {
    /// Per degree of freedom the generalised force \[N m or N\].
    pub tau: Vec<S>,
    /// Per link all that its joint carries, in the link's axes: the moment about a joint that turns \[N m\], the force
    /// through one that slides \[N\]. `tau` is its projection on the joint's axes.
    pub loads: Vec<V3<S>>,
    /// The joint-space inertia matrix.
    pub mass: MassMatrix<S>,
}

impl<S: Real> Inverse<S> {
    /// Allocates the result for a tree.
    pub fn new(tree: &Tree<S>) -> Inverse<S> {
        Inverse {
            tau: vec![S::ZERO; tree.dofs()],
            loads: vec![V3::ZERO; tree.links().len()],
            mass: MassMatrix::new(tree),
        }
    }
}

/// [`rnea`](super::rnea()) with the state's accelerations as they stand, and [`crba`](super::crba()), sharing
/// placement and inertias.
///
/// A joint that follows a captured motion has a rotation, an angular velocity and an angular acceleration of its own,
/// and says which directions of it are coordinates:
///
/// ```
/// use glam::{DQuat, DVec3};
/// use sinew_body::dynamics::*;
/// let arm = Link { axes: 2, mass: 2.2, centre: V3::new(0.0, -0.16, 0.0),
///                  inertia: Sym3::new(0.014, 0.004, 0.013, 0.0, 0.0, 0.0), ..Link::default() };
/// let tree = Tree::new(vec![arm])?;
/// let mut state = State::at_rest(&tree);
/// let motion = &mut state.motions[0];
/// motion.rotation = DQuat::from_rotation_z(0.4).into();
/// motion.velocity = DVec3::new(0.1, 0.2, 1.5).into();
/// motion.acceleration = DVec3::new(0.0, -0.3, 8.0).into();
/// motion.set_axes(&[V3::new(1.0, 0.0, 0.0), V3::new(0.0, 0.0, 1.0)]);
///
/// let (mut workspace, mut out) = (Workspace::new(&tree), Inverse::new(&tree));
/// inverse(&tree, &Base::at_rest(V3::new(0.0, -9.81, 0.0)), &state, &[], &mut workspace, &mut out);
/// // Torque about the two axes is the joint's whole load seen along them; the third direction needs torque too.
/// assert_eq!([out.tau[0], out.tau[1]], [out.loads[0].x(), out.loads[0].z()]);
/// assert!((out.mass.at(1, 1) - (0.013 + 2.2 * 0.16 * 0.16)).abs() < 1e-12);
/// # Ok::<(), TreeError>(())
/// ```
///
/// # Panics
/// If an argument was made for another tree, or a force acts on a link that does not exist.
pub fn inverse<S: Real>(
    tree: &Tree<S>,
    base: &Base<S>,
    state: &State<S>,
    forces: &[PointForce<S>],
    workspace: &mut Workspace<S>,
    out: &mut Inverse<S>,
) {
    workspace.check(tree);
    assert_eq!(state.motions.len(), tree.nodes.len(), "one motion per link");
    assert!(
        out.tau.len() == tree.dofs() && out.mass.dofs() == tree.dofs() && out.loads.len() == tree.nodes.len(),
        "the result was made for another tree"
    );
    let Workspace { links, wrenches, inertias, axes, .. } = workspace;
    links.reference = place_base(tree, base, state, &mut links.placed[0]);
    wrenches[0] = Wrench::ZERO;
    inertias[0] = Inertia::ZERO;
    for (index, (node, motion)) in tree.nodes.iter().zip(&state.motions).enumerate() {
        let (before, placed) = links.placed.split_at_mut(index + 1);
        let placed = &mut placed[0];
        place(&before[node.parent_slot], node, motion, motion.acceleration, placed);
        let (arm, second) = world_mass(node, placed);
        let centre = placed.origin + arm;
        let acceleration = placed.acceleration + placed.gradient * arm;
        wrenches[index + 1] = newton_euler(node.mass, centre, &second, acceleration, &placed.gradient);
        inertias[index + 1] = Inertia::new(node.mass, centre, second);
        axes[index + 1] = world_axes(node, motion, placed);
    }
    take_forces(links.reference, forces, wrenches);
    for (index, (node, motion)) in tree.nodes.iter().zip(&state.motions).enumerate().rev() {
        // In place: copies of what has just been written stall in the store buffer.
        let (wrenches, wrench) = wrenches.split_at_mut(index + 1);
        let (inertias, composite) = inertias.split_at_mut(index + 1);
        let (wrench, composite) = (&wrench[0], &composite[0]);
        let load = joint_load(node, &links.placed[index + 1], wrench);
        out.loads[index] = load;
        put(motion.axes * load, node, &mut out.tau);
        fill_rows(&tree.nodes, index, composite, axes, &mut out.mass);
        wrenches[node.parent_slot] += wrench;
        inertias[node.parent_slot] += composite;
    }
}
