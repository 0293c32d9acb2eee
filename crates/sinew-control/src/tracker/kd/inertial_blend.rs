//! Inertial blending from a body's present pose to the wanted one, without a jump.

use super::ramp::smooth;
use glam::{DQuat, DVec3};
use sinew_body::humanoid::{Body, Node, Pose, exp, log};
use sinew_world::hips_over_soles_m;

/// A decaying difference between present and wanted pose: added to the wanted pose, it starts at the present pose and
/// ends at the wanted one, however that moves meanwhile.
#[derive(Clone, Debug, Default)]
pub(super) struct InertialBlend {
    shift: DVec3,
    /// Initial rate of the shift \[m/s\].
    drift: DVec3,
    /// World axes \[rad\].
    turn: DVec3,
    /// Of each joint, in the node's frame \[rad\].
    bends: [DVec3; Node::COUNT],
    /// Height of the lower sole at the start \[m\].
    sole_m: f64,
    lift_m: f64,
    gone_secs: f64,
    over_secs: f64,
}

/// Decay time of the velocity difference \[s\]: a body that falls at 4 m/s is caught over 0.2 m, with six times its
/// weight.
const DRIFT_SECS: f64 = 0.4;

/// Maximum speed of the blend; a larger difference takes longer \[m/s\].
const MAX_M_S: f64 = 2.0;

/// The steepest slope of the fade.
const STEEPEST: f64 = 1.875;

/// Smoothing time of the lift off the floor \[s\].
const LIFT_SECS: f64 = 0.03;

sinew_snapshot::snapshot!(InertialBlend { shift, drift, turn, bends, sole_m, lift_m, gone_secs, over_secs });

impl InertialBlend {
    /// A blend from one pose to another, with the relative velocity of the hips \[m/s\].
    pub(super) fn between(body: &Body, from: &Pose, to: &Pose, drift: DVec3, over_secs: f64) -> InertialBlend {
        let mut bends = [DVec3::ZERO; Node::COUNT];
        for node in Node::ALL.into_iter().skip(1) {
            bends[node.index()] = log((to.local(node).conjugate() * from.local(node)).normalize());
        }
        let shift = from.hips_position - to.hips_position;
        let turn = log((from.world[0] * to.world[0].conjugate()).normalize());
        // Head and feet move by about the body's rotation times half its height.
        let way_m = shift.length() + turn.length() * body.stature_m() / 2.0;
        let over_secs = over_secs.max(STEEPEST * way_m / MAX_M_S);
        InertialBlend { shift, drift, turn, bends, sole_m: sole_m(body, from), lift_m: 0.0, gone_secs: 0.0, over_secs }
    }

    /// Advances by a step; returns the wanted pose plus the remaining difference at its end.
    pub(super) fn step(&mut self, body: &Body, pose: &Pose, step_secs: f64) -> Pose {
        self.gone_secs += step_secs;
        let mut added = self.added_to(pose);
        // Half way up from lying, straight legs reach below the floor. The lowest point of the soles may jump; the lift
        // is smoothed.
        let lowest = self.sole_m.min(sole_m(body, pose));
        let lift_m = (lowest - sole_m(body, &added)).max(0.0);
        self.lift_m += (lift_m - self.lift_m) * (step_secs / LIFT_SECS).min(1.0);
        added.hips_position.y += self.lift_m * (1.0 - self.progress());
        added
    }

    /// Progress, 0 to 1.
    pub(super) fn progress(&self) -> f64 {
        smooth(self.gone_secs / self.over_secs.max(1e-9))
    }

    pub(super) fn is_over(&self) -> bool {
        self.gone_secs >= self.over_secs
    }

    fn added_to(&self, pose: &Pose) -> Pose {
        let left = 1.0 - self.progress();
        let drift_secs = self.over_secs.min(DRIFT_SECS);
        let drifting = (1.0 - self.gone_secs / drift_secs.max(1e-9)).max(0.0);
        let mut locals = [DQuat::IDENTITY; Node::COUNT];
        locals[0] = (exp(self.turn * left) * pose.world[0]).normalize();
        for node in Node::ALL.into_iter().skip(1) {
            locals[node.index()] = (pose.local(node) * exp(self.bends[node.index()] * left)).normalize();
        }
        let shift = self.shift * left + self.drift * (self.gone_secs * drifting * drifting);
        Pose::from_locals(pose.hips_position + shift, &locals)
    }
}

/// Height of the lowest point of the soles \[m\].
pub(super) fn sole_m(body: &Body, pose: &Pose) -> f64 {
    pose.hips_position.y - hips_over_soles_m(body, pose)
}
