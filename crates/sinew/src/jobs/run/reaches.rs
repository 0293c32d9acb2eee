//! The reaches of a character in a run.

use crate::jobs::reach::ReachReport;
use sinew_reach::{ReachFrame, ReachMeter};
use sinew_stage::Stage;
use sinew_world::CharacterId;

/// Looks at the reach that a character is about.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct ReachWatch {
    /// Which of the character's reaches it is.
    number: u64,
    meter: ReachMeter,
    /// How many there were so far.
    count: usize,
}

/// Reaches that are reported.
const MAX_REACHES: usize = 1000;

impl ReachWatch {
    /// Looks at the stage after a step, and keeps the last of the reports as it is now.
    pub fn watch(&mut self, stage: &Stage, character: CharacterId, reports: &mut Vec<ReachReport>) {
        let spec = &stage.scene().stage;
        if !stage.frame().step.is_multiple_of(u64::from(spec.steps_per_frame())) {
            return;
        }
        let (Some(reach), Some(body)) = (stage.reach_of(character), stage.world().body(character)) else { return };
        let is_new = reach.number != self.number;
        if is_new {
            (self.number, self.meter) = (reach.number, ReachMeter::default());
            self.count += 1;
        }
        let Some(pose) = stage.frame().character(character).map(|seen| seen.pose()) else { return };
        let now = ReachFrame { secs: reach.now_secs, goal: reach.goal, pose };
        self.meter.watch(reach.reacher, body, &now, 1.0 / f64::from(spec.motion_hz));
        if self.count > MAX_REACHES {
            return;
        }
        let report = ReachReport::of(&self.meter, reach.reacher, reach.since_secs, reach.now_secs);
        match reports.last_mut().filter(|_| !is_new) {
            Some(last) => *last = report,
            None => reports.push(report),
        }
    }
}
