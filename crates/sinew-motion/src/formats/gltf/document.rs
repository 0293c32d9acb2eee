//! The source document of a glTF file.

use super::rig::JointNode;
use crate::formats::Format;
use std::fmt;
use std::path::PathBuf;

/// A glTF file as it was read: its bytes, and which node each joint of the clip came from.
#[derive(Clone)]
pub struct GltfDocument {
    pub(super) bytes: Vec<u8>,
    /// Where its external buffers are.
    pub(super) folder: Option<PathBuf>,
    /// One per joint of the clip.
    pub(super) joints: Vec<JointNode>,
    /// Which kind of VRM it is, if it is one.
    pub(super) vrm: Option<Format>,
    /// Index of the animation that was read.
    pub(super) animation: usize,
    /// Time of the clip's first frame in it \[s\].
    pub(super) start_secs: f64,
}

impl GltfDocument {
    /// The file as it was read.
    pub fn bytes(&self) -> &[u8] {
        &self.bytes
    }

    /// Index of the glTF node behind each joint of the clip.
    pub fn nodes(&self) -> impl Iterator<Item = usize> + '_ {
        self.joints.iter().map(|joint| joint.node)
    }
}

impl fmt::Debug for GltfDocument {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("GltfDocument")
            .field("bytes", &self.bytes.len())
            .field("folder", &self.folder)
            .field("joints", &self.joints.len())
            .field("animation", &self.animation)
            .field("start_secs", &self.start_secs)
            .finish()
    }
}
