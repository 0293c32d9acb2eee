//! Frames as bytes: all bits arrive, and any bytes may come.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use super::common::{Rng, adult, spec, standing};
use glam::{DQuat, DVec3};
use sinew_body::humanoid::Node;
use sinew_snapshot::{FrameKind, Writer};
use sinew_world::frame_bytes::{FrameBytesError, MAX_CHARACTERS, MAX_CONTACTS, MAX_CORNERS, MAX_PROPS, VERSION};
use sinew_world::{
    BodyState, CharacterFrame, CharacterId, Contact, Entity, Form, Frame, Motion, PropId, PropSpec, Solid, World,
    WorldSettings,
};

/// Bytes of the checksum at the end.
const CHECKSUM: usize = 8;

/// A frame whose every number is another.
fn frame(characters: usize, props: usize, contacts: usize) -> Frame {
    let mut next = 0.0;
    let mut number = || {
        next += 1.0 / 3.0;
        next
    };
    let mut vector = || DVec3::new(number(), -number(), number() * 1e-300);
    let mut body = || {
        let (a, b) = (vector(), vector());
        let rotation = DQuat::from_xyzw(a.x, a.y, a.z, b.x);
        BodyState { position: a, rotation, centre: b, velocity: a - b, angular_velocity: b - a }
    };
    let mut seen = Vec::new();
    for at in 0..characters {
        let mut character = CharacterFrame::EMPTY;
        character.parts = std::array::from_fn(|_| body());
        let more = body();
        (character.centre_of_mass, character.centre_velocity, character.facing) =
            (more.position, more.centre, more.velocity);
        character.support = vec![more.position; at * 3];
        character.was_reset = at % 2 == 1;
        seen.push(character);
    }
    let things = (0..props).map(|_| body()).collect();
    let mut frame = Frame { step: u64::MAX - 1, time_secs: 1.0 / 7.0, ..Frame::of(seen, things) };
    frame.contacts = (0..contacts)
        .map(|at| Contact {
            a: if at % 2 == 0 || props == 0 { Entity::Floor } else { Entity::Prop(PropId::first_in(at % props)) },
            b: if characters == 0 {
                Entity::Floor
            } else {
                Entity::Part(CharacterId::first_in(at % characters), Node::ALL[at % Node::COUNT])
            },
            point: body().position,
            impulse: body().velocity,
            begins: at % 3 == 0,
        })
        .collect();
    frame
}

/// With vacant slots and slots that were used before.
fn frame_with_vacant_slots() -> Frame {
    let mut frame = frame(3, 4, 12);
    (frame.characters[1], frame.character_ids[1]) = (CharacterFrame::EMPTY, None);
    (frame.props[0], frame.prop_ids[0]) = (BodyState::REST, None);
    frame.character_ids[2] = Some(CharacterId::new(2, 7));
    frame.prop_ids[3] = Some(PropId::new(3, u32::MAX));
    let (part, prop) = (Entity::Part(CharacterId::new(2, 7), Node::Head), Entity::Prop(PropId::new(3, u32::MAX)));
    let ones = frame.contacts.drain(..).take(2);
    let ones = ones.map(|contact| Contact { a: prop, b: part, ..contact });
    frame.contacts = ones.collect();
    frame
}

/// The checksum of changed bytes made right, as a sender can who means harm.
fn forged(bytes: &[u8]) -> Vec<u8> {
    let mut to = Writer::new();
    to.bytes(&bytes[..bytes.len().saturating_sub(CHECKSUM)]);
    FrameKind::finish(to)
}

/// What was read is written to the same bytes, but for the hash, which a sender may claim as it likes.
fn is_error_or_the_same_bytes(bytes: &[u8]) {
    if let Ok((frame, _)) = Frame::from_bytes(bytes) {
        let (content, again) = (&bytes[..bytes.len() - CHECKSUM], frame.to_bytes());
        let again = &again[..again.len() - CHECKSUM];
        assert!(content[..24] == again[..24] && content[32..] == again[32..]);
    }
}

#[test]
fn a_frame_arrives_with_all_its_bits() {
    for (characters, props, contacts) in [(0, 0, 0), (1, 0, 3), (3, 5, 20), (0, 2, 4)] {
        let frame = frame(characters, props, contacts);
        assert_eq!(Frame::from_bytes(&frame.to_bytes()), Ok((frame.clone(), frame.hash())));
    }
    let frame = frame_with_vacant_slots();
    assert_eq!(Frame::from_bytes(&frame.to_bytes()), Ok((frame.clone(), frame.hash())));
}

