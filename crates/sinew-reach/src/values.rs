//! All parameters that the paper leaves open, in one place, scaled by the body.

use sinew_body::humanoid::{Body, Node};

/// The style of a reach: the user's parameters. The defaults are a calm adult.
///
/// It takes effect with the next goal after [`Reacher::new`](crate::Reacher::new) or
/// [`Reacher::set_style`](crate::Reacher::set_style), which refuse what is out of range.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Style {
    /// Flexibility F of the legs, 0.25 to 4 \[1\]. The stoop range is arm length / F: for a target lower than that
    /// below the shoulder the body squats, and stoops for the rest. Default 1.
    pub flexibility: f64,
    /// Peak speed of the hand \[m/s\], 0.05 to 10; under `print` the paper's start speed v_s. Default `None`: 1.15 m/s for a
    /// path of 0.6 m and more for a longer one (see [`Values::hand_secs`]); 0.2 m/s under `print`.
    pub speed_m_s: Option<f64>,
    /// Time from start to arrival \[s\], 0.2 to 600, in place of a speed; applies to the whole body. Default `None`.
    pub time_secs: Option<f64>,
    /// r_st, 0 to 1: share of the stepping that is done when arm and twist begin. Default 0.55.
    pub overlap_step: f64,
    /// r_tw, 0 to 1: share of the twist that is done when the spine swings. Default 0.2.
    pub overlap_twist: f64,
    /// Speed at which the head turns \[rad/s\], 0.1 to 20. Default 2.5.
    pub head_speed_rad_s: f64,
    /// Literal mode, the paper as printed where it can be built: EQ1 to 4 for the hand, one step at most, piecewise
    /// linear arcs, thirds of a swing to each of the three joints, the head with the arm. Default false.
    pub print: bool,
    /// Seed of all random choices, read once, by [`Reacher::new`](crate::Reacher::new). Default 0.
    pub seed: u64,
    /// Seed of the manner: pace, elbow, trunk, gaze and path, read at the same time; 0 is the plain one. Default `None`: as `seed`.
    pub manner_seed: Option<u64>,
}

sinew_snapshot::snapshot!(Style {
    flexibility,
    speed_m_s,
    time_secs,
    overlap_step,
    overlap_twist,
    head_speed_rad_s,
    print,
    seed,
    manner_seed,
});

impl Default for Style {
    fn default() -> Style {
        Style {
            flexibility: 1.0,
            speed_m_s: None,
            time_secs: None,
            overlap_step: 0.55,
            overlap_twist: 0.2,
            head_speed_rad_s: 2.5,
            print: false,
            seed: 0,
            manner_seed: None,
        }
    }
}

/// A parameter out of range.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{name} of {value} is out of range; it is {from} to {to}")]
pub struct StyleError {
    /// The parameter.
    pub name: &'static str,
    /// The requested value.
    pub value: f64,
    /// The minimum.
    pub from: f64,
    /// The maximum.
    pub to: f64,
}

impl Style {
    /// Checks every parameter.
    ///
    /// # Errors
    /// The first parameter that is out of range.
    pub fn check(&self) -> Result<(), StyleError> {
        let within = |name, value: f64, from: f64, to: f64| {
            if (from..=to).contains(&value) { Ok(()) } else { Err(StyleError { name, value, from, to }) }
        };
        within("flexibility", self.flexibility, 0.25, 4.0)?;
        within("speed in metres a second", self.speed_m_s.unwrap_or(1.0), 0.05, 10.0)?;
        within("time in seconds", self.time_secs.unwrap_or(1.0), 0.2, 600.0)?;
        within("overlap of the step", self.overlap_step, 0.0, 1.0)?;
        within("overlap of the twist", self.overlap_twist, 0.0, 1.0)?;
        within("speed of the head in radians a second", self.head_speed_rad_s, 0.1, 20.0)
    }
}

