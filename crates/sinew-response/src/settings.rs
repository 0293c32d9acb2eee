//! Settings of the response, and the method's constants.

use sinew_body::STANDARD_GRAVITY_M_S2;
use sinew_body::humanoid::{Node, UPPER_DOFS, upper_dofs};

/// A named reading of the paper.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum Preset {
    /// Robust on every clip: the dynamic constraint as a penalty, aimed at the input's own torque, with a passive
    /// spring and damper in the near-unactuated coordinates. The default.
    #[default]
    Robust,
    /// Close to the paper as printed: the constraint as a softer penalty, aimed at zero torque, without passive
    /// elements. Shows the paper's sweep over k; deviates a little from the input even without a push.
    Paper,
    /// The paper as printed: the constraint is hard. Its zero dynamics are unstable at any time step (they grow by
    /// about e^5 a second at k = 10), so that even an unpushed walk diverges from the input within a few cycles; kept
    /// to show just that.
    Literal,
}

/// Which end of the spectrum of actuation the dynamic constraint acts on.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum Coordinates {
    /// The least actuated coordinates: the method.
    #[default]
    Low,
    /// The most actuated: the paper's counter-experiment (section 5, eigenvector analysis), which fails.
    High,
}

/// The settings of a response. They take effect when a [`Response`](crate::Response) is made of them, and stay.
///
/// ```
/// use sinew_response::{Settings, SettingsError};
/// let loose = Settings { compliance: 2.0, ..Settings::default() };
/// assert_eq!(loose.check(), Ok(()));
/// assert_eq!(Settings { k: 25, ..loose }.check(), Err(SettingsError::K(25)));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Settings {
    /// The preset. Default [`Preset::Robust`].
    pub preset: Preset,
    /// Number of coordinates under dynamics, k: 0 to 24. Default 10, as in the paper, which uses 5 for slow forms. In the robust
    /// preset the spectrum fades out about the k-th, within two coordinates.
    pub k: usize,
    /// Which coordinates. Default [`Coordinates::Low`], the only choice of the robust preset.
    pub coordinates: Coordinates,
    /// Compliance of the body \[1\], from [`Settings::MIN_COMPLIANCE`] (stiff) to [`Settings::MAX_COMPLIANCE`] (loose),
    /// default 1; only the robust preset uses it. It moves tracking (w1), damping (w2) and the passive spring (ω)
    /// together, with exponents chosen on walks, runs, a sneak, punches, a dance and a martial-arts form so that the
    /// body also comes back. Towards loose, damping falls faster than tracking, since it is damping against the input
    /// that makes a recovery slow; towards stiff they keep their ratio, and the dynamic constraint's penalty falls,
    /// since it is the term that makes a fast motion diverge. From 0.25 to 4 a push deflects a walk's joints from half
    /// to one and a half times as far as at 1. [`Prepared::stable_settings`](crate::Prepared::stable_settings) computes
    /// the maximum for a motion.
    pub compliance: f64,
    /// Time from one frame to the next \[s\]: [`Settings::MIN_TIME_STEP_SECS`] to [`Settings::MAX_TIME_STEP_SECS`], default 1/60.
    /// A motion and its basis are made for one time step.
    pub time_step_secs: f64,
    /// Downward gravity of the world in which the motion takes place \[m/s²\]: any finite number, default 9.81. The torques
    /// that a motion uses depend on it, so a basis is made for one gravity.
    pub gravity_m_s2: f64,
    /// Whether pushed forearms and hands stay out of trunk, head and thighs, as far as the input's do, until a second or so after
    /// the push. Default `false`: small differences of a motion, as of a live stream, then change by more than a twentieth what
    /// a push does to an arm that touches the body. Only the robust preset does it.
    pub arms_clear: bool,
    /// Whether hands that hold something between them in the input, before the trunk and at one distance for half a second,
    /// keep their places relative to each other when they are pushed. Default `true`; only the robust preset does it.
    pub hands_hold: bool,
}

impl Default for Settings {
    fn default() -> Settings {
        Settings {
            preset: Preset::Robust,
            k: 10,
            coordinates: Coordinates::Low,
            compliance: 1.0,
            time_step_secs: 1.0 / 60.0,
            gravity_m_s2: STANDARD_GRAVITY_M_S2,
            arms_clear: false,
            hands_hold: true,
        }
    }
}

/// Why settings cannot be used.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SettingsError {
    /// More coordinates than there are.
    #[error("k = {0} is out of range: the upper body has 24 coordinates, so k is 0 to 24")]
    K(usize),
    /// The dial is out of range.
    #[error(
        "a compliance of {0} is out of range: {min} (stiff) to {max} (loose), 1 is the default",
        min = Settings::MIN_COMPLIANCE,
        max = Settings::MAX_COMPLIANCE
    )]
    Compliance(f64),
    /// A compliance other than 1 with a preset that has no such dial.
    #[error("compliance is the robust preset's dial; the paper's presets yield by k")]
    ComplianceOfPaper,
    /// The counter-experiment with the robust preset.
    #[error("the coordinates `high` are the paper's counter-experiment; use them with the preset `paper`")]
    HighOfRobust,
    /// The time step is out of range.
    #[error(
        "a time step of {0} s is out of range: {min} to {max}",
        min = Settings::MIN_TIME_STEP_SECS,
        max = Settings::MAX_TIME_STEP_SECS
    )]
    TimeStep(f64),
    /// Gravity is NaN or infinite.
    #[error("a gravity of {0} m/s² is invalid; 9.81 is the default")]
    Gravity(f64),
}

