//! Errors of a pose graph.

use crate::pose::PartName;

/// Why a graph cannot be played.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum GraphError {
    /// A state that does not exist.
    #[error("{place}: there is no state {name:?}; the states are {known}")]
    UnknownState {
        /// The place where it is named.
        place: String,
        /// The name.
        name: String,
        /// The known names.
        known: String,
    },
    /// A pose that does not exist.
    #[error("state {state:?}: there is no pose {name:?}; there are: {known}")]
    UnknownPose {
        /// The place where it is named.
        state: String,
        /// The name.
        name: String,
        /// The known names.
        known: String,
    },
    /// An unknown name in a condition.
    #[error(
        "{place}: nothing is called {name:?}; name an own part ({parts}), self, centre, ground, a character's part as name.part, \
         or one of: {known}",
        parts = PartName::list()
    )]
    UnknownName {
        /// The place where it is named.
        place: String,
        /// The name.
        name: String,
        /// The known names.
        known: String,
    },
    /// An invalid condition.
    #[error("{place}: {problem}")]
    Condition {
        /// Its place.
        place: String,
        /// What is wrong and what to do.
        problem: String,
    },
    /// A count above its maximum.
    #[error("{place}: {count} {what} are too many; up to {most} are taken")]
    TooMany {
        /// Where.
        place: String,
        /// Of what.
        what: &'static str,
        /// The count.
        count: usize,
        /// The maximum.
        most: usize,
    },
}
