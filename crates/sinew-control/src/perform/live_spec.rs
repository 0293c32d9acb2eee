//! A live performer as a character's source.

use super::LiveSettings;
use crate::source::SourceFault;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Port and stream settings of a performer. Without a port its samples arrive as commands alone: from a session or a
/// program.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
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

    /// Whether numbers are in range.
    ///
    /// # Errors
    /// What is wrong, at which key of the table.
    pub fn check(&self) -> Result<(), SourceFault> {
        if self.port == Some(0) || self.raw_port == Some(0) {
            let key = if self.port == Some(0) { "port" } else { "raw_port" };
            return Err(SourceFault::at(key, "nobody can send to port 0; write one such as 39539"));
        }
        if self.port.is_some() && self.raw_port.is_some() {
            let problem = "port is stated too; a performer comes by one way, keep one";
            return Err(SourceFault::at("raw_port", problem));
        }
        for (key, value, most, hint) in [
            ("hold_secs", self.hold_secs, 3600.0, "seconds are expected"),
            ("relax_secs", self.relax_secs, 60.0, "seconds are expected"),
            ("relaxed_gain", self.relaxed_gain, 1.0, "1 does not soften the body"),
            ("smoothing_hz", self.smoothing_hz, 1000.0, "6 is usual, 0 switches the filter off"),
            ("most_jitter_secs", self.most_jitter_secs, 0.3, "seconds are expected"),
        ] {
            SourceFault::range(key, value, 0.0..=most, hint)?;
        }
        Ok(())
    }
}
