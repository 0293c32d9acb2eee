//! Numbers that change smoothly.

/// A smooth transition of a number, with zero slope at both ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Ramp {
    from: f64,
    to: f64,
    gone_secs: f64,
    over_secs: f64,
}

/// 0 to 1 with no slope at its ends.
pub(super) fn smooth(share: f64) -> f64 {
    let x = share.clamp(0.0, 1.0);
    x * x * x * (10.0 - x * (15.0 - 6.0 * x))
}

sinew_snapshot::snapshot!(Ramp { from, to, gone_secs, over_secs });

impl Ramp {
    /// A constant.
    pub(super) const fn at(value: f64) -> Ramp {
        Ramp { from: value, to: value, gone_secs: 0.0, over_secs: 0.0 }
    }

    /// Starts a transition to a value within a time from now; 0 sets it at once.
    pub(super) fn aim(&mut self, to: f64, over_secs: f64) {
        *self = Ramp { from: self.value(), to, gone_secs: 0.0, over_secs };
    }

    pub(super) fn advance(&mut self, step_secs: f64) {
        self.gone_secs = (self.gone_secs + step_secs).min(self.over_secs);
    }

    pub(super) fn value(&self) -> f64 {
        if self.gone_secs >= self.over_secs {
            return self.to;
        }
        self.from + (self.to - self.from) * smooth(self.gone_secs / self.over_secs)
    }

    /// The target value.
    pub(super) fn end(&self) -> f64 {
        self.to
    }
}
