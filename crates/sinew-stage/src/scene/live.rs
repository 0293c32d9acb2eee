//! A live performer as a character's source.

use super::error::Fault;
use super::range::number;
use schemars::JsonSchema;
use serde::Deserialize;
use sinew_control::perform::LiveSettings;

/// Port and stream settings of a performer. Without a port its samples arrive as commands alone: from a session or a
/// program.
#[derive(Clone, Debug, PartialEq, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct LiveSpec {
    /// UDP port for VMC; 39539 is usual.
    pub port: Option<u16>,
    /// TCP port for BVH: its header once, then a line of channel values for each frame.
    pub raw_port: Option<u16>,
    /// Time for which the last pose is held when the stream is silent \[s\].
    pub hold_secs: f64,
    /// Minimum time of the following blend to standing \[s\].
    pub relax_secs: f64,
    /// Factor on the stiffness when relaxed, 0 to 1.
    pub relaxed_gain: f64,
    /// Cut-off of the One-Euro filter at rest \[Hz\]; 0 for no filter.
    pub smoothing_hz: f64,
    /// Maximum delay of the jitter buffer \[s\].
    pub most_jitter_secs: f64,
}

impl Default for LiveSpec {
    fn default() -> LiveSpec {
        let LiveSettings { hold_secs, relax_secs, relaxed_gain, smoothing_hz, most_jitter_secs } =
            LiveSettings::default();
        LiveSpec { port: None, raw_port: None, hold_secs, relax_secs, relaxed_gain, smoothing_hz, most_jitter_secs }
    }
}

impl LiveSpec {
    /// Settings of the source.
    pub fn settings(&self) -> LiveSettings {
        LiveSettings {
            hold_secs: self.hold_secs,
            relax_secs: self.relax_secs,
            relaxed_gain: self.relaxed_gain,
            smoothing_hz: self.smoothing_hz,
            most_jitter_secs: self.most_jitter_secs,
        }
    }

    pub(super) fn check(&self, name: &str) -> Result<(), Fault> {
        let at = |key| ["characters", name, "source", "live", key];
        if self.port == Some(0) || self.raw_port == Some(0) {
            let key = if self.port == Some(0) { "port" } else { "raw_port" };
            return Err(Fault::at(&at(key), "nobody can send to port 0; write one such as 39539"));
        }
        if self.port.is_some() && self.raw_port.is_some() {
            return Err(Fault::at(&at("raw_port"), "port is stated too; a performer comes by one way, keep one"));
        }
        number(&at("hold_secs"), self.hold_secs, 0.0..=3600.0, "seconds are expected")?;
        number(&at("relax_secs"), self.relax_secs, 0.0..=60.0, "seconds are expected")?;
        number(&at("relaxed_gain"), self.relaxed_gain, 0.0..=1.0, "1 keeps the body as firm as ever")?;
        number(&at("smoothing_hz"), self.smoothing_hz, 0.0..=1000.0, "6 is usual, 0 switches the filter off")?;
        number(&at("most_jitter_secs"), self.most_jitter_secs, 0.0..=0.3, "seconds are expected")
    }
}