#[test]
fn a_world_from_which_something_was_removed_has_the_same_hash_at_the_receiver() {
    let body = adult();
    let mut world = World::new(WorldSettings::default());
    let ball = |at: DVec3| {
        let solid = Solid::new(Form::Ball { radius_m: 0.1 });
        PropSpec::new(solid, Motion::Dynamic { mass_kg: 1.0 }, at)
    };
    let mut aside = standing(&body);
    aside.hips_position.x += 1.0;
    let gone = world.add_character(spec(&body, standing(&body))).unwrap();
    world.add_character(spec(&body, aside)).unwrap();
    let props = [1.0, 2.0, 3.0].map(|x| world.add_prop(ball(DVec3::new(x, 0.1, 2.0))).unwrap());
    let received = |world: &World| {
        let (frame, said) = Frame::from_bytes(&world.frame().to_bytes()).unwrap();
        assert_eq!((frame.hash(), said), (world.hash(), world.hash()));
        frame
    };
    (0..60).for_each(|_| world.step());
    let whole = received(&world).hash();
    world.remove_character(gone).unwrap();
    world.remove_prop(props[0]).unwrap();
    world.remove_prop(props[2]).unwrap();
    assert_ne!(received(&world).hash(), whole);
    // A slot is used again, another stays vacant.
    let again = world.add_prop(ball(DVec3::new(0.0, 0.1, 3.0))).unwrap();
    (0..60).for_each(|_| world.step());
    let frame = received(&world);
    assert!(frame.character(gone).is_none() && frame.prop(props[0]).is_none() && frame.prop(again).is_some());
    assert_eq!(frame.prop_ids, world.frame().prop_ids);
    assert_eq!(frame.contacts, world.frame().contacts);
}

#[test]
fn the_layout_is_the_one_of_the_table() {
    let frame = frame_with_vacant_slots();
    let bytes = frame.to_bytes();
    let number = |at: usize| f64::from_le_bytes(bytes[at..at + 8].try_into().unwrap());
    assert_eq!((&bytes[..4], &bytes[4..8]), (&b"SNFR"[..], &VERSION.to_le_bytes()[..]));
    assert_eq!((&bytes[8..16], number(16)), (&frame.step.to_le_bytes()[..], frame.time_secs));
    assert_eq!((&bytes[24..32], &bytes[32..38]), (&frame.hash().to_le_bytes()[..], &[3, 0, 4, 0, 2, 0][..]));
    // Slot 0 of characters: no corners. Slot 1 is vacant. Slot 2: 6 corners.
    let head = 38 + 5 + Node::Head.index() * 128;
    assert_eq!((&bytes[38..43], number(head)), (&[1, 0, 0, 0, 0][..], frame.characters[0].part(Node::Head).position.x));
    assert_eq!(number(head + 24 + 24), frame.characters[0].part(Node::Head).rotation.w);
    assert_eq!(number(head + 104), frame.characters[0].part(Node::Head).angular_velocity.x);
    let second = 38 + 5 + 2378;
    assert_eq!(&bytes[second..second + 6], &[0, 1, 7, 0, 0, 0]);
    let third = second + 6;
    assert_eq!(number(third + 2304), frame.characters[2].centre_of_mass.x);
    assert_eq!(number(third + 2352), frame.characters[2].facing.x);
    assert_eq!((bytes[third + 2376], bytes[third + 2377]), (0, 6));
    let props = third + 2378 + 6 * 24;
    assert_eq!((bytes[props], bytes[props + 1]), (0, 1));
    let contacts = props + 1 + 3 * (5 + 128);
    assert_eq!(&bytes[contacts..contacts + 8], &[1, 3, 0, 0, 2, 2, 0, Node::Head.index() as u8]);
    assert_eq!(number(contacts + 32), frame.contacts[0].impulse.x);
    assert_eq!((bytes[contacts + 56], bytes.len()), (1, contacts + 2 * 57 + CHECKSUM));
}

#[test]
fn a_changed_cut_or_longer_frame_is_an_error() {
    let whole = frame_with_vacant_slots().to_bytes();
    for end in 0..whole.len() {
        assert!(Frame::from_bytes(&whole[..end]).is_err(), "{end} bytes");
    }
    assert_eq!(Frame::from_bytes(&[&whole[..], &[0]].concat()), Err(FrameBytesError::Corrupt));
    let mut changed = whole.clone();
    for at in 0..whole.len() {
        changed[at] ^= 1 << (at % 8);
        assert!(Frame::from_bytes(&changed).is_err(), "byte {at}");
        changed[at] = whole[at];
    }
}

