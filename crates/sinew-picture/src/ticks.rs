//! Round numbers for axes.

/// Round numbers a fixed step apart.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Ticks {
    first: f64,
    step: f64,
    count: usize,
    /// Digits after the point, or `None` for powers of ten.
    decimals: Option<usize>,
}

impl Ticks {
    /// About `wanted` round numbers within `low..=high`: steps of 1, 2 or 5 times a power of ten.
    pub fn within(low: f64, high: f64, wanted: f64) -> Ticks {
        let (low, high) = widened(low, high);
        let rough = (high - low) / wanted.clamp(1.0, 40.0);
        let power = libm::floor(libm::log10(rough));
        let decade = libm::pow(10.0, power);
        let lead = rough / decade;
        // Thresholds halfway on a logarithmic scale: the count stays closest to what was wanted.
        let (lead, power) = match lead {
            lead if lead < 1.414 => (1.0, power),
            lead if lead < 3.162 => (2.0, power),
            lead if lead < 7.071 => (5.0, power),
            _ => (1.0, power + 1.0),
        };
        let step = lead * libm::pow(10.0, power);
        // A hair of slack, so that a bound which is a multiple of the step counts as one.
        let first = (low / step - 1e-6).ceil();
        let last = (high / step + 1e-6).floor();
        let count = ((last - first).max(0.0) as usize + 1).min(100);
        let decimals =
            ((-9.0..6.0).contains(&power) && high.abs().max(low.abs()) < 1e7).then(|| (-power).max(0.0) as usize);
        Ticks { first, step, count, decimals }
    }

    pub fn step(&self) -> f64 {
        self.step
    }

    pub fn values(self) -> impl Iterator<Item = f64> {
        (0..self.count).map(move |index| (self.first + index as f64) * self.step)
    }

    pub fn label(&self, value: f64) -> String {
        // −0 prints as "-0"; adding 0 makes it +0.
        let value = if value.abs() < self.step * 1e-6 { 0.0 } else { value };
        match self.decimals {
            Some(decimals) => format!("{value:.decimals$}"),
            None => format!("{value:.2e}"),
        }
        .replace('-', "−")
    }
}

/// A span of positive width for any input.
pub(crate) fn widened(low: f64, high: f64) -> (f64, f64) {
    if !(low.is_finite() && high.is_finite()) || low > high {
        return (0.0, 1.0);
    }
    let size = low.abs().max(high.abs());
    if high - low > size * 1e-9 && high - low > 1e-9 {
        return (low, high);
    }
    let pad = (size * 0.05).max(0.5);
    (low - pad, high + pad)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn labels(low: f64, high: f64, wanted: f64) -> Vec<String> {
        let ticks = Ticks::within(low, high, wanted);
        ticks.values().map(|value| ticks.label(value)).collect()
    }

    #[test]
    fn ticks_are_round_numbers_within_the_span() {
        assert_eq!(labels(0.0, 3.0, 6.0), ["0.0", "0.5", "1.0", "1.5", "2.0", "2.5", "3.0"]);
        assert_eq!(labels(-0.013, 0.041, 5.0), ["−0.01", "0.00", "0.01", "0.02", "0.03", "0.04"]);
        assert_eq!(labels(0.0, 47.0, 5.0), ["0", "10", "20", "30", "40"]);
        assert_eq!(labels(0.0, 3e9, 3.0), ["0.00e0", "1.00e9", "2.00e9", "3.00e9"]);
    }

    #[test]
    fn no_span_gives_endless_or_no_ticks() {
        let odd = [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 0.0, -1e12, 1e12, 1e-300, 5.0, f64::MAX];
        for low in odd {
            for high in odd {
                for wanted in [0.0, 1.0, 7.0, f64::INFINITY] {
                    let ticks = Ticks::within(low, high, wanted);
                    assert!((1..=100).contains(&ticks.values().count()), "{low} {high} {wanted}");
                    assert!(ticks.values().all(|value| ticks.label(value).len() < 40));
                }
            }
        }
    }
}
