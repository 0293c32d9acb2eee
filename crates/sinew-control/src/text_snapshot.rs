//! What is kept in a snapshot as its own text, which scenes and commands have: it changes rarely, and its keys may grow.

use crate::Command;
use crate::perform::PerformerSample;
use crate::source::SourceSpec;
use sinew_snapshot::{Reader, Snapshot, SnapshotError, Writer};

macro_rules! as_text {
    ($($of:ty),*) => { $(
        impl Snapshot for $of {
            fn save(&self, to: &mut Writer) {
                // A value that has no text is saved as none, which is an error of restoring.
                to.blob(&serde_json::to_vec(self).unwrap_or_default());
            }
            fn restore(&mut self, from: &mut Reader<'_>) -> Result<(), SnapshotError> {
                *self = serde_json::from_slice(from.blob()?).map_err(|_| SnapshotError::invalid(stringify!($of)))?;
                Ok(())
            }
        }
    )* };
}

as_text!(Command, SourceSpec, PerformerSample);
