//! Readback of the world into its [`Frame`], and reset of bodies that became invalid.

use crate::character::Character;
use crate::engine::untag;
use crate::frame::{BodyState, CharacterFrame, Contact, Entity};
use crate::sanitize::is_place;
use crate::{CharacterId, ExternalForces, PropId, World, ragdoll};
use glam::{DQuat, DVec3};
use rapier3d_f64::prelude::*;
use sinew_body::humanoid::{Node, keep_support_hull};

/// Buffers that a step reuses.
#[derive(Default)]
pub(crate) struct Readback {
    touching_before: Vec<(Entity, Entity)>,
    /// Support points of characters: character, point.
    standing: Vec<(CharacterId, DVec3)>,
    hull: Vec<DVec3>,
}

/// Minimum vertical component of a contact's normal for support \[1\].
const CARRYING: f64 = 0.5;

impl World {
    /// Reads the frame.
    pub(crate) fn read_back(&mut self) {
        for slot in 0..self.characters.count() {
            self.characters.id_in(slot).inspect(|&id| self.read_back_character(id));
        }
        for slot in 0..self.props.count() {
            self.props.id_in(slot).inspect(|&id| self.read_back_prop(id));
        }
        self.read_back_contacts();
        for slot in 0..self.characters.count() {
            self.characters.id_in(slot).inspect(|&id| self.meter(id));
        }
    }

    pub(crate) fn read_back_character(&mut self, id: CharacterId) {
        let Some(character) = self.characters.get(id) else { return };
        let sound = character
            .bodies
            .iter()
            .all(|&handle| self.engine.bodies.get(handle).is_some_and(|body| body.is_enabled() && is_sound(body)));
        self.frame.characters[id.slot()].was_reset = !sound;
        if !sound {
            self.put_back(id);
        }
        let Some(character) = self.characters.get(id) else { return };
        let frame = &mut self.frame.characters[id.slot()];
        let (mut mass, mut moment, mut momentum) = (0.0, DVec3::ZERO, DVec3::ZERO);
        for node in Node::ALL {
            let Some(body) = self.engine.bodies.get(character.bodies[node.index()]) else { continue };
            let state = part_state(body, character, node);
            let part_mass = character.spec.body.link(node).mass_kg;
            mass += part_mass;
            moment += state.centre * part_mass;
            momentum += state.velocity * part_mass;
            frame.parts[node.index()] = state;
        }
        frame.centre_of_mass = moment / mass;
        frame.centre_velocity = momentum / mass;
        let forward = frame.parts[0].rotation * DVec3::Z;
        // Lying, the hips' z points up or down: the old facing is kept.
        let flat = DVec3::new(forward.x, 0.0, forward.z);
        if flat.length() > 0.3 {
            frame.facing = flat.normalize();
        }
    }

    /// The last valid pose of every part, at rest.
    fn put_back(&mut self, id: CharacterId) {
        let Some(character) = self.characters.get_mut(id) else { return };
        character.warm_starts = Default::default();
        let known = self.frame.step > 0 && self.frame.characters[id.slot()].parts[0] != BodyState::REST;
        let start = character.spec.pose.positions(character.body());
        for node in Node::ALL {
            let Some(body) = self.engine.bodies.get_mut(character.bodies[node.index()]) else { continue };
            let part = &self.frame.characters[id.slot()].parts[node.index()];
            let (position, rotation) = if known {
                (part.position, part.rotation)
            } else {
                (start[node.index()], character.spec.pose.world[node.index()])
            };
            body.set_enabled(true);
            body.set_position(Pose::from_parts(position, rotation), true);
            body.set_linvel(DVec3::ZERO, true);
            body.set_angvel(DVec3::ZERO, true);
        }
    }

