//! What a joint bore in the last step, handed to the next as a start.
//!
//! The solver begins every step with joints that bear nothing, and a sweep hands forces on by one joint; so with few sweeps a
//! loaded spring sags more than it should. (Its own warm start of joints changes no result: it gives each row its old
//! impulse just before that row is solved, which takes it back.) Here the old forces act as forces of the step, in pairs, and each
//! spring's target is shifted so that force and spring together obey the spring's law: the solver finds what has changed.

use crate::rows::joint_impulse;
use glam::{DMat3, DVec3};
use rapier3d_f64::prelude::*;

/// Force and torque of a joint on its parent, the opposite on its child; world axes \[N, N m\].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct WarmStart {
    pub force: DVec3,
    pub torque: DVec3,
}

/// Share that is handed on. All of it makes springs at rest exact with any number of sweeps; but then what a fall leaves behind
/// dies out slowly, and a standing body trembles twice as much.
const SHARE: f64 = 0.95;

/// Most that is handed on \[weights of the body\]: above it is an impact, which is over.
const MAX_WEIGHTS: f64 = 4.0;

impl WarmStart {
    /// What the joint bore in the last step, when this acted as its start.
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

    /// What of it the next step begins with.
    pub fn handed_on(self, weight_n: f64, stature_m: f64) -> WarmStart {
        let share = |vector: DVec3, most: f64| {
            if vector.is_finite() { (vector * SHARE).clamp_length_max(most) } else { DVec3::ZERO }
        };
        let most = MAX_WEIGHTS * weight_n;
        WarmStart { force: share(self.force, most), torque: share(self.torque, most * stature_m * 0.5) }
    }
}
