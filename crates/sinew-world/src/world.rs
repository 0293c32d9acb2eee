//! The world: add bodies, step, read the [`Frame`].

use crate::attachment::Attachment;
use crate::character::{Character, Hold};
use crate::engine::{Engine, tag};
use crate::prop::Prop;
use crate::prop_joint::PropJoint;
use crate::readback::Readback;
use crate::slots::Slots;
use crate::{
    CharacterId, CharacterSpec, Drive, Entity, Frame, Held, Motion, Pin, PropId, PropJointId, PropSpec, SpecError,
    WorldSettings, ragdoll, sanitize, sliding,
};
use glam::{DQuat, DVec3};
use rapier3d_f64::prelude::*;
use sinew_body::humanoid::{Body, Node};

/// A rigid-body world.
///
/// Characters, props and the joints of props are addressed by the ids that adding them returned ([`CharacterId`], [`PropId`],
/// [`PropJointId`]).
///
/// **Stale ids.** An id whose thing was removed, or that never was in this world, is an error ([`SpecError::StaleCharacter`] and its
/// kin) wherever a `Result` is returned. Calls that are made in every step (drives, pins, forces, motors) return none: with a stale id
/// they change nothing and are counted by [`World::stale_calls`]. What only reads answers with `None`, or with the neutral value
/// that it documents.
///
/// ```
/// use sinew_body::humanoid::{Body, Pose};
/// use sinew_world::{CharacterSpec, Surface, World, WorldSettings, hips_over_soles_m};
/// use glam::DVec3;
/// let mut world = World::new(WorldSettings::default());
/// let body = Body::standard(80.0, 1.7);
/// let mut pose = Pose::STANDING;
/// pose.hips_position.y = hips_over_soles_m(&body, &pose);
/// world.add_character(CharacterSpec { body, pose, velocity: DVec3::ZERO, surface: Surface::BODY })?;
/// for _ in 0..240 {
///     world.step();
/// }
/// // Nothing holds its joints: it has fallen.
/// assert!(world.frame().characters[0].parts[0].position.y < 0.5);
/// # Ok::<(), sinew_world::SpecError>(())
/// ```
pub struct World {
    pub(crate) settings: WorldSettings,
    pub(crate) engine: Engine,
    pub(crate) characters: Slots<CharacterId, Character>,
    pub(crate) props: Slots<PropId, Prop>,
    pub(crate) attachments: Vec<Attachment>,
    pub(crate) broken_holds: Vec<(Held, f64)>,
    pub(crate) prop_joints: Slots<PropJointId, PropJoint>,
    pub(crate) frame: Frame,
    pub(crate) readback: Readback,
    pub(crate) stale_calls: u64,
}

impl World {
    /// An empty world with its floor. Settings out of their bounds are brought into them.
    pub fn new(settings: WorldSettings) -> World {
        let settings = sanitize::settings(settings);
        World {
            settings,
            engine: Engine::new(&settings),
            characters: Slots::new(),
            props: Slots::new(),
            attachments: Vec::new(),
            broken_holds: Vec::new(),
            prop_joints: Slots::new(),
            frame: Frame::default(),
            readback: Readback::default(),
            stale_calls: 0,
        }
    }

    /// How it steps.
    pub fn settings(&self) -> &WorldSettings {
        &self.settings
    }

    /// Sets the number of threads, 1 to 64, and returns the number in use: always 1 without the feature `threads`.
    /// Results do not depend on it, bit for bit.
    pub fn set_threads(&mut self, threads: usize) -> usize {
        self.engine.set_threads(threads.clamp(1, 64))
    }

    /// Adds a ragdoll of a body; its joints are limp until they are driven. Returns its id.
    ///
    /// # Errors
    /// A position is not finite, or a part has no mass or size.
    pub fn add_character(&mut self, spec: CharacterSpec) -> Result<CharacterId, SpecError> {
        let character = ragdoll::build(&mut self.engine, &spec, self.characters.next_id())?;
        let id = self.characters.insert(character);
        self.engine.collision_filter.add_character(id);
        self.frame.add_character(id);
        self.read_back_character(id);
        Ok(id)
    }

