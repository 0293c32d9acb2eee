//! Settings of a character's tracker `kd`.

use super::SceneSpec;
use super::error::Fault;
use super::range::{name as known_name, number, optional};
use schemars::JsonSchema;
use serde::Deserialize;
use sinew_body::humanoid::Node;
use sinew_control::range;
use sinew_control::tracker::{KdDamping, KdGains, KdPreset, KdSettings};
use std::collections::BTreeMap;

/// Settings of the tracker `kd`. Other trackers ignore them.
#[derive(Clone, Debug, PartialEq, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct KdSpec {
    /// Gains for a purpose.
    pub preset: KdPreset,
    /// In place of the preset's: stiffness of pins \[1/s², per unit mass\].
    pub k_p: Option<f64>,
    /// Its damping \[1/s, per unit mass\].
    pub d_p: Option<f64>,
    /// Stiffness of joints \[1/s², per unit of outboard inertia\].
    pub k_q: Option<f64>,
    /// Its damping \[1/s, per unit of inertia\].
    pub d_q: Option<f64>,
    /// Damping relative to the performer's velocity, or to the ground as in the paper.
    pub damping: KdDamping,
    /// Feed-forward: add the forces that the performer's motion itself requires.
    pub feed_forward: bool,
    /// Impact compliance: the trunk yields to impacts, not to slow loads.
    pub yields: bool,
    /// Contact support: pins fade by the share of the weight that contacts other than the ground carry, such as a seat.
    pub leans: bool,
    /// Factor on the maximum pin force of a part, 0 to 100: 1 is 1.5 body weights for parts of legs, 4 for others.
    pub strength: f64,
    /// Weights of single parts, by part or alias.
    pub weights: BTreeMap<String, WeightSpec>,
    /// The reaction body: a prop that carries the performer along, such as a car.
    pub stands_on: Option<String>,
}

/// Weights of a part: 1 full, 0 off.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct WeightSpec {
    /// Of its pin, 0 to 100.
    pub pin: f64,
    /// Of its joint spring, 0 to 100.
    pub joint: f64,
}

impl Default for KdSpec {
    fn default() -> KdSpec {
        KdSpec {
            preset: KdPreset::Default,
            k_p: None,
            d_p: None,
            k_q: None,
            d_q: None,
            damping: KdDamping::Relative,
            feed_forward: true,
            yields: true,
            leans: true,
            strength: 1.0,
            weights: BTreeMap::new(),
            stands_on: None,
        }
    }
}

impl Default for WeightSpec {
    fn default() -> WeightSpec {
        WeightSpec { pin: 1.0, joint: 1.0 }
    }
}

impl KdSpec {
    /// For the tracker; `node` finds a part by the character's own names.
    pub(crate) fn settings(&self, node: impl Fn(&str) -> Option<Node>) -> KdSettings {
        let mut settings = KdSettings {
            gains: self.gains(),
            damping: self.damping,
            feed_forward: self.feed_forward,
            yields: self.yields,
            leans: self.leans,
            strength: self.strength,
            ..KdSettings::default()
        };
        for (part, weight) in &self.weights {
            if let Some(node) = node(part) {
                let own = &mut settings.weights[node.index()];
                (own.pin, own.joint) = (weight.pin, weight.joint);
            }
        }
        settings
    }

    /// The preset's gains with those in place of them.
    pub fn gains(&self) -> KdGains {
        let preset = self.preset.gains();
        KdGains {
            k_p: self.k_p.unwrap_or(preset.k_p),
            d_p: self.d_p.unwrap_or(preset.d_p),
            k_q: self.k_q.unwrap_or(preset.k_q),
            d_q: self.d_q.unwrap_or(preset.d_q),
        }
    }

    pub(super) fn check(&self, name: &str) -> Result<(), Fault> {
        let at = |key| ["characters", name, "kd", key];
        for (key, value, hint) in [
            ("k_p", self.k_p, "160 per second squared is usual"),
            ("d_p", self.d_p, "25 per second is usual"),
            ("k_q", self.k_q, "450 per second squared is usual"),
            ("d_q", self.d_q, "10 per second is usual"),
        ] {
            optional(&at(key), value, range::KD_GAIN.inclusive(), hint)?;
        }
        number(&at("strength"), self.strength, range::KD_WEIGHT.inclusive(), "1 is full strength")?;
        for (part, weight) in &self.weights {
            let at = |key| ["characters", name, "kd", "weights", part, key];
            number(&at("pin"), weight.pin, range::KD_WEIGHT.inclusive(), "1 is as the gains say")?;
            number(&at("joint"), weight.joint, range::KD_WEIGHT.inclusive(), "1 is as the gains say")?;
        }
        Ok(())
    }

    /// Whether what it names exists; `name` is the character's.
    pub(super) fn check_names(&self, name: &str, scene: &SceneSpec) -> Result<(), Fault> {
        if let Some(prop) = &self.stands_on {
            let at = ["characters", name, "kd", "stands_on"];
            known_name(&at, "prop", prop, scene.props.keys().map(String::as_str))?;
        }
        let Some(character) = scene.characters.get(name) else { return Ok(()) };
        for part in self.weights.keys() {
            if character.node(part).is_none() {
                return Err(Fault::at(&["characters", name, "kd", "weights", part], character.no_part(part)));
            }
        }
        Ok(())
    }
}
