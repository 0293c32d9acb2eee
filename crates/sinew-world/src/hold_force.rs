//! What a rigid hold bears, read from the solver.
//!
//! The solver orthogonalises the rows of a joint (Gram-Schmidt in the metric of the inverse masses), so the impulses that it reports
//! are not forces along the joint's axes. With J' = L⁻¹ J, L unit lower triangular, the true ones are μ = L⁻ᵀ λ; the turn's rows
//! come first, so the shift's part of L is that of the LDLᵀ of their Schur complement.

use glam::{DMat3, DVec3};
use rapier3d_f64::prelude::*;

/// Length of the impulse between two bodies that a joint fastens, in the last sub-step \[N s\].
pub(crate) fn rigid_impulse(joint: &ImpulseJoint, fastened: [RigidBodyHandle; 2], bodies: &RigidBodySet) -> f64 {
    let reported = DVec3::new(joint.impulses[0], joint.impulses[1], joint.impulses[2]);
    let (Some(one), Some(other)) = (bodies.get(fastened[0]), bodies.get(fastened[1])) else { return 0.0 };
    let (frame, anchor) = {
        let placed = *one.position() * joint.data.local_frame1;
        (DMat3::from_quat(placed.rotation), placed.translation)
    };
    let mut shifts = DMat3::ZERO;
    let mut mixed = DMat3::ZERO;
    let mut turns = DMat3::ZERO;
    for body in [one, other] {
        let properties = body.mass_properties();
        let inertia = inverse_inertia(body);
        let lever = cross_matrix(anchor - body.center_of_mass());
        shifts += DMat3::from_diagonal(properties.effective_inv_mass) + lever * inertia * lever.transpose();
        mixed += lever * inertia;
        turns += inertia;
    }
    if turns.determinant() <= 1e-18 {
        return reported.length();
    }
    let schur = frame.transpose() * (shifts - mixed * turns.inverse() * mixed.transpose()) * frame;
    let (x, y) = (schur.x_axis, schur.y_axis);
    let (l_yx, l_zx) = (x.y / x.x, x.z / x.x);
    let pivot = y.y - l_yx * x.y;
    let l_zy = (y.z - l_yx * x.z) / pivot;
    let true_y = reported.y - l_zy * reported.z;
    let impulse = DVec3::new(reported.x - l_yx * true_y - l_zx * reported.z, true_y, reported.z);
    if impulse.is_finite() { impulse.length() } else { reported.length() }
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

/// The matrix of v × .
fn cross_matrix(v: DVec3) -> DMat3 {
    DMat3::from_cols(DVec3::new(0.0, v.z, -v.y), DVec3::new(-v.z, 0.0, v.x), DVec3::new(v.y, -v.x, 0.0))
}
