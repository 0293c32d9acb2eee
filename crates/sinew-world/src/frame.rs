//! The state of a world after a step: everything that controllers read, files store and clients receive.

use crate::{CharacterId, ExternalForces, PropId};
use glam::{DQuat, DVec3};
use sinew_body::humanoid::{Node, Pose, support_margin_m};

/// A body that can have contacts.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Entity {
    /// The ground.
    #[default]
    Floor,
    /// A prop.
    Prop(PropId),
    /// A part of a character.
    Part(CharacterId, Node),
}

/// Pose and velocity of a rigid body, in world axes. Default [`BodyState::REST`].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct BodyState {
    /// A part's joint to its parent, a prop's origin \[m\].
    pub position: DVec3,
    /// `world_from_body`.
    pub rotation: DQuat,
    /// Centre of mass \[m\].
    pub centre: DVec3,
    /// Velocity of the centre of mass \[m/s\].
    pub velocity: DVec3,
    /// Angular velocity \[rad/s\].
    pub angular_velocity: DVec3,
}

/// A contact of two bodies.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Contact {
    /// The one with the smaller [`Entity`].
    pub a: Entity,
    /// The other.
    pub b: Entity,
    /// Where, the mean over the contact's points \[m\].
    pub point: DVec3,
    /// Impulse on `b` in this step, normal part \[N s\], world axes; `a` gets the opposite.
    pub impulse: DVec3,
    /// The contact is new: the pair did not touch in the previous step.
    pub begins: bool,
}

/// A character after a step.
#[derive(Clone, Debug, PartialEq)]
pub struct CharacterFrame {
    /// By [`Node::index`].
    pub parts: [BodyState; Node::COUNT],
    /// Centre of mass of the whole body \[m\].
    pub centre_of_mass: DVec3,
    /// Its velocity \[m/s\].
    pub centre_velocity: DVec3,
    /// Where the character faces: a horizontal unit vector.
    pub facing: DVec3,
    /// Corners of the support polygon on the ground, counter-clockwise seen from above; empty in the air \[m\].
    pub support: Vec<DVec3>,
    /// External forces on parts in this step, by pins and by other constraints to the world; by [`Node::index`].
    pub external: [ExternalForces; Node::COUNT],
    /// The body became invalid (not finite) in this step and was reset.
    pub was_reset: bool,
}

/// The world after a step.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct Frame {
    /// Physics steps done.
    pub step: u64,
    /// Time since the start \[s\].
    pub time_secs: f64,
    /// Characters by [`CharacterId::slot`]: in the order in which they were added, as long as none is removed. A vacant slot holds
    /// [`CharacterFrame::EMPTY`].
    pub characters: Vec<CharacterFrame>,
    /// Who is in each of these slots; `None` in a vacant one.
    pub character_ids: Vec<Option<CharacterId>>,
    /// Props by [`PropId::slot`]; a vacant slot holds [`BodyState::REST`].
    pub props: Vec<BodyState>,
    /// What is in each of these slots; `None` in a vacant one.
    pub prop_ids: Vec<Option<PropId>>,
    /// All contacts, in a fixed order.
    pub contacts: Vec<Contact>,
}

impl BodyState {
    /// At rest at the origin.
    pub const REST: BodyState = BodyState {
        position: DVec3::ZERO,
        rotation: DQuat::IDENTITY,
        centre: DVec3::ZERO,
        velocity: DVec3::ZERO,
        angular_velocity: DVec3::ZERO,
    };

    /// A point of the body's own frame in the world \[m\].
    pub fn point(&self, own: DVec3) -> DVec3 {
        self.position + self.rotation * own
    }

    /// Velocity of a point of the body \[m/s\].
    pub fn velocity_at(&self, point: DVec3) -> DVec3 {
        self.velocity + self.angular_velocity.cross(point - self.centre)
    }
}

/// [`CharacterFrame::EMPTY`].
impl Default for CharacterFrame {
    fn default() -> CharacterFrame {
        CharacterFrame::EMPTY
    }
}

impl CharacterFrame {
    /// One part.
    pub fn part(&self, node: Node) -> &BodyState {
        &self.parts[node.index()]
    }

