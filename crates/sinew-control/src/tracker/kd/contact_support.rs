//! Contact support: the pins of a body fade with the load that contacts other than the ground carry.
//!
//! Nguyen et al. 2010, section 7: "we are currently unable to handle a case where the primary support of the character
//! changes from the ground to another object [...] because our system assumes the ground is the primary support and
//! distributes the kinematic corrective forces based on this assumption". Here the pins fade by the share of the weight
//! that other contacts carry, and return as the performer rises. The load that the pins release then rests on those
//! contacts too: a sitting body ends up supported by seat and ground alone, and a hand on a table presses a little
//! harder.

use glam::DVec3;
use sinew_body::humanoid::Node;
use sinew_body::strength_gravity_m_s2;
use sinew_world::{CharacterId, Entity, PropId, World};

/// Maximum share of the weight on a seat: the legs stand on the ground \[1\].
const ALL_OF_IT: f64 = 0.55;

/// Remaining factor on the pins of a fully supported body \[1\].
const MIN_FACTOR: f64 = 0.02;

/// Smoothing time of the force, and response time of the pins \[s\].
const FELT_SECS: f64 = 0.05;
const ANSWER_SECS: f64 = 0.12;

/// Rise of the hips within [`RISE_SECS`] at which the performer stands up and the pins return in full \[m\].
const RISE_M: [f64; 2] = [0.01, 0.03];
const RISE_SECS: f64 = 0.5;

/// The contact support of a body.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct ContactSupport {
    /// Upward force of contacts other than the ground, smoothed \[N\].
    force_n: f64,
    share: f64,
    /// Recent minimum height of the wanted hips \[m\].
    low_m: Option<f64>,
}

sinew_snapshot::snapshot!(ContactSupport { force_n, share, low_m });

impl ContactSupport {
    /// Updates with the contacts of the world's last step. `ground`: a prop that counts as ground; `hips_m`: height of
    /// the wanted hips.
    pub(super) fn measure(&mut self, world: &World, character: CharacterId, ground: Option<PropId>, hips_m: f64) {
        let step_secs = world.settings().step_secs();
        let mass_kg = world.body(character).map_or(80.0, |body| body.mass_kg());
        let weight_n = mass_kg * strength_gravity_m_s2(world.settings().gravity_m_s2);
        let force_n = borne_n(world, character, ground);
        self.force_n += (force_n.max(0.0) - self.force_n) * (step_secs / FELT_SECS).min(1.0);
        let low_m = self.low_m.unwrap_or(hips_m).min(hips_m);
        self.low_m = Some(low_m + (hips_m - low_m) * (step_secs / RISE_SECS).min(1.0));
        let [from, to] = RISE_M;
        let stays = 1.0 - ((hips_m - low_m - from) / (to - from)).clamp(0.0, 1.0);
        let wanted = (self.force_n / (ALL_OF_IT * weight_n)).min(1.0) * stays;
        self.share += (wanted - self.share) * (step_secs / ANSWER_SECS).min(1.0);
    }

    /// Resets to no contact support.
    pub(super) fn forget(&mut self) {
        *self = ContactSupport::default();
    }

    /// Factor on the weight of all pins.
    pub(super) fn factor(&self) -> f64 {
        1.0 - self.share * (1.0 - MIN_FACTOR)
    }
}

/// Upward contact force on trunk, arms and thighs from bodies that are neither ground nor held \[N\].
fn borne_n(world: &World, character: CharacterId, ground: Option<PropId>) -> f64 {
    let is_ground = |entity: Entity| entity == Entity::Floor || ground.is_some_and(|prop| entity == Entity::Prop(prop));
    let holds = |entity: Entity| world.held().any(|held| held.character == character && held.object == entity);
    let leans = |entity: Entity| matches!(entity, Entity::Part(owner, node) if owner == character && !stands(node));
    let is_own = |entity: Entity| matches!(entity, Entity::Part(owner, _) if owner == character);
    let mut impulse = DVec3::ZERO;
    for contact in &world.frame().contacts {
        let (other, sign) = if leans(contact.b) {
            (contact.a, 1.0)
        } else if leans(contact.a) {
            (contact.b, -1.0)
        } else {
            continue;
        };
        if !is_own(other) && !is_ground(other) && !holds(other) {
            impulse += contact.impulse * sign;
        }
    }
    let force_n = impulse.y / world.settings().step_secs();
    if force_n.is_finite() { force_n } else { 0.0 }
}

/// Parts whose contacts do not count, because they stand on things.
fn stands(node: Node) -> bool {
    matches!(node, Node::LeftLowerLeg | Node::RightLowerLeg | Node::LeftFoot | Node::RightFoot)
}
