//! A clip as poses at the response's rate.

use crate::settings::{CUTOFF_HZ, Settings};
use glam::DQuat;
use sinew_body::humanoid::{Body, LEGS, Node, Pose, Reduction};
use sinew_motion::{Clip, LowPass};
use std::ops::Range;

/// By how much the hips' deviation may turn a leg's joint \[rad\]: their own turn, and that of a leg of 0.8 m whose hip moves by
/// 5 cm. Feet are held, so that no limit of the legs' joints can stop the hips without a jerk.
const LEG_ROOM: f64 = 20.0 * std::f64::consts::PI / 180.0;

/// Poses of the 18 bodies at the response's own rate, low-pass filtered, from which torques are computed.
#[derive(Clone, Debug, PartialEq)]
pub struct Motion {
    poses: Vec<Pose>,
    start_secs: f64,
    time_step_secs: f64,
}

impl Motion {
    /// The motion of a clip from `first_frame` (its first real one: captures often begin with a T-pose) to its end,
    /// resampled to the settings' rate and filtered without delay at 6 Hz (section 4.1 needs second differences).
    pub fn of_clip(clip: &Clip, reduction: &Reduction, first_frame: usize, settings: &Settings) -> Motion {
        let start_secs = first_frame as f64 * clip.frame_time_secs();
        let time_step_secs = settings.time_step_secs;
        if clip.frames() <= first_frame {
            return Motion { poses: Vec::new(), start_secs, time_step_secs };
        }
        let mut world = Vec::with_capacity(clip.skeleton().len());
        let source: Vec<Pose> = (first_frame..clip.frames())
            .map(|frame| {
                clip.world_into(frame, &mut world);
                reduction.pose(&world)
            })
            .collect();
        let duration = (source.len() - 1) as f64 * clip.frame_time_secs();
        // One pose past the end, so that the clip's last frame lies between two.
        let count = (duration / time_step_secs - 1e-9).ceil().max(0.0) as usize + 1;
        let mut poses: Vec<Pose> =
            (0..count).map(|index| between(&source, index as f64 * time_step_secs / clip.frame_time_secs())).collect();
        smooth(&mut poses, 1.0 / time_step_secs);
        Motion { poses, start_secs, time_step_secs }
    }

    /// Poses that already have the response's rate, unchanged.
    pub fn of_poses(poses: Vec<Pose>, settings: &Settings) -> Motion {
        Motion { poses, start_secs: 0.0, time_step_secs: settings.time_step_secs }
    }

    /// The poses.
    pub fn poses(&self) -> &[Pose] {
        &self.poses
    }

    /// Time of the first pose, from the clip's first frame \[s\].
    pub fn start_secs(&self) -> f64 {
        self.start_secs
    }

    /// Time from one pose to the next \[s\].
    pub fn time_step_secs(&self) -> f64 {
        self.time_step_secs
    }

    /// Which poses lie between two times \[s\], both ends in, from the clip's first frame.
    pub fn range_secs(&self, from_secs: f64, to_secs: f64) -> Range<usize> {
        let index = |secs: f64| ((secs - self.start_secs) / self.time_step_secs).round().max(0.0) as usize;
        let end = index(to_secs).saturating_add(1).min(self.poses.len());
        index(from_secs).min(end)..end
    }

    /// The body with its joint limits widened to contain all poses of this motion, and of the legs' joints to what the hips'
    /// deviation turns them beyond that.
    pub(crate) fn widen(&self, body: &mut Body) {
        for pose in &self.poses {
            body.widen_limits(pose);
        }
        for node in LEGS.into_iter().flat_map(|(upper, lower, foot)| [upper, lower, foot]) {
            body.link_mut(node).limit.add_room(LEG_ROOM);
        }
    }
}

/// The pose at a fractional frame.
fn between(source: &[Pose], at: f64) -> Pose {
    let last = source.len() - 1;
    let index = (at.floor() as usize).min(last);
    let fraction = at - index as f64;
    let (from, to) = (&source[index], &source[(index + 1).min(last)]);
    if fraction < 1e-9 {
        return *from;
    }
    let locals = Node::ALL.map(|node| from.local(node).slerp(to.local(node), fraction));
    Pose::from_locals(from.hips_position.lerp(to.hips_position, fraction), &locals)
}

/// Low-pass filters a sequence of poses without delay.
fn smooth(poses: &mut [Pose], fps: f64) {
    let filter = LowPass::new(CUTOFF_HZ, fps);
    let mut positions: Vec<[f64; 3]> = poses.iter().map(|pose| pose.hips_position.to_array()).collect();
    filter.zero_phase(&mut positions);
    let mut rotations: Vec<Vec<DQuat>> =
        Node::ALL.iter().map(|&node| poses.iter().map(|pose| pose.local(node)).collect()).collect();
    for rotations in &mut rotations {
        filter.zero_phase_rotations(rotations);
    }
    for (index, pose) in poses.iter_mut().enumerate() {
        let locals = Node::ALL.map(|node| rotations[node.index()][index]);
        *pose = Pose::from_locals(positions[index].into(), &locals);
    }
}
