//! The time line of a stage that runs: any earlier time again, and what would have happened otherwise.

use crate::snapshots::Snapshots;
use crate::take::Stamped;
use crate::{Stage, StageError};

/// Knows what was done to a stage, goes back to any earlier step, and runs on from there as another take.
///
/// Call [`Timeline::watch`] after every step. [`Timeline::seek`] brings the stage to any step that is known, with the commands
/// that were given then; it is bit for bit what it was. Running on past it gives the same commands again, to the end of what is
/// known, and after that it is the present again.
///
/// [`Timeline::what_if`] seeks too, but what was to come is left out: the stage is free to be given other commands, in a take of its
/// own. A command that is given after seeking, before the end of what is known, begins a take of its own as well, in which the
/// known commands that follow are given again. The takes before stay as they are, and [`Timeline::go_to`] goes back to them.
///
/// It keeps snapshots of the stage, at most [`Timeline::MAX_SNAPSHOTS`], and seeks by restoring the nearest one before the step
/// and running on from there. They lie at multiples of an interval, at first a quarter of a second at 240 Hz; when there are too many
/// the interval doubles and those between are dropped. So seeking runs at most as many steps as the interval, which is a share of
/// the whole that does not grow: a sixteenth, when no other takes are there. A stage with controllers in Python is run
/// again from its start instead: what of their state a snapshot cannot keep would change the run.
///
/// ```
/// use sinew_control::{Action, Command};
/// use sinew_stage::{Scene, Stage, Timeline};
///
/// let scene = Scene::from_text("format = 1\n[props.ball]\nball_radius_m = 0.1\nmass_kg = 1\nposition_m = [0, 1, 0]")?;
/// let mut stage = Stage::new(scene, None)?;
/// let mut timeline = Timeline::new(&mut stage)?;
/// for _ in 0..120 {
///     stage.step();
///     timeline.watch(&stage)?;
/// }
/// let (height, hash) = (stage.frame().props[0].position.y, stage.hash());
///
/// // What if the ball had lost its weight after 60 steps?
/// let other = timeline.what_if(&mut stage, 60)?;
/// let on = Some("ball".to_owned());
/// stage.command(Command::stage(Action::Gravity { scale: 0.0, on, part: None, over_secs: None, for_secs: None }));
/// for _ in 0..30 {
///     stage.step();
///     timeline.watch(&stage)?;
/// }
/// assert!(stage.frame().props[0].position.y > height);
///
/// // And the first take as it was.
/// timeline.go_to(&mut stage, 0, 120)?;
/// assert_eq!(stage.hash(), hash);
/// assert_eq!((other, timeline.takes().len()), (1, 2));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct Timeline {
    takes: Vec<KnownTake>,
    present: usize,
    snapshots: Snapshots,
    steps_run: u64,
}

/// A take of a [`Timeline`].
#[derive(Clone, Debug)]
pub struct KnownTake {
    from: Option<(usize, u64)>,
    steps: u64,
    commands: Vec<Stamped>,
}

impl KnownTake {
    /// The take that it branched off, and after how many steps; `None` for the first.
    pub fn from(&self) -> Option<(usize, u64)> {
        self.from
    }

    /// Steps that are known of it, from the beginning of the scene.
    pub fn steps(&self) -> u64 {
        self.steps
    }

    /// All commands from outside with their steps, from the beginning of the scene.
    pub fn commands(&self) -> &[Stamped] {
        &self.commands
    }
}

/// Why a time cannot be gone to.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum SeekError {
    /// No take has this number.
    #[error("there is no take {take}; there are {count}, numbered from 0")]
    NoTake {
        /// What was asked for.
        take: usize,
        /// How many there are.
        count: usize,
    },
    /// The take does not go so far.
    #[error("step {step} is beyond the {known} steps that are known of take {take}; run on to it")]
    Beyond {
        /// The take.
        take: usize,
        /// What was asked for.
        step: u64,
        /// How far the take goes.
        known: u64,
    },
    /// There are as many takes as a time line holds.
    #[error("there are {MAX_TAKES} takes already; begin a new time line")]
    TooManyTakes,
    /// The stage had run before the time line began.
    #[error("the stage has done {step} steps already; begin the time line before its first step")]
    BegunLate {
        /// How many.
        step: u64,
    },
    /// The stage was stepped without [`Timeline::watch`].
    #[error("the stage is at step {step}, and the time line has seen {seen}; call watch() after every step")]
    NotWatched {
        /// Where the stage is.
        step: u64,
        /// The last step that was watched.
        seen: u64,
    },
    /// A runner keeps no time line.
    #[error("the runner keeps no time line; make it with Runner::with_timeline()")]
    NoTimeline,
    /// The scene cannot be started again, such as when a file of its is gone.
    #[error("the scene cannot be started again: {0}")]
    Stage(#[from] StageError),
}

/// Takes of one time line.
const MAX_TAKES: usize = 1000;

impl Timeline {
    /// Maximum number of snapshots that it keeps.
    pub const MAX_SNAPSHOTS: usize = Snapshots::MAX;