impl Settings {
    /// Minimum compliance: the stiffest setting.
    pub const MIN_COMPLIANCE: f64 = 0.25;
    /// Maximum compliance: the loosest setting.
    pub const MAX_COMPLIANCE: f64 = 4.0;
    /// Shortest time step \[s\].
    pub const MIN_TIME_STEP_SECS: f64 = 1e-3;
    /// Longest time step \[s\].
    pub const MAX_TIME_STEP_SECS: f64 = 0.1;

    /// Checks every range, and what excludes each other.
    ///
    /// # Errors
    /// The first setting that is out of range, or the pair that does not go together.
    pub fn check(&self) -> Result<(), SettingsError> {
        if self.k > UPPER_DOFS {
            return Err(SettingsError::K(self.k));
        }
        if !(Settings::MIN_COMPLIANCE..=Settings::MAX_COMPLIANCE).contains(&self.compliance) {
            return Err(SettingsError::Compliance(self.compliance));
        }
        if self.preset != Preset::Robust && self.compliance != 1.0 {
            return Err(SettingsError::ComplianceOfPaper);
        }
        if self.coordinates == Coordinates::High && self.preset == Preset::Robust {
            return Err(SettingsError::HighOfRobust);
        }
        if !(Settings::MIN_TIME_STEP_SECS..=Settings::MAX_TIME_STEP_SECS).contains(&self.time_step_secs) {
            return Err(SettingsError::TimeStep(self.time_step_secs));
        }
        if !self.gravity_m_s2.is_finite() {
            return Err(SettingsError::Gravity(self.gravity_m_s2));
        }
        Ok(())
    }
}

/// Cut-off of the low-pass filter for input motion before it is differentiated twice \[Hz\].
pub(crate) const CUTOFF_HZ: f64 = 6.0;

/// Body mass for which the torque weights are stated \[kg\].
pub(crate) const REFERENCE_MASS_KG: f64 = 80.0;

/// Reaction time of muscles \[s\]: the paper's reflex delay, after which w3 has faded to zero.
pub(crate) const REFLEX_SECS: f64 = 0.2;

/// [`Weights::swing_secs`] of the robust preset: arms swing through once, by 10 to 30 %.
const SWING_SECS: f64 = 0.06;

/// The weights of one optimisation, resolved from settings and body.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Weights {
    /// Tracking, w1 of EQ6 \[1/rad\].
    pub track: f64,
    /// Damping, w2 of EQ6, per coordinate \[s/rad\].
    pub damp: [f64; UPPER_DOFS],
    /// Reflex delay, w3 of EQ6 at the instant of a push \[s/(N m)\].
    pub reflex: f64,
    /// The dynamic constraint's penalty \[1/(N m)\]; infinite for the literal preset.
    pub dynamics: f64,
    /// Frequency of the passive spring \[rad/s\]; 0 for none.
    pub passive_frequency: f64,
    /// Its damping ratio.
    pub passive_damping: f64,
    /// Whether the constraint aims at the input's own torque (else at zero).
    pub aims_at_input: bool,
    /// Whether EQ4 damps velocity relative to the input's (else absolute, as printed).
    pub damps_relative: bool,
    /// Time in which a joint that swings by itself loses its velocity relative to the input's to 1/e \[s\]; 0 as printed. EQ4
    /// alone is a door closer: a joint creeps back, for seconds, without ever swinging through.
    pub swing_secs: f64,
    /// Whether the neck keeps the head level against the trunk.
    pub levels_head: bool,
    /// Whether arms stay out of the body.
    pub arms_clear: bool,
    /// Whether hands that hold something stay together.
    pub hands_hold: bool,
}

impl Weights {
    pub(crate) fn of(settings: &Settings, mass_kg: f64) -> Weights {
        let compliance = settings.compliance.clamp(Settings::MIN_COMPLIANCE, Settings::MAX_COMPLIANCE);
        let by_mass = REFERENCE_MASS_KG / mass_kg;
        let mut damp = [10.0; UPPER_DOFS];
        for (weight, dof) in damp.iter_mut().zip(upper_dofs()) {
            if dof.node == Node::Chest {
                *weight = 30.0;
            }
        }
        let base = Weights {
            track: 200.0,
            damp,
            reflex: by_mass / 30.0,
            dynamics: 6.7 * by_mass,
            passive_frequency: 8.0,
            passive_damping: 0.8,
            aims_at_input: true,
            damps_relative: true,
            swing_secs: 0.0,
            levels_head: false,
            arms_clear: false,
            hands_hold: false,
        };
        match settings.preset {
            Preset::Robust => {
                let (stiff, loose) = (compliance.min(1.0), compliance.max(1.0));
                Weights {
                    track: base.track * libm::pow(stiff, -0.8) * libm::pow(loose, -0.4),
                    damp: base.damp.map(|weight| weight * libm::pow(stiff, -0.8) * libm::pow(loose, -0.6)),
                    passive_frequency: base.passive_frequency * libm::pow(compliance, -0.3),
                    dynamics: base.dynamics * stiff,
                    swing_secs: SWING_SECS / (loose * loose),
                    levels_head: true,
                    arms_clear: settings.arms_clear,
                    hands_hold: settings.hands_hold,
                    ..base
                }
            }
            Preset::Paper => Weights { dynamics: 4.0 * by_mass, passive_frequency: 0.0, aims_at_input: false, ..base },
            Preset::Literal => Weights {
                dynamics: f64::INFINITY,
                passive_frequency: 0.0,
                aims_at_input: false,
                damps_relative: false,
                ..base
            },
        }
    }
}