/// The open values for one body. Lengths scale with it; angles and shares do not. Values that the paper states are
/// those of its own adult figure.
///
/// Read-only: [`Values::of`] derives them from a body and a [`Style`], and they change with
/// [`Reacher::set_style`](crate::Reacher::set_style) alone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Values {
    /// From the shoulder joint to the centre of the hand, stretched \[m\].
    pub arm_m: f64,
    /// From the hip joint to the ankle, stretched \[m\].
    pub leg_m: f64,
    /// d_c: radius of the convenient reaching range, 0.75 arm lengths \[m\].
    pub convenient_m: f64,
    /// d_max: radius of the maximal reaching range, 1.2 arm lengths: what leaning reaches \[m\].
    pub maximal_m: f64,
    /// l_min of EQ9, 0.28 leg lengths \[m\].
    pub shortest_step_m: f64,
    /// The paper's usual step of 0.433 m, 0.51 leg lengths \[m\].
    pub usual_step_m: f64,
    /// l_max of EQ9, 0.72 leg lengths \[m\].
    pub longest_step_m: f64,
    /// P_max: probability of a half step at d_c \[1\].
    pub half_step_most: f64,
    /// P_min: probability of a half step at d_max \[1\].
    pub half_step_least: f64,
    /// Mean and standard deviation of p in EQ9 \[1\]; p is kept inside 0.02 to 0.98, for EQ9 has a pole outside (0, 1).
    pub step_bias: (f64, f64),
    /// The comfortable reaching angle, from the forward direction towards the arm's own side \[rad\].
    pub comfortable_rad: (f64, f64),
    /// Maximum twist θ of the whole spine \[rad\].
    pub most_twist_rad: f64,
    /// φ_max of EQ8, 120° \[rad\].
    pub most_swing_rad: f64,
    /// |r_max| of EQ8, 0.1 m for an adult, 0.118 leg lengths \[m\].
    pub most_root_shift_m: f64,
    /// The start swing distance: maximum height of a target above or below the shoulder before the spine swings, 0.55
    /// arm lengths \[m\].
    pub start_swing_m: f64,
    /// Maximum squat depth, 0.7 leg lengths \[m\].
    pub most_squat_m: f64,
    /// Share of a swing that the hips take; the chest takes the rest (lumbar and thoracic spine are one joint here). The paper's
    /// thirds under `print`.
    pub hips_share_of_swing: f64,
    /// Squat depth per distance of a target below the stoop range \[1\]. The paper says only that the hips sink; people
    /// squat deeper than necessary and keep the trunk upright.
    pub squat_per_excess: f64,
    /// Comfortable and maximum extension of the arms \[1 of the arm's length\].
    pub stretch: (f64, f64),
    /// Height to which a foot is lifted, 0.11 leg lengths \[m\].
    pub foot_lift_m: f64,
    /// Time of one step \[s\].
    pub step_secs: f64,
}

/// Ratio of a hand's peak to its mean speed \[1\], see [`MinimumJerk::go_early`](crate::MinimumJerk::go_early).
const EARLY_PEAK: f64 = 2.263;

impl Values {
    /// The values for a body.
    pub fn of(body: &Body, style: &Style) -> Values {
        let length = |node: Node| body.link(node).offset.length();
        let hand = body.link(Node::RightHand).centre;
        let arm_m = length(Node::RightLowerArm) + (body.link(Node::RightHand).offset + hand).length();
        let leg_m = length(Node::RightLowerLeg) + length(Node::RightFoot);
        // A pendulum of the leg's length sets the pace.
        let pace = (leg_m / 0.848).max(0.0).sqrt();
        Values {
            arm_m,
            leg_m,
            convenient_m: 0.75 * arm_m,
            maximal_m: 1.2 * arm_m,
            shortest_step_m: 0.28 * leg_m,
            usual_step_m: 0.51 * leg_m,
            longest_step_m: 0.72 * leg_m,
            half_step_most: 0.8,
            half_step_least: 0.2,
            step_bias: (0.5, 0.2),
            comfortable_rad: (-0.35, 1.05),
            most_twist_rad: 1.2,
            most_swing_rad: 120.0_f64.to_radians(),
            most_root_shift_m: 0.118 * leg_m,
            start_swing_m: 0.55 * arm_m,
            most_squat_m: 0.7 * leg_m,
            hips_share_of_swing: if style.print { 1.0 / 3.0 } else { 0.5 },
            squat_per_excess: if style.print { 1.0 } else { 1.5 },
            stretch: (0.93, 0.975),
            foot_lift_m: 0.11 * leg_m,
            step_secs: 0.62 * pace,
        }
    }

    /// Time of a hand for a path \[s\] if no speed is given: 0.45 s and 0.85 s a metre. In measurements the mean speed
    /// of hands grows with the length of the path.
    pub fn hand_secs(&self, way_m: f64, style: &Style) -> f64 {
        match style.speed_m_s {
            Some(peak) => (EARLY_PEAK * way_m / peak).max(0.15),
            None => 0.45 + 0.85 * way_m * (0.63 / self.arm_m.max(1e-3)),
        }
    }

    /// Time of a hand at a peak speed \[s\].
    pub(crate) fn quickest_hand_secs(&self, way_m: f64, peak_m_s: f64) -> f64 {
        EARLY_PEAK * way_m / peak_m_s
    }

    /// k of EQ8 \[m/rad\].
    pub fn shift_per_swing(&self) -> f64 {
        self.most_root_shift_m / self.most_swing_rad
    }
}
