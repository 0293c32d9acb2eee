//! Whatever a peer of a session sends: datagrams, messages, tokens.
#![no_main]

use libfuzzer_sys::fuzz_target;
use sinew_live::session::{ClientDatagram, ClientMessage, Hello, ServerMessage, Token};

fuzz_target!(|bytes: &[u8]| {
    if let Ok(datagram) = ClientDatagram::read(bytes) {
        assert_eq!(ClientDatagram::read(&datagram.to_bytes()), Ok(datagram));
    }
    let _ = Hello::read(bytes);
    let _ = ServerMessage::read(bytes);
    if let Ok(message) = ClientMessage::read(bytes) {
        let text = serde_json::to_vec(&message).unwrap();
        assert!(ClientMessage::read(&text).is_ok_and(|again| again == message));
    }
    if let Some(token) = std::str::from_utf8(bytes).ok().and_then(|text| text.parse::<Token>().ok()) {
        assert_eq!(token.to_string().parse::<Token>(), Ok(token));
    }
});
