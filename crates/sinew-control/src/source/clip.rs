//! A clip: poses at a constant rate.

use super::Source;
use crate::{Root, Wanted};
use glam::{DQuat, DVec3};
use sinew_body::humanoid::{Body, Node, Pose};
use sinew_snapshot::{Reader, Snapshot, SnapshotError, Writer, snapshot};
use std::sync::Arc;

/// Poses at a constant rate, placed on the stage.
///
/// ```
/// use sinew_body::humanoid::Pose;
/// use sinew_control::source::ClipSource;
/// let mut ahead = Pose::STANDING;
/// ahead.hips_position.z = 0.1;
/// let clip = ClipSource::of_poses(vec![Pose::STANDING, ahead], 60.0, 0.0);
/// assert_eq!(clip.pose_at(10.0), ahead); // after the end it is the last one
/// ```
#[derive(Clone, Debug)]
pub struct ClipSource {
    /// As they were given; shared by all copies.
    given: Arc<[Pose]>,
    /// As they are placed; a clip that is resumed has its own from then on.
    poses: Arc<[Pose]>,
    /// The same low-passed, where the response needs it.
    smooth: Option<Arc<[Pose]>>,
    given_smooth: Option<Arc<[Pose]>>,
    /// How they were placed, one placement after the other.
    placements: Vec<Placement>,
    hz: f64,
    start_secs: f64,
    /// When it was resumed, if it was \[s of the stage\].
    resumed_secs: Option<f64>,
}

/// A turn about the vertical, and a shift over the ground.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Placement {
    turn: DQuat,
    /// The point that is moved, and where it comes to lie \[m\].
    from: DVec3,
    to: DVec3,
}

snapshot!(Placement { turn, from, to });

/// The poses are found again from their placements: each rounds, so they are carried out one after the other.
impl Snapshot for ClipSource {
    fn save(&self, to: &mut Writer) {
        let ClipSource { given: _, poses: _, smooth: _, given_smooth: _, placements, hz: _, start_secs, resumed_secs } =
            self;
        placements.save(to);
        start_secs.save(to);
        resumed_secs.save(to);
    }

    fn restore(&mut self, from: &mut Reader<'_>) -> Result<(), SnapshotError> {
        let mut placements: Vec<Placement> = Vec::new();
        placements.restore(from)?;
        if placements.len() > MAX_PLACEMENTS {
            return Err(SnapshotError::invalid("number of placements of a clip"));
        }
        if placements != self.placements {
            (self.poses, self.placements) = (Arc::clone(&self.given), Vec::new());
            self.smooth.clone_from(&self.given_smooth);
            placements.iter().for_each(|placement| self.place(*placement));
        }
        self.start_secs.restore(from)?;
        self.resumed_secs.restore(from)
    }
}

/// Placements that a snapshot may hold: more than a day of reaches, one in ten seconds.
const MAX_PLACEMENTS: usize = 10_000;

/// Time in which a resumed clip reaches its own pace \[s\].
const STARTS_SECS: f64 = 0.8;

/// Maximum time between leaving and resuming points of a clip, in the search for matching feet \[s\]: half a step of a
/// walk.
const NEAR_SECS: f64 = 0.3;

/// How far into a clip its feet are searched for a match when it begins in a moving body \[s\]: a slow walk's cycle.
const CYCLE_SECS: f64 = 1.4;

/// By how much better a later beginning must match \[m² of both ankles, per second\]: a centimetre is worth no second.
const LATER_M2_PER_S: f64 = 0.01;

impl ClipSource {
    /// Poses at a rate \[Hz\], of which the one at `start_secs` is the stage's first.
    pub fn of_poses(poses: Vec<Pose>, hz: f64, start_secs: f64) -> ClipSource {
        let given: Arc<[Pose]> = poses.into();
        ClipSource {
            poses: Arc::clone(&given),
            given,
            smooth: None,
            given_smooth: None,
            placements: Vec::new(),
            hz,
            start_secs,
            resumed_secs: None,
        }
    }

    /// With the same poses low-passed, for the response: what it shows are the clip's own.
    #[must_use]
    pub fn with_smooth(mut self, poses: Vec<Pose>) -> ClipSource {
        self.given_smooth = (!poses.is_empty()).then(|| poses.into());
        self.smooth.clone_from(&self.given_smooth);
        self
    }

    fn place(&mut self, placement: Placement) {
        let Placement { turn, from, to } = placement;
        let smooth = self.smooth.iter_mut().flat_map(Arc::make_mut);
        for pose in Arc::make_mut(&mut self.poses).iter_mut().chain(smooth) {
            let moved = turn * (pose.hips_position - from);
            pose.hips_position = DVec3::new(to.x, from.y, to.z) + moved;
            pose.world = pose.world.map(|rotation| (turn * rotation).normalize());
        }
        self.placements.push(placement);
    }

    /// The clip's own poses.
    pub fn poses(&self) -> &[Pose] {
        &self.poses
    }

