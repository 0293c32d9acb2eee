//! A clip as the source of the wanted pose.

use crate::apply_command::heading;
use crate::scene::{CharacterSpec, Scene};
use glam::{DQuat, DVec3};
use sinew_body::humanoid::{Body, Node, Person, Pose, Reduction, log};
use sinew_control::Target;
use sinew_motion::formats::{MotionFile, ReadOptions};
use sinew_motion::{find_cycle, moves_from, repeat, resample};
use sinew_response::{Motion, Settings};
use sinew_world::hips_over_soles_m;

/// Poses at a constant rate, placed on the stage.
#[derive(Clone, Debug)]
pub struct MotionSource {
    poses: Vec<Pose>,
    hz: f64,
    start_secs: f64,
    /// When it was resumed, if it was \[s of the stage\].
    resumed_secs: Option<f64>,
}

/// How long a clip that is resumed takes to come to its own pace \[s\].
const STARTS_SECS: f64 = 0.8;

/// How far from where it was left a clip is resumed, to find feet as they stand \[s\]: half a step of a walk.
const NEAR_SECS: f64 = 0.3;

/// Most frames that a repetition makes: an hour at 60 Hz.
const MAX_FRAMES: usize = 216_000;

/// Reads a motion file that a scene names.
pub(crate) fn read(scene: &Scene, name: &str) -> Result<MotionFile, String> {
    // From the bytes that the scene holds: a take has them too.
    let held = scene.files().get(name).ok_or_else(|| format!("{name}: the scene was read without it"))?;
    MotionFile::from_bytes(name.as_ref(), &held.bytes, &ReadOptions::default()).map_err(|error| error.to_string())
}

/// The body in a motion file, with the scene's mass and height.
pub(crate) fn reduction(file: &MotionFile, spec: &CharacterSpec) -> Result<Reduction, String> {
    let humanoid = file.body_parts().map_err(|error| error.to_string())?;
    let person = Person { mass_kg: spec.mass_kg, height_m: spec.height_m };
    Reduction::new(&file.clip, humanoid, file.stature_m, person).map_err(|error| error.to_string())
}

/// How a clip is played.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Play {
    /// Poses a second \[Hz\].
    pub hz: f64,
    /// Where in the clip the stage's time begins \[s\].
    pub start_secs: f64,
    /// The gait cycle, where there is one, is repeated.
    pub repeats: bool,
    /// For how long poses are needed \[s\].
    pub until_secs: f64,
    /// Low-passed, as the response needs it to know the motion's torques.
    pub is_filtered: bool,
    /// Lifted or lowered so that its soles stand on the floor of the character's place: for bodies that feel the floor.
    pub stands_on_floor: bool,
}

impl MotionSource {
    /// Poses at a rate \[Hz\], of which the one at `start_secs` is the stage's first.
    pub fn of_poses(poses: Vec<Pose>, hz: f64, start_secs: f64) -> MotionSource {
        MotionSource { poses, hz, start_secs, resumed_secs: None }
    }

    /// A clip's poses, moved so that at the start the hips are over the character's place and face where it faces.
    pub(crate) fn of(
        file: &MotionFile,
        reduction: &Reduction,
        spec: &CharacterSpec,
        play: &Play,
    ) -> Result<MotionSource, String> {
        let Play { hz, mut start_secs, repeats, until_secs, is_filtered, stands_on_floor } = *play;
        let humanoid = file.body_parts().map_err(|error| error.to_string())?;
        let wanted = (((start_secs + until_secs) * hz).ceil() as usize + 2).min(MAX_FRAMES);
        let clip = resample(&file.clip, hz);
        let clip = match repeats.then(|| find_cycle(&clip, humanoid)).flatten() {
            Some(cycle) => {
                let length = cycle.last.saturating_sub(cycle.first).max(1);
                repeat(&clip, humanoid, (cycle.first, cycle.last), wanted / length + 2).clip
            }
            None => {
                // Many files begin with a rest pose that is not part of the motion.
                start_secs = start_secs.max(moves_from(&file.clip, humanoid) as f64 * file.clip.frame_time_secs());
                clip
            }
        };
        let mut poses: Vec<Pose> = if is_filtered {
            let settings = Settings { time_step_secs: 1.0 / hz, ..Settings::default() };
            Motion::of_clip(&clip, reduction, 0, &settings).poses().to_vec()
        } else {
            (0..clip.frames()).map(|frame| reduction.pose(&clip.world(frame))).collect()
        };
        poses.truncate(wanted);
        let first = ((start_secs * hz).round() as usize).min(poses.len().saturating_sub(1));
        let Some(start) = poses.get(first).copied() else { return Err("the clip has no frames".to_owned()) };
        // Hips swing as they walk: where they face is their mean over a second.
        let second = &poses[first..(first + hz.ceil() as usize).min(poses.len())];
        let forward: DVec3 = second.iter().map(|pose| pose.world[0] * DVec3::Z).sum();
        let wanted = heading(spec.facing_deg);
        let turn = DQuat::from_rotation_y(libm::atan2(wanted.x, wanted.z) - libm::atan2(forward.x, forward.z));
        let place = DVec3::from(spec.position_m);
        let floor = if stands_on_floor { floor_m(reduction.body(), &poses[first..]) } else { 0.0 };
        let from = DVec3::new(start.hips_position.x, floor, start.hips_position.z);
        for pose in &mut poses {
            pose.hips_position = turn * (pose.hips_position - from) + place;
            pose.world = pose.world.map(|rotation| (turn * rotation).normalize());
        }
        Ok(MotionSource { poses, hz, start_secs, resumed_secs: None })
    }

