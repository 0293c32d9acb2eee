//! What a motion file may ask of us.

/// Limits that every reader holds a file to, so that no file can exhaust memory or stack.
///
/// The defaults are far above any motion that people make and far below what hurts a laptop.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Limits {
    /// Largest file read \[bytes\]; a ten-minute 60-joint BVH at 120 Hz is about 150 MB.
    pub file_bytes: u64,
    /// Most joints in a skeleton. A full hand-and-face rig has about 200.
    pub joints: usize,
    /// Deepest nesting of joints; readers and writers may recurse this deep.
    pub depth: usize,
    /// Most frames in a clip: over two hours at 120 Hz.
    pub frames: usize,
    /// Most values (frames × channels) in a clip; 8 bytes each and some copies.
    pub values: usize,
    /// Longest name of a joint \[bytes\].
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
