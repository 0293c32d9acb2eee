#![no_main]

#[path = "../src/text.rs"]
#[allow(dead_code)]
mod text;

libfuzzer_sys::fuzz_target!(|data: &[u8]| text::asf(data));
