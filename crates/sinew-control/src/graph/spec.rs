//! Pose graphs as files state them.

use crate::pose::{PartName, number};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// Key poses in sequence, with what leads from one to the next.
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
    /// What leads out of the state. They are looked at in this order, and the first whose conditions all hold is taken.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub to: Vec<TransitionSpec>,
    /// Turns of joints in proportion to where the centre of mass is.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub feedback: Vec<FeedbackSpec>,
    /// Parts whose wanted turn is measured from an upright frame that faces as their parents do, not from their parents: a foot
    /// with a turn of 0 is level whatever its leg does.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub upright: Vec<PartName>,
    /// Which leg carries the body.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub stance: Option<LegSide>,
    /// The leg that carries turns the hips to `hips_lean_deg` in the world, and the other thigh is upright in the sense of
    /// `upright`. Needs `stance`.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub world_hips: bool,
    /// Lean of the hips with `world_hips` \[degrees\], forward positive, -90 to 90.
    #[serde(default, deserialize_with = "number::lean", skip_serializing_if = "is_zero")]
    #[schemars(range(min = -90, max = 90))]
    pub hips_lean_deg: f64,
    /// Where the hips are turned to with `world_hips` \[degrees about +Y from +Z to +X, -360 to 360\]; when left out they keep the
    /// facing that they have.
    #[serde(default, deserialize_with = "number::some_heading", skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = -360, max = 360))]
    pub heading_deg: Option<f64>,
}

/// A way out of a state. All conditions that are given must hold at once; at least one must be given.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, schemars::JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct TransitionSpec {
    /// The state that it leads to.
    pub state: String,
    /// The state has lasted at least so long \[s\].
    #[serde(default, deserialize_with = "number::some_secs", skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0, max = 3600))]
    pub after_secs: Option<f64>,
    /// These two touch: an own part, `self` for any own part, `ground`, an object, another character, or one of its parts as
    /// `name.part`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub touching: Option<[String; 2]>,
    /// A measured value lies beyond a threshold.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub sensor: Option<SensorSpec>,
    /// This word was sent (by a script, a key, a command).
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
    /// Which of its values.
    pub is: Quantity,
    /// To where a distance is measured; named like `of`.
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
    /// Force of all contacts on a part \[N\], the sum of their sizes.
    LoadN,
    /// Distance of its centre of mass to that of `to` \[m\].
    DistanceM,
    /// How far the own centre of mass lies inside the support polygon's edge \[m\], negative outside; far outside (-1000) in the
    /// air.
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

/// Balance feedback in the manner of Yin, Loken and van de Panne 2007: the wanted turn of a joint changes by
/// `rad_per_m`·d + `rad_per_m_s`·v, where d is how far the centre of mass lies from the part `from` and v its velocity, both
/// along the facing (axis x) or to the left (axis z).
///
/// A leg swings forward by a negative turn about x and to the left by a positive one about z, so that stepping after the
/// centre of mass takes negative numbers for x and positive ones for z.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, schemars::JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct FeedbackSpec {
    /// The joint that turns, about an axis of its parent.
    pub joint: PartName,
    /// About which axis.
    pub axis: TurnAxis,
    /// The part from which the centre of mass is measured; as a rule the foot that stands.
    pub from: PartName,
    /// For the distance \[rad/m\].
    #[serde(default, deserialize_with = "number::feedback")]
    pub rad_per_m: f64,
    /// For the velocity \[rad per m/s\].
    #[serde(default, deserialize_with = "number::feedback")]
    pub rad_per_m_s: f64,
}

/// An axis of feedback.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, schemars::JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum TurnAxis {
    /// To the left: turns forward and backward, fed by what happens along the facing.
    X,
    /// Forward: turns sideways, fed by what happens to the left.
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
