//! Limits for motion files.

/// Limits that every reader enforces, so that no file can exhaust memory or stack.
///
/// The defaults are far above any real motion and far below what a laptop can handle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Limits {
    /// Maximum file size \[bytes\]; a ten-minute 60-joint BVH at 120 Hz is about 150 MB.
    pub file_bytes: u64,
    /// Maximum number of joints in a skeleton. A full hand-and-face rig has about 200.
    pub joints: usize,
    /// Maximum nesting depth of joints; readers and writers may recurse this deep.
    pub depth: usize,
    /// Maximum number of frames in a clip: over two hours at 120 Hz.
    pub frames: usize,
    /// Maximum number of values (frames × channels) in a clip; 8 bytes each and some copies.
    pub values: usize,
    /// Maximum length of a joint's name \[bytes\].
    pub name_bytes: usize,
}

impl Default for Limits {
    fn default() -> Limits {
        Limits {
            file_bytes: 512 << 20,
            joints: 2_000,
            depth: 128,
            frames: 1_000_000,
            values: 100_000_000,
            name_bytes: 1_024,
        }
    }
}
