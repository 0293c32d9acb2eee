//! The joint-space inertia matrix by the composite-rigid-body algorithm (Walker, Orin 1982; Featherstone 2008, 6.2).
//!
//! Everything beyond a joint, frozen, is one rigid body. Its momentum per unit speed of the joint, seen by the axes of
//! the joints on the way to the base, is that joint's column of M.

use super::kinematics::{place_base, place_still, world_axes, world_inertia};
use super::tree::Node;
use super::{Axes, Base, Inertia, MassMatrix, Real, State, Tree, V3, Workspace, Wrench};

/// The joint-space inertia matrix. Of the base and the state only the pose is read.
///
/// # Panics
/// If an argument was made for another tree.
pub fn crba<S: Real>(
    tree: &Tree<S>,
    base: &Base<S>,
    state: &State<S>,
    workspace: &mut Workspace<S>,
    mass: &mut MassMatrix<S>,
) {
    workspace.check(tree);
    assert_eq!(state.motions.len(), tree.nodes.len(), "one motion per link");
    assert_eq!(mass.dofs(), tree.dofs(), "a matrix of the tree's degrees of freedom");
    let Workspace { links, inertias, axes, .. } = workspace;
    links.reference = place_base(tree, base, state, &mut links.placed[0]);
    inertias[0] = Inertia::ZERO;
    for (index, (node, motion)) in tree.nodes.iter().zip(&state.motions).enumerate() {
        let (before, placed) = links.placed.split_at_mut(index + 1);
        let placed = &mut placed[0];
        place_still(&before[node.parent_slot], node, motion, placed);
        inertias[index + 1] = world_inertia(node, placed);
        axes[index + 1] = world_axes(node, motion, placed);
    }
    for (index, node) in tree.nodes.iter().enumerate().rev() {
        let (inertias, composite) = inertias.split_at_mut(index + 1);
        let composite = &composite[0];
        fill_rows(&tree.nodes, index, composite, axes, mass);
        inertias[node.parent_slot] += composite;
    }
}

/// Writes the rows of a link's axes up to and including its own columns.
#[inline(always)]
pub(super) fn fill_rows<S: Real>(
    nodes: &[Node<S>],
    link: usize,
    composite: &Inertia<S>,
    axes: &[Axes<S>],
    mass: &mut MassMatrix<S>,
) {
    let node = &nodes[link];
    if node.axes == 0 {
        return;
    }
    let [a, b, c] = composite.momentum(&axes[link + 1]).each();
    // Unrolled: an index into the three would send them through memory.
    fill_row(nodes, link, 0, a, axes, mass);
    if node.axes > 1 {
        fill_row(nodes, link, 1, b, axes, mass);
    }
    if node.axes > 2 {
        fill_row(nodes, link, 2, c, axes, mass);
    }
}

/// Writes the row of one axis, from the momentum of everything beyond per unit speed of it.
#[inline(always)]
fn fill_row<S: Real>(
    nodes: &[Node<S>],
    link: usize,
    axis: usize,
    (moment, force): (V3<S>, V3<S>),
    axes: &[Axes<S>],
    mass: &mut MassMatrix<S>,
) {
    let wrench = Wrench { moment, force };
    let row = nodes[link].first_dof + axis;
    let mut slot = link + 1;
    while slot != 0 {
        let above = &nodes[slot - 1];
        if above.axes > 0 {
            mass.set(row, above.first_dof, axes[slot].project(&wrench).to_array(), above.axes);
        }
        slot = above.parent_slot;
    }
}
