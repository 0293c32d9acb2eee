//! Jacobians of points and rotations.

use super::kinematics::world_axes;
use super::{Links, Real, State, Tree, V3};

/// The Jacobian of a point fixed in a link: per degree of freedom the velocity of the point per unit speed
/// (\[m/rad\] or 1), world axes. `point` is in the world \[m\]; the links must have been placed by
/// [`kinematics`](super::kinematics()) or any other algorithm.
///
/// ```
/// use sinew_body::dynamics::*;
/// let tree = Tree::new(vec![Link { axes: 1, mass: 1.0, ..Link::default() }])?;
/// let mut state = State::at_rest(&tree);
/// state.motions[0].set_axes(&[V3::new(0.0, 0.0, 1.0)]);
/// let mut links = Links::new(&tree);
/// kinematics(&tree, &Base::at_rest(V3::ZERO), &state, &mut links);
/// let mut columns = [V3::ZERO];
/// point_jacobian(&tree, &state, &links, 0, V3::new(0.0, -0.5, 0.0), &mut columns);
/// assert_eq!(columns[0], V3::new(0.5, 0.0, 0.0));
/// # Ok::<(), TreeError>(())
/// ```
///
/// # Panics
/// If an argument was made for another tree, or the link does not exist.
pub fn point_jacobian<S: Real>(
    tree: &Tree<S>,
    state: &State<S>,
    links: &Links<S>,
    link: usize,
    point: V3<S>,
    columns: &mut [V3<S>],
) {
    let point = point - links.reference;
    each_axis(tree, state, links, link, columns, |angular, linear| linear + angular.cross(point));
}

/// The Jacobian of a link's rotation: per degree of freedom its angular velocity per unit speed (1 or 0), world axes.
///
/// # Panics
/// If an argument was made for another tree, or the link does not exist.
pub fn turning_jacobian<S: Real>(
    tree: &Tree<S>,
    state: &State<S>,
    links: &Links<S>,
    link: usize,
    columns: &mut [V3<S>],
) {
    each_axis(tree, state, links, link, columns, |angular, _| angular);
}

#[inline(always)]
fn each_axis<S: Real>(
    tree: &Tree<S>,
    state: &State<S>,
    links: &Links<S>,
    link: usize,
    columns: &mut [V3<S>],
    column: impl Fn(V3<S>, V3<S>) -> V3<S>,
) {
    assert_eq!(columns.len(), tree.dofs(), "one column per degree of freedom");
    columns.fill(V3::ZERO);
    let mut slot = link + 1;
    while slot != 0 {
        let node = &tree.nodes[slot - 1];
        let axes = world_axes(node, &state.motions[slot - 1], &links.placed[slot]);
        for (axis, (angular, linear)) in axes.each().into_iter().enumerate().take(node.axes) {
            columns[node.first_dof + axis] = column(angular, linear);
        }
        slot = node.parent_slot;
    }
}
