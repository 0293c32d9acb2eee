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

/// A hand goes around what has its centre no farther from its own than this \[m\].
const AROUND_M: f64 = 0.3;

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
        let (a_at, b_at) = (*a.position(), *b.position());
        // A spring has no lever on what a hand goes around; what is larger, or cannot be moved, is held where the hand is.
        let is_small = b.is_dynamic() && (b.center_of_mass() - a.center_of_mass()).length() < AROUND_M;
        let centre = if is_small || !held.soft { b.center_of_mass() } else { a.center_of_mass() };
        let anchor = Pose::from_parts(centre, a_at.rotation);
        // What hangs on a spring sags alike, whatever it weighs: a part with all of its character, and what cannot be moved with
        // the one who holds it.
        let mass = match held.object {
            Entity::Part(owner, _) => self.mass_kg(owner),
            _ if b.is_dynamic() => b.mass(),
            _ => self.mass_kg(held.character),
        };
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

    /// Holds that broke in the last step, with the force that was too much \[N\].
    pub fn broken_holds(&self) -> &[(Held, f64)] {
        &self.broken_holds
    }

    fn mass_kg(&self, character: usize) -> f64 {
        self.characters.get(character).map_or(0.0, |one| one.body().mass_kg())
    }

    /// Impulse of a hold on the part that holds, in the last sub-step \[N s\], world.
    pub(crate) fn attachment_impulse(&self, attachment: &Attachment) -> DVec3 {
        let Some(joint) = self.engine.joints.get(attachment.joint) else { return DVec3::ZERO };
        if !attachment.held.soft {
            return joint_impulse(joint, &self.engine.bodies);
        }
        let Some(holder) = self.engine.bodies.get(joint.body1()) else { return DVec3::ZERO };
        let motors = &joint.data.motors;
        let along = DVec3::new(motors[0].impulse, motors[1].impulse, motors[2].impulse);
        *holder.rotation() * (joint.data.local_frame1.rotation * along)
    }

    pub(crate) fn break_attachments(&mut self) {
        let sub_step_secs = self.settings.step_secs() / self.engine.parameters.num_solver_iterations as f64;
        self.broken_holds.clear();
        let mut at = 0;
        while let Some(attachment) = self.attachments.get(at) {
            let force_n = self.attachment_impulse(attachment).length() / sub_step_secs;
            if attachment.held.break_force_n.is_some_and(|limit| force_n > limit) {
                let attachment = self.attachments.remove(at);
                self.engine.joints.remove(attachment.joint, true);
                self.broken_holds.push((attachment.held, force_n));
            } else {
                at += 1;
            }
        }
    }
}
