//! Keys over time, and the value between them.

use glam::{DQuat, DVec3, DVec4};
use std::rc::Rc;

/// How a value goes from one key to the next (glTF 2.0, appendix C).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Interpolation {
    Linear,
    Step,
    /// Hermite splines; each key holds an in-tangent, a value and an out-tangent.
    CubicSpline,
}

/// Keys of one channel, checked: times ascending, as many values as the interpolation asks for.
#[derive(Clone, Debug)]
pub(super) struct Track {
    pub times_secs: Rc<Vec<f64>>,
    pub values: Vec<f32>,
    /// 3 for translations and scales, 4 for rotations.
    pub width: usize,
    pub interpolation: Interpolation,
}

/// A time that is this close to a key is the key's \[s\]: file times are single precision, and a step must not be
/// taken one frame late for it.
const KEY_TOLERANCE_SECS: f64 = 1e-4;

impl Track {
    /// A key's own value.
    pub fn key(&self, key: usize) -> DVec4 {
        match self.interpolation {
            Interpolation::CubicSpline => self.raw(key * 3 + 1),
            _ => self.raw(key),
        }
    }

    fn raw(&self, row: usize) -> DVec4 {
        let mut value = DVec4::ZERO;
        for component in 0..self.width {
            value[component] = f64::from(self.values[row * self.width + component]);
        }
        value
    }

    /// The largest distance of any value, tangents of splines included, from the first key's.
    pub fn spread(&self) -> f64 {
        let first = self.key(0);
        let keys = self.times_secs.len();
        let tangents = matches!(self.interpolation, Interpolation::CubicSpline) && keys > 1;
        (0..keys)
            .map(|key| {
                let tangent =
                    if tangents { self.raw(key * 3).length().max(self.raw(key * 3 + 2).length()) } else { 0.0 };
                (self.key(key) - first).length().max(tangent)
            })
            .fold(0.0, f64::max)
    }

    /// The vector at a time \[s\].
    pub fn vector(&self, time_secs: f64) -> DVec3 {
        self.at(time_secs, |a, b, alpha| a.lerp(b, alpha)).truncate()
    }

    /// The rotation at a time \[s\].
    pub fn rotation(&self, time_secs: f64) -> DQuat {
        let slerp = |a: DVec4, b: DVec4, alpha| {
            DVec4::from(DQuat::from_vec4(a).normalize().slerp(DQuat::from_vec4(b).normalize(), alpha))
        };
        let value = self.at(time_secs, slerp);
        DQuat::from_vec4(value.try_normalize().unwrap_or(DVec4::W))
    }

    fn at(&self, time_secs: f64, linear: impl Fn(DVec4, DVec4, f64) -> DVec4) -> DVec4 {
        let times = &self.times_secs;
        let next = times.partition_point(|&time| time <= time_secs + KEY_TOLERANCE_SECS);
        let Some(key) = next.checked_sub(1) else { return self.key(0) };
        if next == times.len() || time_secs <= times[key] + KEY_TOLERANCE_SECS {
            return self.key(key);
        }
        let span_secs = times[next] - times[key];
        let alpha = (time_secs - times[key]) / span_secs;
        match self.interpolation {
            Interpolation::Step => self.key(key),
            Interpolation::Linear => linear(self.key(key), self.key(next), alpha),
            Interpolation::CubicSpline => {
                let (a2, a3) = (alpha * alpha, alpha * alpha * alpha);
                self.key(key) * (2.0 * a3 - 3.0 * a2 + 1.0)
                    + self.raw(key * 3 + 2) * span_secs * (a3 - 2.0 * a2 + alpha)
                    + self.key(next) * (3.0 * a2 - 2.0 * a3)
                    + self.raw(next * 3) * span_secs * (a3 - a2)
            }
        }
    }
}
