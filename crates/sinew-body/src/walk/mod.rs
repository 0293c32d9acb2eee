//! A walk made from measured means, by speed, cadence and stature: something to start with when no motion is at hand.
//!
//! Its joint angles are Fourier series measured as means over the normal walks of seven people (`examples/measure_walk.rs`
//! measures, `walk_table.rs` holds the numbers). The hips' path follows from the standing foot, both feet are held on the
//! floor where they stand, and speed, cadence and stature are parameters: see [`Walk`]. The repository ships it as
//! `samples/walk.bvh` and `samples/walk.glb`, which `examples/make_samples.rs` writes.

mod gait;
mod measured;
mod series;
mod skeleton;
mod stance;
mod walk_table;

use crate::humanoid::{Node, Shape};
use gait::{Gait, ShownLeg};
use glam::{DQuat, DVec3};
use measured::mirrored;
use sinew_motion::Clip;
use skeleton::WalkSkeleton;

/// Most frames that are made: an hour at 60 per second.
const MAX_FRAMES: f64 = 216_000.0;

/// A walk to be made.
///
/// A stride (two steps) is 120 × speed / cadence long. Strides other than the measured 0.87 statures swing hips, trunk, thighs and arms
/// in proportion, knees and ankles half as much; all else stays as measured.
///
/// ```
/// use sinew_body::walk::Walk;
/// let clip = Walk { cycles: 2, ..Walk::default() }.clip()?;
/// assert_eq!(clip.frames(), 2 * 66 + 1);
/// # Ok::<(), sinew_body::walk::WalkError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Walk {
    /// Mean speed of the hips \[m/s\]. Default 1.34: what was measured, for a stature of 1.70 m.
    pub speed_m_per_s: f64,
    /// Steps of either foot per minute. Taken to the nearest at which a stride is a whole number of frames, so that the
    /// motion loops; speed is kept. Default 109.
    pub cadence_steps_per_min: f64,
    /// Standing height \[m\], 0.5 to 2.5. Default 1.70.
    pub stature_m: f64,
    /// How many strides (of two steps each), at least 1. Default 8.
    pub cycles: usize,
    /// Frames per second, 10 to 1000. Default 60.
    pub fps: f64,
}

impl Default for Walk {
    fn default() -> Walk {
        Walk { speed_m_per_s: 1.34, cadence_steps_per_min: 109.0, stature_m: 1.70, cycles: 8, fps: 60.0 }
    }
}

/// Why a walk cannot be made.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum WalkError {
    /// A parameter makes no sense by itself.
    #[error("a walk's {name} of {value} is out of range; it is {from} to {to}")]
    OutOfRange {
        /// Which parameter, with its unit.
        name: &'static str,
        /// What was asked for.
        value: f64,
        /// The minimum.
        from: f64,
        /// The maximum.
        to: f64,
    },
    /// Nobody of this stature walks with such strides.
    #[error(
        "strides of {stride_m:.2} m are no walk of a body of {stature_m:.2} m; a stride (120 × speed / cadence) of about \
         {:.2} to {:.2} m is: change speed or cadence", .stature_m * MIN_STRIDE, .stature_m * LONGEST_STRIDE
    )]
    Stride {
        /// The stride asked for \[m\].
        stride_m: f64,
        /// The stature asked for \[m\].
        stature_m: f64,
    },
}

/// Shortest and longest stride that the mean walk's angles are stretched to \[statures\]. Of the people measured the longest
/// had 1.02, the mean 0.87.
const MIN_STRIDE: f64 = 0.45;
const LONGEST_STRIDE: f64 = 1.05;

impl Walk {
    /// Frames from one moment of a foot to the next.
    pub fn frames_per_stride(&self) -> usize {
        (120.0 / self.cadence_steps_per_min * self.fps).round().clamp(1.0, MAX_FRAMES) as usize
    }

