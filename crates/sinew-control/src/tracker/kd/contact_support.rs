//! Support that moves from the ground to something else.
//!
//! Nguyen et al. 2010, section 7: "we are currently unable to handle a case where the primary support of the character changes from the
//! ground to another object [...] because our system assumes the ground is the primary support and distributes the kinematic
//! corrective forces based on this assumption". Here what holds a body to its place fades by the share of its weight that something
//! else bears, and comes back as the performer rises from it. What the pins let go then rests on that thing too: who sits down
//! ends up borne by seat and ground alone, who puts a hand on a table gives it a little more of the own weight.

use glam::DVec3;
use sinew_body::humanoid::Node;
use sinew_world::{CharacterId, Entity, PropId, World};

/// Share of the weight that is all that a seat can bear: the legs stand on the ground \[1\].
const ALL_OF_IT: f64 = 0.55;

/// What is left of the pins of a body that is wholly borne \[1\].
const LEAST: f64 = 0.02;

/// How fast a force is felt, and how fast the pins answer \[s\].
const FELT_SECS: f64 = 0.05;
const ANSWER_SECS: f64 = 0.12;

/// Hips that rise by this within [`RISE_SECS`] are on the way up, and held in full again \[m\].
const RISE_M: [f64; 2] = [0.01, 0.03];
const RISE_SECS: f64 = 0.5;

/// How far something other than the ground bears a body.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct ContactSupport {
    /// Upward force of what is no ground, smoothed \[N\].
    force_n: f64,
    share: f64,
    /// Where the wanted hips were low not long ago \[m\].
    low_m: Option<f64>,
}

sinew_snapshot::snapshot!(ContactSupport { force_n, share, low_m });

impl ContactSupport {
    /// Feels what bore the body in the world's last step. `ground`: a prop that counts as such; `hips_m`: height of the wanted hips.
    pub(super) fn feel(&mut self, world: &World, character: CharacterId, ground: Option<PropId>, hips_m: f64) {
        let step_secs = world.settings().step_secs();
        let mass_kg = world.body(character).map_or(80.0, |body| body.mass_kg());
        let weight_n = mass_kg * world.settings().gravity_m_s2.max(0.1);
        let force_n = borne_n(world, character, ground);
        self.force_n += (force_n.max(0.0) - self.force_n) * (step_secs / FELT_SECS).min(1.0);
        let low_m = self.low_m.unwrap_or(hips_m).min(hips_m);
        self.low_m = Some(low_m + (hips_m - low_m) * (step_secs / RISE_SECS).min(1.0));
        let [from, to] = RISE_M;
        let stays = 1.0 - ((hips_m - low_m - from) / (to - from)).clamp(0.0, 1.0);
        let wanted = (self.force_n / (ALL_OF_IT * weight_n)).min(1.0) * stays;
        self.share += (wanted - self.share) * (step_secs / ANSWER_SECS).min(1.0);
    }

    /// Feels nothing any more.
    pub(super) fn forget(&mut self) {
        *self = ContactSupport::default();
    }

    /// Factor on the weight of all pins.
    pub(super) fn factor(&self) -> f64 {
        1.0 - self.share * (1.0 - LEAST)
    }
}

/// Upward force on trunk, arms and thighs from all that is neither ground nor held \[N\].
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

/// Parts that stand on things.
fn stands(node: Node) -> bool {
    matches!(node, Node::LeftLowerLeg | Node::RightLowerLeg | Node::LeftFoot | Node::RightFoot)
}
