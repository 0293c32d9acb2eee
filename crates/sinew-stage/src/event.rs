//! What happened, for the report.

use serde::Serialize;

/// Something that happened on the stage, with its cause.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Event {
    /// When \[s\].
    pub time_secs: f64,
    /// In which physics step.
    pub step: u64,
    /// Why.
    pub cause: String,
    /// What.
    pub effect: String,
}

/// Events so far. Of very many only the first are kept, and the rest counted.
#[derive(Clone, Debug, Default)]
pub struct Events {
    list: Vec<Event>,
    dropped: u64,
}

/// Events that are kept.
const MAX_EVENTS: usize = 10_000;

/// Length of a cause or an effect that is kept \[bytes\].
const MAX_TEXT: usize = 400;

impl Events {
    /// Notes an event.
    pub fn note(&mut self, event: Event) {
        if self.list.len() >= MAX_EVENTS {
            self.dropped += 1;
            return;
        }
        self.list.push(Event { cause: cut(event.cause), effect: cut(event.effect), ..event });
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

fn cut(mut text: String) -> String {
    if text.len() > MAX_TEXT {
        let end = (0..=MAX_TEXT).rev().find(|&at| text.is_char_boundary(at)).unwrap_or(0);
        text.truncate(end);
        text.push('…');
    }
    text
}
