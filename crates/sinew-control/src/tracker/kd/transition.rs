//! The transition from a body's present state to the wanted motion: inertial blending or get-up.

use super::get_up::GetUp;
use super::inertial_blend::InertialBlend;
use glam::DVec3;
use sinew_body::humanoid::{Body, Pose};

/// A transition to the wanted motion.
#[derive(Clone, Debug)]
#[expect(clippy::large_enum_variant, reason = "one for a character; a box would allocate during a run")]
pub(super) enum Transition {
    InertialBlend(InertialBlend),
    GetUp(GetUp),
}

sinew_snapshot::snapshot!(enum Transition { 0: InertialBlend(blend), 1: GetUp(get_up) });

impl Default for Transition {
    fn default() -> Transition {
        Transition::InertialBlend(InertialBlend::default())
    }
}

impl Transition {
    /// A transition from the present pose, by a get-up if it lies; with the velocities of its hips and of the wanted
    /// ones \[m/s\].
    pub(super) fn from_body(body: &Body, poses: [&Pose; 2], velocities: [DVec3; 2], over_secs: f64) -> Transition {
        let ([pose, wanted], [velocity, wanted_velocity]) = (poses, velocities);
        if GetUp::is_from(body, pose) {
            Transition::GetUp(GetUp::between(body, pose, wanted, velocity, over_secs))
        } else {
            Transition::InertialBlend(InertialBlend::between(body, pose, wanted, velocity - wanted_velocity, over_secs))
        }
    }

    /// Advances by a step; returns the pose at its end.
    pub(super) fn step(&mut self, body: &Body, wanted: &Pose, step_secs: f64) -> Pose {
        match self {
            Transition::InertialBlend(slide) => slide.step(body, wanted, step_secs),
            Transition::GetUp(rise) => rise.step(body, wanted, step_secs),
        }
    }

    /// Progress, 0 to 1.
    pub(super) fn progress(&self) -> f64 {
        match self {
            Transition::InertialBlend(slide) => slide.progress(),
            Transition::GetUp(rise) => rise.progress(),
        }
    }

    pub(super) fn is_over(&self) -> bool {
        match self {
            Transition::InertialBlend(slide) => slide.is_over(),
            Transition::GetUp(rise) => rise.is_over(),
        }
    }
}