    fn gait(&self) -> Result<Gait, WalkError> {
        let within = |name, value: f64, from: f64, to: f64| {
            let sound = (from..=to).contains(&value);
            if sound { Ok(()) } else { Err(WalkError::OutOfRange { name, value, from, to }) }
        };
        within("stature in metres", self.stature_m, 0.5, 2.5)?;
        within("speed in metres per second", self.speed_m_per_s, 0.1, 4.0)?;
        within("cadence in steps per minute", self.cadence_steps_per_min, 40.0, 220.0)?;
        within("frame rate per second", self.fps, 10.0, 1000.0)?;
        let most = (MAX_FRAMES / self.frames_per_stride() as f64).floor();
        within("number of cycles", self.cycles as f64, 1.0, most)?;
        let stride_m = self.speed_m_per_s * self.frames_per_stride() as f64 / self.fps;
        let refused = WalkError::Stride { stride_m, stature_m: self.stature_m };
        if !(MIN_STRIDE..=LONGEST_STRIDE).contains(&(stride_m / self.stature_m)) {
            return Err(refused);
        }
        let skeleton = WalkSkeleton::new(self.stature_m);
        let gain = Gait::gain_for(&skeleton, stride_m).ok_or(refused)?;
        Ok(Gait::new(skeleton, gain))
    }

    /// The walk from the moment when the left foot is farthest ahead: `cycles` × [`Walk::frames_per_stride`] + 1 frames, the
    /// last as the first but one stride per cycle farther along +Z. Joints are named as VRM 1.0 bones; the rest
    /// pose is a T facing +Z. The floor is at height 0.
    ///
    /// # Errors
    /// When a parameter is out of range, or no walk of this stature has such strides.
    pub fn clip(&self) -> Result<Clip, WalkError> {
        let gait = self.gait()?;
        let per_stride = self.frames_per_stride();
        let mut clip = Clip::new(gait.skeleton.skeleton(), 1.0 / self.fps, vec![0]);
        let stride: Vec<(DVec3, [DQuat; Node::COUNT], [DQuat; 2])> =
            (0..per_stride).map(|frame| pose(&gait, frame as f64 / per_stride as f64)).collect();
        for frame in 0..=self.cycles * per_stride {
            let (hips, nodes, toes) = &stride[frame % per_stride];
            let done = DVec3::Z * (gait.stride_m * (frame / per_stride) as f64);
            clip.push(&gait.skeleton.locals(*hips + done, nodes, *toes));
        }
        Ok(clip)
    }

    /// A body of capsules to look at, each with the clip's joint in whose frame it is.
    pub fn shapes(&self) -> Vec<(usize, Shape)> {
        WalkSkeleton::new(self.stature_m).shapes()
    }
}

/// The hips' place, `parent_from_node` of all nodes and the turns of the left and right toes at a phase.
fn pose(gait: &Gait, phase: f64) -> (DVec3, [DQuat; Node::COUNT], [DQuat; 2]) {
    let other = phase + 0.5;
    let hips = gait.measured(Node::Hips, phase);
    let left = gait.left_leg(phase);
    let right = gait.left_leg(other);
    let leg = |leg: &ShownLeg, hips: DQuat| {
        [hips.conjugate() * leg.thigh, leg.thigh.conjugate() * leg.shank, leg.shank.conjugate() * leg.foot]
    };
    let left_leg = leg(&left, hips);
    let right_leg = leg(&right, gait.measured(Node::Hips, other)).map(mirrored);
    let nodes = Node::ALL.map(|node| match node {
        Node::LeftUpperLeg => left_leg[0],
        Node::LeftLowerLeg => left_leg[1],
        Node::LeftFoot => left_leg[2],
        Node::RightUpperLeg => right_leg[0],
        Node::RightLowerLeg => right_leg[1],
        Node::RightFoot => right_leg[2],
        _ if node.is_right() => mirrored(gait.measured(Node::of(node.part().mirrored()), other)),
        _ => gait.measured(node, phase),
    });
    (gait.hips(phase), nodes, [left.toes, mirrored(right.toes)])
}
