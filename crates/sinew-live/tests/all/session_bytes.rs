//! Bytes of a peer: any may come, none may panic or take more memory than they have themselves.

use glam::{DQuat, DVec3};
use proptest::prelude::*;
use sinew_body::humanoid::{Body, Node, Pose};
use sinew_control::perform::{PerformerSample, SampleStatus};
use sinew_live::session::{
    ClientDatagram, ClientMessage, Hello, PROTOCOL, Refusal, ServerMessage, decode_frame, encode_frame,
};
use sinew_world::{BodyState, CharacterFrame, CharacterId, Contact, Entity, Frame, PropId};

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

fn bytes(frame: &Frame) -> Vec<u8> {
    let mut bytes = Vec::new();
    encode_frame(frame, &mut bytes);
    bytes
}

#[test]
fn a_frame_arrives_with_all_its_bits() {
    for (characters, props, contacts) in [(0, 0, 0), (1, 0, 3), (3, 5, 20), (0, 2, 4)] {
        let frame = frame(characters, props, contacts);
        assert_eq!(decode_frame(&bytes(&frame)), Ok((frame.clone(), frame.hash())));
    }
}

#[test]
fn a_frame_that_is_cut_off_or_goes_on_is_none() {
    let whole = bytes(&frame(2, 1, 3));
    for end in 0..whole.len() {
        assert!(decode_frame(&whole[..end]).is_err(), "{end} bytes");
    }
    assert!(decode_frame(&[&whole[..], &[0]].concat()).is_err());
}

#[test]
fn a_sample_arrives_with_all_its_bits_and_fits_a_packet() {
    let turns = std::array::from_fn(|at| DQuat::from_xyzw(0.1 * at as f64, -0.2, 0.3, 0.9));
    let plain = PerformerSample::new(1.0 / 3.0, DVec3::new(-0.1, 0.9, 1e3), &turns);
    let lost = PerformerSample { status: SampleStatus::Untracked, number: Some(u64::MAX), ..plain.clone() };
    let whole = PerformerSample::of_pose(-7.0, &Pose::STANDING, &Body::standard(60.0, 1.6));
    for sample in [plain, lost, whole] {
        let datagram = ClientDatagram::Performed { actor: 3, sample: Box::new(sample) };
        let bytes = datagram.to_bytes();
        // QUIC promises packets of 1200 bytes, of which it takes some tens itself.
        assert!(bytes.len() <= 450, "{} bytes", bytes.len());
        for end in 0..bytes.len() {
            assert!(ClientDatagram::read(&bytes[..end]).is_err());
        }
        assert_eq!(ClientDatagram::read(&bytes), Ok(datagram));
    }
}

#[test]
fn counts_that_the_bytes_cannot_hold_cost_nothing() {
    let mut few = bytes(&Frame::default());
    few[16..22].fill(0xff);
    assert!(decode_frame(&few).is_err());
    // Allowed counts, and nothing behind them.
    few[16..22].copy_from_slice(&[0, 4, 0, 64, 0, 16]);
    assert!(decode_frame(&few).is_err());
}

#[test]
fn a_greeting_of_another_version_is_told_so_whatever_else_it_says() {
    let hello = br#"{"protocol": 999, "new": {"things": []}}"#;
    assert_eq!(Hello::read(hello).err(), Some(Refusal::Version { server: PROTOCOL, client: 999 }));
    let deep = format!("{{\"protocol\": {}", "[".repeat(100_000));
    assert!(matches!(Hello::read(deep.as_bytes()), Err(Refusal::Greeting { .. })));
    let many = format!("{{\"protocol\": {PROTOCOL}, \"secret\": \"\", \"actors\": [{}\"z\"]}}", "\"a\",".repeat(99));
    assert!(matches!(Hello::read(many.as_bytes()), Err(Refusal::Greeting { .. })));
}

proptest! {
    #[test]
    fn no_bytes_bring_a_reader_down(bytes in proptest::collection::vec(any::<u8>(), 0..4000)) {
        let _ = decode_frame(&bytes);
        let _ = ClientDatagram::read(&bytes);
        let _ = Hello::read(&bytes);
        let _ = ClientMessage::read(&bytes);
        let _ = ServerMessage::read(&bytes);
    }

    #[test]
    fn a_frame_with_changed_bytes_is_another_frame_or_none(
        changes in proptest::collection::vec((0usize..10_000, any::<u8>()), 1..6),
    ) {
        let mut changed = bytes(&frame(2, 2, 4));
        for (place, byte) in changes {
            let place = place % changed.len();
            changed[place] = byte;
        }
        if let Ok((frame, _)) = decode_frame(&changed) {
            let (again, _) = decode_frame(&bytes(&frame)).expect("what was read can be written");
            prop_assert_eq!(again, frame);
        }
    }

    #[test]
    fn text_that_is_almost_a_message_is_read_or_refused(text in r#"\{"(command|press|leave)": ?[\[\]{}":,a-z0-9.\-]{0,60}\}"#) {
        let _ = ClientMessage::read(text.as_bytes());
    }
}
