//! No algorithm allocates: a counting allocator says so.

use crate::dynamics_common::bodies::{self, Root};
use crate::dynamics_common::random::{self, Random};
use sinew_body::dynamics::{
    Accelerations, Base, Inverse, Links, MassMatrix, PointForce, State, V3, Workspace, aba, centre_of_mass, crba,
    inverse, kinematics, kinetic_energy, momentum, point_jacobian, potential_energy, rnea, turning_jacobian,
};
use sinew_testkit::allocations;

#[test]
fn no_call_allocates() {
    let (tree, coordinates) = bodies::composite(&bodies::CANONICAL, Root::Quaternion, |_| true);
    let n = tree.dofs();
    let mut random = Random::new(5);
    let q = random::positions(&mut random, &coordinates, 0.8);
    let (qd, qdd) = (random.numbers(n, 2.0), random.numbers(n, 10.0));
    let mut base = Base::at_rest(V3::new(0.0, -9.81, 0.0));
    base.origin = V3::new(1.0, 2.0, 3.0);
    let (mut state, mut links, mut workspace) = (State::at_rest(&tree), Links::new(&tree), Workspace::new(&tree));
    let (mut tau, mut mass, mut both) = (vec![0.0; n], MassMatrix::new(&tree), Inverse::new(&tree));
    let (mut columns, mut moved) = (vec![V3::ZERO; n], q.clone());
    let forces = [PointForce { link: 5, point: V3::ZERO, force: V3::new(1.0, 2.0, 3.0) }];

    let ((sums, potential), count) = allocations(|| {
        coordinates.set(&tree, &q, &qd, &mut state);
        coordinates.advance(&qd, 0.01, &mut moved);
        kinematics(&tree, &base, &state, &mut links);
        rnea(&tree, &base, &state, Accelerations::Coordinates(&qdd), &forces, &mut workspace, &mut tau);
        crba(&tree, &base, &state, &mut workspace, &mut mass);
        inverse(&tree, &base, &state, &forces, &mut workspace, &mut both);
        aba(&tree, &base, &state, &qdd, &forces, &mut workspace, &mut tau);
        point_jacobian(&tree, &state, &links, 7, V3::ZERO, &mut columns);
        turning_jacobian(&tree, &state, &links, 7, &mut columns);
        let sums = (centre_of_mass(&tree, &links), momentum(&tree, &links), kinetic_energy(&tree, &links));
        (sums, potential_energy(&tree, &base, &links))
    });
    assert_eq!(count, 0, "allocations");
    assert!(potential.is_finite() && sums.2 > 0.0);
}
