//! Progress of a run, on a terminal.

use indicatif::{ProgressBar, ProgressStyle};
use sinew::stage::{Observer, Stage};

/// A progress bar on a terminal, nothing when piped; it is cleared when this is dropped.
pub(crate) struct Progress(ProgressBar);

/// Steps between two updates of the bar.
const STEPS_PER_UPDATE: u64 = 60;

impl Progress {
    /// Of a run of so many steps.
    pub(crate) fn of(steps: u64) -> Progress {
        let bar = ProgressBar::new(steps);
        if let Ok(style) = ProgressStyle::with_template("{bar:40} {percent} % {elapsed}, {eta} left") {
            bar.set_style(style);
        }
        Progress(bar)
    }
}

impl Observer for Progress {
    fn after_step(&mut self, stage: &Stage) {
        let step = stage.frame().step;
        if step.is_multiple_of(STEPS_PER_UPDATE) {
            self.0.set_position(step);
        }
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        self.0.finish_and_clear();
    }
}
