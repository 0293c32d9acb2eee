//! External (residual) forces on a body: force, torque, power and work of pins and other constraints to the world.

use crate::character::Hold;
use crate::rows::joint_impulse;
use crate::{CharacterId, Entity, World, ragdoll};
use glam::{DMat3, DVec3};
use sinew_body::humanoid::Node;

/// Force, torque and power on a part in a step, world axes.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ExternalForce {
    /// \[N\], at the part's centre of mass.
    pub force: DVec3,
    /// \[N m\], about it.
    pub torque: DVec3,
    /// Work on the part over the step's length \[W\]; negative when it takes energy out.
    pub power_w: f64,
}

impl ExternalForce {
    /// Nothing.
    pub const NONE: ExternalForce = ExternalForce { force: DVec3::ZERO, torque: DVec3::ZERO, power_w: 0.0 };

    fn add(&mut self, force: DVec3, torque: DVec3, velocity: DVec3, spin: DVec3) {
        self.force += force;
        self.torque += torque;
        self.power_w += force.dot(velocity) + torque.dot(spin);
    }
}

/// External force on a part: neither from joints (muscles) nor from contacts.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ExternalForces {
    /// By its [`Pin`](crate::Pin), the weight that it carries included.
    pub pin: ExternalForce,
    /// By other constraints to the world: physics switched off on it, a plane, an attachment to the ground or to a
    /// fixed or moving (kinematic) prop. A plane's torques are not counted; they do no work.
    pub held: ExternalForce,
}

impl ExternalForces {
    /// Nothing.
    pub const NONE: ExternalForces = ExternalForces { pin: ExternalForce::NONE, held: ExternalForce::NONE };
}

/// State of a part before a step.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Before {
    pub pin_force: DVec3,
    pub pin_torque: DVec3,
    pub velocity: DVec3,
    pub spin: DVec3,
}

impl World {
    /// Reads the external forces of the last step on a character.
    pub(crate) fn meter(&mut self, id: CharacterId) {
        let step_secs = self.settings.step_secs();
        let sub_step_secs = step_secs / self.engine.parameters.num_solver_iterations as f64;
        let Some(character) = self.characters.get(id) else { return };
        let mut spent = [ExternalForces::NONE; Node::COUNT];
        for node in Node::ALL {
            let at = node.index();
            let Some(body) = self.engine.bodies.get(character.bodies[at]) else { continue };
            let before = &character.before[at];
            let (velocity, spin) = (before.velocity + body.linvel(), before.spin + body.angvel());
            spent[at].pin.add(before.pin_force, before.pin_torque, velocity * 0.5, spin * 0.5);
        }
        for (node, handle) in Node::ALL.into_iter().zip(&character.planes) {
            let (Some(joint), Some(body)) =
                (self.engine.joints.get(*handle), self.engine.bodies.get(character.bodies[node.index()]))
            else {
                continue;
            };
            let force = -joint_impulse(joint, &self.engine.bodies) / sub_step_secs;
            spent[node.index()].held.add(force, DVec3::ZERO, body.linvel(), DVec3::ZERO);
        }
        for attachment in self.attachments.iter().filter(|one| one.held.character == id) {
            let is_of_the_world = match attachment.held.object {
                Entity::Floor => true,
                Entity::Prop(prop) => {
                    let handle = self.props.get(prop).map(|prop| prop.handle);
                    let body = handle.and_then(|handle| self.engine.bodies.get(handle));
                    body.is_some_and(|body| !body.is_dynamic())
                }
                Entity::Part(..) => false,
            };
            let at = attachment.held.node.index();
            if let Some(body) = self.engine.bodies.get(character.bodies[at]).filter(|_| is_of_the_world) {
                let force = self.attachment_force(attachment);
                spent[at].held.add(force, DVec3::ZERO, body.linvel(), DVec3::ZERO);
            }
        }
        for node in Node::ALL.into_iter().filter(|node| character.holds[node.index()] != Hold::Free) {
            let (force, torque) = self.moved_by(id, node, step_secs, sub_step_secs);
            let Some(body) = self.engine.bodies.get(character.bodies[node.index()]) else { continue };
            spent[node.index()].held.add(force, torque, body.linvel(), body.angvel());
        }
        self.frame.characters[id.slot()].external = spent;
    }

    /// Force and torque that move a part whose physics is off: those that its motion requires beyond weight, joints and
    /// contacts.
    fn moved_by(&self, id: CharacterId, node: Node, step_secs: f64, sub_step_secs: f64) -> (DVec3, DVec3) {
        let Some(character) = self.characters.get(id) else { return (DVec3::ZERO, DVec3::ZERO) };
        let Some(body) = self.engine.bodies.get(character.bodies[node.index()]) else {
            return (DVec3::ZERO, DVec3::ZERO);
        };
        let link = character.body().link(node);
        let (before, centre) = (&character.before[node.index()], self.frame.characters[id.slot()].part(node).centre);
        let rotation = DMat3::from_quat(*body.rotation());
        let inertia = DMat3::from_diagonal(ragdoll::part_inertia(character.body(), node));
        let turning = (body.angvel() - before.spin) / step_secs;
        let gravity = self.engine.gravity * character.gravity_scales[node.index()];
        let mut force = ((body.linvel() - before.velocity) / step_secs - gravity) * link.mass_kg;
        let mut torque = rotation * (inertia * (rotation.transpose() * turning));
        for child in Node::ALL {
            // The joint's force on its parent, and the opposite on its child.
            let sign = match child.parent() {
                Some(parent) if parent == node => 1.0,
                Some(_) if child == node => -1.0,
                _ => continue,
            };
            let Some(joint) = self.engine.joints.get(character.joints[child.index()]) else { continue };
            let warm_start = character.warm_starts[child.index()].after(joint, &self.engine.bodies, sub_step_secs);
            let place = self.frame.characters[id.slot()].part(child).position;
            force -= warm_start.force * sign;
            torque -= ((place - centre).cross(warm_start.force) + warm_start.torque) * sign;
        }
        for contact in &self.frame.contacts {
            let own = Entity::Part(id, node);
            let sign = if contact.b == own { 1.0 } else { -1.0 };
            if contact.a == own || contact.b == own {
                let push = contact.impulse * (sign / step_secs);
                force -= push;
                torque -= (contact.point - centre).cross(push);
            }
        }
        (force, torque)
    }
}
