//! Key poses as files state them.

use super::number;
use super::part_name::PartName;
use serde::de::value::{MapAccessDeserializer, SeqAccessDeserializer};
use serde::de::{Deserializer, Error, MapAccess, SeqAccess, Visitor};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::fmt;

/// A key pose: its differences from a base pose.
///
/// ```
/// use sinew_control::PoseSpec;
/// let pose: PoseSpec = toml::from_str("joints.leftLowerArm = [-60, 0, 0]").unwrap();
/// assert_eq!(pose.joints.len(), 1);
/// ```
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, schemars::JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PoseSpec {
    /// The pose to start from; `stand` (arms hanging) when left out, which is built in.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub base: Option<String>,
    /// Mirror the base: left and right exchanged.
    #[serde(default, skip_serializing_if = "is_false")]
    pub mirror: bool,
    /// Duration of the blend from the previous pose \[s\]; default: the base's, or 0.25.
    #[serde(default, deserialize_with = "number::some_secs", skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0, max = 3600))]
    pub blend_secs: Option<f64>,
    /// Factor on every joint's stiffness (k_sp of Shapiro et al. 2007, EQ3), 0 to 1000; the base's, or 1.
    #[serde(default, deserialize_with = "number::some_factor", skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0, max = 1000))]
    pub gain: Option<f64>,
    /// Factor on every joint's damping, 0 to 1000; the base's, or 1.
    #[serde(default, deserialize_with = "number::some_factor", skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0, max = 1000))]
    pub damping: Option<f64>,
    /// Damp against the velocity at which the wanted pose blends, instead of against rest; the base's, or false.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub follow_velocity: Option<bool>,
    /// Joints by the part that they rotate relative to its parent; default: the base's.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub joints: BTreeMap<PartName, JointSpec>,
    /// Limbs whose angles are solved by IK, after `joints`.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub ik: Vec<IkSpec>,
}

/// One joint: its three angles, or a table with gains.
#[derive(Clone, Debug, PartialEq, Serialize, schemars::JsonSchema)]
#[serde(untagged)]
pub enum JointSpec {
    /// Degrees about the part's X (to the left), Y (up along the bone) and Z (forward) axes. The rotation is X·Y·Z: Z is
    /// applied first.
    Turn([f64; 3]),
    /// Angles and gains.
    Full(FullJointSpec),
}

/// A joint with gains of its own.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, schemars::JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct FullJointSpec {
    /// Degrees about X, Y, Z; the base's when left out.
    #[serde(default, deserialize_with = "number::some_turn", skip_serializing_if = "Option::is_none")]
    pub turn_deg: Option<[f64; 3]>,
    /// Factor on the joint's stiffness, on top of the pose's; the base's, or 1.
    #[serde(default, deserialize_with = "number::some_factor", skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0, max = 1000))]
    pub gain: Option<f64>,
    /// Factor on the joint's damping, on top of the pose's; the base's, or 1.
    #[serde(default, deserialize_with = "number::some_factor", skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0, max = 1000))]
    pub damping: Option<f64>,
}

/// An IK target of a limb.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, schemars::JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct IkSpec {
    /// The hand or foot whose centre goes to the target.
    pub link: PartName,
    /// The target \[m\], for a body of 1.7 m (scaled with the stature): x to the character's left, y up from the floor,
    /// z forward, from the point on the floor between the feet of the standing body.
    #[serde(deserialize_with = "number::place")]
    pub target_m: [f64; 3],
}

fn is_false(value: &bool) -> bool {
    !value
}

/// An untagged enum's own errors say nothing; this keeps the field's.
impl<'de> Deserialize<'de> for JointSpec {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<JointSpec, D::Error> {
        struct Either;

        impl<'de> Visitor<'de> for Either {
            type Value = JointSpec;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("three angles in degrees such as [-90, 0, 20], or a table with turn_deg, gain, damping")
            }

            fn visit_seq<A: SeqAccess<'de>>(self, seq: A) -> Result<JointSpec, A::Error> {
                let degrees = <[f64; 3]>::deserialize(SeqAccessDeserializer::new(seq))?;
                number::turn(degrees).map(JointSpec::Turn).map_err(A::Error::custom)
            }

            fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<JointSpec, A::Error> {
                FullJointSpec::deserialize(MapAccessDeserializer::new(map)).map(JointSpec::Full)
            }
        }

        from.deserialize_any(Either)
    }
}
