//! Bytes of a peer: any may come, none may panic or take more memory than they have themselves.

use glam::{DQuat, DVec3};
use proptest::prelude::*;
use sinew_body::humanoid::{Body, Pose};
use sinew_control::perform::{PerformerSample, SampleStatus};
use sinew_live::session::{ClientDatagram, ClientMessage, Hello, PROTOCOL, Refusal, ServerMessage};

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
        let _ = ClientDatagram::read(&bytes);
        let _ = Hello::read(&bytes);
        let _ = ClientMessage::read(&bytes);
        let _ = ServerMessage::read(&bytes);
    }

    #[test]
    fn text_that_is_almost_a_message_is_read_or_refused(text in r#"\{"(command|press|leave)": ?[\[\]{}":,a-z0-9.\-]{0,60}\}"#) {
        let _ = ClientMessage::read(text.as_bytes());
    }
}
