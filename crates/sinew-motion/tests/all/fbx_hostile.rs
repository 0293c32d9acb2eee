//! FBX files that are cut off or damaged: refused or read, never a panic. Few cases, since each costs milliseconds.

use sinew_motion::Limits;
use sinew_motion::formats::{Parsed, fbx};
use sinew_testkit::capture;

/// Limits under which nothing that a flipped bit asks for takes long.
fn tight() -> Limits {
    Limits { file_bytes: 1 << 21, joints: 200, depth: 32, frames: 500, values: 200_000, name_bytes: 128 }
}

fn try_read(bytes: &[u8]) -> Option<Parsed> {
    match fbx::read(bytes, &tight()) {
        Ok(parsed) => {
            assert_eq!(parsed.clip.first_non_finite(), None);
            Some(parsed)
        }
        Err(error) => {
            assert!(!error.problem().is_empty() && !error.remedy().is_empty());
            None
        }
    }
}

#[test]
fn files_cut_off_anywhere_are_refused() {
    let Some(path) = capture("fbx/walk01_template.fbx") else { return };
    let bytes = std::fs::read(path).unwrap();
    for part in 0..40 {
        assert!(try_read(&bytes[..bytes.len() / 41 * part]).is_none(), "part {part}");
    }
}

#[test]
fn damaged_files_are_read_or_refused() {
    for file in ["fbx/walk01_template.fbx", "fbx/ozz_walk.fbx"] {
        let Some(path) = capture(file) else { return };
        let bytes = std::fs::read(path).unwrap();
        let mut seed = 0x9E37_79B9_7F4A_7C15_u64;
        for _ in 0..60 {
            let mut bytes = bytes.clone();
            for _ in 0..8 {
                // xorshift64
                seed ^= seed << 13;
                seed ^= seed >> 7;
                seed ^= seed << 17;
                let at = seed as usize % bytes.len();
                bytes[at] = (seed >> 56) as u8;
            }
            try_read(&bytes);
        }
    }
}

#[test]
fn what_is_no_fbx_is_refused() {
    // The last would be a valid Wavefront file.
    for text in
        ["", "Kaydara FBX Binary  \0\x1a\0", "; FBX 7.4.0 project file", "{}", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"]
    {
        assert!(try_read(text.as_bytes()).is_none(), "{text:?}");
    }
}
