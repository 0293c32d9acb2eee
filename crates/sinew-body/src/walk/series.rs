//! Fourier series over the phase of a stride.

use std::f64::consts::TAU;

/// Highest harmonic of the measured series.
pub(super) const ORDER: usize = 5;

/// Mean, then cosine and sine of each harmonic.
pub(super) type Series = [f64; 1 + 2 * ORDER];

/// Cosine and sine of every harmonic at a phase \[strides\].
pub(super) struct Waves([(f64, f64); ORDER]);

impl Waves {
    pub fn at(phase: f64) -> Waves {
        // Whole strides are taken off first, so that the same moment of every stride has the same bits.
        let phase = phase - phase.floor();
        Waves(std::array::from_fn(|index| {
            let (sin, cos) = libm::sincos(TAU * (index + 1) as f64 * phase);
            (cos, sin)
        }))
    }

    /// The series' mean plus its swing about it, `gain` times as large.
    pub fn value(&self, series: &Series, gain: f64) -> f64 {
        let swing: f64 =
            self.0.iter().enumerate().map(|(k, (cos, sin))| series[2 * k + 1] * cos + series[2 * k + 2] * sin).sum();
        series[0] + gain * swing
    }
}

/// The series through values at even phases, by projection, of the harmonics that `keep` names.
pub(super) fn project(values: &[f64], keep: impl Fn(usize) -> bool) -> Series {
    let mut series = [0.0; 1 + 2 * ORDER];
    let count = values.len() as f64;
    for (index, value) in values.iter().enumerate() {
        let waves = Waves::at(index as f64 / count);
        if keep(0) {
            series[0] += value / count;
        }
        for (k, (cos, sin)) in waves.0.iter().enumerate().filter(|(k, _)| keep(k + 1)) {
            series[2 * k + 1] += 2.0 / count * value * cos;
            series[2 * k + 2] += 2.0 / count * value * sin;
        }
    }
    series
}

/// From 0 to 1 with speed and change of speed zero at both ends.
pub(super) fn smooth_step(from: f64, to: f64, at: f64) -> f64 {
    let t = ((at - from) / (to - from)).clamp(0.0, 1.0);
    t * t * t * (t * (6.0 * t - 15.0) + 10.0)
}

/// A value with its first and second derivative.
pub(super) type Jet<V> = [V; 3];

/// The polynomial of fifth degree with these values, speeds and changes of speed at `t` = 0 and `t` = 1 of a stretch
/// that lasts `span`, its derivatives being by the same unit as `span`.
pub(super) fn quintic<V>(start: &Jet<V>, end: &Jet<V>, span: f64, t: f64) -> V
where
    V: Copy + std::ops::Add<Output = V> + std::ops::Sub<Output = V> + std::ops::Mul<f64, Output = V>,
{
    let (v0, v1) = (start[1] * span, end[1] * span);
    let (a0, a1) = (start[2] * (span * span), end[2] * (span * span));
    let way = end[0] - start[0];
    let c3 = way * 10.0 - v0 * 6.0 - v1 * 4.0 - a0 * 1.5 + a1 * 0.5;
    let c4 = way * -15.0 + v0 * 8.0 + v1 * 7.0 + a0 * 1.5 - a1;
    let c5 = way * 6.0 - v0 * 3.0 - v1 * 3.0 - a0 * 0.5 + a1 * 0.5;
    start[0] + (v0 + (a0 * 0.5 + (c3 + (c4 + c5 * t) * t) * t) * t) * t
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_projected_series_returns_its_values() {
        let series: Series = [1.0, 0.3, -0.2, 0.1, 0.4, 0.0, 0.2, -0.1, 0.05, 0.02, 0.01];
        let values: Vec<f64> = (0..32).map(|index| Waves::at(f64::from(index) / 32.0).value(&series, 1.0)).collect();
        let again = project(&values, |_| true);
        assert!(series.iter().zip(again).all(|(a, b)| (a - b).abs() < 1e-12), "{again:?}");
    }

    #[test]
    fn a_quintic_meets_both_of_its_ends() {
        let value = |t: f64| quintic(&[1.0, 2.0, -3.0], &[-1.0, 0.5, 4.0], 0.4, t);
        let step = 1e-4;
        assert!((value(0.0) - 1.0).abs() < 1e-12 && (value(1.0) + 1.0).abs() < 1e-12);
        // One-sided differences are good to the step.
        assert!(((value(step) - value(0.0)) / (0.4 * step) - 2.0).abs() < 1e-3);
        assert!(((value(1.0) - value(1.0 - step)) / (0.4 * step) - 0.5).abs() < 1e-3);
    }
}
