//! The source document of a BVH file.

use super::columns::Columns;
use crate::formats::text::Span;
use std::sync::Arc;

/// The original text of a BVH file, the position of its rows, and which columns belong to which joint.
///
/// It holds the bytes and two numbers per row; the words of a row are found again when the row is written.
#[derive(Clone, Debug)]
pub struct BvhDocument {
    pub(super) bytes: Arc<[u8]>,
    /// One per joint of the clip.
    pub(super) columns: Vec<Columns>,
    pub(super) timing: Timing,
    /// From the first word's line to the end of the last word's line, line end included.
    pub(super) rows: Vec<Span>,
}

impl BvhDocument {
    /// The file's text.
    pub fn bytes(&self) -> &[u8] {
        &self.bytes
    }

    /// Number of complete rows in the file; its `Frames:` may differ.
    pub fn rows(&self) -> usize {
        self.rows.len()
    }
}

/// The lines between `MOTION` and the rows.
#[derive(Clone, Copy, Debug)]
pub(super) struct Timing {
    /// What `Frames:` says.
    pub(super) frames: u64,
    /// The word that says it.
    pub(super) frames_word: Span,
    /// What `Frame Time:` says \[s\].
    pub(super) frame_time_secs: f64,
    /// The word that says it.
    pub(super) frame_time_word: Span,
    /// Where rows may start.
    pub(super) end: usize,
}