    pub(crate) fn read_back_prop(&mut self, id: PropId) {
        let Some(prop) = self.props.get(id) else { return };
        let Some(body) = self.engine.bodies.get_mut(prop.handle) else { return };
        if !(body.is_enabled() && is_sound(body)) {
            let before = self.frame.props[id.slot()];
            let known = self.frame.step > 0;
            let spec = &prop.spec;
            let place = if known { (before.position, before.rotation) } else { (spec.position, spec.rotation) };
            body.set_enabled(true);
            body.set_position(Pose::from_parts(place.0, place.1), true);
            body.set_linvel(DVec3::ZERO, true);
            body.set_angvel(DVec3::ZERO, true);
        }
        self.frame.props[id.slot()] = state_of(body);
    }

    fn read_back_contacts(&mut self) {
        let contacts = &mut self.frame.contacts;
        self.readback.touching_before.clear();
        self.readback.touching_before.extend(contacts.iter().map(|contact| (contact.a, contact.b)));
        contacts.clear();
        self.readback.standing.clear();
        let entity = |handle: ColliderHandle| untag(self.engine.colliders.get(handle)?.user_data);
        for pair in self.engine.narrow_phase.contact_pairs() {
            if !pair.has_any_active_contact() {
                continue;
            }
            let (Some(first), Some(second)) = (entity(pair.collider1), entity(pair.collider2)) else { continue };
            let Some(collider) = self.engine.colliders.get(pair.collider1) else { continue };
            let (mut sum, mut count) = (DVec3::ZERO, 0.0);
            for manifold in pair.manifolds() {
                let upright = manifold.data.normal.y;
                let place = match manifold.subshape_pos1() {
                    Some(piece) => *collider.position() * *piece,
                    None => *collider.position(),
                };
                for point in &manifold.points {
                    // A fast body is stopped in the step before it touches: its impulse counts from any distance.
                    if point.dist > NEAR_M && point.data.impulse <= 0.0 {
                        continue;
                    }
                    let world = place.transform_point(point.local_p1);
                    sum += world;
                    count += 1.0;
                    // The normal points from the first to the second.
                    match (first, second) {
                        (Entity::Part(one, _), Entity::Part(other, _)) if one == other => {}
                        (_, Entity::Part(character, _)) if upright > CARRYING => {
                            self.readback.standing.push((character, world));
                        }
                        (Entity::Part(character, _), _) if upright < -CARRYING => {
                            self.readback.standing.push((character, world));
                        }
                        _ => {}
                    }
                }
            }
            if count == 0.0 {
                continue;
            }
            let impulse = pair.total_impulse();
            let (a, b, impulse) = if first <= second { (first, second, impulse) } else { (second, first, -impulse) };
            contacts.push(Contact { a, b, point: sum / count, impulse, begins: false });
        }
        for (one, other, touching) in self.engine.narrow_phase.intersection_pairs() {
            let (Some(one), Some(other)) = (entity(one), entity(other)) else { continue };
            if touching {
                let (a, b) = if one <= other { (one, other) } else { (other, one) };
                let place = |entity: Entity| match entity {
                    Entity::Floor => DVec3::ZERO,
                    Entity::Prop(prop) => self.frame.props.get(prop.slot()).map_or(DVec3::ZERO, |body| body.position),
                    Entity::Part(character, node) => {
                        self.frame.characters.get(character.slot()).map_or(DVec3::ZERO, |one| one.part(node).position)
                    }
                };
                contacts.push(Contact { a, b, point: place(b), impulse: DVec3::ZERO, begins: false });
            }
        }
        contacts.sort_by(|x, y| (x.a, x.b).cmp(&(y.a, y.b)).then(x.point.x.total_cmp(&y.point.x)));
        for contact in contacts.iter_mut() {
            contact.begins = self.readback.touching_before.binary_search(&(contact.a, contact.b)).is_err();
        }
        for (slot, character) in self.frame.characters.iter_mut().enumerate() {
            character.support.clear();
            let points =
                self.readback.standing.iter().filter(|(owner, _)| owner.slot() == slot).map(|(_, point)| *point);
            character.support.extend(points);
            keep_support_hull(&mut character.support, &mut self.readback.hull);
        }
    }

