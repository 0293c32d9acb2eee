//! Characters of a scene.

use super::error::{Fault, known, shortened};
use super::range::{colour, count, name as known_name, number, optional, rgb, vector};
use super::{KdSpec, ResponseSpec};
use schemars::JsonSchema;
use serde::Deserialize;
use sinew_body::humanoid::Node;
use sinew_control::source::SourceSpec;
use sinew_control::tracker::TrackerKind;
use sinew_control::{Layer, range};
use sinew_motion::Part;
use std::collections::BTreeMap;

/// A character: body, initial position, source and tracker.
#[derive(Clone, Debug, PartialEq, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct CharacterSpec {
    /// Mass \[kg\], 1 to 1000.
    pub mass_kg: f64,
    /// Standing height \[m\], 0.2 to 10. Default: that of the clip's skeleton, or 1.7 without a clip.
    pub height_m: Option<f64>,
    /// A motion file from whose skeleton the body is made. Default: average proportions.
    pub clip: Option<String>,
    /// Initial position: the point of the floor below the hips; y lifts it \[m\].
    pub position_m: [f64; 3],
    /// Initial heading \[degrees about +Y from +Z to +X\].
    pub facing_deg: f64,
    /// Velocity of the whole body at the start, in the world's axes \[m/s\].
    pub velocity_m_s: [f64; 3],
    /// Angular velocity of the whole body about its centre of mass at the start, in the world's axes \[rad/s\].
    pub spin_rad_s: [f64; 3],
    /// The key pose at the start. Default: standing.
    pub pose: Option<String>,
    /// How the body follows the wanted pose.
    pub tracker: TrackerKind,
    /// Settings of the tracker `kd`.
    pub kd: KdSpec,
    /// Settings of the tracker `response`.
    pub response: ResponseSpec,
    /// The source of the wanted pose. Default: the pose at the start.
    pub source: Option<SourceSpec>,
    /// A Python controller to start with.
    pub controller: Option<String>,
    /// Reflexes that are enabled from the start.
    pub reflexes: Vec<String>,
    /// Layers that are on at the start. Default: all.
    pub layers: Vec<Layer>,
    /// Factor on the stiffness of all joints (EQ3's global gain), 0 to 1000.
    pub pose_gain: f64,
    /// Stiffness of single joints, by part or alias.
    pub joints: BTreeMap<String, JointSpec>,
    /// More names for parts, such as `RightArm = "rightHand"`.
    pub aliases: BTreeMap<String, String>,
    /// Constrained to a vertical plane from the start: `true` for that of its facing.
    pub plane: PlaneSpec,
    /// Factor on gravity.
    pub gravity_scale: f64,
    /// Coefficient of friction of skin and soles, 0 to 10.
    pub friction: Option<f64>,
    /// Its colour in pictures, `#rrggbb`.
    pub colour: Option<String>,
}

/// Gains of one joint. Default of each key: the standard gains.
#[derive(Clone, Copy, Debug, Default, PartialEq, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct JointSpec {
    /// Natural frequency \[Hz\], up to 100; 0 makes the joint limp.
    pub frequency_hz: Option<f64>,
    /// Damping ratio: 1 is critical, without overshoot.
    pub damping_ratio: Option<f64>,
    /// The joint carries the body (an ankle): the load is added to its stiffness.
    pub carries: Option<bool>,
}

/// The plane to which a character is constrained.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize, JsonSchema)]
#[serde(untagged, expecting = "expected `true`, `false`, or `{ facing_deg = 90 }`")]
pub enum PlaneSpec {
    /// That of its own facing, or none.
    Held(bool),
    /// Another one.
    Facing(PlaneFacing),
}

/// A plane by its facing.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PlaneFacing {
    /// The horizontal direction in the plane \[degrees about +Y from +Z to +X\].
    pub facing_deg: f64,
}

/// Reflexes that exist.
pub const REFLEXES: [&str; 1] = ["balance"];

impl Default for CharacterSpec {
    fn default() -> CharacterSpec {
        CharacterSpec {
            mass_kg: 80.0,
            height_m: None,
            clip: None,
            position_m: [0.0; 3],
            facing_deg: 0.0,
            velocity_m_s: [0.0; 3],
            spin_rad_s: [0.0; 3],
            pose: None,
            tracker: TrackerKind::default(),
            kd: KdSpec::default(),
            response: ResponseSpec::default(),
            source: None,
            controller: None,
            reflexes: Vec::new(),
            layers: vec![Layer::Poses, Layer::Scripts, Layer::Reflexes],
            pose_gain: 1.0,
            joints: BTreeMap::new(),
            aliases: BTreeMap::new(),
            plane: PlaneSpec::Held(false),
            gravity_scale: 1.0,
            friction: None,
            colour: None,
        }
    }
}

