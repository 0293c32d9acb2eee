//! A world as bytes: its state, in a world that was built in the same way.

use crate::engine::Engine;
use crate::frame::{BodyState, CharacterFrame, Contact, Entity, Frame};
use crate::id::SlotId;
use crate::library_bytes::{Colliders, LeftOut, load, save};
use crate::readback::part_state;
use crate::slots::Slots;
use crate::{ExternalForce, ExternalForces, Held, World};
use rapier3d_f64::prelude::*;
use sinew_body::humanoid::Node;
use sinew_snapshot::{Reader, Snapshot, SnapshotError, Writer, snapshot};
use std::collections::BTreeSet;

/// The state of a world: bodies, joints, contacts with their warm starts, islands and sleep, holds, planes, attachments, the frame.
///
/// What was described when things were added (bodies, shapes, masses, surfaces, joints) is not in it: it is restored into a world to
/// which the same characters, props and joints were added in the same order, such as a clone. What was removed since then is
/// removed; what was added later is an error. A world that was restored goes on to the same bits. After a character or a prop was
/// removed, step once before saving: until then the rigid-body library keeps some of it where it does not serialise it.
///
/// A checksum, such as that of [`FrameKind`](sinew_snapshot::FrameKind), does not authenticate: who forges bytes can make a state in
/// which the next step panics or worse. Restore what your own program has saved.
///
/// ```
/// # use sinew_world::{Form, Motion, PropSpec, Solid, World, WorldSettings};
/// # use glam::DVec3;
/// use sinew_snapshot::{FrameKind, SnapshotError};
/// const KIND: FrameKind = FrameKind { magic: *b"TEST", version: 1 };
/// let new = || {
///     let mut world = World::new(WorldSettings::default());
///     let ball = Solid::new(Form::Ball { radius_m: 0.1 });
///     world.add_prop(PropSpec::new(ball, Motion::Dynamic { mass_kg: 1.0 }, DVec3::Y)).map(|_| world)
/// };
/// let mut world = new()?;
/// (0..100).for_each(|_| world.step());
/// let bytes = KIND.save(&world);
///
/// let mut other = new()?;
/// KIND.restore(&mut other, &bytes)?;
/// (0..100).for_each(|_| world.step());
/// (0..100).for_each(|_| other.step());
/// assert_eq!(world.frame(), other.frame());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
impl Snapshot for World {
    fn save(&self, to: &mut Writer) {
        // Who is there stands first: the rest can only be read into the same.
        self.characters.save_places(to);
        self.props.save_places(to);
        self.prop_joints.save_places(to);
        for (_, character) in self.characters.iter() {
            character.save_shapes(to);
        }
        self.save_engine(to);
        for (_, character) in self.characters.iter() {
            to.section();
            character.save(to);
        }
        to.section();
        self.props.iter().for_each(|(_, prop)| prop.save(to));
        self.prop_joints.iter().for_each(|(_, joint)| joint.save(to));
        self.attachments.save(to);
        self.broken_holds.save(to);
        to.section();
        self.save_frame(to);
        self.stale_calls.save(to);
    }

    fn restore(&mut self, from: &mut Reader<'_>) -> Result<(), SnapshotError> {
        self.characters.restore_places(from)?;
        self.props.restore_places(from)?;
        self.prop_joints.restore_places(from)?;
        for character in self.characters.values_mut() {
            character.restore_shapes(from)?;
        }
        self.restore_engine(from)?;
        self.characters.values_mut().try_for_each(|character| character.restore(from))?;
        self.props.values_mut().try_for_each(|prop| prop.restore(from))?;
        self.prop_joints.values_mut().try_for_each(|joint| joint.restore(from))?;
        self.attachments.restore(from)?;
        self.broken_holds.restore(from)?;
        self.restore_frame(from)?;
        self.stale_calls.restore(from)?;
        self.check()
    }
}

impl World {
    fn save_engine(&self, to: &mut Writer) {
        let Engine { bodies, colliders, joints, islands, broad_phase, narrow_phase, .. } = &self.engine;
        to.length(colliders.len());
        colliders.iter().for_each(|(handle, _)| handle.save_to(to));
        // The joints of a character that is awake are written anew before the next step.
        let awake = self.characters.iter().filter(|(id, _)| !self.is_asleep(*id));
        let rewritten: BTreeSet<(u32, u32)> =
            awake.flat_map(|(_, one)| one.joints).map(ImpulseJointHandle::into_raw_parts).collect();
        let rewritten: Vec<bool> =
            joints.iter().map(|(handle, _)| rewritten.contains(&handle.into_raw_parts())).collect();
        let mut poses = colliders.iter().map(|(handle, _)| self.expected_pose(handle, bodies).unwrap_or_default());
        let none = LeftOut::default;
        // What the library serialises has lengths and small enums, so saving it does not fail; what would be missing is an error
        // of restoring.
        let _ = section(bodies, LeftOut { has_bodies: true, ..none() }, to)
            .and_then(|()| section(colliders, LeftOut { poses: Some(&mut poses), ..none() }, to))
            .and_then(|()| section(joints, LeftOut { rewritten_joints: &rewritten, ..none() }, to))
            .and_then(|()| section(islands, none(), to))
            .and_then(|()| section(broad_phase, none(), to))
            .and_then(|()| section(narrow_phase, none(), to));
        to.section();
        to.length(self.engine.removed_joints.len());
        self.engine.removed_joints.iter().for_each(|handle| handle.save_to(to));
        self.engine.collision_filter.save(to);
    }

