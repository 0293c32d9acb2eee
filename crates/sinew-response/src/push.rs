//! Pushes on a time line.

use crate::force::PointForce;
use glam::{DQuat, DVec3};
use sinew_body::humanoid::{Node, Pose};
use sinew_motion::Part;

/// The axes in which a push is given.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum PushFrame {
    /// The character's own at the instant at which the push begins: x to its left, y up, z forward.
    #[default]
    Facing,
    /// The world's.
    World,
}

/// A force on a part of the body for a while.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Push {
    /// The part on which it acts.
    pub part: Part,
    /// The point of the part, in its anatomical frame from its joint \[m\]; `None` for its centre of mass.
    pub point: Option<DVec3>,
    /// The force \[N\].
    pub force_n: DVec3,
    /// Its axes.
    pub frame: PushFrame,
    /// Start time, from the clip's first frame \[s\].
    pub at_secs: f64,
    /// Duration \[s\].
    pub for_secs: f64,
}

/// A platform motion: the ground accelerates for a while, and from then on keeps the speed that it has reached.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GroundJerk {
    /// The acceleration \[m/s²\].
    pub acceleration: DVec3,
    /// Its axes.
    pub frame: PushFrame,
    /// When it begins, from the clip's first frame \[s\].
    pub at_secs: f64,
    /// How long it lasts \[s\].
    pub for_secs: f64,
}

/// The whole frames in which a push acts, and the factor on its force that keeps the impulse if its duration is not a
/// whole number of frames.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Span {
    pub first: usize,
    pub count: usize,
    pub scale: f64,
}

impl Span {
    /// `start_secs` is the time of frame 0.
    pub(crate) fn of(at_secs: f64, for_secs: f64, start_secs: f64, time_step_secs: f64) -> Span {
        let frames = |secs: f64| (secs / time_step_secs).clamp(0.0, 1e9);
        // An onset between two frames acts from the next; rounding must not move one that lies on a frame.
        let first = (frames(at_secs - start_secs) - 1e-6).ceil().max(0.0) as usize;
        // The part before the motion begins is ignored.
        let exact = frames(for_secs - (start_secs - at_secs).max(0.0));
        let count = exact.round().max(if exact > 0.0 { 1.0 } else { 0.0 });
        Span { first, count: count as usize, scale: if count > 0.0 { exact / count } else { 0.0 } }
    }

    pub(crate) fn holds(&self, frame: usize) -> bool {
        frame >= self.first && frame - self.first < self.count
    }
}

/// `world_from_facing`: the horizontal frame of a body, from its hips and shoulders.
pub(crate) fn facing(pose: &Pose) -> DQuat {
    let left = pose.world[Node::Hips.index()] * DVec3::X + pose.world[Node::Chest.index()] * DVec3::X;
    let left = DVec3::new(left.x, 0.0, left.z);
    if left.length() < 1e-6 {
        return DQuat::IDENTITY;
    }
    // About Y by the angle that takes X to the left.
    let (sin, cos) = libm::sincos(0.5 * libm::atan2(-left.z, left.x));
    DQuat::from_xyzw(0.0, sin, 0.0, cos)
}

impl Push {
    /// The force on the pose in which it begins, kept in the world from then on.
    pub(crate) fn on(&self, begins_in: &Pose, scale: f64) -> PointForce {
        let force = in_world(self.force_n, self.frame, begins_in) * scale;
        PointForce { node: Node::of(self.part), point: self.point, force_n: force }
    }
}

/// A vector given in a push's axes, in the world.
pub(crate) fn in_world(vector: DVec3, frame: PushFrame, pose: &Pose) -> DVec3 {
    match frame {
        PushFrame::Facing => facing(pose) * vector,
        PushFrame::World => vector,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_push_between_frames_keeps_its_impulse() {
        let span = Span::of(1.0, 0.11, 0.0, 1.0 / 60.0);
        assert_eq!((span.first, span.count), (60, 7));
        assert!((span.count as f64 * span.scale / 60.0 - 0.11).abs() < 1e-12);
        let blink = Span::of(0.5, 0.001, 0.0, 1.0 / 60.0);
        assert_eq!((blink.first, blink.count), (30, 1));
        assert!((blink.scale - 0.06).abs() < 1e-12);
    }

    #[test]
    fn what_lies_before_the_motion_is_lost() {
        let over = Span::of(0.0, 0.1, 0.2, 1.0 / 60.0);
        assert_eq!(over.count, 0);
        let half = Span::of(0.1, 0.2, 0.2, 1.0 / 60.0);
        assert_eq!((half.first, half.count), (0, 6));
    }

    #[test]
    fn a_character_that_faces_x_has_its_left_at_minus_z() {
        let mut pose = Pose::STANDING;
        let turn = DQuat::from_rotation_y(std::f64::consts::FRAC_PI_2);
        pose.world = pose.world.map(|world| turn * world);
        let force = in_world(DVec3::X, PushFrame::Facing, &pose);
        assert!((force - DVec3::NEG_Z).length() < 1e-12);
        assert!((in_world(DVec3::Z, PushFrame::Facing, &pose) - DVec3::X).length() < 1e-12);
    }
}
