//! Pose graphs as files state them.

use crate::pose::{PartName, number};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// A pose graph: key poses as states, with transitions between them.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, schemars::JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct GraphSpec {
    /// The state to begin with.
    pub start: String,
    /// The states by name.
    pub states: BTreeMap<String, StateSpec>,
}

/// One state of a graph.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, schemars::JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct StateSpec {
    /// The key pose to aim at.
    pub pose: String,
    /// Transitions out of the state. They are checked in this order, and the first whose conditions all hold is taken.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub to: Vec<TransitionSpec>,
    /// Balance feedback: rotations of joints in proportion to the position and velocity of the centre of mass.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub feedback: Vec<FeedbackSpec>,
    /// Parts whose target rotation is relative to an upright frame with their parent's heading, not to their parent: a
    /// foot with rotation 0 is level for any pose of its leg.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub upright: Vec<PartName>,
    /// The stance leg.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub stance: Option<LegSide>,
    /// The stance leg rotates the hips to `hips_lean_deg` in the world, and the other thigh is upright in the sense of
    /// `upright`. Requires `stance`.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub world_hips: bool,
    /// Lean of the hips with `world_hips` \[degrees\], forward positive, -90 to 90.
    #[serde(default, deserialize_with = "number::lean", skip_serializing_if = "is_zero")]
    #[schemars(range(min = -90, max = 90))]
    pub hips_lean_deg: f64,
    /// Heading of the hips with `world_hips` \[degrees about +Y from +Z to +X, -360 to 360\]. Default: they keep their
    /// present heading.
    #[serde(default, deserialize_with = "number::some_heading", skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = -360, max = 360))]
    pub heading_deg: Option<f64>,
}

/// A transition. All given conditions must hold at once; at least one must be given.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, schemars::JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct TransitionSpec {
    /// The state that it leads to.
    pub state: String,
    /// Minimum time in the state \[s\].
    #[serde(default, deserialize_with = "number::some_secs", skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0, max = 3600))]
    pub after_secs: Option<f64>,
    /// These two are in contact: an own part, `self` for any own part, `ground`, an object, another character, or one
    /// of its parts as `name.part`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub touching: Option<[String; 2]>,
    /// A measured value lies beyond a threshold.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub sensor: Option<SensorSpec>,
    /// This signal was sent (by a script, a key, a command).
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub signal: Option<String>,
}

/// A measured value and its threshold.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, schemars::JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SensorSpec {
    /// What is measured: an own part, `centre` (the own centre of mass), an object, another character, or `name.part`.
    #[serde(default = "centre")]
    pub of: String,
    /// The measured quantity.
    pub is: Quantity,
    /// The other end of a distance; named like `of`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub to: Option<String>,
    /// Holds below this value, in the quantity's unit.
    #[serde(default, deserialize_with = "number::some_threshold", skip_serializing_if = "Option::is_none")]
    pub below: Option<f64>,
    /// Holds above this value; with `below`, both must hold.
    #[serde(default, deserialize_with = "number::some_threshold", skip_serializing_if = "Option::is_none")]
    pub above: Option<f64>,
}

/// What a sensor measures.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, schemars::JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Quantity {
    /// Height above the world's origin of a part's or object's centre of mass \[m\].
    HeightM,
    /// Horizontal speed of its centre of mass \[m/s\].
    SpeedMS,
    /// Velocity of its centre of mass along the character's facing \[m/s\].
    ForwardMS,
    /// Upward velocity of its centre of mass \[m/s\].
    UpMS,
    /// Angle of a part's own up axis from the vertical \[degrees\].
    TiltDeg,
    /// Sum of the magnitudes of all contact forces on a part \[N\].
    LoadN,
    /// Distance of its centre of mass to that of `to` \[m\].
    DistanceM,
    /// Distance of the own centre of mass inside the support polygon's edge \[m\], negative outside; -1000 in the air.
    ComMarginM,
}

impl Quantity {
    /// As files write it.
    pub const fn name(self) -> &'static str {
        match self {
            Quantity::HeightM => "height_m",
            Quantity::SpeedMS => "speed_m_s",
            Quantity::ForwardMS => "forward_m_s",
            Quantity::UpMS => "up_m_s",
            Quantity::TiltDeg => "tilt_deg",
            Quantity::LoadN => "load_n",
            Quantity::DistanceM => "distance_m",
            Quantity::ComMarginM => "com_margin_m",
        }
    }
}

/// Balance feedback in the manner of Yin, Loken and van de Panne 2007: the target rotation of a joint changes by
/// `rad_per_m`·d + `rad_per_m_s`·v, where d is the distance of the centre of mass from the part `from` and v its
/// velocity, both along the facing (axis x) or to the left (axis z).
///
/// A leg swings forward by a negative rotation about x and to the left by a positive one about z, so that stepping
/// towards the centre of mass needs negative gains for x and positive ones for z.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, schemars::JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct FeedbackSpec {
    /// The joint that rotates, about an axis of its parent.
    pub joint: PartName,
    /// About which axis.
    pub axis: TurnAxis,
    /// The part from which the centre of mass is measured; as a rule the stance foot.
    pub from: PartName,
    /// Gain on the distance \[rad/m\].
    #[serde(default, deserialize_with = "number::feedback")]
    pub rad_per_m: f64,
    /// Gain on the velocity \[rad per m/s\].
    #[serde(default, deserialize_with = "number::feedback")]
    pub rad_per_m_s: f64,
}

/// An axis of feedback.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, schemars::JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum TurnAxis {
    /// To the left: rotates forward and backward, with feedback of the motion along the facing.
    X,
    /// Forward: rotates sideways, with feedback of the motion to the left.
    Z,
}

/// A leg.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, schemars::JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum LegSide {
    /// The left one.
    Left,
    /// The right one.
    Right,
}

fn centre() -> String {
    "centre".to_owned()
}

fn is_zero(value: &f64) -> bool {
    *value == 0.0
}
