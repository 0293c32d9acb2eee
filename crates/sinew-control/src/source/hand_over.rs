//! The blend from one source to the next.

use sinew_body::humanoid::{Node, Pose, exp, log};

/// Duration of the blend \[s\].
pub const HAND_OVER_SECS: f64 = 0.6;

/// The blended pose, this time after the next source has begun \[s\]; smooth in velocity and acceleration.
pub fn handed_over(from: &Pose, to: &Pose, since_secs: f64) -> Pose {
    let share = (since_secs / HAND_OVER_SECS).clamp(0.0, 1.0);
    let share = share * share * share * (10.0 + share * (6.0 * share - 15.0));
    let mut pose = *from;
    pose.hips_position = from.hips_position.lerp(to.hips_position, share);
    for node in Node::ALL {
        let (one, other) = (from.world[node.index()], to.world[node.index()]);
        pose.world[node.index()] = (one * exp(log(one.conjugate() * other) * share)).normalize();
    }
    pose
}
