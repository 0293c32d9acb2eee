#![no_main]

#[path = "../src/stage.rs"]
#[allow(dead_code)]
mod stage;

libfuzzer_sys::fuzz_target!(|data: &[u8]| stage::pose(data));
