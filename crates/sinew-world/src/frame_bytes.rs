//! A [`Frame`] as bytes, every number with all its bits: for networks, files and programs in other languages.
//!
//! [`Frame::to_bytes`] and [`Frame::write`] write it, [`Frame::from_bytes`] reads it; what was read has the same
//! [`Frame::hash`]. Everything is little-endian and unpadded; all vectors are in world axes (right-handed, Y up).
//!
//! | offset \[bytes\] | type | content |
//! |---|---|---|
//! | 0 | 4 bytes | magic number `SNFR` |
//! | 4 | `u32` | version of this layout, [`VERSION`] |
//! | 8 | `u64` | [`Frame::step`] |
//! | 16 | `f64` | [`Frame::time_secs`] \[s\] |
//! | 24 | `u64` | [`Frame::hash`] as the sender computed it |
//! | 32 | `u16` | slots of characters, at most [`MAX_CHARACTERS`] |
//! | 34 | `u16` | slots of props, at most [`MAX_PROPS`] |
//! | 36 | `u16` | contacts, at most [`MAX_CONTACTS`] |
//! | 38 | | slots of characters, slots of props, contacts, one after another |
//! | length − 8 | `u64` | checksum: xxh3 of all bytes before, 64 bits |
//!
//! A slot, of a character or a prop:
//!
//! | type | content |
//! |---|---|
//! | `u8` | 0: vacant, and nothing more of this slot follows; 1: in use |
//! | `u32` | generation: how often the slot was used before |
//! | | the character, or the body of the prop |
//!
//! A body, 128 bytes:
//!
//! | offset \[bytes\] | type | content |
//! |---|---|---|
//! | 0 | 3 `f64` | [`BodyState::position`]: a part's joint to its parent, a prop's origin \[m\] |
//! | 24 | 4 `f64` | [`BodyState::rotation`], `world_from_body`: unit quaternion x, y, z, w |
//! | 56 | 3 `f64` | [`BodyState::centre`] of mass \[m\] |
//! | 80 | 3 `f64` | [`BodyState::velocity`] of the centre of mass \[m/s\] |
//! | 104 | 3 `f64` | [`BodyState::angular_velocity`] \[rad/s\] |
//!
//! A character, 2378 bytes and the corners:
//!
//! | offset \[bytes\] | type | content |
//! |---|---|---|
//! | 0 | 18 bodies | its parts by [`Node::index`] |
//! | 2304 | 3 `f64` | centre of mass of the whole body \[m\] |
//! | 2328 | 3 `f64` | its velocity \[m/s\] |
//! | 2352 | 3 `f64` | where it faces: horizontal unit vector |
//! | 2376 | `u8` | 1 when it became invalid in this step and was reset, otherwise 0 |
//! | 2377 | `u8` | corners of the support polygon |
//! | 2378 | 3 `f64` each | the corners, counter-clockwise seen from above \[m\] |
//!
//! A contact, 57 bytes:
//!
//! | offset \[bytes\] | type | content |
//! |---|---|---|
//! | 0 | entity | [`Contact::a`] |
//! | 4 | entity | [`Contact::b`] |
//! | 8 | 3 `f64` | [`Contact::point`] \[m\] |
//! | 32 | 3 `f64` | [`Contact::impulse`] on `b` in this step \[N s\] |
//! | 56 | `u8` | 1 when the pair did not touch in the previous step, otherwise 0 |
//!
//! An entity, 4 bytes: `u8` kind (0 the ground, 1 a prop, 2 a part of a character), `u16` slot, `u8` part by [`Node::index`];
//! what a kind does not have is 0.
//!
//! One number read by hand, the height of the hips of the character in the first slot: behind the header of 38 bytes
//! stand the slot's 5 bytes, then the x of its first body.
//!
//! ```
//! use sinew_world::{CharacterFrame, Frame};
//!
//! let mut character = CharacterFrame::EMPTY;
//! character.parts[0].position.y = 0.93;
//! let bytes = Frame::of(vec![character], Vec::new()).to_bytes();
//!
//! let at = 38 + 5 + 8;
//! let height_m = f64::from_le_bytes(bytes[at..at + 8].try_into()?);
//! assert_eq!(height_m, 0.93);
//! # Ok::<(), std::array::TryFromSliceError>(())
//! ```
//!
//! Not in the bytes: [`CharacterFrame::external`], which is zero in a frame that was read. Numbers are finite; bytes with a
//! NaN or an infinity are an error. The checksum finds accidents, it does not authenticate.

