//! Errors of a take.

/// An invalid take.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum TakeError {
    /// An invalid line.
    #[error("line {line} of the take: {problem}")]
    Line {
        /// Counted from 1.
        line: usize,
        /// The problem and the remedy.
        problem: String,
    },
    /// The file as a whole.
    #[error("{0}")]
    Whole(String),
}

impl TakeError {
    pub(super) fn line(line: usize, problem: impl Into<String>) -> TakeError {
        TakeError::Line { line, problem: problem.into() }
    }
}
