//! The leg controller's decisions: whether to step, how, and how far.

use crate::{Rng, Values};
use glam::DVec3;

/// The kind of a step.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum StepKind {
    /// One foot goes forward, the other stays.
    #[default]
    Half,
    /// The other foot follows.
    Full,
}

sinew_snapshot::snapshot!(enum StepKind { 0: Half, 1: Full });

impl StepKind {
    /// `half` or `full`.
    pub const fn name(self) -> &'static str {
        match self {
            StepKind::Half => "half",
            StepKind::Full => "full",
        }
    }
}

/// The decision to take a step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StepChoice {
    /// Half or full.
    pub kind: StepKind,
    /// How far \[m\].
    pub length_m: f64,
}

/// EQ6: the direction over the ground in which a target lies, a unit vector; `None` for one straight above or below.
pub fn ground_direction(d: DVec3) -> Option<DVec3> {
    let flat = DVec3::new(d.x, 0.0, d.z);
    let length = (d.x * d.x + d.z * d.z).sqrt();
    (length > 1e-9 && length.is_finite()).then(|| flat / length)
}

/// Probability of a step: 0 within d_c, 1 beyond d_max, (d − d_c) / (d_max − d_c) between.
pub fn step_probability(distance_m: f64, values: &Values) -> f64 {
    let (near, far) = (values.convenient_m, values.maximal_m);
    ((distance_m - near) / (far - near)).clamp(0.0, 1.0)
}

/// P_half: probability that a step is a half one, from P_max at d_c to P_min at d_max.
pub fn half_probability(distance_m: f64, values: &Values) -> f64 {
    let share = step_probability(distance_m, values);
    values.half_step_most + (values.half_step_least - values.half_step_most) * share
}

/// EQ9: length of a step \[m\]. `p` is the random number, in (0, 1).
pub fn step_length(distance_m: f64, p: f64, values: &Values) -> f64 {
    let (d, near, far) = (distance_m, values.convenient_m, values.maximal_m);
    let (short, long) = (values.shortest_step_m, values.longest_step_m);
    if d <= near {
        short
    } else if d >= far {
        long
    } else {
        let (a, b) = ((d - near).abs() * p, (d - far).abs() * (1.0 - p));
        (long * a + short * b) / (a + b)
    }
}

/// p of EQ9: normally distributed, kept where EQ9 has no pole.
pub fn step_bias(rng: &mut Rng, values: &Values) -> f64 {
    let (mean, deviation) = values.step_bias;
    rng.normal(mean, deviation).clamp(0.02, 0.98)
}

/// The stepping decision: whether the target's horizontal distance from the shoulder \[m\] requires a step, and which.
///
/// ```
/// use sinew_body::humanoid::Body;
/// use sinew_reach::{Rng, Style, Values, decide_step};
/// let values = Values::of(&Body::standard(80.0, 1.7), &Style::default());
/// assert!(decide_step(0.3, &mut Rng::new(1), &values).is_none());
/// assert!(decide_step(1.2, &mut Rng::new(1), &values).is_some());
/// ```
pub fn decide_step(distance_m: f64, rng: &mut Rng, values: &Values) -> Option<StepChoice> {
    // All three numbers are always drawn, so that the choices of one seed stay comparable.
    let (steps, halves, bias) = (rng.unit(), rng.unit(), step_bias(rng, values));
    if distance_m <= values.convenient_m || steps >= step_probability(distance_m, values) {
        return None;
    }
    let kind = if halves < half_probability(distance_m, values) { StepKind::Half } else { StepKind::Full };
    Some(StepChoice { kind, length_m: step_length(distance_m, bias, values) })
}
