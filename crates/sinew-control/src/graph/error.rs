//! What can be wrong with a pose graph.

use crate::pose::PartName;

/// Why a graph cannot be played.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum GraphError {
    /// A state that is not there.
    #[error("{place}: there is no state {name:?}; the states are {known}")]
    UnknownState {
        /// Where it is named.
        place: String,
        /// The name.
        name: String,
        /// What there is.
        known: String,
    },
    /// A pose that is not there.
    #[error("state {state:?}: there is no pose {name:?}; there are: {known}")]
    UnknownPose {
        /// Where it is named.
        state: String,
        /// The name.
        name: String,
        /// What there is.
        known: String,
    },
    /// A name in a condition that stands for nothing.
    #[error(
        "{place}: nothing is called {name:?}; name an own part ({parts}), self, centre, ground, a character's part as name.part, \
         or one of: {known}",
        parts = PartName::list()
    )]
    UnknownName {
        /// Where it is named.
        place: String,
        /// The name.
        name: String,
        /// What there is.
        known: String,
    },
    /// A condition that makes no sense.
    #[error("{place}: {problem}")]
    Condition {
        /// Where it stands.
        place: String,
        /// What is wrong and what to do.
        problem: String,
    },
    /// Too much of something.
    #[error("{place}: {count} {what} are too many; up to {most} are taken")]
    TooMany {
        /// Where.
        place: String,
        /// Of what.
        what: &'static str,
        /// How many there are.
        count: usize,
        /// How many may be.
        most: usize,
    },
}
