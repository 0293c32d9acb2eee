//! Joints of props: to each other, to the ground, to a part of a character.
//!
//! Hinges are rewritten for each step: the solver sees no angle at the step's start, and a stop only when a step can
//! reach it. So the platform's mathematics is not used, and a wheel may rotate without end.

use crate::joint::stop_at;
use crate::rows::joint_impulse;
use crate::snapshot::Handle;
use crate::{Entity, PropJointId, SpecError, World, sanitize};
use glam::{DQuat, DVec3};
use rapier3d_f64::prelude::*;
use sinew_snapshot::{Reader, Snapshot, SnapshotError, Writer, snapshot};

/// Description of a joint.
#[derive(Clone, Debug, PartialEq)]
pub struct PropJointSpec {
    /// The two bodies that it connects; [`Entity::Floor`] is the world itself.
    pub between: [Entity; 2],
    /// Anchors on the first and on the second body, in the world at their present poses \[m\]. Only ropes and springs
    /// use both; other joints use the first.
    pub anchors: [DVec3; 2],
    /// Its kind: the degrees of freedom that it leaves free.
    pub kind: PropJointKind,
    /// Its motor; only hinges and sliders can have one.
    pub motor: Option<Motor>,
    /// Breaks above this force \[N\].
    pub break_force_n: Option<f64>,
    /// The two bodies collide with each other.
    pub touches: bool,
}

/// The kind of a joint, by its free degrees of freedom.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum PropJointKind {
    /// Nothing.
    Fixed,
    /// All turns.
    Ball,
    /// Turns of the second against the first about an axis of the world as they lie now; `range` \[rad\] from there.
    Hinge {
        /// The axis.
        axis: DVec3,
        /// Its limits: from at most 0 to at least 0, within ±3 rad.
        range: Option<[f64; 2]>,
    },
    /// Shifts of the second against the first along an axis of the world as they lie now; `range` \[m\] from there.
    Slider {
        /// The axis.
        axis: DVec3,
        /// Its limits: from at most 0 to at least 0.
        range: Option<[f64; 2]>,
    },
    /// Everything up to a distance of the anchors.
    Rope {
        /// The distance \[m\].
        length_m: f64,
    },
    /// Everything, against a spring between the anchors.
    Spring {
        /// Its length at rest \[m\].
        length_m: f64,
        /// \[N/m\].
        stiffness_n_m: f64,
        /// \[N s/m\].
        damping_n_s_m: f64,
    },
}

/// The motor of a hinge or a slider.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Motor {
    /// Its target.
    pub aim: Aim,
    /// Maximum torque \[N m\], or force \[N\] of a slider.
    pub strength: f64,
}

/// The target of a motor.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Aim {
    /// A speed \[rad/s, m/s\].
    Speed(f64),
    /// A position \[rad, m\] relative to that at creation; reached after about a third of a second.
    Place(f64),
}

/// The state of a joint.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PropJointState {
    /// It is neither cut nor broken.
    pub is_whole: bool,
    /// The angle of a hinge \[rad\], the shift of a slider \[m\], relative to creation; otherwise the distance of the
    /// anchors \[m\].
    pub place: f64,
    /// Its rate of change \[rad/s, m/s\].
    pub speed: f64,
}

/// Error of the speed at which a motor saturates \[rad/s, m/s\].
const FULL_AT_SPEED: f64 = 0.1;

/// Error of the position at which a motor saturates \[rad, m\].
const FULL_AT_PLACE: f64 = 0.1;

/// Ratio of damping to stiffness of a position motor \[s\].
const PLACE_SECS: f64 = 0.1;

/// Joints of props in a world.
const MAX_JOINTS: usize = 10_000;

#[derive(Clone)]
pub(crate) struct PropJoint {
    spec: PropJointSpec,
    /// `None` once it is cut.
    handle: Option<ImpulseJointHandle>,
    bodies: [RigidBodyHandle; 2],
    /// Its frames in the two bodies at creation.
    frames: [Pose; 2],
    /// Its position before the step, as [`PropJointState::place`].
    before: f64,
}

snapshot!(enum Aim { 0: Speed(speed), 1: Place(place) });
snapshot!(Motor { aim, strength });

