//! Forward dynamics by articulated bodies (Featherstone 1983; 2008, 7.3).
//!
//! The textbook carries velocity terms through the articulated recursion. Here they are handled first: one outward pass
//! gives the wrench that every link would need if all q̈ were zero. What remains, M q̈ = τ − h, is linear, and the
//! recursion below solves it without forming M: inwards, each axis is eliminated from the inertia and the wrench that
//! its parent feels (a rank-one update); outwards, the accelerations are substituted back. About one common reference
//! point inertias and wrenches pass from child to parent unchanged.

use std::ops::AddAssign;

use super::kinematics::{world_axes, world_inertia};
use super::rnea::link_wrenches;
use super::{Accelerations, Base, Inertia, M3, PointForce, Real, State, Tree, V3, Workspace, Wrench};

/// Articulated-body inertia: that of a link with everything attached to it free to move: the map from the acceleration
/// (α, a) of the link at the reference point to the wrench (n, f) it takes, n = angular·α + coupling·a, f = couplingᵀ·α
/// + linear·a.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Articulated<S: Real> {
    angular: M3<S>,
    coupling: M3<S>,
    coupling_transposed: M3<S>,
    linear: M3<S>,
}

impl<S: Real> Articulated<S> {
    /// Of a rigid body: n = I α + h × a, f = m a + α × h.
    #[inline(always)]
    fn rigid(inertia: &Inertia<S>) -> Articulated<S> {
        let ([x, y, z], m, o) = (inertia.first.to_array(), inertia.mass, S::ZERO);
        Articulated {
            angular: M3 { columns: inertia.rotational() },
            coupling: M3::new(V3::new(o, z, -y), V3::new(-z, o, x), V3::new(y, -x, o)),
            coupling_transposed: M3::new(V3::new(o, -z, y), V3::new(z, o, -x), V3::new(-y, x, o)),
            linear: M3::new(V3::new(m, o, o), V3::new(o, m, o), V3::new(o, o, m)),
        }
    }

    #[inline(always)]
    fn times(&self, angular: V3<S>, linear: V3<S>) -> Wrench<S> {
        Wrench {
            moment: self.angular * angular + self.coupling * linear,
            force: self.coupling_transposed * angular + self.linear * linear,
        }
    }

    /// self − u uᵀ / d.
    #[inline(always)]
    fn eliminate(&mut self, u: &Wrench<S>, inverse_d: S) {
        let moment = (u.moment * inverse_d).to_array();
        let force = (u.force * inverse_d).to_array();
        for k in 0..3 {
            self.angular.columns[k] = self.angular.columns[k].minus(u.moment, moment[k]);
            self.coupling.columns[k] = self.coupling.columns[k].minus(u.moment, force[k]);
            self.coupling_transposed.columns[k] = self.coupling_transposed.columns[k].minus(u.force, moment[k]);
            self.linear.columns[k] = self.linear.columns[k].minus(u.force, force[k]);
        }
    }
}

impl<S: Real> AddAssign for Articulated<S> {
    #[inline(always)]
    fn add_assign(&mut self, other: Articulated<S>) {
        for k in 0..3 {
            self.angular.columns[k] += other.angular.columns[k];
            self.coupling.columns[k] += other.coupling.columns[k];
            self.coupling_transposed.columns[k] += other.coupling_transposed.columns[k];
            self.linear.columns[k] += other.linear.columns[k];
        }
    }
}

/// What back substitution needs of one eliminated axis.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Elimination<S: Real> {
    /// The axis, (s, v).
    angular: V3<S>,
    linear: V3<S>,
    /// Inertia times axis.
    u: Wrench<S>,
    /// 1 / (axis · u).
    inverse_d: S,
    /// Generalised force that remains to accelerate the axis.
    force: S,
}

/// The second derivatives of the coordinates (\[rad/s²\] or \[m/s²\]) that generalised forces `tau` and external forces
/// produce: q̈ = M⁻¹ (τ − h + Jᵀ f). The state's relative accelerations are those at q̈ = 0, as
/// [`Coordinates`](super::Coordinates) sets them.
///
/// A degree of freedom that moves no mass makes the result infinite or NaN.
///
/// # Panics
/// If an argument was made for another tree, or a force acts on a link that does not exist.
pub fn aba<S: Real>(
    tree: &Tree<S>,
    base: &Base<S>,
    state: &State<S>,
    tau: &[S],
    forces: &[PointForce<S>],
    workspace: &mut Workspace<S>,
    second: &mut [S],
) {
    assert!(tau.len() == tree.dofs() && second.len() == tree.dofs(), "one number per degree of freedom");
    link_wrenches(tree, base, state, Accelerations::Relative, forces, workspace);
    let Workspace { links, wrenches, articulated, eliminations, .. } = workspace;
    for (node, (placed, articulated)) in tree.nodes.iter().zip(links.placed.iter().zip(articulated.iter_mut()).skip(1))
    {
        *articulated = Articulated::rigid(&world_inertia(node, placed));
    }
    for (index, (node, motion)) in tree.nodes.iter().zip(&state.motions).enumerate().rev() {
        let axes = world_axes(node, motion, &links.placed[index + 1]);
        let (mut inertia, mut wrench) = (articulated[index + 1], wrenches[index + 1]);
        for axis in (0..node.axes).rev() {
            let dof = node.first_dof + axis;
            let (angular, linear) = axes.axis(axis);
            let u = inertia.times(angular, linear);
            let inverse_d = (angular.dot(u.moment) + linear.dot(u.force)).recip();
            let force = tau[dof] - (angular.dot(wrench.moment) + linear.dot(wrench.force));
            inertia.eliminate(&u, inverse_d);
            let factor = force * inverse_d;
            wrench.moment = wrench.moment.plus(u.moment, factor);
            wrench.force = wrench.force.plus(u.force, factor);
            eliminations[dof] = Elimination { angular, linear, u, inverse_d, force };
        }
        if node.parent_slot != 0 {
            articulated[node.parent_slot] += inertia;
            wrenches[node.parent_slot] += &wrench;
        }
    }
    // Outwards. What the links' accelerations gain over q̈ = 0, (α, a) at the reference point, goes in the wrenches'
    // place: they are not needed any more.
    wrenches[0] = Wrench::ZERO;
    for (index, node) in tree.nodes.iter().enumerate() {
        let Wrench { moment: mut alpha, force: mut acceleration } = wrenches[node.parent_slot];
        for dof in node.first_dof..node.first_dof + node.axes {
            let Elimination { angular, linear, u, inverse_d, force } = eliminations[dof];
            let rate = (force - (u.moment.dot(alpha) + u.force.dot(acceleration))) * inverse_d;
            alpha = alpha.plus(angular, rate);
            acceleration = acceleration.plus(linear, rate);
            second[dof] = rate;
        }
        wrenches[index + 1] = Wrench { moment: alpha, force: acceleration };
    }
}
