//! Any bytes as a glTF file: read or refused, and what is read can be written, under limits that keep memory small.

#![no_main]

use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| sinew_motion::formats::gltf::fuzz(bytes));