    /// Begins before the first step of a stage, which keeps its record from now on.
    ///
    /// # Errors
    /// When the stage has done a step.
    pub fn new(stage: &mut Stage) -> Result<Timeline, SeekError> {
        let step = stage.frame().step;
        if step > 0 {
            return Err(SeekError::BegunLate { step });
        }
        stage.keep_record(true);
        let first = KnownTake { from: None, steps: 0, commands: Vec::new() };
        let mut timeline = Timeline { takes: vec![first], present: 0, snapshots: Snapshots::default(), steps_run: 0 };
        timeline.snapshots.offer(0, stage);
        Ok(timeline)
    }

    /// Takes a step down that the stage has just done.
    ///
    /// # Errors
    /// When steps are missing, or there are a thousand takes already.
    pub fn watch(&mut self, stage: &Stage) -> Result<(), SeekError> {
        let (step, record) = (stage.frame().step, stage.record());
        let take = &mut self.takes[self.present];
        if step > take.steps + 1 {
            return Err(SeekError::NotWatched { step, seen: take.steps });
        }
        let known = take.commands.partition_point(|stamped| stamped.step < step);
        if step > take.steps {
            take.steps = step;
            take.commands.extend_from_slice(record.get(known..).unwrap_or_default());
        } else if record.len() != known {
            // In the middle of what is known a command was given: from here on this is another take.
            self.branch(step.saturating_sub(1), step, record.to_vec())?;
        }
        self.snapshots.offer(self.present, stage);
        Ok(())
    }

    /// Physics steps that seeking has run so far, from the snapshots to the steps that were sought.
    pub fn steps_run(&self) -> u64 {
        self.steps_run
    }

    /// Number of snapshots that it keeps at present.
    pub fn snapshots(&self) -> usize {
        self.snapshots.len()
    }

    /// The takes, the first one being number 0.
    pub fn takes(&self) -> &[KnownTake] {
        &self.takes
    }

    /// The number of the take that the stage is in.
    pub fn present(&self) -> usize {
        self.present
    }

    /// Goes to a step of the present take, earlier or later.
    ///
    /// # Errors
    /// When the take does not go so far.
    pub fn seek(&mut self, stage: &mut Stage, step: u64) -> Result<(), SeekError> {
        self.go_to(stage, self.present, step)
    }

    /// Goes to a step of any take. When that cannot be done the stage stays where it is.
    ///
    /// # Errors
    /// When there is no such take, or it does not go so far.
    pub fn go_to(&mut self, stage: &mut Stage, take: usize, step: u64) -> Result<(), SeekError> {
        let known = self.known(take, step)?;
        let commands = known.commands.clone();
        let Some(snapshot) = self.snapshots.nearest(&self.takes, take, step, stage) else {
            return self.go_to_watched(stage, take, step, &mut |_| {});
        };
        if stage.restore(&snapshot).is_err() {
            // It is of this scene and holds no controller.
            return self.go_to_watched(stage, take, step, &mut |_| {});
        }
        stage.record = commands[..commands.partition_point(|stamped| stamped.step < snapshot.step())].to_vec();
        stage.prescribe(commands);
        self.run_to(stage, take, step, &mut |_| {});
        self.present = take;
        Ok(())
    }

    fn known(&self, take: usize, step: u64) -> Result<&KnownTake, SeekError> {
        let known = self.takes.get(take).ok_or(SeekError::NoTake { take, count: self.takes.len() })?;
        if step > known.steps {
            return Err(SeekError::Beyond { take, step, known: known.steps });
        }
        Ok(known)
    }

    fn run_to(&mut self, stage: &mut Stage, take: usize, step: u64, seen: &mut dyn FnMut(&Stage)) {
        while stage.frame().step < step {
            stage.step();
            self.steps_run += 1;
            self.snapshots.offer(take, stage);
            seen(stage);
        }
    }

    /// As [`Timeline::go_to`], from the start of the scene; `seen` is shown the stage there and after every step.
    pub(crate) fn go_to_watched(
        &mut self,
        stage: &mut Stage,
        take: usize,
        step: u64,
        seen: &mut dyn FnMut(&Stage),
    ) -> Result<(), SeekError> {
        let commands = self.known(take, step)?.commands.clone();
        let mut again = stage.again()?;
        again.prescribe(commands);
        seen(&again);
        self.run_to(&mut again, take, step, seen);
        *stage = again;
        self.present = take;
        Ok(())
    }

    /// Goes to a step of the present take and begins another take there, in which nothing is prescribed. Returns its number.
    ///
    /// # Errors
    /// When the take does not go so far, or there are a thousand takes already.
    pub fn what_if(&mut self, stage: &mut Stage, step: u64) -> Result<usize, SeekError> {
        self.seek(stage, step)?;
        self.branch_here(stage)
    }

    /// Begins another take where the stage is now.
    pub(crate) fn branch_here(&mut self, stage: &mut Stage) -> Result<usize, SeekError> {
        let step = stage.frame().step;
        self.branch(step, step, stage.record().to_vec())?;
        stage.prescribe_nothing();
        Ok(self.present)
    }

    /// Begins another take, which leaves the present one after so many steps.
    fn branch(&mut self, from_step: u64, steps: u64, commands: Vec<Stamped>) -> Result<(), SeekError> {
        if self.takes.len() >= MAX_TAKES {
            return Err(SeekError::TooManyTakes);
        }
        let from = Some((self.present, from_step));
        self.present = self.takes.len();
        self.takes.push(KnownTake { from, steps, commands });
        Ok(())
    }
}