    /// The pose at a time of the stage; before the start the first, after the end the last.
    pub fn pose_at(&self, time_secs: f64) -> Pose {
        self.pose_of(self.start_secs + self.own_secs(time_secs))
    }

    /// The clip's time: one that is resumed sets out from rest.
    fn own_secs(&self, time_secs: f64) -> f64 {
        let Some(resumed_secs) = self.resumed_secs else { return time_secs };
        let share = ((time_secs - resumed_secs) / STARTS_SECS).clamp(0.0, 1.0);
        // The integral of a pace that grows by a cubic, 3 s² - 2 s³.
        let behind = STARTS_SECS * (share - share * share * share * (1.0 - 0.5 * share));
        time_secs - behind
    }

    /// The pose at a time of the clip.
    fn pose_of(&self, clip_secs: f64) -> Pose {
        let at = (clip_secs * self.hz).max(0.0);
        let last = self.poses.len().saturating_sub(1);
        let (index, share) = ((at as usize).min(last), at - at.floor());
        let (from, to) = (&self.poses[index], &self.poses[(index + 1).min(last)]);
        let mut pose = *from;
        pose.hips_position = from.hips_position.lerp(to.hips_position, share);
        for node in Node::ALL {
            pose.world[node.index()] = from.world[node.index()].slerp(to.world[node.index()], share).normalize();
        }
        pose
    }

    /// The pose that led to the one at a time in a step of this length, by how the motion goes on from there.
    pub fn pose_before(&self, time_secs: f64, step_secs: f64) -> Pose {
        let (mut pose, next) = (self.pose_at(time_secs), self.pose_at(time_secs + step_secs));
        pose.hips_position += pose.hips_position - next.hips_position;
        for (rotation, next) in pose.world.iter_mut().zip(next.world) {
            *rotation = (*rotation * next.conjugate() * *rotation).normalize();
        }
        pose
    }

    /// Goes on at `now_secs` of the stage from where the clip was at `left_secs`, or near there where its feet are as those of a
    /// pose; moved and turned about the vertical so that the hips are over the pose's place and face as there. It sets out from rest.
    pub fn resume(&mut self, body: &Body, left_secs: f64, now_secs: f64, at: &Pose) {
        let left = self.start_secs + self.own_secs(left_secs);
        let tries = (NEAR_SECS * self.hz).floor() as i64;
        let near = (-tries..=tries).map(|frames| left + frames as f64 / self.hz);
        let stance = stance(body, at);
        let off = |secs: &f64| {
            let other = self::stance(body, &self.pose_of(*secs));
            (0..2).map(|foot| (other[foot] - stance[foot]).length_squared()).sum::<f64>()
        };
        let from_secs = near.min_by(|one, other| off(one).total_cmp(&off(other))).unwrap_or(left).max(0.0);
        let here = self.pose_of(from_secs);
        let turn = DQuat::from_rotation_y(heading_rad(at) - heading_rad(&here));
        let (from, to) = (here.hips_position, at.hips_position);
        for pose in &mut self.poses {
            let moved = turn * (pose.hips_position - from);
            pose.hips_position = DVec3::new(to.x, from.y, to.z) + moved;
            pose.world = pose.world.map(|rotation| (turn * rotation).normalize());
        }
        self.start_secs = from_secs - now_secs;
        self.resumed_secs = Some(now_secs);
    }

    /// All poses, from the clip's start.
    pub fn poses(&self) -> &[Pose] {
        &self.poses
    }

    /// Writes the pose of a time into a target, with the velocity of its joints.
    pub fn write(&self, time_secs: f64, target: &mut Target) {
        let pose = self.pose_at(time_secs);
        let ahead = 1.0 / self.hz;
        let next = self.pose_at(time_secs + ahead);
        for node in Node::ALL.into_iter().skip(1) {
            let joint = target.joint_mut(node);
            let (local, after) = (pose.local(node), next.local(node));
            joint.rotation = local.normalize();
            joint.velocity = log((local.conjugate() * after).normalize()) / ahead;
            joint.gain = 1.0;
            joint.damping = 1.0;
        }
        target.root = Some((pose.hips_position, pose.world[0]));
    }
}

/// Where a pose faces \[rad about +Y from +Z to +X\].
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

/// Height on which the soles of poses stand \[m\]: they come lower by some centimetres only as feet roll off.
fn floor_m(body: &Body, poses: &[Pose]) -> f64 {
    let mut lowest: Vec<f64> = poses.iter().map(|pose| pose.hips_position.y - hips_over_soles_m(body, pose)).collect();
    lowest.sort_by(f64::total_cmp);
    lowest.get(lowest.len() / 4).copied().unwrap_or(0.0)
}
