//! Impact compliance of the trunk: it yields to impacts, not to slow loads.
//!
//! The paper's gains let a hit of 20 N s on the chest move it by little more than a centimetre: pins and the spring of
//! the waist hold forty kilograms that move together. People brace themselves against slow loads and yield to impacts.
//! Here the impulse of the last tenths of a second, minus longer-lasting forces, distinguishes the two.

use glam::DVec3;
use sinew_body::humanoid::Node;
use sinew_world::{CharacterId, Entity, Frame, World};

/// Impulse at which the trunk begins to yield, and at which it yields in full, for a body of 80 kg \[N s\].
const FROM_TO_N_S: [f64; 2] = [3.0, 6.0];

/// Decay time of an impulse, after which a force counts as a load \[s\].
const FORGOTTEN_SECS: f64 = 0.2;
const LOAD_SECS: f64 = 0.3;

/// Remaining stiffness of a fully yielding trunk \[1\].
const MIN_STIFFNESS: f64 = 0.02;

/// The same for the hips' pin; legs keep theirs.
const MIN_OF_HIPS: f64 = 0.2;

/// Time constants of yielding and of recovery \[s\].
const TIMES_SECS: [f64; 2] = [0.01, 0.3];

/// The present compliance of the trunk.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct ImpactCompliance {
    load: DVec3,
    impulse: DVec3,
    share: f64,
}

sinew_snapshot::snapshot!(ImpactCompliance { load, impulse, share });

impl ImpactCompliance {
    /// Updates with pushes and contacts on the trunk in the world's last step.
    pub(super) fn measure(&mut self, world: &World, character: CharacterId, mass_kg: f64, step_secs: f64) {
        let force = force_on_trunk(world, character, step_secs);
        let force = if force.is_finite() { force } else { DVec3::ZERO };
        self.impulse += (force - self.load) * step_secs;
        self.impulse -= self.impulse * (step_secs / FORGOTTEN_SECS).min(1.0);
        self.load += (force - self.load) * (step_secs / LOAD_SECS).min(1.0);
        let [from, to] = FROM_TO_N_S.map(|impulse| impulse * mass_kg / 80.0);
        let felt = ((self.impulse.length() - from) / (to - from)).clamp(0.0, 1.0);
        let secs = TIMES_SECS[usize::from(felt < self.share)];
        self.share += (felt - self.share) * (step_secs / secs).min(1.0);
    }

    /// Resets to full stiffness.
    pub(super) fn forget(&mut self) {
        *self = ImpactCompliance::default();
    }

    /// Factors on the stiffness of a part's pin and of its joint.
    pub(super) fn factors(&self, node: Node) -> (f64, f64) {
        let left = |least: f64| 1.0 - self.share * (1.0 - least);
        let pin = match node {
            Node::Hips => left(MIN_OF_HIPS),
            node if is_above_hips(node) => left(MIN_STIFFNESS),
            _ => 1.0,
        };
        (pin, if node == Node::Chest { left(MIN_STIFFNESS) } else { 1.0 })
    }
}

fn force_on_trunk(world: &World, character: CharacterId, step_secs: f64) -> DVec3 {
    let frame: &Frame = world.frame();
    let pushes = world.pushes(character).map_or(DVec3::ZERO, |pushes| {
        Node::ALL.into_iter().filter(|node| is_trunk(*node)).map(|node| pushes[node.index()]).sum()
    });
    let is_own = |entity: Entity| matches!(entity, Entity::Part(owner, _) if owner == character);
    let counts = |entity: Entity| matches!(entity, Entity::Part(owner, node) if owner == character && is_trunk(node));
    let mut impulse = DVec3::ZERO;
    for contact in &frame.contacts {
        let (other, sign) = if counts(contact.b) {
            (contact.a, 1.0)
        } else if counts(contact.a) {
            (contact.b, -1.0)
        } else {
            continue;
        };
        let holds = || world.held().any(|held| held.character == character && held.object == other);
        if !is_own(other) && !holds() {
            impulse += contact.impulse * sign;
        }
    }
    pushes + impulse / step_secs
}

/// Parts that an impact moves together with the trunk.
fn is_trunk(node: Node) -> bool {
    is_above_hips(node) && !matches!(node, Node::LeftLowerArm | Node::RightLowerArm | Node::LeftHand | Node::RightHand)
}

fn is_above_hips(node: Node) -> bool {
    node != Node::Hips && !node.is_leg()
}
