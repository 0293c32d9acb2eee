//! Repeats a gait cycle without a seam.

use crate::facing::{facing, heading};
use crate::{Clip, Humanoid, Transform};
use glam::{DQuat, DVec3};

/// Time on each side of a seam over which the speeds of both sides are brought together \[s\].
const BLEND_SECS: f64 = 0.12;

/// A clip made of cycles.
#[derive(Clone, Debug, PartialEq)]
pub struct Repeated {
    /// The frames.
    pub clip: Clip,
    /// For each frame, the frame of the source clip that it was made from.
    pub rows: Vec<usize>,
}

/// The cycle from frame `first` to frame `last` (the same moment one stride later) `times` times in a row and its closing frame: `times × (last − first) + 1` frames, in metres and Y up. Nothing before
/// or after the cycle is kept.
///
/// Each round goes on where the one before ended: the roots are moved by the cycle's horizontal displacement of the hips
/// and turned by its change of [`facing`]. What then still differs between both ends of the cycle (pose, height, tilt) is
/// spread evenly over the cycle, half of it at each end, so that a joint is nowhere further from the source than half the pose
/// gap; and within 0.12 s on either side of a seam the speeds are brought to their mean. Feet slide no more than the
/// pose gap over a whole cycle.
///
/// # Panics
/// If the cycle is not within the clip or does not go forward.
pub fn repeat(clip: &Clip, humanoid: &Humanoid, (first, last): (usize, usize), times: usize) -> Repeated {
    assert!(first < last && last < clip.frames(), "a cycle goes forward within its clip");
    let skeleton = clip.skeleton().clone();
    let joints = skeleton.len();
    let is_root: Vec<bool> = skeleton.joints().iter().map(|joint| joint.parent.is_none()).collect();
    let mut moving = clip.moving().to_vec();
    moving.extend((0..joints).filter(|&joint| is_root[joint]));
    let mut repeated = Clip::new(skeleton, clip.frame_time_secs(), moving);

    let advance = advance(clip, humanoid, first, last);
    let length = last - first;
    let seams: Vec<Seam> = (0..joints)
        .map(|joint| {
            let carry = if is_root[joint] { advance } else { Transform::IDENTITY };
            Seam::new(clip, joint, first, last, carry)
        })
        .collect();
    let window = ((BLEND_SECS * clip.fps()).round()).clamp(1.0, 0.5 * length as f64);
    let mut rows = Vec::new();
    let mut carried = Transform::IDENTITY;
    let mut locals: Vec<Transform> = Vec::with_capacity(joints);
    for round in 0..=times {
        for frame in 0..length {
            if round == times && frame > 0 {
                break;
            }
            locals.clear();
            locals.extend((0..joints).map(|joint| {
                let local = seams[joint].correct(clip.local(first + frame, joint), frame, length, window);
                if is_root[joint] { carried * local } else { local }
            }));
            for (joint, local) in locals.iter_mut().enumerate() {
                let rotation = local.rotation.normalize();
                // The sign of a quaternion has no meaning, but differentiation needs it to be continuous.
                let before = repeated.frames().checked_sub(1).map_or(rotation, |frame| repeated.rotation(frame, joint));
                local.rotation = if before.dot(rotation) < 0.0 { -rotation } else { rotation };
            }
            repeated.push(&locals);
            rows.push(if round == times { last } else { first + frame });
        }
        carried = next(carried, advance);
    }
    Repeated { clip: repeated, rows }
}

/// One more round: kept a pure turn about Y, whatever rounding does.
fn next(carried: Transform, advance: Transform) -> Transform {
    let turn = carried.rotation * advance.rotation;
    let moved = carried.point(advance.translation);
    Transform::new(DQuat::from_xyzw(0.0, turn.y, 0.0, turn.w).normalize(), DVec3::new(moved.x, 0.0, moved.z))
}

/// The horizontal move and turn that bring the body from the cycle's first frame to its last.
fn advance(clip: &Clip, humanoid: &Humanoid, first: usize, last: usize) -> Transform {
    let (from, to) = (clip.world(first), clip.world(last));
    let turn = |world: &[Transform]| facing(world, humanoid).map(heading);
    let rotation = match (turn(&from), turn(&to)) {
        (Some(from), Some(to)) => to * from.conjugate(),
        _ => DQuat::IDENTITY,
    };
    let hips = humanoid.hips();
    let moved = to[hips].translation - rotation * from[hips].translation;
    Transform::new(rotation, DVec3::new(moved.x, 0.0, moved.z))
}

/// What one joint needs so that the end of the cycle meets its beginning.
struct Seam {
    /// Rotation vector from the end to the (carried) beginning, in the joint's frame at the end \[rad\].
    turn: DVec3,
    /// The same for the translation, in the parent's frame at the end \[m\].
    shift: DVec3,
    /// Half of the speed at the beginning less that at the end \[rad per frame\] and \[m per frame\].
    turn_speed: DVec3,
    shift_speed: DVec3,
    /// Turns the parent's frame from the beginning to the end, for roots.
    carry: DQuat,
    length: f64,
}

impl Seam {
    fn new(clip: &Clip, joint: usize, first: usize, last: usize, carry: Transform) -> Seam {
        let start = carry * clip.local(first, joint);
        let end = clip.local(last, joint);
        let speed = |from: usize, to: usize| {
            let (from, to) = (clip.local(from, joint), clip.local(to, joint));
            (rotation_vector(from.rotation.conjugate() * to.rotation), to.translation - from.translation)
        };
        let (after, before) = (speed(first, first + 1), speed(last - 1, last));
        let turn = rotation_vector(end.rotation.conjugate() * start.rotation);
        let shift = start.translation - end.translation;
        // The even spread adds the same speed on both sides, so it does not count.
        Seam {
            turn,
            shift,
            turn_speed: 0.5 * (after.0 - before.0),
            shift_speed: 0.5 * (carry.rotation * after.1 - before.1),
            carry: carry.rotation,
            length: (last - first) as f64,
        }
    }

    /// The joint's transform `frame` frames after the beginning of the cycle.
    fn correct(&self, local: Transform, frame: usize, length: usize, window: f64) -> Transform {
        let share = frame as f64 / self.length - 0.5;
        // A bump function of slope 1 at the seam whose value and slope are 0 one window away from it.
        let hat = |distance: f64| {
            if distance < window { distance * (1.0 - distance / window) * (1.0 - distance / window) } else { 0.0 }
        };
        let blend = -hat(frame as f64) - hat((length - frame) as f64);
        let turn = self.turn * share + self.turn_speed * blend;
        // The shift is known in the parent's frame at the end; at the beginning that frame is turned back.
        let back = DQuat::IDENTITY.slerp(self.carry.conjugate(), 0.5 - share);
        let shift = back * (self.shift * share + self.shift_speed * blend);
        Transform::new(local.rotation * DQuat::from_scaled_axis(turn), local.translation + shift)
    }
}

/// The rotation vector of the shorter rotation \[rad\].
fn rotation_vector(rotation: DQuat) -> DVec3 {
    let near = if rotation.w < 0.0 { -rotation } else { rotation };
    near.to_scaled_axis()
}
