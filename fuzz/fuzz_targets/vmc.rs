#![no_main]

#[path = "../src/live.rs"]
#[allow(dead_code)]
mod live;

libfuzzer_sys::fuzz_target!(|data: &[u8]| live::vmc(data));