    fn restore_engine(&mut self, from: &mut Reader<'_>) -> Result<(), SnapshotError> {
        let colliders: Vec<ColliderHandle> = handles(from)?;
        let shapes = colliders.iter().map(|handle| self.shape_of(*handle));
        let shapes = shapes.collect::<Option<Vec<SharedShape>>>();
        let shapes = shapes.ok_or_else(|| other("a collision shape is of something unknown"))?;
        let none = &mut Colliders { shapes: &mut std::iter::empty(), poses: &mut std::iter::empty() };
        let bodies: RigidBodySet = load(from, none)?;
        let mut poses = colliders.iter().map(|handle| self.expected_pose(*handle, &bodies).unwrap_or_default());
        let loaded: ColliderSet = load(from, &mut Colliders { shapes: &mut shapes.into_iter(), poses: &mut poses })?;
        if !loaded.iter().map(|(handle, _)| handle).eq(colliders.iter().copied()) {
            return Err(other("its collision shapes are not those of its colliders"));
        }
        let engine = &mut self.engine;
        (engine.bodies, engine.colliders) = (bodies, loaded);
        engine.joints = load(from, none)?;
        engine.islands = load(from, none)?;
        engine.broad_phase = load(from, none)?;
        engine.narrow_phase = load(from, none)?;
        // Which joints were added since the last step is not in the library's bytes. One that is looked at to change it is linked in
        // the next step; that changes nothing for those that are linked.
        drop(engine.joints.iter_mut());
        engine.forget_buffers();
        engine.removed_joints = handles(from)?;
        engine.collision_filter.restore(from)
    }

    /// Where a collider is when it is where its body is.
    fn expected_pose(&self, handle: ColliderHandle, bodies: &RigidBodySet) -> Option<Pose> {
        let on = |body: RigidBodyHandle, own: Pose| Some(*bodies.get(body)?.position() * own);
        for (_, character) in self.characters.iter() {
            if let Some(at) = character.colliders.iter().position(|own| *own == handle) {
                return on(character.bodies[at], character.solid_of(Node::ALL[at]).placement());
            }
            if let Some(extra) = character.extra_shapes.iter().find(|extra| extra.collider == handle) {
                return on(character.bodies[extra.node.index()], extra.solid.placement());
            }
        }
        let collider = self.engine.colliders.get(handle)?;
        on(collider.parent()?, *collider.position_wrt_parent()?)
    }

    /// Of a part in the frame only what differs from its body.
    fn save_frame(&self, to: &mut Writer) {
        let expected = self.expected_parts();
        self.frame.save(to);
        for (character, expected) in self.frame.characters.iter().zip(&expected) {
            for (part, expected) in character.parts.iter().zip(expected) {
                let is_expected = bits(part) == bits(expected);
                is_expected.save(to);
                if !is_expected {
                    part.save(to);
                }
            }
        }
    }

    fn restore_frame(&mut self, from: &mut Reader<'_>) -> Result<(), SnapshotError> {
        self.frame.restore(from)?;
        let expected = self.expected_parts();
        if self.frame.characters.len() != expected.len() {
            return Err(other("the frame has another number of characters"));
        }
        for (character, expected) in self.frame.characters.iter_mut().zip(&expected) {
            for (part, expected) in character.parts.iter_mut().zip(expected) {
                let mut is_expected = false;
                is_expected.restore(from)?;
                if is_expected {
                    *part = *expected;
                } else {
                    part.restore(from)?;
                }
            }
        }
        Ok(())
    }

    /// The parts in the frame as their bodies have them, by slot.
    fn expected_parts(&self) -> Vec<[BodyState; Node::COUNT]> {
        let parts = |slot: usize| {
            let one = self.characters.id_in(slot).and_then(|id| self.characters.get(id));
            let part = |at: usize| {
                let body = one.and_then(|one| Some((one, self.engine.bodies.get(one.bodies[at])?)));
                body.map_or(BodyState::REST, |(one, body)| part_state(body, one, Node::ALL[at]))
            };
            std::array::from_fn(part)
        };
        (0..self.characters.count()).map(parts).collect()
    }

    /// The shape of a collider: a character's parts may have others than when they were built.
    fn shape_of(&self, handle: ColliderHandle) -> Option<SharedShape> {
        for (_, character) in self.characters.iter() {
            if let Some(at) = character.colliders.iter().position(|own| *own == handle) {
                return character.solid_of(Node::ALL[at]).shape();
            }
            if let Some(extra) = character.extra_shapes.iter().find(|extra| extra.collider == handle) {
                return extra.solid.shape();
            }
        }
        self.engine.colliders.get(handle).map(|collider| collider.shared_shape().clone())
    }

