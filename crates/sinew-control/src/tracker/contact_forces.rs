//! Contact forces on a character's parts, as their mean over a motion frame.

use glam::DVec3;
use sinew_body::humanoid::Node;
use sinew_response::PointForce;
use sinew_world::{CharacterId, Entity, Frame, PropId, World};

/// Impulses on the parts of a character since the motion frame began.
#[derive(Clone, Debug, Default)]
pub(crate) struct ContactForces {
    /// By [`Node::index`].
    parts: [Touch; Node::COUNT],
}

#[derive(Clone, Copy, Debug, Default)]
struct Touch {
    /// Sum of the impulses \[N s\], world.
    impulse: DVec3,
    /// Sum of their sizes \[N s\].
    size: f64,
    /// Sum of their points in the part's frame, times their sizes.
    moment: DVec3,
}

sinew_snapshot::snapshot!(ContactForces { parts });
sinew_snapshot::snapshot!(Touch { impulse, size, moment });

impl ContactForces {
    /// Adds the contacts of the world's last step. Floor, ground prop, own parts and held objects do not count: the
    /// wanted motion already stands on or carries them.
    pub(crate) fn add(&mut self, world: &World, character: CharacterId, ground: Option<PropId>) {
        let frame = world.frame();
        let counts = |other: Entity| match other {
            Entity::Floor => false,
            Entity::Prop(prop) => {
                ground != Some(prop) && !world.held().any(|held| held.character == character && held.object == other)
            }
            Entity::Part(owner, _) => owner != character,
        };
        for contact in &frame.contacts {
            match (contact.a, contact.b) {
                (Entity::Part(owner, node), other) if owner == character && counts(other) => {
                    self.touch(frame, character, node, contact.point, -contact.impulse);
                }
                (other, Entity::Part(owner, node)) if owner == character && counts(other) => {
                    self.touch(frame, character, node, contact.point, contact.impulse);
                }
                _ => {}
            }
        }
    }

    /// Adds the pushes of the world's next step, and takes them off the rigid bodies: the response answers them.
    pub(crate) fn take_pushes(&mut self, world: &mut World, character: CharacterId) {
        let step_secs = world.settings().step_secs();
        for node in Node::ALL {
            let Some((force, torque)) = world.take_push(character, node) else { continue };
            // The line along which a force of this moment about the centre of mass acts.
            let arm = force.cross(torque) / force.length_squared().max(1e-12);
            let frame = world.frame();
            let Some(centre) = frame.character(character).map(|one| one.part(node).centre) else { continue };
            self.touch(frame, character, node, centre + arm, force * step_secs);
        }
    }

    fn touch(&mut self, frame: &Frame, character: CharacterId, node: Node, point: DVec3, impulse: DVec3) {
        let Some(part) = frame.character(character).map(|one| one.part(node)) else { return };
        let size = impulse.length();
        if size > 0.0 && impulse.is_finite() && point.is_finite() {
            let touch = &mut self.parts[node.index()];
            touch.impulse += impulse;
            touch.size += size;
            touch.moment += part.rotation.conjugate() * (point - part.position) * size;
        }
    }

    /// The mean forces over the motion frame that ends; resets for the next one.
    pub(crate) fn take(&mut self, frame_secs: f64, forces: &mut Vec<PointForce>) {
        forces.clear();
        for (node, touch) in Node::ALL.into_iter().zip(&self.parts) {
            if touch.size > 0.0 {
                let point = Some(touch.moment / touch.size);
                forces.push(PointForce { node, point, force_n: touch.impulse / frame_secs });
            }
        }
        self.parts = [Touch::default(); Node::COUNT];
    }
}
