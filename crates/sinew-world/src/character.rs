//! A character in the world: its bodies, joints, and what holds them.

use crate::engine::Engine;
use crate::extra_shape::ExtraShape;
use crate::joint::{LimitSpring, write_ball, write_hinge};
use crate::ragdoll::{is_hinge, part_inertia};
use crate::{CharacterSpec, Drive, Pin};
use glam::{DMat3, DQuat, DVec3};
use rapier3d_f64::prelude::*;
use sinew_body::humanoid::{Body, Node, log};

/// How a part takes part in the physics.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Hold {
    /// Forces move it.
    Free,
    /// Forces are switched off: it goes on with a velocity that decays.
    Drifting,
    /// It is moved to where it is told.
    Told,
}

/// Time in which the velocity of a part without forces falls to 1/e \[s\]: a push's last motion dies out within half a second.
const DRIFT_SECS: f64 = 0.12;

pub(crate) struct Character {
    pub spec: CharacterSpec,
    pub bodies: [RigidBodyHandle; Node::COUNT],
    pub colliders: [ColliderHandle; Node::COUNT],
    pub joints: [ImpulseJointHandle; Node::COUNT],
    pub drives: [Drive; Node::COUNT],
    pub pins: [Option<Pin>; Node::COUNT],
    pub holds: [Hold; Node::COUNT],
    /// Moments of inertia of what hangs from each joint, about it \[kg m²\].
    pub outboard: [f64; Node::COUNT],
    pub gravity_scale: f64,
    pub planes: Vec<ImpulseJointHandle>,
    pub extra_shapes: Vec<ExtraShape>,
    limit_spring: LimitSpring,
    stays_awake: bool,
}

impl Character {
    pub fn new(
        spec: CharacterSpec,
        bodies: [RigidBodyHandle; Node::COUNT],
        colliders: [ColliderHandle; Node::COUNT],
        joints: [ImpulseJointHandle; Node::COUNT],
        drives: [Drive; Node::COUNT],
        outboard: [f64; Node::COUNT],
    ) -> Character {
        let limit_spring = LimitSpring::of(spec.body.mass_kg(), spec.body.stature_m());
        Character {
            spec,
            bodies,
            colliders,
            joints,
            drives,
            pins: [None; Node::COUNT],
            holds: [Hold::Free; Node::COUNT],
            outboard,
            gravity_scale: 1.0,
            planes: Vec::new(),
            extra_shapes: Vec::new(),
            limit_spring,
            stays_awake: false,
        }
    }

    pub fn body(&self) -> &Body {
        &self.spec.body
    }

    /// Hands springs, limits and pins to the solver.
    pub fn prepare(&self, engine: &mut Engine, step_secs: f64) {
        if self.is_asleep(engine) {
            return;
        }
        for node in Node::ALL {
            if node.parent().is_some() {
                self.prepare_joint(engine, node, step_secs);
            }
            self.prepare_body(engine, node, step_secs);
        }
    }

    /// Wakes the character after something that holds it has changed. What is held may seem to rest while it slowly tips, or
    /// while it creeps to its place: only a limp body may sleep.
    pub fn hold_changed(&mut self, engine: &mut Engine) {
        let drives = self
            .drives
            .iter()
            .any(|drive| drive.stiffness > 0.0 || drive.velocity != DVec3::ZERO || drive.torque != DVec3::ZERO);
        let awake = drives || self.pins.iter().any(Option::is_some);
        if self.stays_awake == awake && !self.is_asleep(engine) {
            return;
        }
        self.stays_awake = awake;
        for handle in self.bodies {
            if let Some(body) = engine.bodies.get_mut(handle) {
                let threshold = if awake { -1.0 } else { RigidBodyActivation::default_normalized_linear_threshold() };
                body.activation_mut().normalized_linear_threshold = threshold;
                body.wake_up(true);
            }
        }
    }

    fn is_asleep(&self, engine: &Engine) -> bool {
        self.bodies.iter().all(|&handle| engine.bodies.get(handle).is_some_and(RigidBody::is_sleeping))
    }

    fn rotation(&self, engine: &Engine, node: Node) -> DQuat {
        engine.bodies.get(self.bodies[node.index()]).map_or(DQuat::IDENTITY, |body| *body.rotation())
    }

    fn prepare_joint(&self, engine: &mut Engine, node: Node, step_secs: f64) {
        let Some(parent) = node.parent() else { return };
        let parent_rotation = self.rotation(engine, parent);
        let local = (parent_rotation.conjugate() * self.rotation(engine, node)).normalize();
        let drive = self.drives[node.index()];
        let limit = self.body().link(node).limit;
        let Some(joint) = engine.joints.get_mut(self.joints[node.index()], false) else { return };
        let write = if is_hinge(node) { write_hinge } else { write_ball };
        write(&mut joint.data, &limit, &self.limit_spring, &drive, local, step_secs);
        if drive.torque != DVec3::ZERO {
            for (part, torque) in [(node, drive.torque), (parent, -drive.torque)] {
                if let Some(body) = engine.bodies.get_mut(self.bodies[part.index()]) {
                    body.add_torque(torque, true);
                }
            }
        }
    }

    fn prepare_body(&self, engine: &mut Engine, node: Node, step_secs: f64) {
        let gravity = engine.gravity * self.gravity_scale;
        let Some(body) = engine.bodies.get_mut(self.bodies[node.index()]) else { return };
        match (self.holds[node.index()], self.pins[node.index()]) {
            (Hold::Drifting, _) => {
                let kept = libm::exp(-step_secs / DRIFT_SECS);
                body.set_linvel(body.linvel() * kept, true);
                body.set_angvel(body.angvel() * kept, true);
            }
            (Hold::Free, Some(pin)) => {
                let (force, torque) = pin_force(body, part_inertia(self.body(), node), &pin, step_secs, gravity);
                body.add_force(force, true);
                body.add_torque(torque, true);
            }
            _ => {}
        }
    }
}

/// Force \[N\] and torque \[N m\] of a pin on a body with these moments of inertia along its axes. (The library's own are along
/// axes that it chooses: with those of another axis the torque is no longer stable.)
fn pin_force(body: &RigidBody, inertia: DVec3, pin: &Pin, step_secs: f64, gravity: DVec3) -> (DVec3, DVec3) {
    let (h, k, d) = (step_secs, pin.stiffness, pin.damping);
    let scale = 1.0 / (1.0 + h * d + h * h * k);
    let centre = pin.position + pin.rotation * body.local_center_of_mass();
    let slip = pin.velocity - body.linvel();
    let acceleration = ((centre - body.center_of_mass() + slip * h) * k + slip * d) * scale;
    let force = acceleration * body.mass() - gravity * (body.mass() * pin.gravity_share);

    let spin = pin.angular_velocity - body.angvel();
    let turn = log(pin.rotation * body.rotation().conjugate());
    let turning = ((turn + spin * h) * k + spin * d) * scale;
    let rotation = DMat3::from_quat(*body.rotation());
    let torque = rotation * (DMat3::from_diagonal(inertia) * (rotation.transpose() * turning));

    let cut = (pin.max_force_n / force.length().max(1e-9)).min(1.0);
    (force * cut, torque * cut)
}
