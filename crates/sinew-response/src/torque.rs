//! The torques that a motion uses.

use crate::input::Input;
use crate::settings::Settings;
use crate::upper_body::{Coordinates24, HipsMotion, JointMotion, UpperBody};
use glam::{DQuat, DVec3};
use sinew_body::humanoid::{Body, Pose, UPPER_DOFS, UPPER_NODES, log};

/// Rotations of the upper body's joints from one pose to the next, each a rotation vector in the child's frame \[rad\],
/// from the `parent_from_node` rotations.
pub(crate) fn steps(from: &[DQuat; UPPER_NODES], to: &[DQuat; UPPER_NODES]) -> [DVec3; UPPER_NODES] {
    let mut steps = [DVec3::ZERO; UPPER_NODES];
    for (node, step) in steps.iter_mut().enumerate().skip(1) {
        *step = log(from[node].conjugate() * to[node]);
    }
    steps
}

/// The rotation vector in the world \[rad\] from one orientation to the next.
pub(crate) fn world_turn(from: DQuat, to: DQuat) -> DVec3 {
    log(to * from.conjugate())
}

/// A body's motion about one frame, by the paper's differences: backward for velocity, central for acceleration.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Differences<'a> {
    pub time_step_secs: f64,
    /// `world_from_hips` now.
    pub rotation: DQuat,
    /// The hips' positions before, now and next \[m\].
    pub positions: [DVec3; 3],
    /// The hips' turns to now and from now \[rad\], world.
    pub turns: [DVec3; 2],
    /// `parent_from_node` now.
    pub local: &'a [DQuat; UPPER_NODES],
    /// The joints' turns to now and from now \[rad\], child's frame.
    pub steps: [&'a [DVec3; UPPER_NODES]; 2],
}

impl Differences<'_> {
    pub(crate) fn hips(&self) -> HipsMotion {
        let ([before, now, after], [last, next]) = (self.positions, self.turns);
        let (per, per_square) = self.per_second();
        HipsMotion {
            rotation: self.rotation,
            angular_velocity: last * per,
            angular_acceleration: (next - last) * per_square,
            acceleration: ((after - now) - (now - before)) * per_square,
        }
    }

    /// Rates and changes of the joints.
    pub(crate) fn joints(&self) -> [[DVec3; UPPER_NODES]; 2] {
        let [last, next] = self.steps;
        let (per, per_square) = self.per_second();
        let rate = last.map(|step| step * per);
        [rate, std::array::from_fn(|node| (next[node] - last[node]) * per_square)]
    }

    fn per_second(&self) -> (f64, f64) {
        (1.0 / self.time_step_secs, 1.0 / (self.time_step_secs * self.time_step_secs))
    }

    /// The torque of this motion under gravity alone.
    pub(crate) fn torque(&self, upper: &mut UpperBody) -> Coordinates24 {
        let [rate, change] = &self.joints();
        upper.torques(&self.hips(), JointMotion { local: self.local, rate, change })
    }
}

/// Joint torques \[N m\] of the upper body's 24 coordinates in every frame but the first and the last, under gravity
/// alone (EQ1): the matrix U of the paper, a column a frame. Poses follow each other at the settings' time step, and
/// should be low-pass filtered (6 Hz): accelerations are second differences. Of the settings only time step and gravity
/// count.
pub fn torques(body: &Body, motion: &[Pose], settings: &Settings) -> Vec<[f64; UPPER_DOFS]> {
    let [first, second, rest @ ..] = motion else { return Vec::new() };
    let mut upper = UpperBody::of(body, settings.gravity_m_s2);
    let mut now = Input::at(first, second);
    rest.iter()
        .map(|next| {
            let next = now.followed_by(next);
            let torque = now.torque(&next, &mut upper, settings.time_step_secs);
            now = next;
            torque
        })
        .collect()
}
