//! From a target to a motion.

use super::report::ReachReport;
use glam::{DQuat, DVec3};
use sinew_body::humanoid::{Body, Node, Person, Pose, Reduction, ReductionError};
use sinew_control::source::{ClipSource, HAND_OVER_SECS, Source as _, handed_over};
use sinew_motion::formats::MotionFile;
use sinew_motion::resample;
use sinew_reach::{
    Goal, MovingGoal, MovingGoalError, Obstacle, ReachMeter, ReachPlayback, Reacher, Start, Style, StyleError,
    Waypoint, standing,
};
use sinew_stage::{OwnRig, RecordedCharacter, RecordedProp, Recording};
use sinew_world::{CharacterId, Form, PropId, Solid, hips_over_soles_m};

/// Which hand reaches.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Hand {
    /// The left one.
    Left,
    /// The right one.
    Right,
    /// The one on the target's side.
    #[default]
    Auto,
}

/// Where a target is at a time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MovingPoint {
    /// The place, as [`ReachJob::target`] \[m\].
    pub at: DVec3,
    /// When \[s\].
    pub secs: f64,
}

/// A ball in the way.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ball {
    /// Its centre, as [`ReachJob::target`] \[m\].
    pub at: DVec3,
    /// Its radius \[m\].
    pub radius_m: f64,
}

/// What is to be reached, by whom, and how. Places are in the character's facing frame at the start (x to its left, y up, z
/// forward), with the origin on the floor between the feet.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ReachJob {
    /// The target of one hand \[m\].
    pub target: Option<DVec3>,
    /// Which hand that is.
    pub hand: Hand,
    /// The left hand's own target \[m\].
    pub left: Option<DVec3>,
    /// The right hand's own target \[m\].
    pub right: Option<DVec3>,
    /// Where the target goes; before the first point it is at `target`, or, without one, at that point already.
    pub moving: Vec<MovingPoint>,
    /// What the arms keep clear of.
    pub avoid: Vec<Ball>,
    /// Mass and height of the body.
    pub person: Person,
    /// How it reaches.
    pub style: Style,
    /// When the clip is left for the reach \[s\], where there is a clip.
    pub from_secs: f64,
    /// Stand up again afterwards; out of a clip, go on with it.
    pub back: bool,
}

/// A reach: the motion, and what came of it.
#[derive(Clone, Debug)]
pub struct Reached {
    /// What was decided and achieved.
    pub report: ReachReport,
    /// The motion, with the targets as balls.
    pub recording: Recording,
    /// Where the character faced at the start \[rad\].
    pub facing_rad: f64,
    /// Frames until the clip, where there is one, goes on.
    reach_frames: usize,
}

impl Reached {
    /// The skeleton of the clip that was left, to give the motion back on: [`OwnRig::clip`] of the recording's poses. What the body does
    /// not tell, such as fingers, stays as it was when the clip was left, until that goes on.
    ///
    /// # Errors
    /// When the clip holds no body.
    pub fn own_rig(&self, job: &ReachJob, file: &MotionFile) -> Result<OwnRig, ReachError> {
        let reduction = Reduction::new(&file.clip, file.body_parts()?, file.stature_m, job.person)?;
        let base = resample(&file.clip, HZ);
        let last = file.clip.frames().saturating_sub(1);
        let row = |frame: usize| ((frame as f64 * file.clip.fps() / HZ).round() as usize).min(last);
        let rows = (0..base.frames()).map(row).collect();
        let left = (job.from_secs * HZ).round() as usize;
        let frame =
            |index: usize| (left + index.saturating_sub(self.reach_frames)).min(base.frames().saturating_sub(1));
        let frames = (0..self.recording.frames).map(frame).collect();
        Ok(OwnRig::of_file(file.clone(), reduction, base, rows, frames))
    }
}

