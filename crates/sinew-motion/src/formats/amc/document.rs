//! The source document of an AMC file.

use super::bone::Bone;
use crate::formats::text::Span;
use std::sync::Arc;

/// The original text of an AMC file and its skeleton, and the position of each frame.
#[derive(Clone, Debug)]
pub struct AmcDocument {
    pub(super) bytes: Arc<[u8]>,
    pub(super) skeleton_bytes: Arc<[u8]>,
    /// One per joint of the clip.
    pub(super) bones: Vec<Bone>,
    /// Whether angles are degrees, or radians.
    pub(super) degrees: bool,
    /// Joints that the motion has values for.
    pub(super) present: Vec<bool>,
    /// From the line with the frame's number to the end of its last line, line end included.
    pub(super) frames: Vec<Span>,
}

impl AmcDocument {
    /// The motion's text.
    pub fn bytes(&self) -> &[u8] {
        &self.bytes
    }

    /// The skeleton's text.
    pub fn skeleton_bytes(&self) -> &[u8] {
        &self.skeleton_bytes
    }

    /// How many complete frames the file holds.
    pub fn frames(&self) -> usize {
        self.frames.len()
    }
}
