//! The trackers by name, and what each of them honours.

use super::{KdTracker, KinematicTracker, Limp, PdTracker, ResponseTracker};
use serde::Deserialize;

/// How a body follows the wanted pose.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize, schemars::JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum TrackerKind {
    /// Kinematic: the body has the wanted pose, and nothing moves it.
    Kinematic,
    /// Springs in the joints.
    #[default]
    Pd,
    /// Joint springs, and pins that hold every part to its position in the world.
    Kd,
    /// The response: follows, and yields in the near-unactuated coordinates of its own motion.
    Response,
    /// No tracker: the body is limp.
    None,
}

/// The inputs that a tracker honours beside the wanted pose. Inputs that it does not honour are refused.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Honours {
    /// Factors on the joints' stiffness: the command `gain`, a scene's `pose_gain`, the layer `poses` off.
    pub gains: bool,
    /// Torques in joints: reflexes.
    pub torques: bool,
    /// Frequencies and damping ratios of single joints: a scene's `joints`.
    pub springs: bool,
}

impl Honours {
    /// The wanted pose alone.
    pub const NOTHING: Honours = Honours { gains: false, torques: false, springs: false };
}

impl TrackerKind {
    /// All of them.
    pub const ALL: [TrackerKind; 5] =
        [TrackerKind::Kinematic, TrackerKind::Pd, TrackerKind::Kd, TrackerKind::Response, TrackerKind::None];

    /// As scenes and commands name it.
    pub const fn name(self) -> &'static str {
        match self {
            TrackerKind::Kinematic => "kinematic",
            TrackerKind::Pd => "pd",
            TrackerKind::Kd => "kd",
            TrackerKind::Response => "response",
            TrackerKind::None => "none",
        }
    }

    /// The one of this name.
    pub fn of(name: &str) -> Option<TrackerKind> {
        TrackerKind::ALL.into_iter().find(|kind| kind.name() == name)
    }

    /// What such a tracker honours, before there is one.
    pub const fn honours(self) -> Honours {
        match self {
            TrackerKind::Kinematic => KinematicTracker::HONOURS,
            TrackerKind::Pd => PdTracker::HONOURS,
            TrackerKind::Kd => KdTracker::HONOURS,
            TrackerKind::Response => ResponseTracker::HONOURS,
            TrackerKind::None => Limp::HONOURS,
        }
    }
}
