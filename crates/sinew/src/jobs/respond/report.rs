//! The report of a response: the JSON of `--report`.

use super::job::RespondJob;
use glam::DVec3;
use serde::Serialize;
use sinew_body::humanoid::Node;
use sinew_motion::formats::MotionFile;
use sinew_motion::{Clip, Error, Humanoid, Part, Side, contacts};
use sinew_response::{Coordinates, Preset, PreparedClip, Push, PushFrame, Track};
use std::collections::BTreeMap;

/// A joint within this of the run without pushes has recovered \[rad\]: 2 degrees.
pub(super) const RECOVERED: f64 = 2.0 * std::f64::consts::PI / 180.0;

/// The report of a response. Units are in the names.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct RespondReport {
    /// The file answered.
    pub file: String,
    /// `robust`, `paper` or `literal`.
    pub preset: String,
    /// Number of coordinates under dynamics.
    pub k: usize,
    /// `low` or `high`.
    pub coordinates: String,
    /// The compliance used.
    pub compliance: f64,
    /// The cycle from which the basis was made, in the file's frames, both ends in; null where the whole clip was.
    pub cycle: Option<(usize, usize)>,
    /// Mass of the body \[kg\].
    pub mass_kg: f64,
    /// Height of the body \[m\].
    pub height_m: f64,
    /// Frames written.
    pub frames: usize,
    /// Frames per second.
    pub fps: f64,
    /// One per push, in the order given.
    pub pushes: Vec<PushReport>,
    /// The largest geodesic angle of every joint from the run without disturbances, over the whole clip \[deg\].
    pub peak_deflection_deg: BTreeMap<String, f64>,
    /// Largest deviation of any joint from the input, over the whole clip \[deg\].
    pub largest_departure_deg: f64,
    /// From the end of the last disturbance until every joint stays within 2 degrees \[s\]; null if never, or if nothing
    /// disturbed.
    pub recovered_after_s: Option<f64>,
    /// Largest deviation of a stance ankle from the input's, in the ground's frame \[m\].
    pub stance_deviation_max_m: f64,
    /// Whether every number of the answer is finite.
    pub finite: bool,
}

/// The effect of one push.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct PushReport {
    /// Where.
    pub part: String,
    /// The force as given \[N\].
    pub force_n: [f64; 3],
    /// Its axes: `facing` or `world`.
    pub frame: String,
    /// The force in the world \[N\]; null if it never acted.
    pub world_force_n: Option<[f64; 3]>,
    /// When \[s\].
    pub at_s: f64,
    /// How long \[s\].
    pub for_s: f64,
    /// Per body part the largest geodesic angle of its joint from the same preset's run without the push, from this push
    /// until the next \[deg\].
    pub peak_deflection_deg: BTreeMap<String, f64>,
    /// From the end of the push until every joint stays within 2 degrees, up to the next push \[s\]; null if never.
    pub recovered_after_s: Option<f64>,
    /// Largest deviation of a stance ankle from the input's, in the ground's frame, until the next push \[m\].
    pub stance_deviation_max_m: f64,
    /// Whether every number of the answer is finite.
    pub finite: bool,
}

impl RespondReport {
    pub(super) fn of(
        file: &MotionFile,
        job: &RespondJob,
        prepared: &PreparedClip,
        clip: &Clip,
        pushed: &Track,
        unpushed: &Track,
    ) -> Result<RespondReport, Error> {
        let settings = prepared.motion().stable_settings();
        let body = prepared.reduction().body();
        let timeline = Timeline::of(pushed, unpushed);
        let end = f64::INFINITY;
        let acted = job.pushes.iter().zip(pushed.forces()).filter(|(_, force)| force.is_some());
        let disturbances = acted.map(|(push, _)| (push.at_secs, push.for_secs));
        let disturbances = disturbances.chain(job.ground.iter().map(|jerk| (jerk.at_secs, jerk.for_secs)));
        let last_end = disturbances.clone().map(|(at, lasts)| at + lasts).fold(f64::NEG_INFINITY, f64::max);
        let finite = pushed.is_finite() && clip.first_non_finite().is_none();
        let stance = StanceDeviation::of(file.body_parts()?, prepared, clip, pushed);
        let pushes = job
            .pushes
            .iter()
            .enumerate()
            .map(|(index, push)| {
                let next = disturbances.clone().map(|(at, _)| at).filter(|&at| at > push.at_secs).fold(end, f64::min);
                PushReport::of(push, pushed.forces()[index], &timeline, &stance, finite, next)
            })
            .collect();
        Ok(RespondReport {
            file: file.path.display().to_string(),
            preset: preset_name(settings.preset).to_owned(),
            k: settings.k,
            coordinates: match settings.coordinates {
                Coordinates::Low => "low".to_owned(),
                Coordinates::High => "high".to_owned(),
            },
            compliance: settings.compliance,
            cycle: prepared.cycle(),
            mass_kg: body.mass_kg(),
            height_m: body.stature_m(),
            frames: clip.frames(),
            fps: clip.fps(),
            pushes,
            peak_deflection_deg: timeline.peaks(f64::NEG_INFINITY, end),
            largest_departure_deg: largest_departure(pushed).to_degrees(),
            recovered_after_s: (last_end > f64::NEG_INFINITY).then(|| timeline.recovered(last_end, end)).flatten(),
            stance_deviation_max_m: stance.largest(f64::NEG_INFINITY, end),
            finite,
        })
    }
}

