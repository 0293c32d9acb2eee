//! Attachments: a part attached to a prop or to another character's part, by a rigid joint or a spring.

use crate::rows::joint_impulse;
use crate::snapshot::Handle;
use crate::{CharacterId, Entity, World};
use glam::DVec3;
use rapier3d_f64::prelude::*;
use sinew_body::humanoid::Node;
use sinew_snapshot::{Reader, Snapshot, SnapshotError, Writer, snapshot};

/// An attachment: a part and the object that it holds.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Held {
    /// The character that holds.
    pub character: CharacterId,
    /// With this part.
    pub node: Node,
    /// What it holds.
    pub object: Entity,
    /// By a spring instead of a rigid joint.
    pub soft: bool,
    /// Breaks above this force \[N\].
    pub break_force_n: Option<f64>,
}

#[derive(Clone)]
pub(crate) struct Attachment {
    pub held: Held,
    joint: ImpulseJointHandle,
    /// Data of a soft attachment.
    spring: Option<Spring>,
}

/// A spring between two points that coincide at rest.
#[derive(Clone, Copy, Default)]
struct Spring {
    stiffness_n_m: f64,
    damping_n_s_m: f64,
    /// From the holder's point to the object's before the step \[m\], world.
    before: DVec3,
}

/// A hand encloses an object whose centre is no farther from its own than this \[m\].
const AROUND_M: f64 = 0.3;

/// Frequency \[Hz\] and damping ratio of a soft attachment.
const SOFT: (f64, f64) = (4.0, 0.7);

impl Attachment {
    /// Ends the joint that holds.
    pub fn release(&self, removed_joints: &mut Vec<ImpulseJointHandle>) {
        removed_joints.push(self.joint);
    }
}

impl World {
    /// Attaches something to a part at their present relative pose. Without effect if it is attached already.
    pub fn attach(&mut self, held: Held) {
        let itself = held.object == Entity::Part(held.character, held.node);
        if itself || self.is_attached(held.character, held.node, held.object) {
            return;
        }
        let (Some(one), Some(other)) = (self.handle(Entity::Part(held.character, held.node)), self.handle(held.object))
        else {
            return self.count_stale();
        };
        let (Some(a), Some(b)) = (self.engine.bodies.get(one), self.engine.bodies.get(other)) else { return };
        let (a_at, b_at) = (*a.position(), *b.position());
        // The spring acts at the centre of an enclosed object; a larger or fixed object is held at the hand's position.
        let is_small = b.is_dynamic() && (b.center_of_mass() - a.center_of_mass()).length() < AROUND_M;
        let centre = if is_small || !held.soft { b.center_of_mass() } else { a.center_of_mass() };
        let anchor = Pose::from_parts(centre, a_at.rotation);
        // The stiffness is scaled by the mass that hangs on the spring, so that the sag does not depend on it: a part
        // counts with its whole character, a fixed object with the holder.
        let mass = match held.object {
            Entity::Part(owner, _) => self.mass_kg(owner),
            _ if b.is_dynamic() => b.mass(),
            _ => self.mass_kg(held.character),
        };
        let omega = std::f64::consts::TAU * SOFT.0;
        let spring = held.soft.then_some(Spring {
            stiffness_n_m: mass * omega * omega,
            damping_n_s_m: 2.0 * SOFT.1 * mass * omega,
            before: DVec3::ZERO,
        });
        let mut joint = match spring {
            Some(spring) => {
                let mut joint = GenericJointBuilder::new(JointAxesMask::empty()).build();
                for axis in [JointAxis::LinX, JointAxis::LinY, JointAxis::LinZ] {
                    joint.set_motor_model(axis, MotorModel::ForceBased);
                    joint.set_motor(axis, 0.0, 0.0, spring.stiffness_n_m, spring.damping_n_s_m);
                }
                joint
            }
            None => GenericJointBuilder::new(JointAxesMask::LIN_AXES | JointAxesMask::ANG_AXES).build(),
        };
        joint.set_local_frame1(a_at.inverse() * anchor);
        joint.set_local_frame2(b_at.inverse() * anchor);
        joint.set_contacts_enabled(false);
        let joint = self.engine.insert_joint(one, other, joint);
        self.attachments.push(Attachment { held, joint, spring });
    }

