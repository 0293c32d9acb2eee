//! Steps of physics within motion frames.

/// How far into a motion frame the physics is.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Clock {
    time_step_secs: f64,
    /// Fraction of the motion frame that is over, 1 when the next one is to begin.
    into: f64,
}

/// Rounding of a fraction that is summed step by step.
const ROUNDING: f64 = 1e-6;

sinew_snapshot::snapshot!(Clock { into } fixed { time_step_secs });

impl Clock {
    /// With a motion frame to begin.
    pub(crate) fn new(time_step_secs: f64) -> Clock {
        Clock { time_step_secs: time_step_secs.max(1e-4), into: 1.0 }
    }

    /// Whether the next step of physics begins a motion frame.
    pub(crate) fn is_due(&self) -> bool {
        self.into > 1.0 - ROUNDING
    }

    /// Begins the next motion frame; what physics has gone beyond the last one counts.
    pub(crate) fn begin_frame(&mut self) {
        self.into = (self.into - 1.0).clamp(0.0, 1.0);
        if self.into < ROUNDING {
            self.into = 0.0;
        }
    }

    /// Goes on by a step of physics; the fraction of the motion frame at its end. A step that would end beyond the frame
    /// ends with it and leaves the rest to the next.
    pub(crate) fn advance(&mut self, step_secs: f64) -> f64 {
        self.into += step_secs / self.time_step_secs;
        self.into.min(1.0)
    }

    /// Length of a motion frame \[s\].
    pub(crate) fn time_step_secs(&self) -> f64 {
        self.time_step_secs
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn physics_that_is_no_multiple_of_the_motion_keeps_its_pace() {
        for physics_hz in [60.0, 100.0, 240.0, 250.0, 1000.0] {
            let mut clock = Clock::new(1.0 / 60.0);
            let mut frames = 0;
            for _ in 0..(10.0 * physics_hz) as usize {
                if clock.is_due() {
                    clock.begin_frame();
                    frames += 1;
                }
                clock.advance(1.0 / physics_hz);
            }
            assert!((600..=601).contains(&frames), "{physics_hz}: {frames}");
        }
    }
}
