//! A character's performer on the stage.

use sinew_control::perform::{LiveSource, Presence};

/// A performer's stream, and whether the character follows it at present.
pub(crate) struct Performance {
    source: LiveSource,
    followed: bool,
}

impl Performance {
    pub fn of(source: LiveSource) -> Performance {
        Performance { source, followed: true }
    }

    pub fn source(&self) -> &LiveSource {
        &self.source
    }

    pub fn source_mut(&mut self) -> &mut LiveSource {
        &mut self.source
    }

    pub fn is_followed(&self) -> bool {
        self.followed
    }

    pub fn follow(&mut self, on: bool) {
        self.followed = on;
    }

    /// Goes on by a step. Returns what the performer did, when it did something.
    pub fn advance(&mut self, now_secs: f64, step_secs: f64) -> Option<&'static str> {
        Some(match self.source.advance(now_secs, step_secs)? {
            Presence::Waiting => "waits for a performer",
            Presence::Performing => "is performed",
            Presence::Holding => "hears no performer and holds",
            Presence::Relaxed => "hears no performer and relaxes",
        })
    }
}
