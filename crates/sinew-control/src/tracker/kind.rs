//! The trackers by name, and what each of them honours.

use super::{KdTracker, KinematicTracker, Limp, PdTracker, ResponseTracker};
use crate::{OrderError, OrderErrorKind};
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

sinew_snapshot::snapshot!(enum TrackerKind { 0: Kinematic, 1: Pd, 2: Kd, 3: Response, 4: None });

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

/// Something that is asked of a tracker beside following the wanted pose.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Asked {
    /// See [`Honours::gains`].
    Gains,
    /// See [`Honours::torques`].
    Torques,
    /// See [`Honours::springs`].
    Springs,
}

impl Asked {
    const fn is_in(self, honours: Honours) -> bool {
        match self {
            Asked::Gains => honours.gains,
            Asked::Torques => honours.torques,
            Asked::Springs => honours.springs,
        }
    }

    const fn words(self) -> &'static str {
        match self {
            Asked::Gains => "has no joint gains",
            Asked::Torques => "takes no torques from reflexes",
            Asked::Springs => "does not use the springs of single joints",
        }
    }
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

    /// Whether such a tracker honours something.
    ///
    /// ```
    /// use sinew_control::OrderErrorKind;
    /// use sinew_control::tracker::{Asked, TrackerKind};
    /// let refused = TrackerKind::Kinematic.check(Asked::Gains).unwrap_err();
    /// assert_eq!(refused.kind(), OrderErrorKind::NotHonoured);
    /// assert_eq!(refused.to_string(), "the tracker `kinematic` has no joint gains; follow by pd or kd");
    /// ```
    ///
    /// # Errors
    /// [`OrderErrorKind::NotHonoured`]: what it lacks, and which trackers have it.
    pub fn check(self, asked: Asked) -> Result<(), OrderError> {
        if asked.is_in(self.honours()) {
            return Ok(());
        }
        let able = TrackerKind::ALL.into_iter().filter(|kind| asked.is_in(kind.honours())).map(TrackerKind::name);
        let able = able.collect::<Vec<_>>().join(" or ");
        let problem = format!("the tracker `{}` {}; follow by {able}", self.name(), asked.words());
        Err(OrderError::new(OrderErrorKind::NotHonoured, problem))
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
