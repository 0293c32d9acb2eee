//! Notes about a file: warnings that are not errors.

use std::fmt;

/// A warning about a file: what was guessed, repaired or lost in reading it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Note {
    /// Line in the file (from 1), where there is one.
    pub line: Option<usize>,
    /// What was found and how it was handled.
    pub text: String,
}

impl Note {
    /// A note about the file as a whole.
    pub fn new(text: impl Into<String>) -> Note {
        Note { line: None, text: text.into() }
    }

    /// A note about a line (from 1).
    pub fn at_line(line: usize, text: impl Into<String>) -> Note {
        Note { line: Some(line), text: text.into() }
    }
}

impl fmt::Display for Note {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.line {
            Some(line) => write!(f, "line {line}: {}", self.text),
            None => f.write_str(&self.text),
        }
    }
}
