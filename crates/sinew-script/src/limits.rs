//! Limits of a script.

use serde::{Deserialize, Serialize};
use std::time::Duration;

/// Limits of a script.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Limits {
    /// Address space for the script's own data, on top of what the interpreter has taken before the script is read
    /// \[bytes\]. Enforced by the kernel on Linux; not enforced elsewhere.
    pub memory_bytes: u64,
    /// Maximum wall-clock time of a step \[s\].
    pub step_secs: f64,
    /// Additional time for the first step and a new text, for the interpreter to start \[s\].
    pub startup_secs: f64,
    /// Maximum number of commands in one step; one more is an exception in the script.
    pub commands: usize,
    /// Maximum number of printed lines kept in one step; further ones are counted.
    pub printed_lines: usize,
}

impl Default for Limits {
    fn default() -> Limits {
        Limits { memory_bytes: 512 << 20, step_secs: 1.0, startup_secs: 5.0, commands: 1000, printed_lines: 100 }
    }
}

impl Limits {
    pub(crate) fn step(&self) -> Duration {
        seconds(self.step_secs)
    }

    pub(crate) fn startup(&self) -> Duration {
        seconds(self.startup_secs) + self.step()
    }
}

/// Clamped to the range from a millisecond to a day.
fn seconds(secs: f64) -> Duration {
    let secs = if secs.is_finite() { secs.clamp(1e-3, 86_400.0) } else { 86_400.0 };
    Duration::from_secs_f64(secs)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn times_that_are_no_times_become_some() {
        for secs in [f64::NAN, f64::INFINITY, -1.0, 0.0, 1e300] {
            let limits = Limits { step_secs: secs, startup_secs: secs, ..Limits::default() };
            assert!(limits.step() >= Duration::from_millis(1) && limits.startup() <= Duration::from_secs(2 * 86_400));
        }
    }
}
