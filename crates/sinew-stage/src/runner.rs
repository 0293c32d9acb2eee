//! The runner of a stage: pace, observers, recording, take.

use crate::take::{HashTrace, Take};
use crate::{Pacer, Recording, SeekError, Stage, Timeline};

/// An observer gives a stage commands and reads its frames: a keyboard, a session's network, a report, a progress bar.
pub trait Observer {
    /// Called before every step. Commands that are given here are applied in this step, and recorded in the take.
    fn before_step(&mut self, _stage: &mut Stage) {}

    /// Called after every step, when its frame is there.
    fn after_step(&mut self, _stage: &Stage) {}

    /// Asked before every step: `true` ends the run.
    fn should_stop(&self) -> bool {
        false
    }
}

/// Runs a stage step by step; optionally in real time, with its motion recorded and its take kept.
///
/// Before each step it waits until the step is due and calls [`Observer::before_step`] of all observers in their order;
/// after it [`Observer::after_step`], then it records. Without any observer, pace or recording it does what
/// [`Stage::step`] does.
///
/// ```
/// use sinew_stage::{Observer, Runner, Scene, Stage};
///
/// struct Lowest(f64);
///
/// impl Observer for Lowest {
///     fn after_step(&mut self, stage: &Stage) {
///         self.0 = self.0.min(stage.frame().props[0].position.y);
///     }
/// }
///
/// let scene = Scene::from_text("format = 1\n[props.ball]\nball_radius_m = 0.1\nmass_kg = 1\nposition_m = [0, 1, 0]")?;
/// let mut lowest = Lowest(f64::INFINITY);
/// let mut runner = Runner::new(Stage::new(scene, None)?).with_motion().with_take();
/// runner.run(240, &mut [&mut lowest]);
/// assert!(lowest.0 < 0.11);
///
/// let done = runner.finish();
/// assert_eq!(done.recording.map(|recording| recording.frames), Some(61));
/// assert_eq!(done.take.map(|take| take.hash), Some(done.stage.hash()));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub struct Runner {
    stage: Stage,
    steps_per_frame: u64,
    is_paced: bool,
    pacer: Option<Pacer>,
    recording: Option<Recording>,
    trace: Option<Vec<u64>>,
    timeline: Option<Timeline>,
}

/// The result of a run.
pub struct Finished {
    /// The stage after its last step.
    pub stage: Stage,
    /// Its motion, if it was recorded.
    pub recording: Option<Recording>,
    /// Everything needed to run it again, if it was kept.
    pub take: Option<Take>,
    /// Number of times that the machine fell so far behind real time that time was skipped; see [`Pacer`].
    pub lapses: u64,
}

/// Physics steps between two hashes of a take's trace: one a second at 240 Hz.
const TRACE_STEPS: u64 = 240;

impl Runner {
    /// Maximum duration of recorded motion \[s\]; later frames are left out.
    pub const MAX_MOTION_SECS: f64 = 3600.0;

    /// Runs a stage as fast as the machine can, and keeps nothing: no motion, no commands.
    pub fn new(mut stage: Stage) -> Runner {
        stage.keep_record(false);
        let steps_per_frame = u64::from(stage.scene().stage.steps_per_frame()).max(1);
        Runner { stage, steps_per_frame, is_paced: false, pacer: None, recording: None, trace: None, timeline: None }
    }

    /// Runs in real time: one second of the stage takes one second. The clock starts with the next step.
    #[must_use]
    pub fn paced(mut self) -> Runner {
        self.is_paced = true;
        self
    }

    /// Records the motion from now on, at the scene's motion rate, up to [`Runner::MAX_MOTION_SECS`].
    #[must_use]
    pub fn with_motion(mut self) -> Runner {
        let mut recording = Recording::new(&self.stage);
        recording.push(&self.stage);
        self.recording = Some(recording);
        self
    }

    /// Keeps the take: commands from outside, and the hash of every 240th step. A take begins where its scene does: of a stage
    /// that has already run a step none is kept.
    #[must_use]
    pub fn with_take(mut self) -> Runner {
        if self.stage.frame().step == 0 {
            self.stage.keep_record(true);
            self.trace = Some(Vec::new());
        }
        self
    }

    /// Keeps a time line, so that [`Runner::seek`], [`Runner::go_to`] and [`Runner::what_if`] can go back.
    ///
    /// # Errors
    /// When the stage has done a step already.
    pub fn with_timeline(mut self) -> Result<Runner, SeekError> {
        self.timeline = Some(Timeline::new(&mut self.stage)?);
        Ok(self)
    }

    /// The time line, if one is kept.
    pub fn timeline(&self) -> Option<&Timeline> {
        self.timeline.as_ref()
    }

