//! The list of events.

use super::{Cause, Effect};
use serde::Serialize;

/// Something that happened on the stage, with its cause. In a report both are texts, as `Display` writes them.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Event {
    /// When \[s\].
    pub time_secs: f64,
    /// In which physics step.
    pub step: u64,
    /// Why.
    pub cause: Cause,
    /// What.
    pub effect: Effect,
}

/// Events so far. Of very many only the first are kept, and the rest counted.
#[derive(Clone, Debug, Default)]
pub struct Events {
    list: Vec<Event>,
    dropped: u64,
}

/// Events that are kept.
const MAX_EVENTS: usize = 10_000;

impl Events {
    /// Notes an event. Of a text that somebody else wrote the first 400 bytes are kept.
    pub fn note(&mut self, mut event: Event) {
        if self.list.len() >= MAX_EVENTS {
            self.dropped += 1;
            return;
        }
        event.effect.shorten();
        self.list.push(event);
    }

    /// Those that were kept.
    pub fn list(&self) -> &[Event] {
        &self.list
    }

    /// How many more there were.
    pub fn dropped(&self) -> u64 {
        self.dropped
    }
}
