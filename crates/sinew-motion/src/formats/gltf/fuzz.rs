//! Entry point for fuzzing: read, write and read again.

use super::{read_slice, write};
use crate::formats::{Format, Source, WriteJob};
use crate::{Limits, SourceSpace};
use glam::DQuat;

/// Reads any bytes as glTF under tight limits; what is read is finite, and can be written unchanged and with a changed
/// joint, and read again. Called by the fuzz target `gltf`; also useful on a corpus.
///
/// # Panics
/// If one of these claims does not hold.
#[doc(hidden)]
pub fn fuzz(bytes: &[u8]) {
    let limits = Limits { file_bytes: 1 << 20, joints: 64, depth: 16, frames: 2_000, values: 100_000, name_bytes: 64 };
    let Ok(parsed) = read_slice(bytes, None, &limits) else { return };
    assert_eq!(parsed.clip.first_non_finite(), None, "what is read is finite");
    let mut changed = parsed.clip.clone();
    changed.set_rotation(0, 0, DQuat::from_rotation_x(0.5) * changed.rotation(0, 0));
    let rows: Vec<usize> = (0..changed.frames()).collect();
    let source = Source { document: &parsed.document, clip: &parsed.clip, space: SourceSpace::SINEW, rows: &rows };
    for (clip, source) in [(&parsed.clip, None), (&parsed.clip, Some(source)), (&changed, Some(source))] {
        for format in [Format::Glb, Format::Gltf] {
            let mut file = Vec::new();
            // Values near the end of single precision, or buffers that only meshes use, may be refused.
            if write(&mut file, &WriteJob { clip, source }, format, &[]).is_ok() {
                let again = read_slice(&file, None, &Limits::default()).expect("what is written can be read");
                assert_eq!(again.clip.skeleton().len(), clip.skeleton().len());
            }
        }
    }
}