    /// Adds a prop. Returns its id.
    ///
    /// # Errors
    /// A position is not finite, the shape is degenerate, or a dynamic prop is a triangle mesh.
    pub fn add_prop(&mut self, spec: PropSpec) -> Result<PropId, SpecError> {
        let prop = Prop::build(&mut self.engine, spec, self.props.next_id())?;
        let id = self.props.insert(prop);
        self.frame.add_prop(id);
        self.read_back_prop(id);
        Ok(id)
    }

    /// One physics step: passes springs and pins to the solver, moves everything, and updates the [`World::frame`].
    pub fn step(&mut self) {
        let step_secs = self.settings.step_secs();
        self.engine.remove_joints();
        for character in self.characters.values_mut() {
            character.prepare(&mut self.engine, step_secs);
        }
        for prop in self.props.values_mut() {
            prop.prepare(&mut self.engine, step_secs);
        }
        self.prepare_attachments();
        self.prepare_prop_joints();
        sliding::prepare(&mut self.engine, self.characters.values(), self.props.values());
        self.engine.step();
        self.forget_forces();
        self.break_attachments();
        self.break_prop_joints();
        self.frame.step += 1;
        self.frame.time_secs = self.frame.step as f64 * step_secs;
        self.read_back();
    }

    /// How many calls that change something were made with a stale id, since the world was made. In a program without a fault: 0.
    pub fn stale_calls(&self) -> u64 {
        self.stale_calls
    }

    pub(crate) fn count_stale(&mut self) {
        self.stale_calls += 1;
    }

    /// The state of the world after the last step.
    pub fn frame(&self) -> &Frame {
        &self.frame
    }

    /// A character's body.
    pub fn body(&self, character: CharacterId) -> Option<&Body> {
        Some(self.characters.get(character)?.body())
    }

    /// Outboard moments of inertia about each joint of a character, standing \[kg m²\]; by [`Node::index`].
    pub fn outboard_inertias(&self, character: CharacterId) -> Option<&[f64; Node::COUNT]> {
        Some(&self.characters.get(character)?.outboard)
    }

    /// Sets the drive of a joint. Takes effect in the next step and stays until it is changed. With numbers that are
    /// not finite, or negative gains, the joint becomes limp.
    pub fn set_drive(&mut self, character: CharacterId, node: Node, drive: Drive) {
        let Some(character) = self.characters.get_mut(character) else { return self.count_stale() };
        let outboard = character.outboard[node.index()];
        let drive = sanitize::drive(drive).unwrap_or(Drive::limp(ragdoll::LIMP_DAMPING * outboard));
        if drive != character.drives[node.index()] {
            character.drives[node.index()] = drive;
            character.hold_changed(&mut self.engine);
        }
    }

    /// Makes a character limp: removes all drives and pins.
    pub fn set_limp(&mut self, character: CharacterId) {
        let Some(character) = self.characters.get_mut(character) else { return self.count_stale() };
        for at in 0..Node::COUNT {
            character.drives[at] = Drive::limp(ragdoll::LIMP_DAMPING * character.outboard[at]);
            character.pins[at] = None;
        }
        character.hold_changed(&mut self.engine);
    }

    /// Sets the pin of a part, or removes it with `None`. Takes effect in the next step.
    pub fn set_pin(&mut self, character: CharacterId, node: Node, pin: Option<Pin>) {
        let Some(character) = self.characters.get_mut(character) else { return self.count_stale() };
        let pin = pin.and_then(sanitize::pin);
        if pin != character.pins[node.index()] {
            character.pins[node.index()] = pin;
            character.hold_changed(&mut self.engine);
        }
    }

    /// Moves a part kinematically to a pose by the end of the next step; it stays kinematic until [`World::set_forces`]
    /// frees it.
    pub fn move_part(&mut self, character: CharacterId, node: Node, position: DVec3, rotation: DQuat) {
        let Some(character) = self.characters.get_mut(character) else { return self.count_stale() };
        let Some(rotation) = sanitize::unit(rotation).filter(|_| sanitize::is_place(position)) else { return };
        character.holds[node.index()] = Hold::Told;
        if let Some(body) = self.engine.bodies.get_mut(character.bodies[node.index()]) {
            if body.body_type() != RigidBodyType::KinematicPositionBased {
                body.set_body_type(RigidBodyType::KinematicPositionBased, true);
            }
            body.set_next_kinematic_position(Pose::from_parts(position, rotation));
        }
    }

