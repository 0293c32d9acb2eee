//! What is held: a part fastened to a prop or to another character's part, by a rigid joint or a spring.

use crate::rows::joint_impulse;
use crate::{Entity, World};
use glam::DVec3;
use rapier3d_f64::prelude::*;
use sinew_body::humanoid::Node;

/// A part and what it holds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Held {
    /// The character that holds.
    pub character: usize,
    /// With this part.
    pub node: Node,
    /// What it holds.
    pub object: Entity,
    /// By a spring instead of a rigid joint.
    pub soft: bool,
    /// Breaks above this force \[N\].
    pub break_force_n: Option<f64>,
}

pub(crate) struct Attachment {
    pub held: Held,
    joint: ImpulseJointHandle,
}

/// Frequency \[Hz\] and damping ratio of a soft hold.
const SOFT: (f64, f64) = (4.0, 0.7);

impl World {
    /// Fastens something to a part as the two lie now. Fastened already, nothing changes.
    pub fn attach(&mut self, held: Held) {
        let itself = held.object == Entity::Part(held.character, held.node);
        if itself || self.is_attached(held.character, held.node, held.object) {
            return;
        }
        let (Some(one), Some(other)) = (self.handle(Entity::Part(held.character, held.node)), self.handle(held.object))
        else {
            return;
        };
        let (Some(a), Some(b)) = (self.engine.bodies.get(one), self.engine.bodies.get(other)) else { return };
        let (a_at, b_at, mass) = (*a.position(), *b.position(), b.mass());
        // Of the held thing's centre, so that a spring has no lever on it.
        let anchor = Pose::from_parts(b.center_of_mass(), a_at.rotation);
        let mut joint = if held.soft {
            let mut spring = GenericJointBuilder::new(JointAxesMask::empty()).build();
            let omega = std::f64::consts::TAU * SOFT.0;
            for axis in [JointAxis::LinX, JointAxis::LinY, JointAxis::LinZ] {
                spring.set_motor_model(axis, MotorModel::ForceBased);
                spring.set_motor(axis, 0.0, 0.0, mass * omega * omega, 2.0 * SOFT.1 * mass * omega);
            }
            spring
        } else {
            GenericJointBuilder::new(JointAxesMask::LIN_AXES | JointAxesMask::ANG_AXES).build()
        };
        joint.set_local_frame1(a_at.inverse() * anchor);
        joint.set_local_frame2(b_at.inverse() * anchor);
        joint.set_contacts_enabled(false);
        let joint = self.engine.joints.insert(one, other, joint, true);
        self.attachments.push(Attachment { held, joint });
    }

    /// Lets go of something.
    pub fn detach(&mut self, character: usize, node: Node, object: Entity) {
        let joints = &mut self.engine.joints;
        self.attachments.retain(|attachment| {
            let held = &attachment.held;
            let stays = !(held.character == character && held.node == node && held.object == object);
            if !stays {
                joints.remove(attachment.joint, true);
            }
            stays
        });
    }

    /// Whether a part holds something.
    pub fn is_attached(&self, character: usize, node: Node, object: Entity) -> bool {
        self.held().any(|held| held.character == character && held.node == node && held.object == object)
    }

    /// All that is held.
    pub fn held(&self) -> impl Iterator<Item = &Held> {
        self.attachments.iter().map(|attachment| &attachment.held)
    }

    pub(crate) fn handle(&self, entity: Entity) -> Option<RigidBodyHandle> {
        match entity {
            Entity::Floor => Some(self.engine.ground),
            Entity::Prop(prop) => Some(self.props.get(prop)?.handle),
            Entity::Part(character, node) => Some(self.characters.get(character)?.bodies[node.index()]),
        }
    }

    pub(crate) fn break_attachments(&mut self) {
        let step_secs = self.settings.step_secs() / self.engine.parameters.num_solver_iterations as f64;
        let (joints, bodies) = (&mut self.engine.joints, &self.engine.bodies);
        self.attachments.retain(|attachment| {
            let Some(limit) = attachment.held.break_force_n else { return true };
            let Some(joint) = joints.get(attachment.joint) else { return true };
            let impulse = if attachment.held.soft {
                let motors = &joint.data.motors;
                DVec3::new(motors[0].impulse, motors[1].impulse, motors[2].impulse).length()
            } else {
                joint_impulse(joint, bodies).length()
            };
            let stays = impulse / step_secs <= limit;
            if !stays {
                joints.remove(attachment.joint, true);
            }
            stays
        });
    }
}
