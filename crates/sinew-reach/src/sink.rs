//! How far the hips sink in a walk, so that both legs reach their feet.

use crate::feet::{Feet, Stride};
use crate::minimum_jerk::{MinimumJerk, arc};
use glam::{DQuat, DVec3};

/// Samples of a stride, and rounds over all strides: those beside it sink with it.
const SAMPLES: usize = 10;
const ROUNDS: usize = 2;

/// How long before lift-off and after landing the hips sink \[1 of the stride's time\].
const AROUND: f64 = 0.5;

/// Samples at which a stride's own sinking is less than this share of its most are its neighbours' \[1\].
const OWN: f64 = 0.5;

/// By how much less than its length a leg reaches in a walk \[m\]: its knee stays a little bent when the foot lands.
const BENT_M: f64 = 0.004;

/// Deepest sinking of a stride \[1 of the leg\].
const MOST: f64 = 0.14;

/// Course of the sinking of a stride \[1\].
pub(crate) fn sinks(stride: &Stride, secs: f64) -> f64 {
    let from = begins_secs(stride);
    arc((secs - from) / (stride.lands_secs() + AROUND * stride.for_secs - from))
}

/// When the hips begin to sink: with the first stride of a walk only as it begins \[s\].
fn begins_secs(stride: &Stride) -> f64 {
    let first = if stride.stops() { 0.0 } else { stride.bears_secs.0 };
    first.max(stride.start_secs - AROUND * stride.for_secs)
}

/// Samples of a stride at which the acceleration of a walk is measured.
const SAMPLES_OF_STRIDE: usize = 16;

impl Feet {
    /// Finishes the plan of a walk from an index of the strides on: the weight goes on from stride to stride, the hips sink as far as the
    /// legs need it, and all becomes slower until the hips' acceleration is at most `most_m_s2`. Returns their largest speed \[m/s\].
    pub(crate) fn settle_walk(&mut self, from: usize, most_m_s2: f64) -> f64 {
        if self.linear || from >= self.strides.len() {
            return 0.0;
        }
        self.link(from);
        self.sink(from, MinimumJerk::rest(DVec3::ZERO));
        let (fastest, roughest) = self.roughness(from);
        let slower = (roughest / most_m_s2).sqrt().max(1.0);
        let begins = self.strides[from].start_secs;
        for stride in &mut self.strides[from..] {
            let later = |secs: f64| begins + (secs - begins) * slower;
            stride.start_secs = later(stride.start_secs);
            stride.bears_secs = (later(stride.bears_secs.0), later(stride.bears_secs.1));
            stride.for_secs *= slower;
        }
        fastest / slower
    }

    /// Largest speed \[m/s\] and acceleration \[m/s²\] of hips that go where the strides take them.
    fn roughness(&self, from: usize) -> (f64, f64) {
        let begins = self.strides[from].start_secs;
        let ends = self.rests_secs().unwrap_or(begins);
        let count = SAMPLES_OF_STRIDE * (self.strides.len() - from);
        let step = (ends - begins) / count as f64;
        let at = |index: usize| {
            let support = self.support(begins + step * index as f64);
            let turn = DQuat::from_rotation_y(support.yaw_rad);
            support.rest - turn * self.rest_com - DVec3::Y * support.dip_m
        };
        let mut last = [at(0), at(0), at(1)];
        let (mut fastest, mut roughest): (f64, f64) = (0.0, 0.0);
        for index in 2..=count {
            last = [last[1], last[2], at(index)];
            fastest = fastest.max((last[2] - last[1]).length() / step);
            roughest = roughest.max((last[2] - last[1] * 2.0 + last[0]).length() / (step * step));
        }
        (fastest, roughest)
    }

    /// The same for the strides with which a body comes to stand, whose hips are still `shift` away from where they will be \[m\].
    pub(crate) fn sink_from(&mut self, shift: MinimumJerk<DVec3>) {
        self.sink(0, shift);
    }

    /// Has the hips sink in the strides from an index on as far as the legs need it, sampled along the way.
    fn sink(&mut self, from: usize, shift: MinimumJerk<DVec3>) {
        if self.linear {
            return;
        }
        for _ in 0..ROUNDS {
            for index in from..self.strides.len() {
                let stride = self.strides[index];
                let mut more: f64 = 0.0;
                for sample in 1..SAMPLES {
                    let (from, to) = (begins_secs(&stride), stride.lands_secs() + AROUND * stride.for_secs);
                    let secs = from + (to - from) * sample as f64 / SAMPLES as f64;
                    let course = sinks(&stride, secs);
                    if course > OWN {
                        more = more.max(self.lacks_m(secs, shift.at(secs)) / course);
                    }
                }
                self.strides[index].sinks_m += more.min(MOST * self.legs_m.0 - self.strides[index].sinks_m);
            }
        }
    }

    /// How much lower the hips would have to be at a time \[s\] for the longer leg to reach its foot \[m\].
    fn lacks_m(&self, secs: f64, shift: DVec3) -> f64 {
        let support = self.support(secs);
        let turn = DQuat::from_rotation_y(support.yaw_rad);
        let (leg_m, hips_m) = self.legs_m;
        let reach_m = leg_m - BENT_M;
        let hips = support.rest - turn * self.rest_com + shift;
        let lowest = [0, 1].map(|side| {
            let joint = hips + turn * DVec3::new(if side == 0 { 0.5 } else { -0.5 } * hips_m, 0.0, 0.0);
            let foot =
                crate::heel::raised(self.foot(side, secs), self.soles[side].toe(), self.heel_off_rad(side, secs));
            let away = DVec3::new(joint.x - foot.0.x, 0.0, joint.z - foot.0.z).length_squared();
            let ankle_m = foot.0.y - (support.centre.y + self.soles[side].ankle_m);
            ankle_m + (reach_m * reach_m - away).max(0.25 * leg_m * leg_m).sqrt()
        });
        (leg_m - support.dip_m + shift.y - lowest[0].min(lowest[1])).max(0.0)
    }
}