use crate::{BodyState, CharacterFrame, CharacterId, Contact, Entity, Frame, PropId};
use glam::DVec3;
use sinew_body::humanoid::Node;
use sinew_snapshot::{FrameKind, Reader, Snapshot, SnapshotError, Writer};

/// Version of the layout. Only this one is read.
pub const VERSION: u32 = 1;

/// Maximum number of slots of characters. What is in later slots is not written, nor are its contacts.
pub const MAX_CHARACTERS: usize = 1 << 10;

/// Maximum number of slots of props. What is in later slots is not written, nor are its contacts.
pub const MAX_PROPS: usize = 1 << 14;

/// Maximum number of contacts; of more only the first are written.
pub const MAX_CONTACTS: usize = 1 << 12;

/// Maximum number of corners of one support polygon; of more only the first are written.
pub const MAX_CORNERS: usize = 255;

/// What stands around the content.
const KIND: FrameKind = FrameKind { magic: *b"SNFR", version: VERSION };

sinew_snapshot::snapshot!(BodyState { position, rotation, centre, velocity, angular_velocity });

/// Why bytes are not a frame.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum FrameBytesError {
    /// The bytes begin with another magic number, or are shorter than the shortest frame.
    #[error("these bytes are no frame; write them with Frame::to_bytes")]
    NotAFrame,
    /// The frame is of another version of the layout.
    #[error("the frame has version {found}, this program reads version {expected}; use the same version on both sides")]
    Version {
        /// What the bytes say.
        found: u32,
        /// What this program writes and reads.
        expected: u32,
    },
    /// Bytes were changed, lost or added.
    #[error("the frame's checksum does not fit its content: bytes were changed, lost or added; send it again")]
    Corrupt,
    /// The bytes end before the frame is complete.
    #[error("the frame ends before it is complete; its sender is at fault")]
    TooShort,
    /// Bytes are left over behind the frame.
    #[error("the frame goes on for {bytes} bytes after its end; its sender is at fault")]
    TooLong {
        /// How many are left.
        bytes: usize,
    },
    /// More of something than is allowed.
    #[error("the frame has {count} {what}; the maximum is {maximum}")]
    TooMany {
        /// What there are too many of.
        what: &'static str,
        /// How many the bytes promise.
        count: usize,
        /// How many are allowed.
        maximum: usize,
    },
    /// A number is NaN or infinite.
    #[error("a number of a {what} in the frame is not finite; its sender is at fault")]
    NotFinite {
        /// Where it stands.
        what: &'static str,
    },
    /// A value that its type does not have, or a contact with something that is not there.
    #[error("the frame holds an invalid {what}; its sender is at fault")]
    Invalid {
        /// Which value.
        what: &'static str,
    },
}

impl From<SnapshotError> for FrameBytesError {
    fn from(error: SnapshotError) -> FrameBytesError {
        match error {
            SnapshotError::NotASnapshot => FrameBytesError::NotAFrame,
            SnapshotError::Version { found, expected } => FrameBytesError::Version { found, expected },
            SnapshotError::Corrupt => FrameBytesError::Corrupt,
            SnapshotError::TooShort { .. } => FrameBytesError::TooShort,
            SnapshotError::TooLong { bytes } => FrameBytesError::TooLong { bytes },
            SnapshotError::Invalid { what } => FrameBytesError::Invalid { what },
            _ => FrameBytesError::Invalid { what: "value" },
        }
    }
}

impl Frame {
    /// The frame as bytes; the [module](crate::frame_bytes) documents the layout.
    ///
    /// ```
    /// use sinew_world::Frame;
    /// let frame = Frame { step: 5, ..Frame::default() };
    /// assert_eq!(Frame::from_bytes(&frame.to_bytes())?, (frame.clone(), frame.hash()));
    /// # Ok::<(), sinew_world::frame_bytes::FrameBytesError>(())
    /// ```
    pub fn to_bytes(&self) -> Vec<u8> {
        let mut bytes = Vec::new();
        self.write(&mut bytes);
        bytes
    }

