//! Hips and trunk: upright when all is well, thrown after the fall when the feet alone cannot stop it.

use super::legs::smooth;
use super::stance::{Stance, leg};
use super::BalanceSettings;
use crate::Target;
use crate::reflex::Sense;
use glam::{DQuat, DVec2, DVec3};
use sinew_body::humanoid::{Body, Node, Pose};

/// The upper body on its hips.
#[derive(Clone, Debug)]
pub(super) struct Trunk {
    /// Moment of inertia of hips, trunk, head and arms about the hip joints \[kg m²\].
    inertia: f64,
}

impl Trunk {
    pub fn of(body: &Body) -> Trunk {
        let positions = Pose::STANDING.positions(body);
        let axis = positions[Node::LeftUpperLeg.index()].y;
        let inertia = Node::ALL
            .into_iter()
            .filter(|node| !node.is_leg())
            .map(|node| {
                let link = body.link(node);
                let arm = positions[node.index()].y + link.centre.y - axis;
                link.inertia.x + link.mass_kg * arm * arm
            })
            .sum();
        Trunk { inertia }
    }

    /// Moment of the ground about the centre of mass \[N m\]. `beyond` is how far the centre of pressure would have to lie outside
    /// the soles \[m\].
    pub fn moment(&self, sense: &Sense, stance: &Stance, settings: &BalanceSettings, beyond: DVec2, target: &Target) -> DVec3 {
        let hips = sense.character().part(Node::Hips);
        let (up, wanted) = (hips.rotation * DVec3::Y, wanted_up(sense, stance, target));
        let spin = DVec3::new(hips.angular_velocity.x, 0.0, hips.angular_velocity.z);
        let omega = std::f64::consts::TAU * settings.upright_hz;
        let error = up.cross(wanted);
        let upright = (error * (omega * omega) - spin * (2.0 * settings.upright_damping * omega)) * self.inertia;

        let weight = sense.body.mass_kg() * sense.gravity_m_s2;
        let most = settings.trunk_moment * weight * stance.height_m;
        let throw = (DVec3::new(beyond.y, 0.0, -beyond.x) * weight).clamp_length_max(most);
        let Some(axis) = throw.try_normalize() else { return upright.with_y(0.0) };
        // How far it has leant about that axis, and will have soon.
        let lean = -error.dot(axis) + 0.15 * spin.dot(axis);
        let room = self.room(sense, settings, axis);
        let thrown = smooth(beyond.length() / 0.02) * (1.0 - smooth(lean / room * 2.0 - 1.0));
        (throw * thrown + upright * (1.0 - thrown)).with_y(0.0)
    }

    /// How far the trunk may lean about an axis.
    fn room(&self, sense: &Sense, settings: &BalanceSettings, axis: DVec3) -> f64 {
        let me = sense.character();
        let [forward, backward, sideways] = settings.trunk_lean;
        let (pitch, roll) = (axis.dot(me.left()), axis.dot(me.facing));
        let ahead = if pitch > 0.0 { forward } else { backward };
        1.0 / ((pitch / ahead) * (pitch / ahead) + (roll / sideways) * (roll / sideways)).sqrt().max(1e-3)
    }
}

/// The hips' up axis if the wanted pose stood on level feet.
fn wanted_up(sense: &Sense, stance: &Stance, target: &Target) -> DVec3 {
    let mut up = DVec3::ZERO;
    for side in 0..2 {
        if stance.stands[side] {
            let hips_from_foot = leg(side).into_iter().rev().fold(DQuat::IDENTITY, |turn, node| turn * target.joint(node).rotation);
            up += stance.feet[side].level * (hips_from_foot.conjugate() * DVec3::Y);
        }
    }
    let _ = sense;
    up.try_normalize().unwrap_or(DVec3::Y)
}
