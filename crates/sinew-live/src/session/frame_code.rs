//! Frames as bytes, every number with all its bits: the receiver computes the same [`Frame::hash`] as the sender.
//!
//! ```text
//! step u64, time f64, characters u16, props u16, contacts u16, hash u64, then
//! a character: 18 bodies, centre of mass, its velocity, facing: 3 f64 each, was_reset u8, corners u8, corners x 3 f64
//! a prop: a body
//! a body: position 3, rotation 4 (x, y, z, w), centre 3, velocity 3, angular velocity 3: f64
//! a contact: two entities (kind u8, index u16, node u8), point 3 f64, impulse 3 f64, begins u8
//! ```

use super::limits::{MAX_CHARACTERS, MAX_CONTACTS, MAX_CORNERS, MAX_PROPS};
use super::wire::{Malformed, Reader};
use glam::{DQuat, DVec3};
use sinew_body::humanoid::Node;
use sinew_world::{BodyState, CharacterFrame, CharacterId, Contact, Entity, Frame, PropId};

/// Bytes of a body, of a character without corners, of a contact.
const BODY: usize = 16 * 8;
const CHARACTER: usize = Node::COUNT * BODY + 9 * 8 + 2;
const CONTACT: usize = 2 * 4 + 6 * 8 + 1;

/// Writes a frame behind what is there already.
///
/// ```
/// use sinew_live::session::{decode_frame, encode_frame};
/// let frame = sinew_world::Frame { step: 5, ..Default::default() };
/// let mut bytes = Vec::new();
/// encode_frame(&frame, &mut bytes);
/// assert_eq!(decode_frame(&bytes)?, (frame.clone(), frame.hash()));
/// # Ok::<(), sinew_live::session::Malformed>(())
/// ```
pub fn encode_frame(frame: &Frame, out: &mut Vec<u8>) {
    let characters = &frame.characters[..frame.characters.len().min(MAX_CHARACTERS)];
    let props = &frame.props[..frame.props.len().min(MAX_PROPS)];
    let contacts = &frame.contacts[..frame.contacts.len().min(MAX_CONTACTS)];
    out.reserve(38 + characters.len() * (CHARACTER + 200) + props.len() * BODY + contacts.len() * CONTACT);
    out.extend(frame.step.to_le_bytes());
    out.extend(frame.time_secs.to_le_bytes());
    for count in [characters.len(), props.len(), contacts.len()] {
        out.extend((count as u16).to_le_bytes());
    }
    out.extend(frame.hash().to_le_bytes());
    for character in characters {
        for part in &character.parts {
            body(part, out);
        }
        for it in [character.centre_of_mass, character.centre_velocity, character.facing] {
            vector(it, out);
        }
        let corners = &character.support[..character.support.len().min(MAX_CORNERS)];
        out.push(u8::from(character.was_reset));
        out.push(corners.len() as u8);
        for corner in corners {
            vector(*corner, out);
        }
    }
    for prop in props {
        body(prop, out);
    }
    for contact in contacts {
        entity(contact.a, out);
        entity(contact.b, out);
        vector(contact.point, out);
        vector(contact.impulse, out);
        out.push(u8::from(contact.begins));
    }
}

/// Reads a frame and the hash that its sender computed of it. Any bytes may come.
///
/// # Errors
/// Bytes that are no frame.
pub fn decode_frame(bytes: &[u8]) -> Result<(Frame, u64), Malformed> {
    let mut from = Reader(bytes);
    let (step, time_secs) = (from.u64()?, from.f64()?);
    let characters = from.count(MAX_CHARACTERS)?;
    let props = from.count(MAX_PROPS)?;
    let contacts = from.count(MAX_CONTACTS)?;
    let hash = from.u64()?;
    if characters * CHARACTER + props * BODY + contacts * CONTACT > from.0.len() {
        return Err(Malformed("it counts more than it holds"));
    }
    let these = (0..characters).map(|_| read_character(&mut from)).collect::<Result<_, _>>()?;
    let those = (0..props).map(|_| read_body(&mut from)).collect::<Result<_, _>>()?;
    let mut frame = Frame { step, time_secs, ..Frame::of(these, those) };
    frame.contacts.reserve_exact(contacts);
    for _ in 0..contacts {
        let (a, b) = (read_entity(&mut from)?, read_entity(&mut from)?);
        let (point, impulse) = (read_vector(&mut from)?, read_vector(&mut from)?);
        for entity in [a, b] {
            let is_there = match entity {
                Entity::Floor => true,
                Entity::Prop(prop) => prop.slot() < props,
                Entity::Part(character, _) => character.slot() < characters,
            };
            if !is_there {
                return Err(Malformed("a contact is with something that is not there"));
            }
        }
        frame.contacts.push(Contact { a, b, point, impulse, begins: from.bool()? });
    }
    from.end()?;
    Ok((frame, hash))
}

fn read_character(from: &mut Reader) -> Result<CharacterFrame, Malformed> {
    let mut character = CharacterFrame::EMPTY;
    for part in &mut character.parts {
        *part = read_body(from)?;
    }
    character.centre_of_mass = read_vector(from)?;
    character.centre_velocity = read_vector(from)?;
    character.facing = read_vector(from)?;
    character.was_reset = from.bool()?;
    let corners = usize::from(from.u8()?);
    for _ in 0..corners {
        character.support.push(read_vector(from)?);
    }
    Ok(character)
}

fn vector(it: DVec3, out: &mut Vec<u8>) {
    for number in it.to_array() {
        out.extend(number.to_le_bytes());
    }
}

fn read_vector(from: &mut Reader) -> Result<DVec3, Malformed> {
    Ok(DVec3::new(from.f64()?, from.f64()?, from.f64()?))
}

fn body(it: &BodyState, out: &mut Vec<u8>) {
    vector(it.position, out);
    for number in it.rotation.to_array() {
        out.extend(number.to_le_bytes());
    }
    vector(it.centre, out);
    vector(it.velocity, out);
    vector(it.angular_velocity, out);
}

fn read_body(from: &mut Reader) -> Result<BodyState, Malformed> {
    Ok(BodyState {
        position: read_vector(from)?,
        rotation: DQuat::from_xyzw(from.f64()?, from.f64()?, from.f64()?, from.f64()?),
        centre: read_vector(from)?,
        velocity: read_vector(from)?,
        angular_velocity: read_vector(from)?,
    })
}

fn entity(it: Entity, out: &mut Vec<u8>) {
    let (kind, index, node) = match it {
        Entity::Floor => (0, 0, 0),
        Entity::Prop(prop) => (1, prop.slot(), 0),
        Entity::Part(character, node) => (2, character.slot(), node.index()),
    };
    out.push(kind);
    out.extend((index as u16).to_le_bytes());
    out.push(node as u8);
}

fn read_entity(from: &mut Reader) -> Result<Entity, Malformed> {
    let (kind, index, node) = (from.u8()?, usize::from(from.u16()?), usize::from(from.u8()?));
    match kind {
        0 => Ok(Entity::Floor),
        1 => Ok(Entity::Prop(PropId::first_in(index))),
        2 => {
            let node = Node::ALL.get(node).ok_or(Malformed("there is no such part"))?;
            Ok(Entity::Part(CharacterId::first_in(index), *node))
        }
        _ => Err(Malformed("there is no such kind of thing")),
    }
}
