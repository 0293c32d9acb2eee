//! Settings of a live source.

/// Times and filters of a [`LiveSource`](super::LiveSource).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LiveSettings {
    /// Time for which the last pose is held when the stream is silent \[s\].
    pub hold_secs: f64,
    /// Minimum time of the following blend to standing \[s\].
    pub relax_secs: f64,
    /// Factor on the stiffness when relaxed \[1\].
    pub relaxed_gain: f64,
    /// Cut-off of the One-Euro filter at rest \[Hz\]; 0 switches it off.
    pub smoothing_hz: f64,
    /// Maximum delay of the jitter buffer \[s\].
    pub most_jitter_secs: f64,
}

impl Default for LiveSettings {
    fn default() -> LiveSettings {
        LiveSettings { hold_secs: 1.0, relax_secs: 1.5, relaxed_gain: 0.5, smoothing_hz: 6.0, most_jitter_secs: 0.12 }
    }
}
