//! The torques that a motion uses.

use crate::upper_body::{Coordinates24, HipsMotion, UpperBody};
use glam::{DQuat, DVec3};
use sinew_body::humanoid::{Body, Node, Pose, UPPER_DOFS, UPPER_NODES, log};

/// How the upper body turns from one pose to the next, each joint's rotation vector in the child's frame \[rad\].
pub(crate) fn steps(from: &Pose, to: &Pose) -> [DVec3; UPPER_NODES] {
    let mut steps = [DVec3::ZERO; UPPER_NODES];
    for node in Node::ALL.into_iter().take(UPPER_NODES).skip(1) {
        steps[node.index()] = log(from.local(node).conjugate() * to.local(node));
    }
    steps
}

/// How the hips move at the middle of three poses, by the paper's differences: backward for velocity, central for
/// acceleration.
pub(crate) fn hips_motion(hips: [(DVec3, DQuat); 3], time_step_secs: f64) -> HipsMotion {
    let [(before, turned_before), (now, turned), (after, turned_after)] = hips;
    let last = log(turned * turned_before.conjugate());
    let next = log(turned_after * turned.conjugate());
    let per_square = 1.0 / (time_step_secs * time_step_secs);
    HipsMotion {
        angular_velocity: last / time_step_secs,
        angular_acceleration: (next - last) * per_square,
        acceleration: ((after - now) - (now - before)) * per_square,
    }
}

/// Joint torques \[N m\] of the upper body's 24 coordinates in every frame but the first and the last, with no force but
/// gravity (EQ1): the matrix U of the paper, a column a frame. Poses follow each other at `time_step_secs`, and should be
/// low-pass filtered (6 Hz): accelerations are second differences.
pub fn torques(body: &Body, motion: &[Pose], time_step_secs: f64) -> Vec<[f64; UPPER_DOFS]> {
    let upper = UpperBody::of(body);
    motion.windows(3).map(|window| torque(&upper, [&window[0], &window[1], &window[2]], time_step_secs)).collect()
}

/// The torque at the middle of three poses.
pub(crate) fn torque(upper: &UpperBody, poses: [&Pose; 3], time_step_secs: f64) -> Coordinates24 {
    let [before, now, after] = poses;
    let (last, next) = (steps(before, now), steps(now, after));
    let hips = hips_motion(poses.map(|pose| (pose.hips_position, pose.world[0])), time_step_secs);
    let rate = last.map(|step| step / time_step_secs);
    let per_square = 1.0 / (time_step_secs * time_step_secs);
    let change = std::array::from_fn(|node| (next[node] - last[node]) * per_square);
    upper.torques(&upper.place(&now.world[..UPPER_NODES]), &hips, &rate, &change)
}
