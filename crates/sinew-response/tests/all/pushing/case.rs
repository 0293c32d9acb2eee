//! A clip, ready to be pushed.
#![allow(clippy::unwrap_used, dead_code, reason = "tests of two programs use a part each")]

use sinew_body::humanoid::{Body, Node, Person, Pose, Reduction};
use sinew_motion::formats::{MotionFile, ReadOptions};
use sinew_motion::{Side, contacts, find_cycle, moves_from};
use sinew_response::{Basis, Excerpt, Motion, Prepared, PreparedClip, Settings};
use std::path::Path;
use std::sync::Mutex;

/// What `respond` makes of a file before anything disturbs it.
pub struct Case {
    pub name: String,
    pub file: MotionFile,
    pub repeats: usize,
    /// The file's clip, its cycle repeated where it is shorter than the window.
    clip: PreparedClip,
    /// Per pose of the motion whether each foot stands, left and right.
    pub stance: Vec<[bool; 2]>,
    /// The same motion with every settings that a claim has asked for: each keeps how loose it may be.
    prepared: Mutex<Vec<Prepared>>,
}

/// The person of all claims unless said otherwise.
pub const PERSON: Person = Person { mass_kg: 80.0, height_m: Some(1.7) };

impl Case {
    /// 80 kg and 1.7 m, with room for pushes in the third cycle and `window_secs` after them.
    pub fn load(mocap: &Path, name: &str, window_secs: f64) -> Case {
        Case::of_person(mocap, name, window_secs, PERSON)
    }

    pub fn of_person(mocap: &Path, name: &str, window_secs: f64, person: Person) -> Case {
        let file = MotionFile::read(&mocap.join(name), &ReadOptions::default()).unwrap();
        let humanoid = file.body_parts().unwrap();
        let frames = file.clip.frames() - moves_from(&file.clip, humanoid);
        let cycle = find_cycle(&file.clip, humanoid).map(|cycle| (cycle.first, cycle.last));
        let reduction = Reduction::new(&file.clip, humanoid, file.stature_m, person).unwrap();
        let secs = |frames: usize| frames as f64 * file.clip.frame_time_secs();
        let repeats = match cycle {
            Some((first, last)) if secs(frames) < window_secs + 3.0 * secs(last - first) => {
                3 + (window_secs / secs(last - first)).ceil() as usize
            }
            _ => 0,
        };
        let excerpt = Excerpt { cycle, repeat: repeats };
        let clip = PreparedClip::new(&file.clip, humanoid, reduction, excerpt, Settings::default()).unwrap();
        let standing = contacts(clip.clip(), humanoid);
        let motion = clip.motion().motion();
        let frame = |pose: usize| {
            let secs = motion.start_secs() + pose as f64 * motion.time_step_secs();
            ((secs / clip.clip().frame_time_secs()).round() as usize).min(clip.clip().frames() - 1)
        };
        let stance = (0..motion.poses().len())
            .map(|pose| [Side::Left, Side::Right].map(|side| standing.side(side)[frame(pose)]))
            .collect();
        Case { name: name.to_owned(), repeats, clip, stance, prepared: Mutex::default(), file }
    }

    /// Limits widened to the motion.
    pub fn body(&self) -> &Body {
        self.clip.motion().body()
    }

    pub fn motion(&self) -> &Motion {
        self.clip.motion().motion()
    }

    pub fn basis(&self) -> &Basis {
        self.clip.motion().basis()
    }

    /// The settings as `respond` uses them: the dial stopped where the motion would no longer come back. The search is long, so
    /// that it is done once for the same settings.
    pub fn stable(&self, settings: Settings) -> Settings {
        let mut known = self.prepared.lock().unwrap();
        if let Some(prepared) = known.iter().find(|prepared| *prepared.settings() == settings) {
            return prepared.stable_settings();
        }
        let prepared = self.clip.motion().with_settings(settings).unwrap();
        let stable = prepared.stable_settings();
        known.push(prepared);
        stable
    }

    /// Poses in one cycle; in the whole clip when it has none.
    pub fn period(&self) -> usize {
        self.clip.motion().measured().len() - 1
    }

    /// Where the pushes begin: at so many phases of the third cycle; of a clip without one, spread over its first half.
    pub fn onsets(&self, phases: usize) -> Vec<usize> {
        let (first, length) = if self.repeats > 0 {
            (2 * self.period(), self.period())
        } else if self.clip.cycle().is_some() {
            (self.clip.motion().measured().start, self.period())
        } else {
            (10, self.motion().poses().len() / 2)
        };
        (0..phases).map(|phase| first + phase * length / phases).collect()
    }

    /// Poses whose ankles are at most this far apart \[m\], by foot.
    pub fn ankle_gap(&self, ours: &Pose, theirs: &Pose) -> [f64; 2] {
        let (ours, theirs) = (ours.positions(self.body()), theirs.positions(self.body()));
        [Node::LeftFoot, Node::RightFoot].map(|foot| (ours[foot.index()] - theirs[foot.index()]).length())
    }
}
