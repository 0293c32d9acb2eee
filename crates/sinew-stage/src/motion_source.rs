//! Clips of a scene: read, reduced to the body, placed on the stage.

use crate::heading::heading;
use crate::scene::{CharacterSpec, Scene};
use glam::{DQuat, DVec3};
use sinew_body::humanoid::{Body, Person, Pose, Reduction};
use sinew_control::source::ClipSource;
use sinew_motion::formats::{MotionFile, ReadOptions};
use sinew_motion::{Clip, find_cycle, moves_from, repeat, resample};
use sinew_response::{Motion, Settings};
use sinew_world::hips_over_soles_m;

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
    /// Low-passed too, as the response needs it to know the motion's torques.
    pub is_filtered: bool,
    /// Lifted or lowered so that its soles stand on the floor of the character's place: for bodies that collide with the floor.
    pub stands_on_floor: bool,
}

/// A clip at the stage's rate.
pub(crate) struct Played {
    pub clip: Clip,
    /// For each of its frames, the frame of the file that it came from.
    pub rows: Vec<usize>,
    /// Where in it the stage's time begins \[s\].
    pub start_secs: f64,
    /// Frames that are needed.
    wanted: usize,
}

impl Played {
    /// The frame of the clip in a frame of the stage.
    pub fn frame(&self, index: usize) -> usize {
        let first = (self.start_secs * self.clip.fps()).round() as usize;
        (first + index).min(self.clip.frames().saturating_sub(1))
    }
}

/// A clip at the stage's rate, its cycle repeated where it is to be.
pub(crate) fn played(file: &MotionFile, play: &Play) -> Result<Played, String> {
    let Play { hz, mut start_secs, repeats, until_secs, .. } = *play;
    let humanoid = file.body_parts().map_err(|error| error.to_string())?;
    let wanted = (((start_secs + until_secs) * hz).ceil() as usize + 2).min(MAX_FRAMES);
    let clip = resample(&file.clip, hz);
    let last = file.clip.frames().saturating_sub(1);
    let row = |frame: usize| ((frame as f64 * file.clip.fps() / hz).round() as usize).min(last);
    let (clip, rows) = match repeats.then(|| find_cycle(&clip, humanoid)).flatten() {
        Some(cycle) => {
            let length = cycle.last.saturating_sub(cycle.first).max(1);
            let repeated = repeat(&clip, humanoid, (cycle.first, cycle.last), wanted / length + 2);
            (repeated.clip, repeated.rows.into_iter().map(row).collect())
        }
        None => {
            // Many files begin with a rest pose that is not part of the motion.
            start_secs = start_secs.max(moves_from(&file.clip, humanoid) as f64 * file.clip.frame_time_secs());
            let rows = (0..clip.frames()).map(row).collect();
            (clip, rows)
        }
    };
    Ok(Played { clip, rows, start_secs, wanted })
}

/// A clip's poses, moved so that at the start the hips are over the character's place and face where it faces.
pub(crate) fn clip_source(
    file: &MotionFile,
    reduction: &Reduction,
    spec: &CharacterSpec,
    play: &Play,
) -> Result<ClipSource, String> {
    let Play { hz, is_filtered, stands_on_floor, .. } = *play;
    let Played { clip, start_secs, wanted, .. } = played(file, play)?;
    let mut poses: Vec<Pose> = (0..clip.frames()).map(|frame| reduction.pose(&clip.world(frame))).collect();
    let settings = Settings { time_step_secs: 1.0 / hz, ..Settings::default() };
    let smooth = is_filtered.then(|| Motion::of_clip(&clip, reduction, 0, &settings).poses().to_vec());
    let mut smooth = smooth.unwrap_or_default();
    poses.truncate(wanted);
    smooth.truncate(wanted);
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
    for pose in poses.iter_mut().chain(&mut smooth) {
        pose.hips_position = turn * (pose.hips_position - from) + place;
        pose.world = pose.world.map(|rotation| (turn * rotation).normalize());
    }
    Ok(ClipSource::of_poses(poses, hz, start_secs).with_smooth(smooth))
}

/// Height on which the soles of poses stand \[m\]: they come lower by some centimetres only as feet roll off.
fn floor_m(body: &Body, poses: &[Pose]) -> f64 {
    let mut lowest: Vec<f64> = poses.iter().map(|pose| pose.hips_position.y - hips_over_soles_m(body, pose)).collect();
    lowest.sort_by(f64::total_cmp);
    lowest.get(lowest.len() / 4).copied().unwrap_or(0.0)
}
