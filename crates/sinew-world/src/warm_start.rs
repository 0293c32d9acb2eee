//! Warm start of joints: the constraint force of the last step, applied at the start of the next.
//!
//! The solver begins every step with unloaded joints, and a sweep propagates forces by one joint; so with few sweeps a
//! loaded spring sags more than it should. (Its own warm start of joints changes no result: it gives each row its old
//! impulse just before that row is solved, which undoes it.) Here the old forces act as forces of the step, in pairs,
//! and each spring's target is shifted so that force and spring together satisfy the spring's law: the solver only
//! finds the change.

use crate::rows::joint_impulse;
use glam::{DMat3, DVec3};
use rapier3d_f64::prelude::*;

/// Force and torque of a joint on its parent, the opposite on its child; world axes \[N, N m\].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct WarmStart {
    pub force: DVec3,
    pub torque: DVec3,
}

sinew_snapshot::snapshot!(WarmStart { force, torque });

/// Share of the force that is carried over. With all of it springs at rest are exact with any number of sweeps; but
/// then the transients of a fall decay slowly, and a standing body jitters twice as much.
const SHARE: f64 = 0.95;

/// Maximum force that is carried over \[weights of the body\]: a larger one is an impact, which is over.
const MAX_WEIGHTS: f64 = 4.0;

impl WarmStart {
    /// The joint's force in the last step, in which this warm start acted.
    pub fn after(self, joint: &ImpulseJoint, bodies: &RigidBodySet, sub_step_secs: f64) -> WarmStart {
        let Some(parent) = bodies.get(joint.body1()) else { return WarmStart::default() };
        let axes = DMat3::from_quat(parent.rotation() * joint.data.local_frame1.rotation);
        let mut torque = DVec3::ZERO;
        for (at, mask) in [JointAxesMask::ANG_X, JointAxesMask::ANG_Y, JointAxesMask::ANG_Z].into_iter().enumerate() {
            if joint.data.motor_axes.contains(mask) {
                torque += axes.col(at) * joint.data.motors[3 + at].impulse;
            }
        }
        WarmStart {
            force: self.force + joint_impulse(joint, bodies) / sub_step_secs,
            torque: self.torque + torque / sub_step_secs,
        }
    }

    /// The warm start of the next step.
    pub fn handed_on(self, weight_n: f64, stature_m: f64) -> WarmStart {
        let share = |vector: DVec3, most: f64| {
            if vector.is_finite() { (vector * SHARE).clamp_length_max(most) } else { DVec3::ZERO }
        };
        let most = MAX_WEIGHTS * weight_n;
        WarmStart { force: share(self.force, most), torque: share(self.torque, most * stature_m * 0.5) }
    }
}
