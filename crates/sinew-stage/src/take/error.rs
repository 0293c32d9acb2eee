//! Errors of a take.

use std::fmt;

/// What kind of trouble a [`TakeError`] is, for a program to match on.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum TakeErrorKind {
    /// The file cannot be read or written.
    Unreadable,
    /// It is no take.
    NotATake,
    /// It has another version of the format.
    WrongVersion,
    /// It, or something in it, is beyond a limit.
    TooLarge,
    /// It was cut off: its end is missing.
    Incomplete,
    /// A line is not what it should be.
    Malformed,
    /// A command holds a number that is not finite.
    NotFinite,
}

/// A take that cannot be used.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TakeError {
    /// What kind of trouble it is.
    pub kind: TakeErrorKind,
    /// The line that is wrong, counted from 1; `None` for the take as a whole.
    pub line: Option<usize>,
    /// What is wrong and what to do.
    pub problem: String,
}

impl TakeError {
    pub(super) fn line(line: usize, problem: impl Into<String>) -> TakeError {
        TakeError { kind: TakeErrorKind::Malformed, line: Some(line), problem: problem.into() }
    }

    pub(super) fn whole(kind: TakeErrorKind, problem: impl Into<String>) -> TakeError {
        TakeError { kind, line: None, problem: problem.into() }
    }

    /// The same of another kind.
    #[must_use]
    pub(super) fn of_kind(self, kind: TakeErrorKind) -> TakeError {
        TakeError { kind, ..self }
    }
}

impl fmt::Display for TakeError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some(line) = self.line {
            write!(f, "line {line} of the take: ")?;
        }
        f.write_str(&self.problem)
    }
}

impl std::error::Error for TakeError {}