    /// The pose of all parts.
    pub fn pose(&self) -> Pose {
        Pose { hips_position: self.parts[0].position, world: self.parts.map(|part| part.rotation) }
    }

    /// Stability margin: distance of the centre of mass inside the support polygon, seen from above \[m\]; negative
    /// outside, `None` in the air.
    pub fn support_margin_m(&self) -> Option<f64> {
        Some(support_margin_m(&self.support, self.centre_of_mass)).filter(|margin| margin.is_finite())
    }

    /// Horizontal unit vector to the character's left.
    pub fn left(&self) -> DVec3 {
        DVec3::Y.cross(self.facing)
    }
}

impl Frame {
    /// A frame of characters and props as those that were put first into their slots, with no contacts, at the start.
    pub fn of(characters: Vec<CharacterFrame>, props: Vec<BodyState>) -> Frame {
        Frame {
            character_ids: (0..characters.len()).map(|slot| Some(CharacterId::first_in(slot))).collect(),
            prop_ids: (0..props.len()).map(|slot| Some(PropId::first_in(slot))).collect(),
            characters,
            props,
            ..Frame::default()
        }
    }

    /// A character; `None` for a stale id.
    pub fn character(&self, id: CharacterId) -> Option<&CharacterFrame> {
        self.characters.get(id.slot()).filter(|_| self.character_ids.get(id.slot()) == Some(&Some(id)))
    }

    /// A prop; `None` for a stale id.
    pub fn prop(&self, id: PropId) -> Option<&BodyState> {
        self.props.get(id.slot()).filter(|_| self.prop_ids.get(id.slot()) == Some(&Some(id)))
    }

    /// Makes room for a character that was added.
    pub(crate) fn add_character(&mut self, id: CharacterId) {
        let slots = self.characters.len().max(id.slot() + 1);
        self.characters.resize(slots, CharacterFrame::EMPTY);
        self.character_ids.resize(slots, None);
        self.character_ids[id.slot()] = Some(id);
    }

    /// Makes room for a prop that was added.
    pub(crate) fn add_prop(&mut self, id: PropId) {
        let slots = self.props.len().max(id.slot() + 1);
        self.props.resize(slots, BodyState::REST);
        self.prop_ids.resize(slots, None);
        self.prop_ids[id.slot()] = Some(id);
    }

    /// A hash of the bits of every position and velocity: equal for equal worlds, on any machine. A client that
    /// receives the frame can compute it and compare it with others of the same [`Frame::step`].
    pub fn hash(&self) -> u64 {
        let mut hasher = xxhash_rust::xxh3::Xxh3::new();
        let parts = self.characters.iter().flat_map(|character| &character.parts);
        for body in parts.chain(&self.props) {
            let rotation = [body.rotation.x, body.rotation.y, body.rotation.z, body.rotation.w];
            let vectors = [body.position, body.velocity, body.angular_velocity];
            for number in vectors.iter().flat_map(|vector| vector.to_array()).chain(rotation) {
                hasher.update(&number.to_bits().to_le_bytes());
            }
        }
        // Only where slots are vacant or used again, so that all other worlds keep their hashes.
        let characters = self.character_ids.iter().map(|id| id.map(CharacterId::generation));
        let props = self.prop_ids.iter().map(|id| id.map(PropId::generation));
        if characters.clone().chain(props.clone()).any(|generation| generation != Some(0)) {
            for generation in characters.chain(props) {
                hasher.update(&generation.map_or(u64::MAX, u64::from).to_le_bytes());
            }
        }
        hasher.digest()
    }

    /// Contacts of a body.
    pub fn touching(&self, entity: Entity) -> impl Iterator<Item = &Contact> {
        self.contacts.iter().filter(move |contact| contact.a == entity || contact.b == entity)
    }

    /// Whether two things touch.
    pub fn are_touching(&self, one: Entity, other: Entity) -> bool {
        let (a, b) = if one <= other { (one, other) } else { (other, one) };
        self.contacts.iter().any(|contact| contact.a == a && contact.b == b)
    }
}