    /// Switches physics of a part off (it drifts with a velocity that decays) or on again (Shapiro et al. 2007, section
    /// 4.1).
    pub fn set_forces(&mut self, character: CharacterId, node: Node, on: bool) {
        let Some(character) = self.characters.get_mut(character) else { return self.count_stale() };
        character.holds[node.index()] = if on { Hold::Free } else { Hold::Drifting };
        let kind = if on { RigidBodyType::Dynamic } else { RigidBodyType::KinematicVelocityBased };
        if let Some(body) = self.engine.bodies.get_mut(character.bodies[node.index()])
            && body.body_type() != kind
        {
            body.set_body_type(kind, true);
        }
    }

    /// Whether forces on a part are on, as [`World::set_forces`] switches them.
    pub fn has_forces(&self, character: CharacterId, node: Node) -> bool {
        let Some(character) = self.characters.get(character) else { return false };
        !matches!(character.holds[node.index()], Hold::Drifting)
    }

    /// A force on a part in the next step only \[N\], at a point of the world or at its centre of mass.
    pub fn push_part(&mut self, character: CharacterId, node: Node, force: DVec3, point: Option<DVec3>) {
        let Some(character) = self.characters.get_mut(character) else { return self.count_stale() };
        let handle = character.bodies[node.index()];
        character.pushes[0][node.index()] += sanitize::force(force).unwrap_or(DVec3::ZERO);
        self.push_body(handle, force, point);
    }

    /// Sum of the forces of [`World::push_part`] in the last step on each part of a character \[N\]; by
    /// [`Node::index`].
    pub fn pushes(&self, character: CharacterId) -> Option<&[DVec3; Node::COUNT]> {
        Some(&self.characters.get(character)?.pushes[1])
    }

    /// Takes a part's pushes of the next step off its rigid body, and returns their force \[N\] and their moment about the part's centre
    /// of mass \[N m\], world axes; `None` without any. For a tracker that answers pushes itself. [`World::pushes`] counts them
    /// all the same.
    pub fn take_push(&mut self, character: CharacterId, node: Node) -> Option<(DVec3, DVec3)> {
        let handle = self.characters.get(character)?.bodies[node.index()];
        let is_pushed = |body: &RigidBody| body.user_force() != DVec3::ZERO || body.user_torque() != DVec3::ZERO;
        // Mutable access marks a body as changed in the library.
        self.engine.bodies.get(handle).filter(|body| is_pushed(body))?;
        let body = self.engine.bodies.get_mut(handle)?;
        let push = (body.user_force(), body.user_torque());
        body.reset_forces(false);
        body.reset_torques(false);
        Some(push)
    }

    /// A force on a prop in the next step only \[N\], at a point of the world or at its centre of mass.
    pub fn push_prop(&mut self, prop: PropId, force: DVec3, point: Option<DVec3>) {
        let Some(prop) = self.props.get(prop) else { return self.count_stale() };
        let handle = prop.handle;
        self.push_body(handle, force, point);
    }

    fn push_body(&mut self, handle: RigidBodyHandle, force: DVec3, point: Option<DVec3>) {
        if let Some(body) = self.engine.bodies.get_mut(handle)
            && let Some(force) = sanitize::force(force)
        {
            let point = point.filter(|&point| sanitize::is_place(point)).unwrap_or_else(|| body.center_of_mass());
            body.add_force_at_point(force, point, true);
        }
    }

    fn forget_forces(&mut self) {
        for character in self.characters.values_mut() {
            character.pushes = [[DVec3::ZERO; Node::COUNT], character.pushes[0]];
        }
        let parts = self.characters.iter().flat_map(|(_, character)| character.bodies);
        let props = self.props.iter().map(|(_, prop)| prop.handle);
        for handle in parts.chain(props) {
            // Mutable access marks a body as changed in the library.
            let pushed = |body: &RigidBody| body.user_force() != DVec3::ZERO || body.user_torque() != DVec3::ZERO;
            if self.engine.bodies.get(handle).is_some_and(pushed)
                && let Some(body) = self.engine.bodies.get_mut(handle)
            {
                body.reset_forces(false);
                body.reset_torques(false);
            }
        }
    }