    /// As [`Frame::to_bytes`], into a buffer whose content is replaced: one that is large enough is written without
    /// allocation.
    ///
    /// ```
    /// use sinew_world::Frame;
    /// let mut buffer = Vec::new();
    /// for step in 0..3 {
    ///     Frame { step, ..Frame::default() }.write(&mut buffer);
    ///     assert_eq!(Frame::from_bytes(&buffer)?.0.step, step);
    /// }
    /// # Ok::<(), sinew_world::frame_bytes::FrameBytesError>(())
    /// ```
    pub fn write(&self, buffer: &mut Vec<u8>) {
        let to = &mut KIND.begin(std::mem::take(buffer));
        let characters = &self.characters[..self.characters.len().min(MAX_CHARACTERS)];
        let props = &self.props[..self.props.len().min(MAX_PROPS)];
        let contacts =
            self.contacts.iter().filter(|contact| self.has(contact.a) && self.has(contact.b)).take(MAX_CONTACTS);
        self.step.save(to);
        self.time_secs.save(to);
        self.hash().save(to);
        for count in [characters.len(), props.len(), contacts.clone().count()] {
            (count as u16).save(to);
        }
        for (slot, character) in characters.iter().enumerate() {
            let id = self.character_ids.get(slot).copied().flatten();
            if save_slot(id.map(CharacterId::generation), to) {
                save_character(character, to);
            }
        }
        for (slot, prop) in props.iter().enumerate() {
            let id = self.prop_ids.get(slot).copied().flatten();
            if save_slot(id.map(PropId::generation), to) {
                prop.save(to);
            }
        }
        for contact in contacts {
            to.bytes(&entity_bytes(contact.a));
            to.bytes(&entity_bytes(contact.b));
            contact.point.save(to);
            contact.impulse.save(to);
            contact.begins.save(to);
        }
        *buffer = FrameKind::finish(std::mem::take(to));
    }

    /// Reads a frame, and the hash that its sender computed of it: equal to [`Frame::hash`] of the frame unless machine or program
    /// are faulty. Any bytes may come; memory is at most 10 MB and three times their length.
    ///
    /// # Errors
    /// When the bytes are no frame; the [kind](FrameBytesError) says why.
    ///
    /// ```
    /// use sinew_world::{Frame, frame_bytes::FrameBytesError};
    /// let mut bytes = Frame::default().to_bytes();
    /// bytes[9] ^= 1;
    /// assert_eq!(Frame::from_bytes(&bytes), Err(FrameBytesError::Corrupt));
    /// ```
    pub fn from_bytes(bytes: &[u8]) -> Result<(Frame, u64), FrameBytesError> {
        let mut from = KIND.open(bytes)?;
        let mut frame = Frame { step: value(&mut from)?, time_secs: value(&mut from)?, ..Frame::default() };
        finite(frame.time_secs.is_finite(), "time")?;
        let hash = value(&mut from)?;
        let characters = count(&mut from, "slots of characters", MAX_CHARACTERS)?;
        let props = count(&mut from, "slots of props", MAX_PROPS)?;
        let contacts = count(&mut from, "contacts", MAX_CONTACTS)?;
        for slot in 0..characters {
            let generation = read_slot(&mut from)?;
            frame.character_ids.push(generation.map(|generation| CharacterId::new(slot, generation)));
            frame.characters.push(match generation {
                Some(_) => read_character(&mut from)?,
                None => CharacterFrame::EMPTY,
            });
        }
        for slot in 0..props {
            let generation = read_slot(&mut from)?;
            frame.prop_ids.push(generation.map(|generation| PropId::new(slot, generation)));
            frame.props.push(match generation {
                Some(_) => read_body(&mut from)?,
                None => BodyState::REST,
            });
        }
        frame.contacts.reserve(from.capacity::<Contact>(contacts));
        for _ in 0..contacts {
            let contact = Contact {
                a: frame.read_entity(&mut from)?,
                b: frame.read_entity(&mut from)?,
                point: read_vector(&mut from, "contact")?,
                impulse: read_vector(&mut from, "contact")?,
                begins: value(&mut from)?,
            };
            frame.contacts.push(contact);
        }
        from.end()?;
        Ok((frame, hash))
    }