impl Snapshot for PropJoint {
    fn save(&self, to: &mut Writer) {
        let PropJoint { spec, handle, bodies: _, frames: _, before } = self;
        spec.motor.save(to);
        handle.map(Handle::parts).save(to);
        before.save(to);
    }
    fn restore(&mut self, from: &mut Reader<'_>) -> Result<(), SnapshotError> {
        self.spec.motor.restore(from)?;
        if self.spec.motor.is_some_and(|motor| !is_motor(&motor, &self.spec.kind)) {
            return Err(SnapshotError::invalid("motor of a joint"));
        }
        let mut handle: Option<(u32, u32)> = None;
        handle.restore(from)?;
        self.handle = handle.map(|(index, generation)| ImpulseJointHandle::of(index, generation));
        self.before.restore(from)
    }
}

/// A speed of 0.
impl Default for Aim {
    fn default() -> Aim {
        Aim::Speed(0.0)
    }
}

impl World {
    /// Connects two bodies at their present poses. Returns the joint's id.
    ///
    /// # Errors
    /// The two are the same or do not exist, a number is invalid, or a joint that is neither hinge nor slider has a
    /// motor.
    pub fn add_prop_joint(&mut self, spec: PropJointSpec) -> Result<PropJointId, SpecError> {
        if !is_sound(&spec) || self.prop_joints.count() >= MAX_JOINTS {
            return Err(SpecError::NoJoint);
        }
        let [one, other] = [self.living(spec.between[0])?, self.living(spec.between[1])?];
        let (Some(a), Some(b)) = (self.engine.bodies.get(one), self.engine.bodies.get(other)) else {
            return Err(SpecError::NoJoint);
        };
        if one == other {
            return Err(SpecError::NoJoint);
        }
        let rotation = match spec.kind {
            PropJointKind::Hinge { axis, .. } | PropJointKind::Slider { axis, .. } => {
                DQuat::from_rotation_arc(DVec3::X, axis.normalize())
            }
            _ => DQuat::IDENTITY,
        };
        let second = match spec.kind {
            PropJointKind::Rope { .. } | PropJointKind::Spring { .. } => spec.anchors[1],
            _ => spec.anchors[0],
        };
        let frames = [
            a.position().inverse() * Pose::from_parts(spec.anchors[0], rotation),
            b.position().inverse() * Pose::from_parts(second, rotation),
        ];
        let mut joint = base(&spec.kind);
        joint.set_contacts_enabled(spec.touches);
        joint.set_local_frame1(frames[0]);
        joint.set_local_frame2(frames[1]);
        let handle = self.engine.insert_joint(one, other, joint);
        Ok(self.prop_joints.insert(PropJoint { spec, handle: Some(handle), bodies: [one, other], frames, before: 0.0 }))
    }

    /// Sets the motor of a hinge or a slider, or releases it with `None`. Takes effect in the next step. Without effect
    /// for other joints and for invalid numbers.
    pub fn set_prop_motor(&mut self, joint: PropJointId, motor: Option<Motor>) {
        let Some(joint) = self.prop_joints.get_mut(joint) else { return self.count_stale() };
        if motor.is_none_or(|motor| is_motor(&motor, &joint.spec.kind)) {
            joint.spec.motor = motor;
        }
    }

    /// The motor of a joint.
    pub fn prop_motor(&self, joint: PropJointId) -> Option<Motor> {
        self.prop_joints.get(joint)?.spec.motor
    }

    /// Cuts a joint permanently. False if it is cut or broken already, or does not exist.
    pub fn cut_prop_joint(&mut self, joint: PropJointId) -> bool {
        let Some(joint) = self.prop_joints.get_mut(joint) else {
            self.count_stale();
            return false;
        };
        joint.cut(&mut self.engine.removed_joints)
    }

    /// The present state of a joint. One that does not exist is not whole.
    pub fn prop_joint(&self, joint: PropJointId) -> PropJointState {
        let Some(joint) = self.prop_joints.get(joint) else { return PropJointState::default() };
        let bodies = joint.bodies.map(|handle| self.engine.bodies.get(handle));
        let [Some(one), Some(other)] = bodies else { return PropJointState::default() };
        let (place, speed) = joint.place(one, other);
        PropJointState { is_whole: joint.handle.is_some(), place, speed }
    }

    /// The body of something that is there.
    fn living(&self, entity: Entity) -> Result<RigidBodyHandle, SpecError> {
        self.handle(entity).ok_or(match entity {
            Entity::Prop(prop) => SpecError::StaleProp(prop),
            Entity::Part(character, _) => SpecError::StaleCharacter(character),
            Entity::Floor => SpecError::NoJoint,
        })
    }