impl CharacterSpec {
    /// The part that a name means: a VRM part or one of the character's aliases.
    pub fn part(&self, name: &str) -> Option<Part> {
        self.aliases.get(name).map_or(name, String::as_str).parse().ok()
    }

    /// The body of that part.
    pub fn node(&self, name: &str) -> Option<Node> {
        self.part(name).map(Node::of)
    }

    /// Heading of the plane to which it is constrained at the start \[degrees about +Y from +Z to +X\].
    pub fn plane_facing_deg(&self) -> Option<f64> {
        match self.plane {
            PlaneSpec::Held(false) => None,
            PlaneSpec::Held(true) => Some(self.facing_deg),
            PlaneSpec::Facing(PlaneFacing { facing_deg }) => Some(facing_deg),
        }
    }

    /// The colour's red, green and blue.
    pub fn rgb(&self) -> Option<[u8; 3]> {
        self.colour.as_deref().and_then(rgb)
    }

    /// The error for an unknown part.
    pub(crate) fn no_part(&self, wanted: &str) -> String {
        let parts = Node::ALL.into_iter().map(|node| node.part().name());
        let names = self.aliases.keys().map(String::as_str).chain(parts);
        format!("no part or alias `{}`; {}", shortened(wanted), known(wanted, names))
    }

    pub(super) fn check(&self, name: &str) -> Result<(), Fault> {
        let at = |key| ["characters", name, key];
        number(&at("mass_kg"), self.mass_kg, 1.0..=1000.0, "kilograms are expected")?;
        optional(&at("height_m"), self.height_m, 0.2..=10.0, "metres are expected, not centimetres")?;
        vector(&at("position_m"), self.position_m, range::PLACE_M.max, "metres are expected")?;
        number(&at("facing_deg"), self.facing_deg, range::FACING_DEG.inclusive(), "degrees are expected")?;
        vector(&at("velocity_m_s"), self.velocity_m_s, range::VELOCITY_M_S.max, "metres a second are expected")?;
        vector(&at("spin_rad_s"), self.spin_rad_s, 1e3, "radians a second are expected")?;
        number(&at("pose_gain"), self.pose_gain, range::GAIN.inclusive(), "1 is usual")?;
        number(&at("gravity_scale"), self.gravity_scale, range::GRAVITY_SCALE.inclusive(), "1 is as on Earth")?;
        optional(&at("friction"), self.friction, 0.0..=10.0, "rubber has about 1, ice 0.05")?;
        colour(&at("colour"), self.colour.as_deref())?;
        if let PlaneSpec::Facing(plane) = self.plane {
            number(
                &["characters", name, "plane", "facing_deg"],
                plane.facing_deg,
                range::FACING_DEG.inclusive(),
                "degrees are expected",
            )?;
        }
        self.kd.check(name)?;
        self.response.check(name)?;
        count(&at("reflexes"), self.reflexes.len(), REFLEXES.len())?;
        for reflex in &self.reflexes {
            known_name(&at("reflexes"), "reflex", reflex, REFLEXES)?;
        }
        count(&at("layers"), self.layers.len(), 3)?;
        count(&at("aliases"), self.aliases.len(), 100)?;
        for (alias, part) in &self.aliases {
            let path = ["characters", name, "aliases", alias];
            if Part::named(alias).is_some() {
                return Err(Fault::at(&path, "this is a part's own name; choose another alias"));
            }
            if part.parse::<Part>().is_err() {
                return Err(Fault::at(&path, CharacterSpec::default().no_part(part)));
            }
        }
        for (joint, spec) in &self.joints {
            let path = |key: &'static str| ["characters", name, "joints", joint, key];
            match self.node(joint) {
                Some(Node::Hips) => {
                    return Err(Fault::at(&path("")[..4], "the hips have no joint above them; name another part"));
                }
                Some(_) => {}
                None => return Err(Fault::at(&path("")[..4], self.no_part(joint))),
            }
            optional(&path("frequency_hz"), spec.frequency_hz, 0.0..=100.0, "2 to 6 Hz are usual")?;
            optional(&path("damping_ratio"), spec.damping_ratio, 0.0..=100.0, "1 is usual")?;
        }
        Ok(())
    }
}
