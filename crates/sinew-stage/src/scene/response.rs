//! Settings of a character's tracker `response`.

use super::SceneSpec;
use super::error::Fault;
use super::range::{count, name as known_name, number};
use schemars::JsonSchema;
use serde::Deserialize;

/// Settings of the tracker `response`. Other trackers ignore them.
#[derive(Clone, Debug, PartialEq, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct ResponseSpec {
    /// Compliance, 0.25 (stiff) to 4 (loose).
    pub compliance: f64,
    /// A moving prop that it stands on; the input is then relative to it.
    pub stands_on: Option<String>,
    /// A hand that keeps a held object (a cup) upright, by part or alias.
    pub keep_upright: Option<String>,
    /// Props that the upper body avoids.
    pub avoid: Vec<String>,
}

impl Default for ResponseSpec {
    fn default() -> ResponseSpec {
        ResponseSpec { compliance: 1.0, stands_on: None, keep_upright: None, avoid: Vec::new() }
    }
}

impl ResponseSpec {
    pub(super) fn check(&self, name: &str) -> Result<(), Fault> {
        let at = |key| ["characters", name, "response", key];
        number(&at("compliance"), self.compliance, 0.25..=4.0, "1 is usual, 0.25 stiff, 4 loose")?;
        count(&at("avoid"), self.avoid.len(), 100)
    }

    /// Whether what it names exists; `name` is the character's.
    pub(super) fn check_names(&self, name: &str, scene: &SceneSpec) -> Result<(), Fault> {
        let at = |key| ["characters", name, "response", key];
        let props = || scene.props.keys().map(String::as_str);
        if let Some(prop) = &self.stands_on {
            known_name(&at("stands_on"), "prop", prop, props())?;
        }
        if let (Some(part), Some(character)) = (&self.keep_upright, scene.characters.get(name))
            && character.node(part).is_none()
        {
            return Err(Fault::at(&at("keep_upright"), character.no_part(part)));
        }
        self.avoid.iter().try_for_each(|prop| known_name(&at("avoid"), "prop", prop, props()))
    }
}
