//! What a file says of what is in it, beside the motion that is read.

use crate::Part;

/// One of the animations of a file.
#[derive(Clone, Debug, PartialEq)]
pub struct AnimationInfo {
    /// Its name; empty where the file gives it none.
    pub name: String,
    /// Number of frames that its keys make; 1 without keys of the skeleton, 0 where its keys cannot be read.
    pub frames: usize,
    /// Rate of its keys \[Hz\].
    pub fps: f64,
    /// Whether it is the one that was read.
    pub is_read: bool,
}

impl AnimationInfo {
    /// Its name for messages.
    pub fn shown(&self) -> &str {
        if self.name.is_empty() { "(no name)" } else { &self.name }
    }
}

/// What a file says of what is in it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Contents {
    /// All its animations in the file's order; empty for formats that hold one without a name (BVH, AMC).
    pub animations: Vec<AnimationInfo>,
    /// Names that stand above a root joint without being joints (a glTF's armature), by root joint.
    pub armatures: Vec<(usize, String)>,
    /// Which joint is which part, where the file itself says so (the `humanBones` of VRM).
    pub parts: Vec<(Part, usize)>,
}
