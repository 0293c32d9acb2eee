//! How fast a changed motion leaves its input, and how hard its segments turn.

use crate::humanoid::{Node, Pose, log};
use glam::DVec3;
use std::ops::Range;

/// Time over which changes are stated \[s\]: a frame of most games and screens.
const FRAME_SECS: f64 = 1.0 / 60.0;

/// By [`Node::index`], the rotation vector \[rad\], in the node's frame, by which each joint of `ours` is turned from `input`'s;
/// the hips' is that of `world_from_hips`.
pub fn deflections(ours: &Pose, input: &Pose) -> [DVec3; Node::COUNT] {
    Node::ALL.map(|node| log(input.local(node).conjugate() * ours.local(node)))
}

/// A motion and the input that it was made from, pose by pose at the same times.
///
/// ```
/// use sinew_body::humanoid::{Node, Pose};
/// use sinew_body::measure::Changed;
/// use glam::{DQuat, DVec3};
///
/// let input = vec![Pose::STANDING; 3];
/// let mut ours = input.clone();
/// ours[1].hips_position += DVec3::X * 0.05; // for one frame
/// ours[2].world[Node::Head.index()] = DQuat::from_rotation_y(0.1);
/// let changed = Changed { ours: &ours, input: &input, frame_secs: 1.0 / 60.0 };
/// assert_eq!(changed.largest_hips_step_m(0..3), 0.05);
/// assert!((changed.largest_deflection_steps(0..3)[Node::Head.index()] - 0.1).abs() < 1e-12);
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Changed<'a> {
    /// The motion.
    pub ours: &'a [Pose],
    /// Its input; of motions that differ in length the common part counts.
    pub input: &'a [Pose],
    /// Time from one pose to the next \[s\], positive.
    pub frame_secs: f64,
}

impl Changed<'_> {
    /// By [`Node::index`], the largest turn by which a joint's deflection from the input changes in 1/60 s \[rad\], within a
    /// range of poses. At 120 poses a second two frames are one step; at 30 a frame's change is halved.
    pub fn largest_deflection_steps(&self, poses: Range<usize>) -> [f64; Node::COUNT] {
        let mut largest = [0.0; Node::COUNT];
        self.steps(poses, |from, to, per| {
            for (node, largest) in Node::ALL.into_iter().zip(&mut largest) {
                let at = |pose: usize| self.input[pose].local(node).conjugate() * self.ours[pose].local(node);
                *largest = f64::max(*largest, log(at(from).conjugate() * at(to)).length() * per);
            }
        });
        largest
    }

    /// The largest change in 1/60 s of the hips' offset from the input \[m\], within a range of poses.
    pub fn largest_hips_step_m(&self, poses: Range<usize>) -> f64 {
        let offset = |pose: usize| self.ours[pose].hips_position - self.input[pose].hips_position;
        let mut largest = 0.0;
        self.steps(poses, |from, to, per| largest = f64::max(largest, (offset(to) - offset(from)).length() * per));
        largest
    }

    /// Calls `each` for every two poses about 1/60 s apart, with the factor that makes their change one of 1/60 s.
    fn steps(&self, poses: Range<usize>, mut each: impl FnMut(usize, usize, f64)) {
        let stride = (FRAME_SECS / self.frame_secs).round().clamp(1.0, 1e6) as usize;
        let per = FRAME_SECS / (stride as f64 * self.frame_secs);
        let end = poses.end.min(self.ours.len()).min(self.input.len());
        for to in poses.start.saturating_add(stride)..end {
            each(to - stride, to, per);
        }
    }
}

/// The largest angular acceleration of a segment in the world \[rad/s²\], by second differences over 1/60 s, within a range of
/// poses `frame_secs` apart.
pub fn largest_angular_acceleration(poses: &[Pose], frame_secs: f64, node: Node, range: Range<usize>) -> f64 {
    let stride = (FRAME_SECS / frame_secs).round().clamp(1.0, 1e6) as usize;
    let step_secs = stride as f64 * frame_secs;
    let end = range.end.min(poses.len());
    let world = |pose: usize| poses[pose].world[node.index()];
    let turn = |pose: usize| log(world(pose) * world(pose - stride).conjugate());
    (range.start.saturating_add(2 * stride)..end)
        .map(|pose| (turn(pose) - turn(pose - stride)).length() / (step_secs * step_secs))
        .fold(0.0, f64::max)
}