    /// Passes the joints of props to the solver.
    pub(crate) fn prepare_prop_joints(&mut self) {
        for joint in self.prop_joints.values_mut() {
            joint.prepare(&mut self.engine.joints, &self.engine.bodies);
        }
    }

    /// Breaks the joints whose force in the last step exceeded their limit.
    pub(crate) fn break_prop_joints(&mut self) {
        let step_secs = self.settings.step_secs();
        let sub_step_secs = step_secs / self.engine.parameters.num_solver_iterations as f64;
        let (joints, bodies) = (&self.engine.joints, &self.engine.bodies);
        for prop_joint in self.prop_joints.values_mut() {
            let (Some(limit), Some(handle)) = (prop_joint.spec.break_force_n, prop_joint.handle) else { continue };
            let Some(joint) = joints.get(handle) else { continue };
            let force_n = match prop_joint.spec.kind {
                PropJointKind::Rope { .. } => joint.data.limits[0].impulse.abs() / sub_step_secs,
                PropJointKind::Spring { length_m, stiffness_n_m, damping_n_s_m } => {
                    let (before, after) = (prop_joint.before, prop_joint.place_now(bodies));
                    let stretch_m = (before + after) * 0.5 - length_m;
                    (stretch_m * stiffness_n_m + (after - before) / step_secs * damping_n_s_m).abs()
                }
                _ => joint_impulse(joint, bodies).length() / sub_step_secs,
            };
            if force_n > limit {
                prop_joint.cut(&mut self.engine.removed_joints);
            }
        }
    }
}

impl PropJoint {
    /// Ends it. False when it was cut or broken before.
    pub fn cut(&mut self, removed_joints: &mut Vec<ImpulseJointHandle>) -> bool {
        let Some(handle) = self.handle.take() else { return false };
        removed_joints.push(handle);
        true
    }

    /// Whether it fastens something that is meant.
    pub fn fastens(&self, is_it: impl Fn(Entity) -> bool) -> bool {
        self.spec.between.iter().any(|&entity| is_it(entity))
    }

    fn place_now(&self, bodies: &RigidBodySet) -> f64 {
        let [Some(one), Some(other)] = self.bodies.map(|handle| bodies.get(handle)) else { return 0.0 };
        self.place(one, other).0
    }

    fn prepare(&mut self, joints: &mut ImpulseJointSet, bodies: &RigidBodySet) {
        let Some(handle) = self.handle else { return };
        self.before = self.place_now(bodies);
        let [Some(one), Some(other)] = self.bodies.map(|handle| bodies.get(handle)) else { return };
        // A slow pendulum is slower than any threshold of sleep.
        let Some(joint) = joints.get_mut(handle, true) else { return };
        let (range, axis) = match self.spec.kind {
            PropJointKind::Hinge { range, .. } => (range, JointAxis::AngX),
            PropJointKind::Slider { range, .. } => (range, JointAxis::LinX),
            _ => return,
        };
        let (place, _) = self.place(one, other);
        let data = &mut joint.data;
        // The solver's own zero position.
        let zero = if axis == JointAxis::AngX {
            let (sin, cos) = libm::sincos(place / 2.0);
            data.local_frame2.rotation = self.frames[1].rotation * DQuat::from_xyzw(-sin, 0.0, 0.0, cos);
            if let Some([low, high]) = range {
                let (room, sign) = if high - place < place - low { (high - place, 1.0) } else { (place - low, -1.0) };
                stop_at(data, axis, room, sign);
            }
            place
        } else {
            0.0
        };
        match self.spec.motor {
            None => data.motor_axes.remove(JointAxesMask::from(axis)),
            Some(motor) => {
                data.set_motor_model(axis, MotorModel::ForceBased);
                data.set_motor_max_force(axis, motor.strength);
                match motor.aim {
                    Aim::Speed(speed) => data.set_motor(axis, 0.0, speed, 0.0, motor.strength / FULL_AT_SPEED),
                    Aim::Place(wanted) => {
                        let stiffness = motor.strength / FULL_AT_PLACE;
                        data.set_motor(axis, wanted - zero, 0.0, stiffness, stiffness * PLACE_SECS)
                    }
                };
            }
        }
    }

