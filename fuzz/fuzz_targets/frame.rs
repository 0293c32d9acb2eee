//! A frame as bytes, and the same bytes with a right head and checksum, so that what stands behind them is reached.
#![no_main]

use libfuzzer_sys::fuzz_target;
use sinew_snapshot::FrameKind;
use sinew_world::Frame;
use sinew_world::frame_bytes::VERSION;

fn read(bytes: &[u8]) {
    if let Ok((frame, _)) = Frame::from_bytes(bytes) {
        // All but the hash, which a sender may claim as it likes.
        assert_eq!(Frame::from_bytes(&frame.to_bytes()).map(|(frame, _)| frame), Ok(frame));
    }
}

fuzz_target!(|bytes: &[u8]| {
    read(bytes);
    let mut to = FrameKind { magic: *b"SNFR", version: VERSION }.begin(Vec::new());
    to.bytes(bytes);
    read(&FrameKind::finish(to));
});