impl PushReport {
    fn of(
        push: &Push,
        world_force_n: Option<DVec3>,
        timeline: &Timeline,
        stance: &StanceDeviation,
        finite: bool,
        next_secs: f64,
    ) -> PushReport {
        PushReport {
            part: push.part.name().to_owned(),
            force_n: push.force_n.to_array(),
            frame: match push.frame {
                PushFrame::Facing => "facing".to_owned(),
                PushFrame::World => "world".to_owned(),
            },
            world_force_n: world_force_n.map(|force| force.to_array()),
            at_s: push.at_secs,
            for_s: push.for_secs,
            peak_deflection_deg: timeline.peaks(push.at_secs, next_secs),
            recovered_after_s: world_force_n.and_then(|_| timeline.recovered(push.at_secs + push.for_secs, next_secs)),
            stance_deviation_max_m: stance.largest(push.at_secs, next_secs),
            finite,
        }
    }
}

/// The largest turn of any joint from the input \[rad\].
fn largest_departure(track: &Track) -> f64 {
    let turns = track.deviations().iter().flat_map(|deviation| deviation.turns.iter().chain([&deviation.hips_turn]));
    turns.map(|turn| turn.length()).fold(0.0, f64::max)
}

/// The command line's word for a preset.
pub(super) fn preset_name(preset: Preset) -> &'static str {
    match preset {
        Preset::Robust => "robust",
        Preset::Paper => "paper",
        Preset::Literal => "literal",
    }
}

/// Every joint's deflection over time.
pub(super) struct Timeline {
    /// Time \[s\] and angle by node \[rad\].
    pub rows: Vec<(f64, [f64; Node::COUNT])>,
}

impl Timeline {
    pub(super) fn of(pushed: &Track, unpushed: &Track) -> Timeline {
        let rows =
            (0..pushed.poses().len()).map(|index| (pushed.secs(index), pushed.deflection(unpushed, index))).collect();
        Timeline { rows }
    }

    fn peaks(&self, from_secs: f64, to_secs: f64) -> BTreeMap<String, f64> {
        let mut peaks = [0.0; Node::COUNT];
        for (_, angles) in self.rows.iter().filter(|(secs, _)| (from_secs..to_secs).contains(secs)) {
            for (peak, angle) in peaks.iter_mut().zip(angles) {
                *peak = f64::max(*peak, *angle);
            }
        }
        let named = Node::ALL.iter().zip(peaks);
        named.map(|(node, peak)| (node.part().name().to_owned(), peak.to_degrees())).collect()
    }

    /// Time from `end_secs` until every joint stays within 2 degrees up to `to_secs`.
    pub(super) fn recovered(&self, end_secs: f64, to_secs: f64) -> Option<f64> {
        let away = |angles: &[f64; Node::COUNT]| !angles.iter().all(|&angle| angle <= RECOVERED);
        let rows = || self.rows.iter().filter(|(secs, _)| (end_secs..to_secs).contains(secs));
        let (last, _) = rows().next_back()?;
        match rows().rfind(|(_, angles)| away(angles)) {
            None => Some(0.0),
            Some((secs, _)) if secs == last => None,
            Some((secs, _)) => rows().map(|(later, _)| *later).find(|later| later > secs).map(|back| back - end_secs),
        }
    }
}

/// How far stance ankles leave the input's over time.
struct StanceDeviation {
    /// Time \[s\] and distance \[m\].
    rows: Vec<(f64, f64)>,
}

impl StanceDeviation {
    fn of(humanoid: &Humanoid, prepared: &PreparedClip, clip: &Clip, track: &Track) -> StanceDeviation {
        let (input, scale) = (prepared.clip(), prepared.reduction().scale());
        let standing = contacts(input, humanoid);
        let ankles = [(Side::Left, Part::LeftFoot), (Side::Right, Part::RightFoot)];
        let (mut before, mut after) = (Vec::new(), Vec::new());
        let mut rows = Vec::new();
        for frame in prepared.first_frame()..clip.frames() {
            input.world_into(frame, &mut before);
            clip.world_into(frame, &mut after);
            let secs = frame as f64 * clip.frame_time_secs();
            let ground = track.deviation_at(secs).ground_shift / scale;
            for (side, part) in ankles {
                if let (true, Some(ankle)) = (standing.side(side)[frame], humanoid.joint(part)) {
                    let gap = after[ankle].translation - before[ankle].translation - ground;
                    rows.push((secs, gap.length()));
                }
            }
        }
        StanceDeviation { rows }
    }

    fn largest(&self, from_secs: f64, to_secs: f64) -> f64 {
        let rows = self.rows.iter().filter(|(secs, _)| (from_secs..to_secs).contains(secs));
        rows.map(|(_, gap)| *gap).fold(0.0, f64::max)
    }
}
