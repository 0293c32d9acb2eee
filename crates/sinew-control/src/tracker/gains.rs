//! Joint gains, given as frequencies, so that the same numbers suit any body.

use serde::{Deserialize, Serialize};
use sinew_body::humanoid::{Body, Node, Pose};
use std::f64::consts::TAU;

/// The gains of a joint. They take effect when a [`PdTracker`](super::PdTracker) is made and stay. Scenes hold every number to its
/// range.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, schemars::JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct JointGain {
    /// Natural frequency of the parts below the joint on the spring alone \[Hz\], 0 to 100; default 3.
    #[serde(default = "frequency")]
    pub frequency_hz: f64,
    /// Damping ratio \[1\], 0 to 100; default 1.
    #[serde(default = "ratio")]
    pub damping_ratio: f64,
    /// Load factor \[1\], 0 or more: m g h of the parts above the joint is added to the stiffness, times this factor; g is that
    /// of the world. Default `None`: 2 for ankles, knees, hips and chest, else 0.
    #[serde(default)]
    pub load: Option<f64>,
}

fn frequency() -> f64 {
    JointGain::DEFAULT.frequency_hz
}

fn ratio() -> f64 {
    JointGain::DEFAULT.damping_ratio
}

impl JointGain {
    /// Firm, without overshoot.
    pub const DEFAULT: JointGain = JointGain { frequency_hz: 3.0, damping_ratio: 1.0, load: None };
}

impl Default for JointGain {
    fn default() -> JointGain {
        JointGain::DEFAULT
    }
}

/// Stiffness \[N m/rad\] and damping \[N m s/rad\] of every joint of a body; by [`Node::index`], the hips' are 0.
#[derive(Clone, Debug, PartialEq)]
pub struct Gains {
    /// k_sj of Shapiro et al. 2007, EQ3.
    pub stiffness: [f64; Node::COUNT],
    /// The damping that goes with it.
    pub damping: [f64; Node::COUNT],
}

impl Gains {
    /// k = (2π f)² I + load · m g h and d = 2 ζ k / (2π f), with I the outboard inertia of the joint, m and h the mass
    /// above the joint and its height over it, standing, and g the world's gravity \[m/s²\], whatever its sign. An ankle's
    /// own foot has 0.0075 kg m²: without the load every standing pose would collapse.
    pub fn of(
        body: &Body,
        outboard: &[f64; Node::COUNT],
        joints: &[JointGain; Node::COUNT],
        gravity_m_s2: f64,
    ) -> Gains {
        let mut gains = Gains { stiffness: [0.0; Node::COUNT], damping: [0.0; Node::COUNT] };
        for node in Node::ALL.into_iter().skip(1) {
            let joint = &joints[node.index()];
            let omega = TAU * joint.frequency_hz;
            let load = joint.load.unwrap_or(if carries(node) { LOAD } else { 0.0 });
            let stiffness = omega * omega * outboard[node.index()] + load * load_moment(body, node, gravity_m_s2.abs());
            gains.stiffness[node.index()] = stiffness;
            gains.damping[node.index()] = 2.0 * joint.damping_ratio * stiffness / omega.max(1e-6);
        }
        gains
    }
}

/// Default share of the load: a leg's three joints buckle together when each holds just m g h, and two legs share it.
const LOAD: f64 = 2.0;

/// Joints that carry a standing body.
fn carries(node: Node) -> bool {
    matches!(
        node,
        Node::Chest
            | Node::LeftUpperLeg
            | Node::RightUpperLeg
            | Node::LeftLowerLeg
            | Node::RightLowerLeg
            | Node::LeftFoot
            | Node::RightFoot
    )
}

/// m g h of the parts above a joint \[N m\].
fn load_moment(body: &Body, node: Node, gravity_m_s2: f64) -> f64 {
    let positions = Pose::STANDING.positions(body);
    let joint = positions[node.index()].y;
    Node::ALL
        .into_iter()
        .map(|part| {
            let height = (positions[part.index()].y + body.link(part).centre.y - joint).max(0.0);
            body.link(part).mass_kg * gravity_m_s2 * height
        })
        .sum()
}

#[cfg(test)]
mod tests {
    use super::*;
    use sinew_world::outboard_inertias;

    #[test]
    fn on_the_moon_standing_joints_are_softer_by_what_they_carry_less() {
        let body = Body::standard(80.0, 1.7);
        let outboard = outboard_inertias(&body);
        let of = |gravity_m_s2| Gains::of(&body, &outboard, &[JointGain::DEFAULT; Node::COUNT], gravity_m_s2);
        let (earth, moon, weightless) = (of(9.81), of(1.62), of(0.0));
        for node in Node::ALL.into_iter().skip(1) {
            let at = node.index();
            let (on_earth, on_the_moon) =
                (earth.stiffness[at] - weightless.stiffness[at], moon.stiffness[at] - weightless.stiffness[at]);
            // The differences lose some of the sixteen digits.
            assert!((on_the_moon - on_earth * 1.62 / 9.81).abs() < 1e-9 * earth.stiffness[at], "{node:?}");
            assert_eq!(on_earth > 0.0, carries(node), "{node:?}: the load counts where the body rests");
        }
    }
}
