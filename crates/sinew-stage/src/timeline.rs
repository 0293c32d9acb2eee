//! Seeking a running stage: going back to an earlier step, and branching into what-if takes.

use crate::snapshots::Snapshots;
use crate::take::Stamped;
use crate::{Stage, StageError};

/// Records the commands and snapshots of a stage, seeks to any recorded step, and branches into further takes.
///
/// Call [`Timeline::watch`] after every step. [`Timeline::seek`] brings the stage to any recorded step, bit for bit as it was.
/// Stepping on from there replays the recorded commands up to the last recorded step; after that the stage is live again.
///
/// [`Timeline::what_if`] seeks and starts a new take without the later commands, so that others can be sent. A command sent after
/// [`Timeline::seek`], before the last recorded step, starts a new take too, but there the later recorded commands are replayed.
/// Existing takes never change, and [`Timeline::go_to`] returns to any of them.
///
/// Seeking restores the nearest earlier snapshot and simulates from it. At most [`Timeline::MAX_SNAPSHOTS`] are kept, at multiples
/// of an interval that begins at 60 steps (a quarter of a second at 240 Hz) and doubles whenever they become too many. A seek
/// therefore simulates at most one interval: a sixteenth of a take that has no branches, however long it is. A stage with
/// Python controllers is simulated from its start instead, because a snapshot cannot keep all of a script's state.
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
    /// The parent take and the step at which this one branched off; `None` for the first take.
    pub fn from(&self) -> Option<(usize, u64)> {
        self.from
    }

    /// Number of recorded steps, from the start of the scene.
    pub fn steps(&self) -> u64 {
        self.steps
    }

    /// The recorded commands with their steps, from the start of the scene.
    pub fn commands(&self) -> &[Stamped] {
        &self.commands
    }
}

/// Why a step cannot be sought.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum SeekError {
    /// No take has this number.
    #[error("there is no take {take}; there are {count}, numbered from 0")]
    NoTake {
        /// The take asked for.
        take: usize,
        /// Number of takes.
        count: usize,
    },
    /// The step lies beyond the end of the take.
    #[error("step {step} is beyond the {known} recorded steps of take {take}; step the stage on to it")]
    Beyond {
        /// The take.
        take: usize,
        /// The step asked for.
        step: u64,
        /// Number of recorded steps.
        known: u64,
    },
    /// The time line holds its maximum number of takes.
    #[error("there are {MAX_TAKES} takes already; start a new time line")]
    TooManyTakes,
    /// The stage was stepped before the time line was made.
    #[error("the stage has done {step} steps already; make the time line before its first step")]
    BegunLate {
        /// Number of steps done.
        step: u64,
    },
    /// The stage was stepped without [`Timeline::watch`].
    #[error("the stage is at step {step}, but the time line has recorded {seen}; call watch() after every step")]
    NotWatched {
        /// The stage's step.
        step: u64,
        /// The last recorded step.
        seen: u64,
    },
    /// The runner was made without a time line.
    #[error("the runner keeps no time line; make it with Runner::with_timeline()")]
    NoTimeline,
    /// The scene cannot be restarted, for example because one of its files is missing.
    #[error("the scene cannot be restarted: {0}")]
    Stage(#[from] StageError),
}

/// Maximum number of takes in a time line.
const MAX_TAKES: usize = 1000;

impl Timeline {
    /// Maximum number of snapshots kept.
    pub const MAX_SNAPSHOTS: usize = Snapshots::MAX;

    /// Starts recording a stage, before its first step.
    ///
    /// # Errors
    /// [`SeekError::BegunLate`] when the stage was stepped already.
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

    /// Records the step that the stage has just done.
    ///
    /// # Errors
    /// [`SeekError::NotWatched`] when steps are missing; [`SeekError::TooManyTakes`] when a new take is needed and there are 1000.
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
            // A new command among the recorded ones changes what follows: from here on this is another take.
            self.branch(step.saturating_sub(1), step, record.to_vec())?;
        }
        self.snapshots.offer(self.present, stage);
        Ok(())
    }

    /// Total number of physics steps simulated by seeking so far.
    pub fn steps_run(&self) -> u64 {
        self.steps_run
    }

    /// Number of snapshots kept at present.
    pub fn snapshots(&self) -> usize {
        self.snapshots.len()
    }

    /// All takes; the index is a take's number.
    pub fn takes(&self) -> &[KnownTake] {
        &self.takes
    }

    /// Number of the take that the stage is in.
    pub fn present(&self) -> usize {
        self.present
    }

    /// Seeks to a step of the present take, earlier or later.
    ///
    /// # Errors
    /// [`SeekError::Beyond`] when the take is shorter; [`SeekError::Stage`] when the scene cannot be restarted.
    pub fn seek(&mut self, stage: &mut Stage, step: u64) -> Result<(), SeekError> {
        self.go_to(stage, self.present, step)
    }

    /// Seeks to a step of any take. On an error the stage stays where it is.
    ///
    /// # Errors
    /// [`SeekError::NoTake`], [`SeekError::Beyond`], or [`SeekError::Stage`] when the scene cannot be restarted.
    pub fn go_to(&mut self, stage: &mut Stage, take: usize, step: u64) -> Result<(), SeekError> {
        let known = self.known(take, step)?;
        let commands = known.commands.clone();
        let Some(snapshot) = self.snapshots.nearest(&self.takes, take, step, stage) else {
            return self.go_to_watched(stage, take, step, &mut |_| {});
        };
        if stage.restore(&snapshot).is_err() {
            // Not expected: the snapshot is of this scene and holds no controller. Simulating from the start is always right.
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

    /// As [`Timeline::go_to`], but simulates from the start of the scene; calls `seen` at the start and after every step.
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

    /// Seeks to a step of the present take and starts a new take there, without the recorded commands that follow. Returns its
    /// number.
    ///
    /// # Errors
    /// As [`Timeline::seek`]; [`SeekError::TooManyTakes`] when there are 1000.
    pub fn what_if(&mut self, stage: &mut Stage, step: u64) -> Result<usize, SeekError> {
        self.seek(stage, step)?;
        self.branch_here(stage)
    }

    /// Starts a new take at the stage's present step.
    pub(crate) fn branch_here(&mut self, stage: &mut Stage) -> Result<usize, SeekError> {
        let step = stage.frame().step;
        self.branch(step, step, stage.record().to_vec())?;
        stage.prescribe_nothing();
        Ok(self.present)
    }

    /// Starts a new take that branches off the present one at `from_step`.
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
