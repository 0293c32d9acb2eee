//! How a character responds: the settings of its tracker `response`.

use super::error::Fault;
use super::range::{count, number};
use schemars::JsonSchema;
use serde::Deserialize;

/// Settings of the tracker `response`. They are only looked at by it.
#[derive(Clone, Debug, PartialEq, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct ResponseSpec {
    /// How far the body yields, 0.25 (stiff) to 4 (loose).
    pub compliance: f64,
    /// A moving prop that it stands on; the input is then relative to it.
    pub stands_on: Option<String>,
    /// A hand that is to keep what it holds upright (a cup), by part or alias.
    pub keep_upright: Option<String>,
    /// Props that the upper body is to keep away from.
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
}
