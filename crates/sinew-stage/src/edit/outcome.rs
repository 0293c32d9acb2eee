//! What becomes of each key of an edit.

use crate::build::StageError;
use crate::scene::SceneError;
use std::fmt;

/// A key whose value was edited, and what becomes of it.
#[derive(Clone, Debug, PartialEq)]
pub struct Edited {
    /// The key's path, as `characters.left.pose_gain`.
    pub path: String,
    /// Whether the running stage follows.
    pub outcome: EditOutcome,
}

/// Whether a running stage follows an edit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum EditOutcome {
    /// It does, from the next step on.
    Applied,
    /// It takes effect when the scene is started again.
    NeedsRestart(RestartReason),
}

/// Why an edit takes effect only when the scene is started again.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum RestartReason {
    /// Rates: a running stage counts its time in steps of one length.
    Rates,
    /// The world is made with it: its floor, its solver.
    World,
    /// Seeds: what was chosen by the old one has happened.
    Seed,
    /// A body keeps its mass, size and skin as long as it is on the stage.
    Body,
    /// It says how something begins, and that has begun.
    Start,
    /// A character has its performer from the start, or none.
    Performer,
    /// The prop is fastened by a joint, or a character's tracker knows it.
    Fastened,
    /// A running controller keeps its class; its text can be edited.
    Controller,
    /// The command's time is over.
    Past,
    /// Nothing on the stage follows this key.
    Unknown,
}

impl fmt::Display for RestartReason {
    /// The reason and what to do.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            RestartReason::Rates => "time is counted in steps of one length; start the scene again",
            RestartReason::World => "the world is made with it; start the scene again",
            RestartReason::Seed => "what was chosen by the old seed has happened; start the scene again",
            RestartReason::Body => {
                "a body stays as it is while it is there; remove the character and add it under another name, or start the scene again"
            }
            RestartReason::Start => "it says how something begins; start the scene again",
            RestartReason::Performer => "a character has its performer from the start; start the scene again",
            RestartReason::Fastened => {
                "the prop is fastened, or a character knows it; remove it with its joints and add it under another name, or start the \
                 scene again"
            }
            RestartReason::Controller => "a running controller keeps its class; start the scene again",
            RestartReason::Past => "its time is over; start the scene again, or give it a later time",
            RestartReason::Unknown => "nothing on the stage follows it; start the scene again",
        })
    }
}

/// Why a scene cannot be edited. Nothing was changed.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum EditError {
    /// The text is no sound scene.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// Something of it cannot come onto the stage.
    #[error(transparent)]
    Stage(#[from] StageError),
}
