//! Why a command cannot be carried out.

use std::fmt;

/// The kind of an [`OrderError`], for a program to match on.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum OrderErrorKind {
    /// No character, prop, joint, part, pose, graph, shape, controller or file has this name.
    NotFound,
    /// A number is NaN, infinite or out of range.
    OutOfRange,
    /// A text or a list exceeds its maximum, or too many effects are active.
    TooLarge,
    /// The command has the wrong addressee: it needs a character, or a prop, or the addressee does not support it.
    WrongTarget,
    /// Keys of the command exclude each other, or one is missing.
    Contradiction,
    /// The character's tracker or source does not honour it (gains of `kd` for a character that follows by `pd`).
    NotHonoured,
    /// The command makes sense, but not as the stage is now: nothing lies in reach, no such shape was added.
    WrongState,
    /// The sender is not authorized to give the command.
    NotPermitted,
    /// A Python controller does not start or does not run.
    Script,
}

/// Why a command cannot be carried out: a kind for programs, and words that name what is wrong and what to do.
///
/// ```
/// use sinew_control::{OrderError, OrderErrorKind};
/// let error = OrderError::new(OrderErrorKind::NotHonoured, "`kinematic` has no joint gains; follow by pd or kd");
/// assert_eq!(error.kind(), OrderErrorKind::NotHonoured);
/// assert!(error.to_string().contains("pd or kd"));
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct OrderError {
    kind: OrderErrorKind,
    problem: String,
}

impl OrderError {
    /// An error of a kind; `problem` says what is wrong and what to do.
    pub fn new(kind: OrderErrorKind, problem: impl Into<String>) -> OrderError {
        OrderError { kind, problem: problem.into() }
    }

    /// Its kind.
    pub fn kind(&self) -> OrderErrorKind {
        self.kind
    }

    /// The problem and the remedy, as text.
    pub fn problem(&self) -> &str {
        &self.problem
    }

    /// The same with other words, such as the place in front.
    #[must_use]
    pub fn map_problem(self, words: impl FnOnce(String) -> String) -> OrderError {
        OrderError { kind: self.kind, problem: words(self.problem) }
    }
}

impl fmt::Display for OrderError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.problem)
    }
}

impl std::error::Error for OrderError {}
