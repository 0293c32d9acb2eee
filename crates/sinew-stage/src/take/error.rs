//! What is wrong with a take.

/// A take that cannot be used.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum TakeError {
    /// A line that is not what it should be.
    #[error("line {line} of the take: {problem}")]
    Line {
        /// Counted from 1.
        line: usize,
        /// What is wrong with it and what to do.
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