    /// Goes to a step of the present take, earlier or later. The motion and the take that are kept are those until then.
    ///
    /// # Errors
    /// Without a time line, or when the take does not go so far; everything is as before then.
    pub fn seek(&mut self, step: u64) -> Result<(), SeekError> {
        let present = self.timeline.as_ref().ok_or(SeekError::NoTimeline)?.present();
        self.go_to(present, step)
    }

    /// Goes to a step of any take; see [`Timeline::go_to`].
    ///
    /// # Errors
    /// Without a time line, without such a take, or when it does not go so far; everything is as before then.
    pub fn go_to(&mut self, take: usize, step: u64) -> Result<(), SeekError> {
        let timeline = self.timeline.as_mut().ok_or(SeekError::NoTimeline)?;
        // The clock starts anew.
        self.pacer = None;
        if self.recording.is_none() && self.trace.is_none() {
            return timeline.go_to(&mut self.stage, take, step);
        }
        // Motion and trace from the start must be seen again.
        let mut recording = self.recording.as_ref().map(|_| Recording::new(&self.stage));
        let mut trace = self.trace.as_ref().map(|_| Vec::new());
        let steps_per_frame = self.steps_per_frame;
        timeline.go_to_watched(&mut self.stage, take, step, &mut |stage| {
            keep(stage, steps_per_frame, recording.as_mut(), trace.as_mut());
        })?;
        (self.recording, self.trace) = (recording, trace);
        Ok(())
    }

    /// Goes to a step of the present take and begins another take there, free of the commands that came after; see
    /// [`Timeline::what_if`]. Returns its number.
    ///
    /// # Errors
    /// As [`Runner::seek`], and when there are too many takes.
    pub fn what_if(&mut self, step: u64) -> Result<usize, SeekError> {
        self.seek(step)?;
        self.timeline.as_mut().ok_or(SeekError::NoTimeline)?.branch_here(&mut self.stage)
    }

    /// The stage as it is now.
    pub fn stage(&self) -> &Stage {
        &self.stage
    }

    /// The stage, to give it commands.
    pub fn stage_mut(&mut self) -> &mut Stage {
        &mut self.stage
    }

    /// The motion so far, if it is recorded.
    pub fn recording(&self) -> Option<&Recording> {
        self.recording.as_ref()
    }

    /// Runs until so many physics steps are done since the stage began, or an observer stops the run.
    pub fn run(&mut self, until_step: u64, observers: &mut [&mut dyn Observer]) {
        while self.stage.frame().step < until_step && !observers.iter().any(|observer| observer.should_stop()) {
            self.step(observers);
        }
    }

    /// One physics step with pacing, observers and recording.
    pub fn step(&mut self, observers: &mut [&mut dyn Observer]) {
        if self.is_paced {
            let step = self.stage.frame().step;
            let step_secs = self.stage.world().settings().step_secs();
            self.pacer.get_or_insert_with(|| Pacer::new(step, step_secs)).wait(step);
        }
        for observer in observers.iter_mut() {
            observer.before_step(&mut self.stage);
        }
        self.stage.step();
        for observer in observers.iter_mut() {
            observer.after_step(&self.stage);
        }
        self.keep();
    }

    /// Keeps of the finished step what is to be kept.
    fn keep(&mut self) {
        keep(&self.stage, self.steps_per_frame, self.recording.as_mut(), self.trace.as_mut());
        if let Some(timeline) = &mut self.timeline {
            // It sees every step; only takes beyond the thousandth are not kept apart.
            let _ = timeline.watch(&self.stage);
        }
    }

    /// The take of the run so far, if it is kept.
    pub fn take(&self) -> Option<Take> {
        let trace = self.trace.as_ref()?;
        let mut take = self.stage.empty_take();
        take.commands = self.stage.record().to_vec();
        (take.steps, take.hash) = (self.stage.frame().step, self.stage.hash());
        take.trace = Some(HashTrace { every_steps: TRACE_STEPS, hashes: trace.clone() });
        Some(take)
    }

    /// Ends the run and returns its result.
    pub fn finish(self) -> Finished {
        let take = self.take();
        let lapses = self.pacer.as_ref().map_or(0, Pacer::lapses);
        Finished { stage: self.stage, recording: self.recording, take, lapses }
    }
}

/// Keeps of a step what is to be kept: its motion, and its hash for the take.
fn keep(stage: &Stage, steps_per_frame: u64, recording: Option<&mut Recording>, trace: Option<&mut Vec<u64>>) {
    let frame = stage.frame();
    if let Some(recording) = recording
        && frame.step.is_multiple_of(steps_per_frame)
        && frame.time_secs <= Runner::MAX_MOTION_SECS
    {
        recording.push(stage);
    }
    if let Some(trace) = trace
        && frame.step > 0
        && frame.step.is_multiple_of(TRACE_STEPS)
    {
        trace.push(stage.hash());
    }
}
