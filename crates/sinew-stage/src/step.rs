//! Times as steps of physics.

/// The step that begins at, or first after, a time.
pub(crate) fn step_of(secs: f64, step_secs: f64) -> u64 {
    // A time that is a whole number of steps but for rounding is that number.
    (secs / step_secs - 1e-6).ceil().max(0.0) as u64
}