#[test]
fn bytes_with_a_forged_checksum_are_an_error_or_another_frame() {
    let whole = frame_with_vacant_slots().to_bytes();
    for end in CHECKSUM..whole.len() {
        assert!(Frame::from_bytes(&forged(&whole[..end])).is_err(), "{end} bytes");
    }
    let longer = forged(&[&whole[..], &[0]].concat());
    assert_eq!(Frame::from_bytes(&longer), Err(FrameBytesError::TooLong { bytes: 1 }));
    let mut changed = whole.clone();
    for at in 0..whole.len() - CHECKSUM {
        for value in [whole[at] ^ 1, whole[at] ^ 0x80, 0, 2, 0xff] {
            changed[at] = value;
            is_error_or_the_same_bytes(&forged(&changed));
        }
        changed[at] = whole[at];
    }
    let mut rng = Rng::new(11);
    for _ in 0..3000 {
        let mut bytes = whole.clone();
        for _ in 0..1 + (rng.unit() * 5.0) as usize {
            let at = (rng.unit() * bytes.len() as f64) as usize;
            bytes[at] = (rng.unit() * 256.0) as u8;
        }
        is_error_or_the_same_bytes(&forged(&bytes));
    }
}

#[test]
fn every_fault_has_its_kind() {
    let whole = frame(1, 1, 1).to_bytes();
    let read = |at: usize, with: &[u8]| {
        let mut bytes = whole.clone();
        bytes[at..at + with.len()].copy_from_slice(with);
        Frame::from_bytes(&forged(&bytes)).unwrap_err()
    };
    assert_eq!(read(0, b"SNWW"), FrameBytesError::NotAFrame);
    assert_eq!(read(4, &[9]), FrameBytesError::Version { found: 9, expected: VERSION });
    assert_eq!(read(16, &f64::NAN.to_le_bytes()), FrameBytesError::NotFinite { what: "time" });
    assert_eq!(read(43, &f64::INFINITY.to_le_bytes()), FrameBytesError::NotFinite { what: "body" });
    // Counts that the bytes cannot hold.
    for (at, what, maximum) in
        [(32, "slots of characters", MAX_CHARACTERS), (34, "slots of props", MAX_PROPS), (36, "contacts", MAX_CONTACTS)]
    {
        assert_eq!(read(at, &[0xff; 2]), FrameBytesError::TooMany { what, count: 65_535, maximum });
    }
    assert_eq!(read(36, &(MAX_CONTACTS as u16).to_le_bytes()), FrameBytesError::TooShort);
    assert_eq!(read(38, &[2]), FrameBytesError::Invalid { what: "bool" });
    let contact = whole.len() - CHECKSUM - 57;
    let entity = FrameBytesError::Invalid { what: "entity of a contact" };
    // Of no kind; a prop and a part that are not there; ground with a slot.
    for bytes in [[3, 0, 0, 0], [1, 1, 0, 0], [2, 1, 0, 0], [2, 0, 0, 18], [0, 1, 0, 0]] {
        assert_eq!(read(contact, &bytes), entity, "{bytes:?}");
    }
}

#[test]
fn more_than_the_maximum_is_left_out_and_the_rest_can_be_read() {
    let mut frame = frame(1, 0, 0);
    frame.characters[0].support = vec![DVec3::X; MAX_CORNERS + 1];
    frame.props = vec![BodyState::REST; MAX_PROPS + 1];
    frame.prop_ids = (0..=MAX_PROPS).map(|slot| Some(PropId::first_in(slot))).collect();
    let contact = |slot: usize| {
        let prop = Entity::Prop(PropId::first_in(slot));
        Contact { a: Entity::Floor, b: prop, point: DVec3::X, impulse: DVec3::Y, begins: false }
    };
    frame.contacts = vec![contact(MAX_PROPS), contact(0)];
    let (read, said) = Frame::from_bytes(&frame.to_bytes()).unwrap();
    assert_eq!((read.characters[0].support.len(), read.props.len()), (MAX_CORNERS, MAX_PROPS));
    assert_eq!((read.contacts, said), (vec![contact(0)], frame.hash()));
}
