//! Trackers make a body follow the wanted pose: the [`Tracker`], and its five kinds.

mod clock;
mod contact_forces;
mod gains;
mod hold;
mod instant;
mod kd;
mod kind;
mod kinematic;
mod limp;
mod pd;
mod pose_interpolator;
mod response;
mod self_collision;
mod tasks;

pub use gains::{Gains, JointGain};
pub use hold::Grip;
pub use kd::{KdDamping, KdGains, KdPreset, KdSettings, KdTracker, KdWeight};
pub use kind::{Asked, Honours, TrackerKind};
pub use kinematic::KinematicTracker;
pub use limp::Limp;
pub use pd::PdTracker;
pub use response::ResponseTracker;

use crate::Wanted;
use sinew_body::humanoid::Pose;
use sinew_snapshot::Snapshot;
use sinew_world::{CharacterId, World};
use std::any::Any;
use std::fmt::Debug;

/// The input that a tracker needs for the world's next step. Each variant includes those before it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Wants {
    /// Nothing: it continues with its last input.
    Nothing,
    /// Gains, damping and torques of the joints.
    Firmness,
    /// The joints too, at the end of the step.
    Joints,
    /// The whole pose too, at the end of the motion frame that begins.
    Pose,
}

/// The state with which a tracker starts.
#[derive(Clone, Copy)]
pub struct TrackerStart<'a> {
    /// The wanted pose at any time of the stage \[s\], where the source is a motion that is known beforehand, such as a clip.
    pub motion: Option<&'a dyn Fn(f64) -> Pose>,
}

/// Makes one character's body follow what is wanted. What it remembers is kept by [`Snapshot`].
///
/// Before each step of the world: when [`wants`](Tracker::wants) says so, bring [`Wanted`] up to date, then
/// [`follow`](Tracker::follow). Neither allocates or panics. The character is a place in the world's frame.
///
/// ```
/// use sinew_body::humanoid::{Body, Pose};
/// use sinew_control::Wanted;
/// use sinew_control::tracker::{KinematicTracker, TrackerStart, Tracker, Wants};
/// use sinew_world::{CharacterSpec, Surface, World, WorldSettings};
/// let mut world = World::new(WorldSettings::default());
/// let spec = CharacterSpec { body: Body::standard(80.0, 1.7), pose: Pose::STANDING, velocity: glam::DVec3::ZERO, surface: Surface::BODY };
/// let character = world.add_character(spec)?;
/// let mut tracker: Box<dyn Tracker> = Box::new(KinematicTracker::new(1.0 / 60.0, &Pose::STANDING));
/// tracker.start(&TrackerStart { motion: None }, &mut world, character);
/// let mut wanted = Wanted::STANDING;
/// for _ in 0..240 {
///     if tracker.wants() == Wants::Pose {
///         wanted.pose.hips_position.x += 0.01;
///     }
///     tracker.follow(&wanted, &mut world, character);
///     world.step();
/// }
/// assert!((world.frame().characters[character.slot()].parts[0].position.x - 0.6).abs() < 1e-3);
/// # Ok::<(), sinew_world::SpecError>(())
/// ```
pub trait Tracker: Snapshot + Any + Debug + Send + Sync {
    /// A copy of it with all its state, which goes on to the same bits: a snapshot of a stage holds one.
    fn cloned(&self) -> Box<dyn Tracker>;

    /// Its kind.
    fn kind(&self) -> TrackerKind;

    /// Which of gains, torques and joint springs it honours.
    fn honours(&self) -> Honours;

    /// The input that it needs for the next step.
    fn wants(&self) -> Wants;

    /// Foot locking: whether a root without root motion follows the stance foot on the floor, instead of staying.
    fn locks_feet(&self) -> bool {
        false
    }

    /// The body is its own from now on, after another tracker's [`release`](Tracker::release).
    fn start(&mut self, start: &TrackerStart, world: &mut World, character: CharacterId);

    /// Sets forces, springs or positions for the world's next step.
    fn follow(&mut self, wanted: &Wanted, world: &mut World, character: CharacterId);

    /// Hands the body back to physics.
    fn release(&mut self, world: &mut World, character: CharacterId);
}

impl Clone for Box<dyn Tracker> {
    fn clone(&self) -> Box<dyn Tracker> {
        self.as_ref().cloned()
    }
}