/// Why a reach cannot be made.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ReachError {
    /// A dial is out of range.
    #[error(transparent)]
    Style(#[from] StyleError),
    /// A target that is out of range, or whose times are.
    #[error(transparent)]
    Goal(#[from] MovingGoalError),
    /// Neither hand has a target.
    #[error(
        "nothing to reach; state ReachJob::target in metres: x to the left, y up, z forward, or a first point of ReachJob::moving"
    )]
    NoTarget,
    /// The clip ends before it is to be left.
    #[error("ReachJob::from_secs: the clip ends at {ends_secs:.2} s; leave it before, not at {from_secs} s")]
    ClipEnds {
        /// Its end \[s\].
        ends_secs: f64,
        /// When it was to be left \[s\].
        from_secs: f64,
    },
    /// The clip's skeleton is no body.
    #[error(transparent)]
    Body(#[from] ReductionError),
    /// The clip.
    #[error(transparent)]
    Clip(#[from] sinew_motion::Error),
}

impl ReachError {
    /// Whether the job asks for what cannot be: a number of [`ReachJob`] out of range.
    pub fn is_of_job(&self) -> bool {
        !matches!(self, ReachError::Clip(_)) && !matches!(self, ReachError::Body(error) if !is_person(error))
    }
}

fn is_person(error: &ReductionError) -> bool {
    matches!(error, ReductionError::Person { .. })
}

/// Frames per second of the motion.
const HZ: f64 = 60.0;

/// Makes the motion of a reach, from standing or from a clip.
///
/// ```
/// use glam::DVec3;
/// use sinew::jobs::reach::{ReachJob, reach};
/// let job = ReachJob { target: Some(DVec3::new(0.4, 1.4, 0.5)), ..ReachJob::default() };
/// let reached = reach(&job, None)?;
/// assert!(reached.report.reached && reached.report.hand_error_m < 1e-3);
/// # Ok::<(), sinew::jobs::reach::ReachError>(())
/// ```
///
/// # Errors
/// When there is no target, a number is out of range, or the clip holds no body.
pub fn reach(job: &ReachJob, clip: Option<&MotionFile>) -> Result<Reached, ReachError> {
    job.check()?;
    let (body, mut clip) = match clip {
        Some(clip) => {
            let (body, motion) = from_clip(job, clip)?;
            (body, Some(motion))
        }
        None => (Body::standard(job.person.mass_kg, job.person.height_m.unwrap_or(1.7)), None),
    };
    let start = match &clip {
        // At its beginning nothing was before.
        Some(clip) => {
            let before = (job.from_secs >= 1.0 / HZ).then(|| (clip.pose_at(-1.0 / HZ), 1.0 / HZ));
            Start { pose: clip.pose_at(0.0), before }
        }
        None => Start { pose: standing(&body, DVec3::ZERO, 0.0), before: None },
    };
    let facing_rad = facing(&start.pose);
    let place = between_feet(&body, &start.pose);
    let world = |point: DVec3| place + DQuat::from_rotation_y(facing_rad) * point;
    let hand = job.chosen_hand();
    let first = |side: usize| -> Option<DVec3> {
        let own = if side == 0 { job.left } else { job.right };
        let of_one = || job.first_target().filter(|_| hand == side && job.left.is_none() && job.right.is_none());
        own.or_else(of_one).map(world)
    };
    let mut reacher = Reacher::new(&body, &job.style, &start)?;
    let obstacles = job.avoid.iter().map(|ball| {
        let at = world(ball.at);
        Obstacle::Capsule { from: at, to: at, radius_m: ball.radius_m }
    });
    reacher.set_obstacles(&obstacles.collect::<Vec<_>>());
    let goal = Goal { left: first(0), right: first(1) };
    let begin = job.first_target().or(job.right).or(job.left).unwrap_or_default();
    let waypoint =
        |to: &MovingPoint| Waypoint { shift: DQuat::from_rotation_y(facing_rad) * (to.at - begin), secs: to.secs };
    let goal = MovingGoal::new(goal, job.moving.iter().map(waypoint).collect())?;
    let sides: Vec<usize> = (0..2).filter(|&side| first(side).is_some()).collect();
    let mut playback = ReachPlayback::new(reacher, goal, HZ);
    let mut poses: Vec<Pose> = Vec::new();
    let mut meter = ReachMeter::default();
    let mut places: Vec<Vec<(DVec3, DQuat)>> = vec![Vec::new(); sides.len()];
    while let Some(now) = playback.next_frame() {
        meter.watch(playback.reacher(), &body, &now, 1.0 / HZ);
        poses.push(now.pose);
        for (places, side) in places.iter_mut().zip(&sides) {
            let at = if *side == 0 { now.goal.left } else { now.goal.right };
            places.push((at.unwrap_or_default(), DQuat::IDENTITY));
        }
    }
    let report = ReachReport::of(&meter, playback.reacher(), 0.0, playback.reacher().done_secs());
    let mut reach_frames = poses.len();
    if job.back {
        poses.extend(playback.stand_up());
        reach_frames = poses.len();
        poses.extend(afterwards(&body, &playback, clip.as_mut()));
    }
    let frames = poses.len();
    let ball = |name: String, radius_m: f64, rgb: [u8; 3], mut places: Vec<(DVec3, DQuat)>| {
        let last = places.last().copied().unwrap_or_default();
        places.resize(frames, last);
        RecordedProp {
            id: PropId::default(),
            name,
            solid: Solid::new(Form::Ball { radius_m }),
            rgb: Some(rgb),
            is_sensor: false,
            places,
        }
    };
    let goals = sides.iter().zip(places).map(|(side, places)| {
        let name = if sides.len() == 1 { "target" } else { ["leftTarget", "rightTarget"][*side] };
        ball(name.to_owned(), TARGET_M, [0xd0, 0x40, 0x40], places)
    });
    let avoided = job.avoid.iter().enumerate().map(|(index, one)| {
        ball(format!("avoided{}", index + 1), one.radius_m, [0x80, 0x80, 0x80], vec![(world(one.at), DQuat::IDENTITY)])
    });
    let props = goals.chain(avoided).collect();
    let character = RecordedCharacter {
        id: CharacterId::default(),
        name: "body".to_owned(),
        body,
        rgb: None,
        poses,
        shapes: Vec::new(),
    };
    Ok(Reached {
        report,
        recording: Recording { motion_hz: HZ, frames, characters: vec![character], props },
        facing_rad,
        reach_frames,
    })
}

/// How long what was before is shown afterwards \[s\].
const AFTERWARDS_SECS: f64 = 2.0;

/// What follows once the body stands again: standing, or, where there is a clip, going on with it from where it was left.
fn afterwards(body: &Body, playback: &ReachPlayback, clip: Option<&mut ClipSource>) -> Vec<Pose> {
    let (from_secs, standing) = (playback.now_secs(), playback.reacher().pose_at(playback.now_secs()));
    let Some(clip) = clip else { return vec![standing] };
    clip.resume(body, 0.0, from_secs, &standing);
    let frames = ((HAND_OVER_SECS + AFTERWARDS_SECS) * HZ) as usize;
    let first = (from_secs * HZ).round() as usize;
    (first..first + frames)
        .map(|frame| {
            let secs = frame as f64 / HZ;
            handed_over(&playback.reacher().pose_at(secs), &clip.pose_at(secs), secs - from_secs)
        })
        .collect()
}

/// Radius of a target's ball in pictures and files \[m\].
const TARGET_M: f64 = 0.045;

impl ReachJob {
    fn check(&self) -> Result<(), ReachError> {
        self.style.check()?;
        if [self.first_target(), self.left, self.right].iter().all(Option::is_none) {
            return Err(ReachError::NoTarget);
        }
        let Person { mass_kg, height_m } = self.person;
        let height_m = height_m.unwrap_or(1.7);
        if !(1.0..=1000.0).contains(&mass_kg) || !(0.2..=10.0).contains(&height_m) {
            return Err(ReductionError::Person { mass_kg, height_m }.into());
        }
        Ok(())
    }

    /// The single target when it begins: the first point of a moving one that has no other.
    fn first_target(&self) -> Option<DVec3> {
        let moves =
            || self.moving.first().filter(|_| self.left.is_none() && self.right.is_none()).map(|point| point.at);
        self.target.or_else(moves)
    }

    /// The hand of the single target.
    fn chosen_hand(&self) -> usize {
        match self.hand {
            Hand::Left => 0,
            Hand::Right => 1,
            // Most people are right-handed: what is straight ahead is the right hand's.
            Hand::Auto => usize::from(self.first_target().is_none_or(|target| target.x < 0.06)),
        }
    }
}

/// The body of a clip, and its motion from the time at which it is left, standing there on the floor at height 0.
fn from_clip(job: &ReachJob, file: &MotionFile) -> Result<(Body, ClipSource), ReachError> {
    let parts = file.body_parts()?;
    let ends_secs = file.clip.duration_secs();
    if job.from_secs > ends_secs + 0.5 / HZ {
        return Err(ReachError::ClipEnds { ends_secs, from_secs: job.from_secs });
    }
    let reduction = Reduction::new(&file.clip, parts, file.stature_m, job.person)?;
    let clip = resample(&file.clip, HZ);
    let mut poses: Vec<Pose> = (0..clip.frames()).map(|frame| reduction.pose(&clip.world(frame))).collect();
    let start = ClipSource::of_poses(poses.clone(), HZ, job.from_secs).pose_at(0.0);
    let lift = hips_over_soles_m(reduction.body(), &start) - start.hips_position.y;
    poses.iter_mut().for_each(|pose| pose.hips_position.y += lift);
    let mut body = reduction.body().clone();
    body.widen_limits(&start);
    Ok((body, ClipSource::of_poses(poses, HZ, job.from_secs)))
}

/// Where a pose faces \[rad about +Y from +Z to +X\].
fn facing(pose: &Pose) -> f64 {
    let forward = pose.world[Node::Hips.index()] * DVec3::Z;
    libm::atan2(forward.x, forward.z)
}

/// The floor between the feet \[m\].
fn between_feet(body: &Body, pose: &Pose) -> DVec3 {
    let at = pose.positions(body);
    let middle = (at[Node::LeftFoot.index()] + at[Node::RightFoot.index()]) * 0.5;
    DVec3::new(middle.x, pose.hips_position.y - hips_over_soles_m(body, pose), middle.z)
}
