//! Opposed forces of both feet: they turn the body on the spot and keep the feet's distance.
//!
//! Planted feet are held by friction alone, and pushes, and any solver's friction in the long run, move them a little.
//! Hips that rotate over planted feet sink, and so do legs that spread; without a restoring force both would grow.

use super::stance::Stance;
use crate::Wanted;
use crate::reflex::Sense;
use glam::{DQuat, DVec3};
use sinew_body::humanoid::{Body, LEGS, Node, Pose};

/// Keeps the hips' heading and the feet's distance.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pair {
    /// Moment of inertia of the body about the vertical \[kg m²\].
    inertia: f64,
}

/// Return frequency of the hips' heading \[rad/s\].
const HEADING_RAD_S: f64 = 6.0;

/// Restoring force for a foot placement error of a tenth of the stature \[1 of the weight\].
const PULL: f64 = 0.1;

/// Maximum opposed force, relative to the load of the less loaded foot \[1\]: more would make it slip.
const GRIP: f64 = 0.2;

impl Pair {
    pub fn of(body: &Body) -> Pair {
        let positions = Pose::STANDING.positions(body);
        let inertia = Node::ALL
            .into_iter()
            .map(|node| {
                let link = body.link(node);
                let arm = positions[node.index()] + link.centre;
                link.inertia.y + link.mass_kg * (arm.x * arm.x + arm.z * arm.z)
            })
            .sum();
        Pair { inertia }
    }

    /// Horizontal force on the left foot; the right one gets the opposite \[N\].
    pub fn force(&self, sense: &Sense, stance: &Stance, load_n: &[f64; 2], target: &Wanted) -> DVec3 {
        if stance.stands != [true, true] {
            return DVec3::ZERO;
        }
        let me = sense.character();
        let level = |point: DVec3| point.with_y(0.0);
        let [left, right] = [0, 1].map(|side| me.part(LEGS[side].2).position);
        let apart = level(left - right);
        let meant = level(meant_ankle(sense.body, target, 0) - meant_ankle(sense.body, target, 1));
        let (distance, meant_distance) = (apart.length(), meant.length());
        let Some(along) = apart.try_normalize() else { return DVec3::ZERO };
        // Near feet define the heading of the hips less well.
        let heading = |direction: DVec3| libm::atan2(direction.x, direction.z);
        let off = wrap(heading(apart) - heading(meant) - heading(me.facing));
        let spin = me.part(Node::Hips).angular_velocity.y;
        let moment = self.inertia * HEADING_RAD_S * (HEADING_RAD_S * off - 2.0 * spin);
        let least = 0.05 * sense.body.stature_m();
        let across = DVec3::Y.cross(along) * (moment / distance.max(least) * (meant_distance / least).min(1.0));
        let stretch = (meant_distance - distance) / (0.1 * sense.body.stature_m());
        let weight = sense.body.mass_kg() * sense.gravity_m_s2;
        (across + along * (stretch * PULL * weight)).clamp_length_max(GRIP * load_n[0].min(load_n[1]))
    }
}

/// Position of an ankle in the wanted pose, in the hips' frame \[m\].
fn meant_ankle(body: &Body, target: &Wanted, side: usize) -> DVec3 {
    let (upper, lower, foot) = LEGS[side];
    let (mut place, mut turn) = (DVec3::ZERO, DQuat::IDENTITY);
    for node in [upper, lower, foot] {
        place += turn * body.link(node).offset;
        turn *= target.joint(node).rotation;
    }
    place
}

/// The same angle within half a turn.
fn wrap(angle: f64) -> f64 {
    angle - libm::round(angle / std::f64::consts::TAU) * std::f64::consts::TAU
}