    /// Whether all that is named is there.
    fn check(&self) -> Result<(), SnapshotError> {
        let bodies = &self.engine.bodies;
        let is_there = |entity: Entity| self.handle(entity).is_some_and(|handle| bodies.contains(handle));
        let characters = self.characters.iter().all(|(_, one)| {
            one.bodies.iter().all(|handle| bodies.contains(*handle))
                && one.colliders.iter().all(|handle| self.engine.colliders.contains(*handle))
        });
        let props = self.props.iter().all(|(_, prop)| bodies.contains(prop.handle));
        let held = self.attachments.iter().all(|attachment| {
            is_there(attachment.held.object) && is_there(Entity::Part(attachment.held.character, attachment.held.node))
        });
        let frame = self.frame.characters.len() == self.characters.count()
            && self
                .frame
                .character_ids
                .iter()
                .copied()
                .eq((0..self.characters.count()).map(|at| self.characters.id_in(at)))
            && self.frame.props.len() == self.props.count()
            && self.frame.prop_ids.iter().copied().eq((0..self.props.count()).map(|at| self.props.id_in(at)))
            && self.frame.contacts.iter().all(|contact| is_there(contact.a) && is_there(contact.b));
        if characters && props && held && frame && bodies.contains(self.engine.ground) {
            Ok(())
        } else {
            Err(other("it names a body that is not there"))
        }
    }
}

fn section<T: serde::Serialize>(set: &T, left_out: LeftOut<'_>, to: &mut Writer) -> Result<(), SnapshotError> {
    to.section();
    save(set, left_out, to)
}

fn bits(body: &BodyState) -> [u64; 16] {
    let BodyState { position, rotation, centre, velocity, angular_velocity } = body;
    let vectors = [position, centre, velocity, angular_velocity].map(|vector| vector.to_array().map(f64::to_bits));
    let rotation = rotation.to_array().map(f64::to_bits);
    let mut bits = vectors.iter().flatten().chain(&rotation);
    std::array::from_fn(|_| bits.next().copied().unwrap_or_default())
}

impl<I: SlotId, T> Slots<I, T> {
    fn save_places(&self, to: &mut Writer) {
        to.length(self.count());
        for (generation, is_vacant) in self.places() {
            generation.save(to);
            is_vacant.save(to);
        }
    }

    /// What is not there any more goes; what came later cannot be had.
    fn restore_places(&mut self, from: &mut Reader<'_>) -> Result<(), SnapshotError> {
        let count = from.length()?;
        if count != self.count() {
            return Err(other("another number of characters, props or joints was added"));
        }
        for slot in 0..count {
            let (mut generation, mut is_vacant) = (0_u32, false);
            generation.restore(from)?;
            is_vacant.restore(from)?;
            if !self.set_place(slot, generation, is_vacant) {
                return Err(other("a character, prop or joint was added later"));
            }
        }
        Ok(())
    }
}

fn other(what: &str) -> SnapshotError {
    SnapshotError::mismatch(what)
}

/// A handle of the library: index and generation.
pub(crate) trait Handle: Sized {
    fn parts(self) -> (u32, u32);
    fn of(index: u32, generation: u32) -> Self;

    fn save_to(self, to: &mut Writer) {
        self.parts().save(to);
    }
    fn restored(from: &mut Reader<'_>) -> Result<Self, SnapshotError> {
        let mut parts = (0, 0);
        parts.restore(from)?;
        Ok(Self::of(parts.0, parts.1))
    }
}

macro_rules! handle {
    ($($name:ident),*) => { $(
        impl Handle for $name {
            fn parts(self) -> (u32, u32) {
                self.into_raw_parts()
            }
            fn of(index: u32, generation: u32) -> $name {
                $name::from_raw_parts(index, generation)
            }
        }
    )* };
}

handle!(RigidBodyHandle, ColliderHandle, ImpulseJointHandle);

pub(crate) fn handles<T: Handle>(from: &mut Reader<'_>) -> Result<Vec<T>, SnapshotError> {
    (0..from.length()?).map(|_| T::restored(from)).collect()
}

snapshot!(Frame { step, time_secs, characters, character_ids, props, prop_ids, contacts } valid |frame| frame.step <= u64::MAX / 2);
// Its parts are kept by the world, which has their bodies.
snapshot!(CharacterFrame { centre_of_mass, centre_velocity, facing, support, external, was_reset } fixed { parts });
snapshot!(ExternalForces { pin, held });
snapshot!(ExternalForce { force, torque, power_w });
snapshot!(Contact { a, b, point, impulse, begins });
snapshot!(Held { character, node, object, soft, break_force_n });
snapshot!(enum Entity { 0: Floor, 1: Prop(prop), 2: Part(character, node) });
