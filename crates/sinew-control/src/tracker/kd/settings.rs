//! Gains, presets and weights of the tracker `kd` (Nguyen et al. 2010, section 6's table).

use serde::{Deserialize, Serialize};
use sinew_body::humanoid::Node;

/// The four numbers of Nguyen et al. 2010, EQ1 and EQ2.
///
/// They mean per unit of mass and of inertia: read as N/m, 160 lets a trunk sag by 1.5 m.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct KdGains {
    /// Stiffness of a part's pin, per unit of its mass \[1/s²\], 0 to 1e5, default 160; times [`KdGains::multiple`].
    pub k_p: f64,
    /// Its damping, per unit of mass \[1/s\], 0 to 1e5, default 25; times the root of [`KdGains::multiple`], so that the damping ratio is the same everywhere.
    pub d_p: f64,
    /// Stiffness of a joint, per unit of its outboard inertia \[1/s²\], 0 to 1e5, default 450.
    pub k_q: f64,
    /// Its damping, per unit of inertia \[1/s\], 0 to 1e5, default 10.
    pub d_q: f64,
}

sinew_snapshot::snapshot!(KdGains { k_p, d_p, k_q, d_q });

impl KdGains {
    /// Factor on the gains of the legs: the ground is what a body's strength comes from (Nguyen et al. 2010, section
    /// 4.3).
    pub const fn multiple(node: Node) -> f64 {
        match node {
            Node::LeftFoot | Node::RightFoot => 125.0,
            Node::LeftLowerLeg | Node::RightLowerLeg => 25.0,
            Node::LeftUpperLeg | Node::RightUpperLeg => 5.0,
            _ => 1.0,
        }
    }
}

/// The rows of the paper's table.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, schemars::JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum KdPreset {
    /// 160, 25, 450, 10.
    #[default]
    Default,
    /// 0, 0, 200, 2: without pins.
    Balloon,
    /// 200, 25, 450, 10.
    Stapler,
    /// 420, 50, 1200, 15.
    Giant,
    /// 1000, 125, 450, 10.
    Glider,
}

sinew_snapshot::snapshot!(enum KdPreset { 0: Default, 1: Balloon, 2: Stapler, 3: Giant, 4: Glider });

impl KdPreset {
    /// All of them.
    pub const ALL: [KdPreset; 5] =
        [KdPreset::Default, KdPreset::Balloon, KdPreset::Stapler, KdPreset::Giant, KdPreset::Glider];

    /// As scenes and commands name it.
    pub const fn name(self) -> &'static str {
        match self {
            KdPreset::Default => "default",
            KdPreset::Balloon => "balloon",
            KdPreset::Stapler => "stapler",
            KdPreset::Giant => "giant",
            KdPreset::Glider => "glider",
        }
    }

    /// Its gains.
    pub const fn gains(self) -> KdGains {
        let (k_p, d_p, k_q, d_q) = match self {
            KdPreset::Default => (160.0, 25.0, 450.0, 10.0),
            KdPreset::Balloon => (0.0, 0.0, 200.0, 2.0),
            KdPreset::Stapler => (200.0, 25.0, 450.0, 10.0),
            KdPreset::Giant => (420.0, 50.0, 1200.0, 15.0),
            KdPreset::Glider => (1000.0, 125.0, 450.0, 10.0),
        };
        KdGains { k_p, d_p, k_q, d_q }
    }
}

/// The reference of the damped velocity.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, schemars::JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum KdDamping {
    /// Relative to the performer: motion with the performer is not damped.
    #[default]
    Relative,
    /// Relative to the ground, as EQ1 and EQ2 are printed: everything lags.
    Absolute,
}

/// Weights of a part's pin and of its joint spring: 1 full, 0 off.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct KdWeight {
    /// Factor on k_p \[1\], 0 to 100, default 1; its root on d_p. Up to 1 it is also the share of the part's weight that is carried.
    pub pin: f64,
    /// Factor on k_q \[1\], 0 to 100, default 1; its root on d_q.
    pub joint: f64,
}

sinew_snapshot::snapshot!(enum KdDamping { 0: Relative, 1: Absolute });
sinew_snapshot::snapshot!(KdWeight { pin, joint });

impl KdWeight {
    /// Full weights.
    pub const FULL: KdWeight = KdWeight { pin: 1.0, joint: 1.0 };
}

/// Settings of the tracker `kd`. They take effect when the tracker is made; gains, weights and pins can be changed later, over a time
/// ([`KdTracker`](super::KdTracker)). Scenes and commands hold every number to its range.
#[derive(Clone, Debug, PartialEq)]
pub struct KdSettings {
    /// Stiffness and damping. Default those of [`KdPreset::Default`].
    pub gains: KdGains,
    /// What is damped. Default [`KdDamping::Relative`].
    pub damping: KdDamping,
    /// Feed-forward: adds the forces that the wanted motion itself requires, from its accelerations. Without it the
    /// body lags. Default true.
    pub feed_forward: bool,
    /// Impact compliance: the trunk yields to impacts (contacts and pushes), which the gains alone would hardly allow;
    /// slow loads meet full stiffness. Default true.
    pub yields: bool,
    /// Contact support: pins fade by the share of the weight that contacts other than the ground carry: a box that it
    /// sits on, a table that it leans on. Default true.
    pub leans: bool,
    /// Factor on the maximum force of a pin \[1\], 0 to 100, default 1: one and a half body weights for a part of a leg, four for
    /// another. Weights are those in the world's own gravity, see [`strength_gravity_m_s2`](sinew_body::strength_gravity_m_s2).
    pub strength: f64,
    /// By [`Node::index`]. Default [`KdWeight::FULL`] everywhere.
    pub weights: [KdWeight; Node::COUNT],
}

sinew_snapshot::snapshot!(KdSettings { gains, damping, feed_forward, yields, leans, strength, weights });

impl KdSettings {
    /// A preset with damping relative to the performer, feed-forward and full weights.
    pub const fn of(preset: KdPreset) -> KdSettings {
        KdSettings {
            gains: preset.gains(),
            damping: KdDamping::Relative,
            feed_forward: true,
            yields: true,
            leans: true,
            strength: 1.0,
            weights: [KdWeight::FULL; Node::COUNT],
        }
    }
}

impl Default for KdSettings {
    fn default() -> KdSettings {
        KdSettings::of(KdPreset::Default)
    }
}
