//! The impulses of a joint's locked axes, read from the solver.
//!
//! The solver orthogonalises the rows of a joint one after the other (Gram-Schmidt in the metric of the inverse masses), so what it
//! reports are not impulses along the joint's axes. With J' = L⁻¹ J, L unit lower triangular from the LDLᵀ of the rows' Gram
//! matrix, the true ones are μ = L⁻ᵀ λ.

use glam::{DMat3, DVec3};
use rapier3d_f64::prelude::*;

/// Impulse along a direction and about both centres of mass, of one locked axis.
#[derive(Clone, Copy, Default)]
struct Row {
    shift: DVec3,
    turns: [DVec3; 2],
}

const SHIFTS: [JointAxesMask; 3] = [JointAxesMask::LIN_X, JointAxesMask::LIN_Y, JointAxesMask::LIN_Z];

/// Impulse that a joint's locked shifts put on its first body in the last sub-step, and the opposite on its second, at the joint;
/// world axes \[N s\].
pub(crate) fn joint_impulse(joint: &ImpulseJoint, bodies: &RigidBodySet) -> DVec3 {
    let (Some(one), Some(other)) = (bodies.get(joint.body1()), bodies.get(joint.body2())) else { return DVec3::ZERO };
    let placed = *one.position() * joint.data.local_frame1;
    let axes = DMat3::from_quat(placed.rotation);
    let levers = [placed.translation - one.center_of_mass(), placed.translation - other.center_of_mass()];
    let locked = joint.data.locked_axes;
    let mut rows = [(Row::default(), 0.0); 6];
    let mut count = 0;
    // In the solver's order: turns, then shifts.
    for (at, mask) in [JointAxesMask::ANG_X, JointAxesMask::ANG_Y, JointAxesMask::ANG_Z].into_iter().enumerate() {
        if locked.contains(mask) {
            let axis = axes.col(at);
            rows[count] = (Row { shift: DVec3::ZERO, turns: [axis; 2] }, joint.impulses[3 + at]);
            count += 1;
        }
    }
    let turns = count;
    for (at, mask) in SHIFTS.into_iter().enumerate() {
        if !locked.contains(mask) {
            continue;
        }
        let axis = axes.col(at);
        rows[count] = (Row { shift: axis, turns: levers.map(|lever| lever.cross(axis)) }, joint.impulses[at]);
        count += 1;
    }
    let inverses = [inverse_inertia(one), inverse_inertia(other)];
    let inverse_mass = one.mass_properties().effective_inv_mass + other.mass_properties().effective_inv_mass;
    let impulses = true_impulses(&rows[..count], inverse_mass, &inverses);
    let impulse = (turns..count).map(|at| rows[at].0.shift * impulses[at]).sum::<DVec3>();
    if impulse.is_finite() { impulse } else { DVec3::ZERO }
}

fn true_impulses(rows: &[(Row, f64)], inverse_mass: DVec3, inverses: &[DMat3; 2]) -> [f64; 6] {
    let count = rows.len();
    let mut lower = [[0.0; 6]; 6];
    let mut pivots = [0.0; 6];
    for j in 0..count {
        let column = rows[j].0;
        let moved = [inverses[0] * column.turns[0], inverses[1] * column.turns[1]];
        for i in j..count {
            let row = rows[i].0;
            let mut gram =
                row.shift.dot(inverse_mass * column.shift) + row.turns[0].dot(moved[0]) + row.turns[1].dot(moved[1]);
            for k in 0..j {
                gram -= lower[i][k] * lower[j][k] * pivots[k];
            }
            if i == j {
                pivots[j] = gram;
            } else if pivots[j] > 1e-12 {
                lower[i][j] = gram / pivots[j];
            }
        }
    }
    let mut impulses = [0.0; 6];
    for i in (0..count).rev() {
        impulses[i] = rows[i].1;
        for j in i + 1..count {
            impulses[i] -= lower[j][i] * impulses[j];
        }
    }
    impulses
}

/// Inverse inertia about the centre of mass, world axes \[1/(kg m²)\].
fn inverse_inertia(body: &RigidBody) -> DMat3 {
    let inverse = body.mass_properties().effective_world_inv_inertia;
    DMat3::from_cols(
        DVec3::new(inverse.m11, inverse.m12, inverse.m13),
        DVec3::new(inverse.m12, inverse.m22, inverse.m23),
        DVec3::new(inverse.m13, inverse.m23, inverse.m33),
    )
}
