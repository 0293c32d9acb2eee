//! The walk that is made anew is the one that the repository ships.

#![allow(clippy::unwrap_used, reason = "tests")]

use sinew_stage::sample_walk_bvh;
use std::path::Path;

#[test]
fn the_sample_walk_is_the_shipped_file_byte_for_byte() {
    let shipped = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../samples/walk.bvh");
    assert!(sample_walk_bvh().unwrap() == std::fs::read(shipped).unwrap());
}
