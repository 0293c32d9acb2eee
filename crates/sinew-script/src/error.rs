//! What is wrong with a script, and where.

use serde::{Deserialize, Serialize};
use std::fmt;

/// What is wrong with a script, and where.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, thiserror::Error)]
pub struct ScriptError {
    /// The script's file, as the stage named it.
    pub file: String,
    /// The line in it, from 1; `None` when the trouble is not in one line.
    pub line: Option<u32>,
    /// What is wrong, in Python's words where Python found it.
    pub message: String,
}

impl fmt::Display for ScriptError {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.line {
            Some(line) => write!(formatter, "{}:{line}: {}", self.file, self.message),
            None => write!(formatter, "{}: {}", self.file, self.message),
        }
    }
}