    /// Whether something is there, in a slot that is written.
    fn has(&self, entity: Entity) -> bool {
        match entity {
            Entity::Floor => true,
            Entity::Prop(prop) => prop.slot() < MAX_PROPS && self.prop(prop).is_some(),
            Entity::Part(owner, _) => owner.slot() < MAX_CHARACTERS && self.character(owner).is_some(),
        }
    }

    fn read_entity(&self, from: &mut Reader<'_>) -> Result<Entity, FrameBytesError> {
        let bytes: [u8; 4] = from.array()?;
        let [kind, low, high, node] = bytes;
        let slot = usize::from(u16::from_le_bytes([low, high]));
        let owner = || self.character_ids.get(slot).copied().flatten();
        let entity = match kind {
            0 => Some(Entity::Floor),
            1 => self.prop_ids.get(slot).copied().flatten().map(Entity::Prop),
            2 => owner().and_then(|owner| Some(Entity::Part(owner, *Node::ALL.get(usize::from(node))?))),
            _ => None,
        };
        // The same entity has the same bytes: what a kind does not have is 0.
        entity
            .filter(|entity| entity_bytes(*entity) == bytes)
            .ok_or(FrameBytesError::Invalid { what: "entity of a contact" })
    }
}

/// Writes the beginning of a slot; whether something is in it.
fn save_slot(generation: Option<u32>, to: &mut Writer) -> bool {
    generation.is_some().save(to);
    generation.inspect(|generation| generation.save(to)).is_some()
}

fn read_slot(from: &mut Reader<'_>) -> Result<Option<u32>, SnapshotError> {
    if value(from)? { value(from).map(Some) } else { Ok(None) }
}

fn save_character(character: &CharacterFrame, to: &mut Writer) {
    character.parts.save(to);
    [character.centre_of_mass, character.centre_velocity, character.facing].save(to);
    character.was_reset.save(to);
    let corners = &character.support[..character.support.len().min(MAX_CORNERS)];
    to.byte(corners.len() as u8);
    corners.iter().for_each(|corner| corner.save(to));
}

fn read_character(from: &mut Reader<'_>) -> Result<CharacterFrame, FrameBytesError> {
    let mut character = CharacterFrame::EMPTY;
    for part in &mut character.parts {
        *part = read_body(from)?;
    }
    for vector in [&mut character.centre_of_mass, &mut character.centre_velocity, &mut character.facing] {
        *vector = read_vector(from, "character")?;
    }
    character.was_reset = value(from)?;
    for _ in 0..from.byte()? {
        character.support.push(read_vector(from, "corner")?);
    }
    Ok(character)
}

fn read_body(from: &mut Reader<'_>) -> Result<BodyState, FrameBytesError> {
    let mut body = BodyState::REST;
    body.restore(from)?;
    let vectors = [body.position, body.centre, body.velocity, body.angular_velocity];
    finite(body.rotation.is_finite() && vectors.iter().all(|vector| vector.is_finite()), "body")?;
    Ok(body)
}

fn read_vector(from: &mut Reader<'_>, what: &'static str) -> Result<DVec3, FrameBytesError> {
    let vector: DVec3 = value(from)?;
    finite(vector.is_finite(), what)?;
    Ok(vector)
}

fn entity_bytes(entity: Entity) -> [u8; 4] {
    let (kind, slot, node) = match entity {
        Entity::Floor => (0, 0, 0),
        Entity::Prop(prop) => (1, prop.slot(), 0),
        Entity::Part(owner, node) => (2, owner.slot(), node.index()),
    };
    let [low, high] = (slot as u16).to_le_bytes();
    [kind, low, high, node as u8]
}

fn count(from: &mut Reader<'_>, what: &'static str, maximum: usize) -> Result<usize, FrameBytesError> {
    let count = usize::from(value::<u16>(from)?);
    if count <= maximum { Ok(count) } else { Err(FrameBytesError::TooMany { what, count, maximum }) }
}

fn finite(is_finite: bool, what: &'static str) -> Result<(), FrameBytesError> {
    if is_finite { Ok(()) } else { Err(FrameBytesError::NotFinite { what }) }
}

fn value<T: Snapshot + Default>(from: &mut Reader<'_>) -> Result<T, SnapshotError> {
    let mut value = T::default();
    value.restore(from)?;
    Ok(value)
}
