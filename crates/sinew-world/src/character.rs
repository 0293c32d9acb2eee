//! A character in the world: its bodies, joints, springs and pins.

use crate::engine::Engine;
use crate::external_force::Before;
use crate::extra_shape::ExtraShape;
use crate::joint::{LimitSpring, Start, write_ball, write_hinge};
use crate::pin::pin_force;
use crate::ragdoll::{is_hinge, part_inertia, part_solid};
use crate::reaction_body::ReactionBody;
use crate::warm_start::WarmStart;
use crate::{CharacterSpec, Drive, Pin, Solid};
use glam::{DQuat, DVec3};
use rapier3d_f64::prelude::*;
use sinew_body::humanoid::{Body, Node};
use sinew_body::strength_gravity_m_s2;

/// How a part takes part in the physics.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Hold {
    /// Forces move it.
    Free,
    /// Forces are switched off: it drifts with a velocity that decays.
    Drifting,
    /// Kinematic: it is moved to a given place.
    Told,
}

/// Time in which the velocity of a part without forces falls to 1/e \[s\]: a push's last motion dies out within half a second.
const DRIFT_SECS: f64 = 0.12;

#[derive(Clone)]
pub(crate) struct Character {
    pub spec: CharacterSpec,
    pub bodies: [RigidBodyHandle; Node::COUNT],
    pub colliders: [ColliderHandle; Node::COUNT],
    pub joints: [ImpulseJointHandle; Node::COUNT],
    pub drives: [Drive; Node::COUNT],
    pub pins: [Option<Pin>; Node::COUNT],
    pub holds: [Hold; Node::COUNT],
    /// Outboard moments of inertia about each joint \[kg m²\].
    pub outboard: [f64; Node::COUNT],
    /// Factors on gravity.
    pub gravity_scales: [f64; Node::COUNT],
    pub planes: Vec<ImpulseJointHandle>,
    /// Load on each joint's parent at the start of a step.
    pub warm_starts: [WarmStart; Node::COUNT],
    pub extra_shapes: Vec<ExtraShape>,
    /// Shapes of parts in place of their own.
    pub solids: [Option<Solid>; Node::COUNT],
    /// Forces of pushes in the next step, and in the last one \[N\].
    pub pushes: [[DVec3; Node::COUNT]; 2],
    /// For the meter.
    pub before: [Before; Node::COUNT],
    /// The reaction body of its pins.
    pub reaction_body: Option<ReactionBody>,
    pub stays_awake: bool,
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
        Character {
            spec,
            bodies,
            colliders,
            joints,
            drives,
            pins: [None; Node::COUNT],
            holds: [Hold::Free; Node::COUNT],
            outboard,
            gravity_scales: [1.0; Node::COUNT],
            planes: Vec::new(),
            warm_starts: [WarmStart::default(); Node::COUNT],
            extra_shapes: Vec::new(),
            solids: Default::default(),
            pushes: [[DVec3::ZERO; Node::COUNT]; 2],
            before: [Before::default(); Node::COUNT],
            reaction_body: None,
            stays_awake: false,
        }
    }

    pub fn body(&self) -> &Body {
        &self.spec.body
    }

    /// The shape of a part now.
    pub fn solid_of(&self, node: Node) -> Solid {
        self.solids[node.index()].clone().unwrap_or_else(|| part_solid(self.body(), node))
    }

    /// Passes springs, limits and pins to the solver.
    pub fn prepare(&mut self, engine: &mut Engine, step_secs: f64) {
        if self.is_asleep(engine) {
            self.before = [Before::default(); Node::COUNT];
            return;
        }
        let mut loads = [Load::default(); Node::COUNT];
        for node in Node::ALL {
            if node.parent().is_some() {
                self.prepare_joint(engine, node, step_secs, &mut loads);
            }
        }
        for node in Node::ALL {
            self.prepare_body(engine, node, step_secs, &loads[node.index()]);
        }
        if let Some(reaction_body) = &mut self.reaction_body {
            reaction_body.press(engine, &self.bodies, &self.before);
        }
    }

    /// Wakes the character after a spring, pin or attachment has changed. A held body may seem to rest while it slowly
    /// tips or creeps: only a limp body may sleep.
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

    /// Writes a joint's rows, and adds its warm start to the loads of the two bodies.
    fn prepare_joint(&mut self, engine: &mut Engine, node: Node, step_secs: f64, loads: &mut [Load; Node::COUNT]) {
        let Some(parent) = node.parent() else { return };
        let sub_step_secs = step_secs / engine.parameters.num_solver_iterations as f64;
        let parent_rotation = self.rotation(engine, parent);
        let local = (parent_rotation.conjugate() * self.rotation(engine, node)).normalize();
        let drive = self.drives[node.index()];
        let limit = self.body().link(node).limit;
        let (mass_kg, stature_m) = (self.body().mass_kg(), self.body().stature_m());
        let gravity_m_s2 = strength_gravity_m_s2(engine.gravity.y);
        let limit_spring = LimitSpring::of(mass_kg, gravity_m_s2, stature_m);
        let handle = self.joints[node.index()];
        let place = engine.bodies.get(self.bodies[node.index()]).map_or(DVec3::ZERO, RigidBody::translation);
        let warm_start = &mut self.warm_starts[node.index()];
        let Some(joint) = engine.joints.get(handle) else { return };
        *warm_start =
            warm_start.after(joint, &engine.bodies, sub_step_secs).handed_on(mass_kg * gravity_m_s2, stature_m);
        let Some(joint) = engine.joints.get_mut(handle, false) else { return };
        let write = if is_hinge(node) { write_hinge } else { write_ball };
        let start = Start { step_secs, sub_step_secs, torque: parent_rotation.conjugate() * warm_start.torque };
        let torque = write(&mut joint.data, &limit, &limit_spring, &drive, local, start);
        warm_start.torque = parent_rotation * torque;
        loads[parent.index()].add(warm_start.force, place, warm_start.torque - drive.torque);
        loads[node.index()].add(-warm_start.force, place, drive.torque - warm_start.torque);
    }

    fn prepare_body(&mut self, engine: &mut Engine, node: Node, step_secs: f64, load: &Load) {
        let gravity = engine.gravity * self.gravity_scales[node.index()];
        let Some(body) = engine.bodies.get_mut(self.bodies[node.index()]) else { return };
        let before = &mut self.before[node.index()];
        *before = Before { velocity: body.linvel(), spin: body.angvel(), ..Before::default() };
        body.add_force(load.force, false);
        body.add_torque(load.moment - body.center_of_mass().cross(load.force), false);
        match (self.holds[node.index()], self.pins[node.index()]) {
            (Hold::Drifting, _) => {
                let kept = libm::exp(-step_secs / DRIFT_SECS);
                body.set_linvel(body.linvel() * kept, true);
                body.set_angvel(body.angvel() * kept, true);
            }
            (Hold::Free, Some(pin)) => {
                let (force, torque) = pin_force(body, part_inertia(&self.spec.body, node), &pin, step_secs, gravity);
                (before.pin_force, before.pin_torque) = (force, torque);
                body.add_force(force, true);
                body.add_torque(torque, true);
            }
            _ => {}
        }
    }
}

/// Forces on a body: their sum \[N\] and their moment about the world's origin \[N m\].
#[derive(Clone, Copy, Default)]
struct Load {
    force: DVec3,
    moment: DVec3,
}

impl Load {
    fn add(&mut self, force: DVec3, at: DVec3, torque: DVec3) {
        self.force += force;
        self.moment += at.cross(force) + torque;
    }
}
