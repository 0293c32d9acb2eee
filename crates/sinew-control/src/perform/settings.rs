//! How a live source behaves.

/// Times and filters of a [`LiveSource`](super::LiveSource).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LiveSettings {
    /// How long the last pose is held when nothing comes \[s\].
    pub hold_secs: f64,
    /// How long it then takes, at least, to relax into standing \[s\].
    pub relax_secs: f64,
    /// Factor on the stiffness when relaxed \[1\].
    pub relaxed_gain: f64,
    /// Cut-off of the One-Euro filter at rest \[Hz\]; 0 switches it off.
    pub smoothing_hz: f64,
    /// The longest that samples may be kept back to even out a network's jitter \[s\].
    pub most_jitter_secs: f64,
}

impl Default for LiveSettings {
    fn default() -> LiveSettings {
        LiveSettings { hold_secs: 1.0, relax_secs: 1.5, relaxed_gain: 0.5, smoothing_hz: 6.0, most_jitter_secs: 0.12 }
    }
}