    /// Place and speed, as [`PropJointState`] has them.
    fn place(&self, one: &RigidBody, other: &RigidBody) -> (f64, f64) {
        let [a, b] = [*one.position() * self.frames[0], *other.position() * self.frames[1]];
        match self.spec.kind {
            PropJointKind::Hinge { .. } => {
                let local = a.rotation.conjugate() * b.rotation;
                let sign = if local.w < 0.0 { -1.0 } else { 1.0 };
                let angle = 2.0 * libm::atan2(local.x * sign, local.w * sign);
                (angle, (a.rotation * DVec3::X).dot(other.angvel() - one.angvel()))
            }
            kind => {
                let apart = b.translation - a.translation;
                let along = match kind {
                    PropJointKind::Slider { .. } => a.rotation * DVec3::X,
                    _ => apart.normalize_or_zero(),
                };
                let slip = other.velocity_at_point(b.translation) - one.velocity_at_point(b.translation);
                (apart.dot(along), slip.dot(along))
            }
        }
    }
}

/// The part of the library's joint that stays.
fn base(kind: &PropJointKind) -> GenericJoint {
    match *kind {
        PropJointKind::Fixed => GenericJointBuilder::new(JointAxesMask::LIN_AXES | JointAxesMask::ANG_AXES).build(),
        PropJointKind::Ball => GenericJointBuilder::new(JointAxesMask::LIN_AXES).build(),
        PropJointKind::Hinge { .. } => {
            GenericJointBuilder::new(JointAxesMask::LIN_AXES | JointAxesMask::ANG_Y | JointAxesMask::ANG_Z).build()
        }
        PropJointKind::Slider { range, .. } => {
            let locked = JointAxesMask::LIN_Y | JointAxesMask::LIN_Z | JointAxesMask::ANG_AXES;
            let joint = GenericJointBuilder::new(locked);
            range.map_or(joint, |range| joint.limits(JointAxis::LinX, range)).build()
        }
        PropJointKind::Rope { length_m } => GenericJointBuilder::new(JointAxesMask::empty())
            .coupled_axes(JointAxesMask::LIN_AXES)
            .limits(JointAxis::LinX, [0.0, length_m])
            .build(),
        PropJointKind::Spring { length_m, stiffness_n_m, damping_n_s_m } => {
            GenericJointBuilder::new(JointAxesMask::empty())
                .coupled_axes(JointAxesMask::LIN_AXES)
                .motor_model(JointAxis::LinX, MotorModel::ForceBased)
                .set_motor(JointAxis::LinX, length_m, 0.0, stiffness_n_m, damping_n_s_m)
                .build()
        }
    }
}

fn is_sound(spec: &PropJointSpec) -> bool {
    let gain = |gain: f64| (0.0..1e9).contains(&gain);
    let length = |length: f64| (0.0..sanitize::MAX_DISTANCE_M).contains(&length);
    let axis = |axis: DVec3| axis.is_finite() && axis.length() > 1e-6;
    let around_zero = |range: Option<[f64; 2]>, most: f64| {
        range.is_none_or(|[low, high]| (-most..=0.0).contains(&low) && (0.0..=most).contains(&high) && low < high)
    };
    let kind = match spec.kind {
        PropJointKind::Fixed | PropJointKind::Ball => true,
        PropJointKind::Hinge { axis: about, range } => axis(about) && around_zero(range, 3.0),
        PropJointKind::Slider { axis: along, range } => axis(along) && around_zero(range, sanitize::MAX_DISTANCE_M),
        PropJointKind::Rope { length_m } => length(length_m) && length_m > 1e-4,
        PropJointKind::Spring { length_m, stiffness_n_m, damping_n_s_m } => {
            length(length_m) && gain(stiffness_n_m) && gain(damping_n_s_m) && stiffness_n_m + damping_n_s_m > 0.0
        }
    };
    kind && spec.anchors.into_iter().all(sanitize::is_place)
        && spec.break_force_n.is_none_or(|force| force > 0.0)
        && spec.motor.is_none_or(|motor| is_motor(&motor, &spec.kind))
}

fn is_motor(motor: &Motor, kind: &PropJointKind) -> bool {
    let aim = match motor.aim {
        Aim::Speed(speed) => speed.abs() <= sanitize::MAX_SPEED_M_S,
        Aim::Place(place) => place.abs() <= sanitize::MAX_DISTANCE_M,
    };
    aim && (0.0..=crate::MAX_FORCE_N).contains(&motor.strength)
        && motor.strength > 0.0
        && matches!(kind, PropJointKind::Hinge { .. } | PropJointKind::Slider { .. })
}
