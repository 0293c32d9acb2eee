//! Motions that are held in memory.
#![allow(clippy::unwrap_used, reason = "a test may fail")]

use sinew_motion::formats::{MotionFile, ReadOptions};

#[test]
fn a_motion_in_memory_is_the_one_on_the_disk() {
    let samples = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../../samples");
    for name in ["walk.bvh", "walk.glb"] {
        let path = samples.join(name);
        let bytes = std::fs::read(&path).unwrap();
        let held = MotionFile::from_bytes(name.as_ref(), &bytes, &ReadOptions::default()).unwrap();
        assert_eq!(held.clip, MotionFile::read(&path, &ReadOptions::default()).unwrap().clip);
    }
    let error = MotionFile::from_bytes("walk.amc".as_ref(), b"", &ReadOptions::default()).unwrap_err().to_string();
    assert!(error.contains("another file") && error.contains("sinew convert"), "{error}");
}
