//! The list of events.

use super::{Cause, Effect};
use serde::Serialize;
use sinew_snapshot::{Reader, Snapshot, SnapshotError, Writer};

/// An event of the stage, with its cause. In a report both are texts, as `Display` writes them.
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
    /// The list as it is kept.
    log: Writer,
}

/// Events that are kept.
const MAX_EVENTS: usize = 10_000;

impl Events {
    /// Adds an event. Untrusted texts are truncated to 400 bytes.
    pub fn note(&mut self, mut event: Event) {
        if self.list.len() >= MAX_EVENTS {
            self.dropped += 1;
            return;
        }
        event.effect.shorten();
        Kept {
            time_secs: event.time_secs,
            step: event.step,
            cause: event.cause.to_string(),
            effect: event.effect.to_string(),
        }
        .save(&mut self.log);
        self.list.push(event);
    }

    /// The kept events.
    pub fn list(&self) -> &[Event] {
        &self.list
    }

    /// Number of events that were not kept.
    pub fn dropped(&self) -> u64 {
        self.dropped
    }
}

/// An event as it is kept: its words.
#[derive(Default)]
struct Kept {
    time_secs: f64,
    step: u64,
    cause: String,
    effect: String,
}

sinew_snapshot::snapshot!(Kept { time_secs, step, cause, effect });

/// Events are kept in words. Restored into the stage that they happened in they are what they were; in another stage those from before
/// are [`Cause::Earlier`] and [`Effect::Earlier`].
impl Snapshot for Events {
    fn save(&self, to: &mut Writer) {
        self.dropped.save(to);
        self.list.len().save(to);
        to.blob(self.log.as_slice());
    }

    fn restore(&mut self, from: &mut Reader<'_>) -> Result<(), SnapshotError> {
        let mut count = 0_usize;
        self.dropped.restore(from)?;
        count.restore(from)?;
        let log = from.blob()?;
        if self.list.len() < count || !self.log.as_slice().starts_with(log) {
            self.list.clear();
            let mut earlier = Reader::new(log);
            for _ in 0..count.min(MAX_EVENTS) {
                let mut kept = Kept::default();
                kept.restore(&mut earlier)?;
                let Kept { time_secs, step, cause, effect } = kept;
                let (cause, effect) = (Cause::Earlier { words: cause }, Effect::Earlier { words: effect });
                self.list.push(Event { time_secs, step, cause, effect });
            }
        }
        self.list.truncate(count);
        self.log = Writer::new();
        self.log.bytes(log);
        Ok(())
    }
}