    /// Gravity of the world, as [`WorldSettings::gravity_m_s2`], from the next step on. Wakes everything. Ignored when not finite.
    pub fn set_world_gravity(&mut self, gravity_m_s2: f64) {
        if !gravity_m_s2.is_finite() {
            return;
        }
        self.settings = sanitize::settings(WorldSettings { gravity_m_s2, ..self.settings });
        self.engine.gravity = DVec3::new(0.0, -self.settings.gravity_m_s2, 0.0);
        for (_, body) in self.engine.bodies.iter_mut() {
            body.wake_up(true);
        }
    }

    /// Factor on gravity for all parts of a character.
    pub fn set_gravity(&mut self, character: CharacterId, scale: f64) {
        if self.characters.get(character).is_none() {
            return self.count_stale();
        }
        for node in Node::ALL {
            self.set_part_gravity(character, node, scale);
        }
    }

    /// Factor on gravity for one part of a character.
    pub fn set_part_gravity(&mut self, character: CharacterId, node: Node, scale: f64) {
        let Some(character) = self.characters.get_mut(character) else { return self.count_stale() };
        let Some(scale) = sanitize::gravity_scale(scale) else { return };
        character.gravity_scales[node.index()] = scale;
        if let Some(body) = self.engine.bodies.get_mut(character.bodies[node.index()]) {
            body.set_gravity_scale(scale, true);
        }
    }

    /// Factor on gravity for a part of a character, as it is now.
    pub fn part_gravity(&self, character: CharacterId, node: Node) -> f64 {
        self.characters.get(character).map_or(1.0, |one| one.gravity_scales[node.index()])
    }

    /// Factor on gravity for a prop, as it is now.
    pub fn prop_gravity(&self, prop: PropId) -> f64 {
        let body = self.props.get(prop).and_then(|prop| self.engine.bodies.get(prop.handle));
        body.map_or(1.0, RigidBody::gravity_scale)
    }

    /// Gives a part another collision shape, its own again with `own`, or none at all. Its mass stays; its inertia is
    /// that of the mass spread over the shape, if that is more than its own: with the inertia of a foot alone the ends
    /// of a long ski would sink into the ground.
    ///
    /// # Errors
    /// The shape is degenerate.
    pub fn set_shape(&mut self, character: CharacterId, node: Node, shape: PartShape) -> Result<(), SpecError> {
        let Some(one) = self.characters.get_mut(character) else { return Err(SpecError::StaleCharacter(character)) };
        let own = ragdoll::part_solid(one.body(), node);
        let handle = one.colliders[node.index()];
        let Some(collider) = self.engine.colliders.get_mut(handle) else { return Ok(()) };
        let solid = match &shape {
            PartShape::Own => Some(&own),
            PartShape::Other(solid) => Some(solid),
            PartShape::None => None,
        };
        let other = match &shape {
            PartShape::Other(solid) => Some(solid.clone()),
            PartShape::Own => None,
            // The collider keeps the shape that it has.
            PartShape::None => one.solids[node.index()].take(),
        };
        let form = solid.map(|solid| solid.shape().ok_or(SpecError::NoShape)).transpose()?;
        collider.set_enabled(solid.is_some());
        let mut inertia = ragdoll::part_inertia(one.body(), node);
        let link = *one.body().link(node);
        if let (Some(solid), Some(form)) = (solid, form) {
            if let PartShape::Other(_) = shape {
                inertia =
                    inertia.max(spread_inertia(&form.compute_aabb(&solid.placement()), link.centre, link.mass_kg));
            }
            collider.set_shape(form);
            collider.set_position_wrt_parent(solid.placement());
            collider.user_data = tag(Entity::Part(character, node));
        }
        one.solids[node.index()] = other;
        if let Some(body) = self.engine.bodies.get_mut(one.bodies[node.index()]) {
            body.set_additional_mass_properties(MassProperties::new(link.centre, link.mass_kg, inertia), true);
        }
        Ok(())
    }

