//! The snapshots of a time line: at an interval, in bounded memory.

use crate::timeline::KnownTake;
use crate::{Stage, StageSnapshot};
use std::sync::Arc;

/// Snapshots of takes at multiples of an interval that doubles when there are too many.
#[derive(Clone, Debug)]
pub(crate) struct Snapshots {
    /// Each with the take that it was taken in.
    kept: Vec<(usize, Arc<StageSnapshot>)>,
    every_steps: u64,
}

/// The interval at first \[steps\]: a quarter of a second at 240 Hz, which takes milliseconds to run again.
const FIRST_EVERY_STEPS: u64 = 60;

impl Default for Snapshots {
    fn default() -> Snapshots {
        Snapshots { kept: Vec::new(), every_steps: FIRST_EVERY_STEPS }
    }
}

impl Snapshots {
    /// Maximum number that is kept.
    pub const MAX: usize = 32;

    /// Number that is kept.
    pub fn len(&self) -> usize {
        self.kept.len()
    }

    /// Keeps a snapshot of a stage that is in a take, when it is due.
    pub fn offer(&mut self, take: usize, stage: &Stage) {
        let step = stage.frame().step;
        let is_known = |(of, kept): &(usize, Arc<StageSnapshot>)| *of == take && kept.step() == step;
        if !step.is_multiple_of(self.every_steps) || !stage.scripts.is_empty() || self.kept.iter().any(is_known) {
            return;
        }
        while self.kept.len() >= Snapshots::MAX {
            self.thin_out();
        }
        if step.is_multiple_of(self.every_steps) {
            self.kept.push((take, Arc::new(stage.snapshot_of_run())));
        }
    }

    /// Doubles the interval. When takes branch so often that this drops nothing, the oldest one goes; the start stays.
    fn thin_out(&mut self) {
        let before = self.kept.len();
        self.every_steps = self.every_steps.saturating_mul(2);
        self.kept.retain(|(_, kept)| kept.step().is_multiple_of(self.every_steps));
        if self.kept.len() == before
            && let Some(oldest) = self.kept.iter().position(|(_, kept)| kept.step() > 0)
        {
            self.kept.remove(oldest);
        }
    }

    /// The last one at or before a step of a take, also of the takes that it branched off; of the stage's scene.
    pub fn nearest(&self, takes: &[KnownTake], take: usize, step: u64, stage: &Stage) -> Option<Arc<StageSnapshot>> {
        let (mut of, mut until) = (take, step);
        loop {
            let here = self.kept.iter().filter(|(in_take, kept)| *in_take == of && kept.step() <= until);
            if let Some((_, kept)) = here.max_by_key(|(_, kept)| kept.step()) {
                return kept.is_of(&stage.scene).then(|| Arc::clone(kept));
            }
            // A take branches off an earlier one, so this ends.
            let (from, branched) = takes.get(of)?.from()?;
            (of, until) = (from, until.min(branched));
        }
    }
}
