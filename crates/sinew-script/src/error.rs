//! Errors of a script.

use serde::{Deserialize, Serialize};
use std::fmt;

/// What kind of trouble a [`ScriptError`] is, for a program to match on.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[non_exhaustive]
pub enum ScriptErrorKind {
    /// The text is no Python, has no such class, or the class has no `step`.
    Text,
    /// The script raised an exception.
    #[default]
    Raised,
    /// The text or a message is longer than allowed.
    TooLarge,
    /// The program that runs scripts cannot be started, has ended, or did not answer in time.
    Host,
    /// A state that was kept is broken or does not fit the text.
    State,
    /// The stage asked with names that do not fit: a fault of the caller.
    Names,
}

/// An error of a script: its kind and its place.
///
/// ```
/// use sinew_script::{ScriptError, ScriptErrorKind};
/// let error = ScriptError { kind: ScriptErrorKind::Raised, file: "dunk.py".into(), line: Some(7), message: "ValueError".into() };
/// assert_eq!(error.to_string(), "dunk.py:7: ValueError");
/// ```
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, thiserror::Error)]
pub struct ScriptError {
    /// What kind of trouble it is.
    pub kind: ScriptErrorKind,
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