    /// Adds an angular velocity of the whole character about its centre of mass, as if it were one rigid body
    /// \[rad/s\].
    pub fn spin_character(&mut self, character: CharacterId, spin: DVec3) {
        let (Some(one), Some(frame)) = (self.characters.get(character), self.frame.character(character)) else {
            return self.count_stale();
        };
        let Some(spin) = sanitize::spin(spin) else { return };
        for node in Node::ALL {
            if let Some(body) = self.engine.bodies.get_mut(one.bodies[node.index()]) {
                let arm = frame.part(node).centre - frame.centre_of_mass;
                body.set_linvel(body.linvel() + spin.cross(arm), true);
                body.set_angvel(body.angvel() + spin, true);
            }
        }
        self.read_back_character(character);
    }

    /// Gives every part of a character its velocity and angular velocity \[m/s, rad/s\]; by [`Node::index`]. Values
    /// that are not finite are ignored.
    pub fn set_velocities(&mut self, character: CharacterId, velocities: &[(DVec3, DVec3); Node::COUNT]) {
        let Some(one) = self.characters.get(character) else { return self.count_stale() };
        for (handle, (velocity, spin)) in one.bodies.into_iter().zip(velocities) {
            let (Some(velocity), Some(spin)) = (sanitize::velocity(*velocity), sanitize::spin(*spin)) else { continue };
            if let Some(body) = self.engine.bodies.get_mut(handle) {
                body.set_linvel(velocity, true);
                body.set_angvel(spin, true);
            }
        }
        self.read_back_character(character);
    }

    /// Sets a prop's position or velocity.
    pub fn place_prop(&mut self, prop: PropId, position: Option<DVec3>, velocity: Option<DVec3>) {
        let Some(prop) = self.props.get_mut(prop) else { return self.count_stale() };
        if let Some(body) = self.engine.bodies.get_mut(prop.handle) {
            if let Some(position) = position.filter(|&place| sanitize::is_place(place)) {
                body.set_translation(position, true);
            }
            if let Some(velocity) = velocity.and_then(sanitize::velocity) {
                body.set_linvel(velocity, true);
            }
        }
    }

    /// Sets the acceleration of a moving (kinematic) prop \[m/s²\]; zero keeps its speed.
    pub fn accelerate_prop(&mut self, prop: PropId, acceleration: DVec3) {
        let Some(prop) = self.props.get_mut(prop) else { return self.count_stale() };
        if prop.spec.motion == Motion::Moving
            && let Some(acceleration) = sanitize::force(acceleration)
        {
            prop.acceleration = acceleration;
        }
    }

    /// Factor on gravity for a prop.
    pub fn set_prop_gravity(&mut self, prop: PropId, scale: f64) {
        let Some(prop) = self.props.get(prop) else { return self.count_stale() };
        if let Some(scale) = sanitize::gravity_scale(scale)
            && let Some(body) = self.engine.bodies.get_mut(prop.handle)
        {
            body.set_gravity_scale(scale, true);
        }
    }
}

/// Moments of inertia about a point of a mass that fills a box, along its axes \[kg m²\].
fn spread_inertia(bounds: &rapier3d_f64::parry::bounding_volume::Aabb, about: DVec3, mass_kg: f64) -> DVec3 {
    let (size, arm) = (bounds.maxs - bounds.mins, (bounds.maxs + bounds.mins) / 2.0 - about);
    let square = size * size / 12.0 + arm * arm;
    DVec3::new(square.y + square.z, square.z + square.x, square.x + square.y) * mass_kg
}

/// Maximum force \[N\]; larger ones are clamped. Ten tonnes' weight: beyond it bodies tunnel through obstacles.
pub const MAX_FORCE_N: f64 = 1e5;

/// The collision shape of a part, for [`World::set_shape`].
#[derive(Clone, Debug, Default, PartialEq)]
pub enum PartShape {
    /// The body's own.
    #[default]
    Own,
    /// Another shape, in the part's frame.
    Other(crate::Solid),
    /// No shape: it passes through everything.
    None,
}

sinew_snapshot::snapshot!(enum PartShape { 0: Own, 1: Other(solid), 2: None });
