//! Whatever a peer of a session sends: frames, datagrams, messages, tokens.
#![no_main]

use libfuzzer_sys::fuzz_target;
use sinew_live::session::{ClientSays, Hello, ServerSays, Token, Upward, decode_frame, encode_frame};

fuzz_target!(|bytes: &[u8]| {
    if let Ok((frame, _)) = decode_frame(bytes) {
        let mut again = Vec::new();
        encode_frame(&frame, &mut again);
        // All but the hash, which a sender may claim as it likes.
        assert_eq!(decode_frame(&again).map(|(frame, _)| frame), Ok(frame));
    }
    if let Ok(upward) = Upward::read(bytes) {
        assert_eq!(Upward::read(&upward.to_bytes()), Ok(upward));
    }
    let _ = Hello::read(bytes);
    let _ = ServerSays::read(bytes);
    if let Ok(says) = ClientSays::read(bytes) {
        let text = serde_json::to_vec(&says).unwrap();
        assert_eq!(ClientSays::read(&text), Ok(says));
    }
    if let Some(token) = std::str::from_utf8(bytes).ok().and_then(|text| text.parse::<Token>().ok()) {
        assert_eq!(token.to_string().parse::<Token>(), Ok(token));
    }
});
