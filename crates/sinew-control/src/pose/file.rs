//! Pose files: TOML with `[poses.NAME]` tables, and graphs of them in `[graphs.NAME]`.

use super::{PoseFileError, PoseSpec};
use crate::graph::GraphSpec;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// Maximum length of a pose file's text \[bytes\].
pub const MAX_FILE_BYTES: usize = 1 << 20;

/// The contents of a pose file.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, schemars::JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PoseFile {
    /// Key poses by name.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub poses: BTreeMap<String, PoseSpec>,
    /// Pose graphs by name.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub graphs: BTreeMap<String, GraphSpec>,
}

/// Parses a pose file's text; `file_name` is for messages. No file is read.
///
/// # Errors
/// With the line, the problem and the remedy.
pub fn read_poses(text: &str, file_name: &str) -> Result<PoseFile, PoseFileError> {
    let file = file_name.to_owned();
    if text.len() > MAX_FILE_BYTES {
        return Err(PoseFileError::TooLong { file, bytes: text.len(), most: MAX_FILE_BYTES });
    }
    toml::from_str(text).map_err(|error| {
        let at = error.span().map_or(0, |span| span.start).min(text.len());
        let line = 1 + text.as_bytes()[..at].iter().filter(|byte| **byte == b'\n').count();
        // A sentence in the middle of a line; a hostile key may be long.
        let problem = error.message().trim().replace('\n', "; ").chars().take(600).collect();
        PoseFileError::Line { file, line, problem }
    })
}