    /// Detaches something.
    pub fn detach(&mut self, character: CharacterId, node: Node, object: Entity) {
        if self.characters.get(character).is_none() {
            return self.count_stale();
        }
        let joints = &mut self.engine.removed_joints;
        self.attachments.retain(|attachment| {
            let held = &attachment.held;
            let stays = !(held.character == character && held.node == node && held.object == object);
            if !stays {
                attachment.release(joints);
            }
            stays
        });
    }

    /// Whether a part holds something.
    pub fn is_attached(&self, character: CharacterId, node: Node, object: Entity) -> bool {
        self.held().any(|held| held.character == character && held.node == node && held.object == object)
    }

    /// All attachments.
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

    /// Attachments that broke in the last step, with the force that broke them \[N\].
    pub fn broken_holds(&self) -> &[(Held, f64)] {
        &self.broken_holds
    }

    fn mass_kg(&self, character: CharacterId) -> f64 {
        self.characters.get(character).map_or(0.0, |one| one.body().mass_kg())
    }

    /// Stores the extension of springs before a step.
    pub(crate) fn prepare_attachments(&mut self) {
        for attachment in &mut self.attachments {
            if let Some(spring) = &mut attachment.spring
                && let Some(joint) = self.engine.joints.get(attachment.joint)
            {
                spring.before = apart(joint, &self.engine.bodies);
            }
        }
    }

    /// Force of an attachment on the holding part \[N\], world: the mean over the last step for a soft one, that of the
    /// last sub-step for a rigid one.
    ///
    /// The solver keeps no more than the last sub-step's impulses. Those of a spring that is stiff beside a hand's half kilogram differ
    /// from one sub-step to the next by half; its law over the whole step does not.
    pub(crate) fn attachment_force(&self, attachment: &Attachment) -> DVec3 {
        let Some(joint) = self.engine.joints.get(attachment.joint) else { return DVec3::ZERO };
        let step_secs = self.settings.step_secs();
        let Some(spring) = &attachment.spring else {
            let sub_step_secs = step_secs / self.engine.parameters.num_solver_iterations as f64;
            return joint_impulse(joint, &self.engine.bodies) / sub_step_secs;
        };
        let (before, after) = (spring.before, apart(joint, &self.engine.bodies));
        (before + after) * (0.5 * spring.stiffness_n_m) + (after - before) * (spring.damping_n_s_m / step_secs)
    }

    pub(crate) fn break_attachments(&mut self) {
        self.broken_holds.clear();
        let mut at = 0;
        while let Some(attachment) = self.attachments.get(at) {
            let force_n = self.attachment_force(attachment).length();
            if attachment.held.break_force_n.is_some_and(|limit| force_n > limit) {
                let attachment = self.attachments.remove(at);
                attachment.release(&mut self.engine.removed_joints);
                self.broken_holds.push((attachment.held, force_n));
            } else {
                at += 1;
            }
        }
    }
}

/// Held things with their joints.
impl Snapshot for Attachment {
    fn save(&self, to: &mut Writer) {
        self.held.save(to);
        self.joint.save_to(to);
        self.spring.save(to);
    }
    fn restore(&mut self, from: &mut Reader<'_>) -> Result<(), SnapshotError> {
        self.held.restore(from)?;
        self.joint = ImpulseJointHandle::restored(from)?;
        self.spring.restore(from)
    }
}

impl Default for Attachment {
    fn default() -> Attachment {
        Attachment { held: Held::default(), joint: ImpulseJointHandle::invalid(), spring: None }
    }
}

snapshot!(Spring { stiffness_n_m, damping_n_s_m, before });

/// From a joint's point on its first body to that on its second, world \[m\].
fn apart(joint: &ImpulseJoint, bodies: &RigidBodySet) -> DVec3 {
    let (Some(one), Some(other)) = (bodies.get(joint.body1()), bodies.get(joint.body2())) else { return DVec3::ZERO };
    let point = |body: &RigidBody, frame: Pose| (*body.position() * frame).translation;
    point(other, joint.data.local_frame2) - point(one, joint.data.local_frame1)
}