    /// The hash of its [`crate::Frame`].
    pub fn hash(&self) -> u64 {
        self.frame.hash()
    }

    /// The largest gap between two parts at their joint, over all characters \[m\].
    pub fn largest_joint_gap_m(&self) -> f64 {
        let gap = |(id, character)| {
            let (id, body): (CharacterId, _) = (id, Character::body(character));
            let parts = &self.frame.characters[id.slot()].parts;
            Node::ALL.into_iter().filter_map(move |node| {
                let parent = &parts[node.parent()?.index()];
                let joint = parent.position + parent.rotation * body.link(node).offset;
                Some((joint - parts[node.index()].position).length())
            })
        };
        self.characters.iter().flat_map(gap).fold(0.0, f64::max)
    }

    /// Kinetic and potential energy of a character, heights from the floor \[J\].
    pub fn energy_j(&self, character: CharacterId) -> f64 {
        let (Some(one), Some(frame)) = (self.characters.get(character), self.frame.character(character)) else {
            return 0.0;
        };
        let gravity = -self.engine.gravity.y;
        Node::ALL
            .into_iter()
            .filter_map(|node| {
                let body = self.engine.bodies.get(one.bodies[node.index()])?;
                let mass = one.body().link(node).mass_kg;
                let (part, inertia) = (frame.part(node), ragdoll::part_inertia(one.body(), node));
                let spin = part.rotation.conjugate() * body.angvel();
                let kinetic = 0.5 * (mass * body.linvel().length_squared() + (spin * spin).dot(inertia));
                Some(kinetic + mass * gravity * one.gravity_scales[node.index()] * part.centre.y)
            })
            .sum()
    }

    /// Whether all parts of a character sleep.
    pub fn is_asleep(&self, character: CharacterId) -> bool {
        self.characters.get(character).is_some_and(|one| {
            one.bodies.iter().all(|&handle| self.engine.bodies.get(handle).is_some_and(RigidBody::is_sleeping))
        })
    }

    /// Moments of inertia of a part about its centre of mass, along its axes, as the world uses them \[kg m²\].
    pub fn part_inertia(&self, character: CharacterId, node: Node) -> DVec3 {
        self.body(character).map_or(DVec3::ZERO, |body| ragdoll::part_inertia(body, node))
    }

    /// Outboard moment of inertia about a joint, standing \[kg m²\].
    pub fn outboard_inertia(&self, character: CharacterId, node: Node) -> f64 {
        self.characters.get(character).map_or_else(
            || ragdoll::outboard_inertias(&sinew_body::humanoid::Body::standard(80.0, 1.7))[node.index()],
            |one| one.outboard[node.index()],
        )
    }
}

/// Points farther apart than this and without an impulse do not count as contact \[m\].
const NEAR_M: f64 = 0.004;

impl CharacterFrame {
    /// A character before its first readback: at rest at the origin.
    pub const EMPTY: CharacterFrame = CharacterFrame {
        parts: [BodyState::REST; Node::COUNT],
        centre_of_mass: DVec3::ZERO,
        centre_velocity: DVec3::ZERO,
        facing: DVec3::Z,
        support: Vec::new(),
        external: [ExternalForces::NONE; Node::COUNT],
        was_reset: false,
    };
}

/// A part as its body has it.
pub(crate) fn part_state(body: &RigidBody, character: &Character, node: Node) -> BodyState {
    let state = state_of(body);
    // Before its first step the library has not computed a body's centre of mass.
    BodyState { centre: state.position + state.rotation * character.spec.body.link(node).centre, ..state }
}

fn state_of(body: &RigidBody) -> BodyState {
    BodyState {
        position: body.translation(),
        rotation: *body.rotation(),
        centre: body.center_of_mass(),
        velocity: body.linvel(),
        angular_velocity: body.angvel(),
    }
}

fn is_sound(body: &RigidBody) -> bool {
    let rotation: DQuat = *body.rotation();
    is_place(body.translation()) && rotation.is_finite() && body.linvel().is_finite() && body.angvel().is_finite()
}
