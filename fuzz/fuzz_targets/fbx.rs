//! Any bytes as an FBX file: read or refused, under limits that keep memory small.

#![no_main]

use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| sinew_motion::formats::fbx::fuzz(bytes));
