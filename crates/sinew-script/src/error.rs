//! Errors of a script.

use serde::{Deserialize, Serialize};
use std::fmt;

/// An error of a script, with its place.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, thiserror::Error)]
pub struct ScriptError {
    /// The script's file, as the stage named it.
    pub file: String,
    /// The line in it, from 1; `None` if it is not in one line.
    pub line: Option<u32>,
    /// The problem; Python's own text if Python found it.
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