    /// The pose at a time of the stage; before the start the first, after the end the last.
    pub fn pose_at(&self, time_secs: f64) -> Pose {
        self.pose_of(&self.poses, self.start_secs + self.own_secs(time_secs))
    }

    /// As [`Source::resume`] from its beginning, but at full pace at once: for a character that another source moves until then. A walk
    /// begins in the phase of its cycle in which the feet are; what fits at its beginning begins there.
    pub fn begin_in(&mut self, body: &Body, now_secs: f64, at: &Pose) {
        let first = self.start_secs + self.own_secs(0.0);
        let tries = (CYCLE_SECS * self.hz).floor() as i64;
        let hz = self.hz;
        let phases = (0..=tries).map(|frames| first + frames as f64 / hz);
        self.enter(body, phases, LATER_M2_PER_S, now_secs, at);
        self.resumed_secs = None;
    }

    /// Goes on from that of some times of the clip at which its feet match those of a pose best, moved and turned to it. A later one
    /// must match better, by so much a second.
    fn enter(&mut self, body: &Body, times: impl Iterator<Item = f64>, later_m2_per_s: f64, now_secs: f64, at: &Pose) {
        let stance = stance(body, at);
        let off = |secs: &f64| {
            let other = self::stance(body, &self.pose_of(&self.poses, *secs));
            let feet = (0..2).map(|foot| (other[foot] - stance[foot]).length_squared()).sum::<f64>();
            feet + later_m2_per_s * secs
        };
        let best = times.min_by(|one, other| off(one).total_cmp(&off(other)));
        let from_secs = best.unwrap_or(self.start_secs).max(0.0);
        let here = self.pose_of(&self.poses, from_secs);
        let turn = DQuat::from_rotation_y(heading_rad(at) - heading_rad(&here));
        self.place(Placement { turn, from: here.hips_position, to: at.hips_position });
        self.start_secs = from_secs - now_secs;
    }

    /// The clip's time: a resumed clip starts from rest.
    fn own_secs(&self, time_secs: f64) -> f64 {
        let Some(resumed_secs) = self.resumed_secs else { return time_secs };
        let share = ((time_secs - resumed_secs) / STARTS_SECS).clamp(0.0, 1.0);
        // The integral of a pace that grows by a cubic, 3 s² - 2 s³.
        let behind = STARTS_SECS * (share - share * share * share * (1.0 - 0.5 * share));
        time_secs - behind
    }

    /// The pose at a time of the clip, among these of it.
    fn pose_of(&self, poses: &[Pose], clip_secs: f64) -> Pose {
        let at = (clip_secs * self.hz).max(0.0);
        let last = poses.len().saturating_sub(1);
        let (index, share) = ((at as usize).min(last), at - at.floor());
        let (from, to) = (&poses[index], &poses[(index + 1).min(last)]);
        let mut pose = *from;
        pose.hips_position = from.hips_position.lerp(to.hips_position, share);
        for node in Node::ALL {
            pose.world[node.index()] = from.world[node.index()].slerp(to.world[node.index()], share).normalize();
        }
        pose
    }
}

impl Source for ClipSource {
    fn cloned(&self) -> Box<dyn Source> {
        Box::new(self.clone())
    }

    fn root(&self) -> Root {
        Root::Placed
    }

    fn wanted(&self, at_secs: f64, wanted: &mut Wanted) {
        let ahead = 1.0 / self.hz;
        wanted.follow_poses(&self.pose_at(at_secs), &self.pose_at(at_secs + ahead), ahead);
        let clip_secs = self.start_secs + self.own_secs(at_secs);
        wanted.smooth = self.smooth.as_ref().map(|smooth| self.pose_of(smooth, clip_secs));
    }

    fn motion(&self) -> Option<&[Pose]> {
        Some(self.smooth.as_ref().unwrap_or(&self.poses))
    }

    /// Resumes at `now_secs` of the stage from the clip's time at `left_secs`, or near it where its feet match those of
    /// a pose; moved and rotated about the vertical so that the hips have the pose's position and heading. It starts
    /// from rest.
    fn resume(&mut self, body: &Body, left_secs: f64, now_secs: f64, at: &Pose) {
        let left = self.start_secs + self.own_secs(left_secs);
        let tries = (NEAR_SECS * self.hz).floor() as i64;
        let hz = self.hz;
        let near = (-tries..=tries).map(|frames| left + frames as f64 / hz);
        self.enter(body, near, 0.0, now_secs, at);
        self.resumed_secs = Some(now_secs);
    }
}

/// Heading of a pose \[rad about +Y from +Z to +X\].
fn heading_rad(pose: &Pose) -> f64 {
    let forward = pose.world[0] * DVec3::Z;
    libm::atan2(forward.x, forward.z)
}

/// Both ankles, seen from the hips, along and across where these face \[m\].
fn stance(body: &Body, pose: &Pose) -> [DVec3; 2] {
    let at = pose.positions(body);
    let turn = DQuat::from_rotation_y(-heading_rad(pose));
    [Node::LeftFoot, Node::RightFoot].map(|foot| turn * (at[foot.index()] - pose.hips_position))
}
