//! A clip, ready to be pushed.
#![allow(clippy::unwrap_used, dead_code, reason = "tests of two programs use a part each")]

use sinew_body::humanoid::{Body, Node, Person, Pose, Reduction};
use sinew_motion::formats::{MotionFile, ReadOptions};
use sinew_motion::{Side, contacts, find_cycle, moves_from, repeat};
use sinew_response::{Basis, Motion, Preset, Settings, stable_compliance};
use std::path::Path;
use std::sync::Mutex;

/// What `respond` makes of a file before anything disturbs it.
pub struct Case {
    pub name: String,
    pub file: MotionFile,
    pub repeats: usize,
    /// Limits widened to the motion.
    pub body: Body,
    pub motion: Motion,
    /// The poses of one cycle: first and last \[s\]; of the whole clip when it has none.
    cyclic_secs: Option<(f64, f64)>,
    /// Per pose of the motion whether each foot stands, left and right.
    pub stance: Vec<[bool; 2]>,
    /// What [`Case::stable`] has found already: the settings asked for, and those to use.
    stable: Mutex<Vec<(Settings, Settings)>>,
}

/// The person of all claims unless said otherwise.
pub const PERSON: Person = Person { mass_kg: 80.0, height_m: Some(1.7) };

impl Case {
    /// 80 kg and 1.7 m, with room for pushes in the third cycle and `window_secs` after them.
    pub fn load(mocap: &Path, name: &str, window_secs: f64) -> Case {
        Case::of_person(mocap, name, window_secs, PERSON)
    }

    pub fn of_person(mocap: &Path, name: &str, window_secs: f64, person: Person) -> Case {
        let settings = Settings::default();
        let file = MotionFile::read(&mocap.join(name), &ReadOptions::default()).unwrap();
        let humanoid = file.body_parts().unwrap();
        let mut first_frame = moves_from(&file.clip, humanoid);
        let cycle = find_cycle(&file.clip, humanoid).map(|cycle| (cycle.first, cycle.last));
        let reduction = Reduction::new(&file.clip, humanoid, file.stature_m, person).unwrap();
        let long_enough = |secs: f64| (file.clip.frames() - first_frame) as f64 * file.clip.frame_time_secs() >= secs;
        let secs = |frame: usize| frame as f64 * file.clip.frame_time_secs();
        let (input, cyclic_secs, repeats) = match cycle {
            Some((first, last)) if !long_enough(window_secs + 3.0 * secs(last - first)) => {
                let times = 3 + (window_secs / secs(last - first)).ceil() as usize;
                let repeated = repeat(&file.clip, humanoid, (first, last), times);
                first_frame = 0;
                // A round in the middle, as `respond` takes.
                let middle = times / 2 * (last - first);
                (repeated.clip, Some((secs(middle), secs(middle + last - first))), times)
            }
            Some((first, last)) => (file.clip.clone(), Some((secs(first.max(first_frame)), secs(last))), 0),
            None => (file.clip.clone(), None, 0),
        };
        let motion = Motion::of_clip(&input, &reduction, first_frame, &settings);
        let mut body = reduction.body().clone();
        motion.widen(&mut body);
        let standing = contacts(&input, humanoid);
        let frame = |pose: usize| {
            let secs = motion.start_secs() + pose as f64 * motion.time_step_secs();
            ((secs / input.frame_time_secs()).round() as usize).min(input.frames() - 1)
        };
        let stance = (0..motion.poses().len())
            .map(|pose| [Side::Left, Side::Right].map(|side| standing.side(side)[frame(pose)]))
            .collect();
        let stable = Mutex::default();
        Case { name: name.to_owned(), file, repeats, body, motion, cyclic_secs, stance, stable }
    }

    /// The poses from which the basis is made.
    pub fn cyclic(&self) -> &[Pose] {
        match self.cyclic_secs {
            Some((from, to)) => self.motion.between_secs(from, to),
            None => self.motion.poses(),
        }
    }

    pub fn basis(&self, settings: &Settings) -> Basis {
        Basis::of_motion(&self.body, self.cyclic(), settings).unwrap()
    }

    /// The settings as `respond` uses them: the dial stopped where the motion would no longer come back. The search is long, so
    /// that it is done once for the same settings.
    pub fn stable(&self, settings: Settings) -> Settings {
        if settings.preset != Preset::Robust {
            return settings;
        }
        let mut known = self.stable.lock().unwrap();
        if let Some((_, stable)) = known.iter().find(|(asked, _)| *asked == settings) {
            return *stable;
        }
        let compliance = stable_compliance(&self.body, &self.basis(&settings), &settings, self.cyclic());
        let stable = Settings { compliance, ..settings };
        known.push((settings, stable));
        stable
    }

    /// Poses in one cycle.
    pub fn period(&self) -> usize {
        self.cyclic().len() - 1
    }

    /// Where the pushes begin: at so many phases of the third cycle; of a clip without one, spread over its first half.
    pub fn onsets(&self, phases: usize) -> Vec<usize> {
        let (first, length) = if self.repeats > 0 {
            (2 * self.period(), self.period())
        } else if let Some((from, to)) = self.cyclic_secs {
            let index = |secs: f64| ((secs - self.motion.start_secs()) / self.motion.time_step_secs()).round() as usize;
            (index(from), index(to) - index(from))
        } else {
            (10, self.motion.poses().len() / 2)
        };
        (0..phases).map(|phase| first + phase * length / phases).collect()
    }

    /// Poses whose ankles are at most this far apart \[m\], by foot.
    pub fn ankle_gap(&self, ours: &Pose, theirs: &Pose) -> [f64; 2] {
        let (ours, theirs) = (ours.positions(&self.body), theirs.positions(&self.body));
        [Node::LeftFoot, Node::RightFoot].map(|foot| (ours[foot.index()] - theirs[foot.index()]).length())
    }
}
