//! The report of a response: the JSON of `--report`.

use super::job::RespondJob;
use glam::DVec3;
use serde::Serialize;
use sinew_body::humanoid::Node;
use sinew_motion::formats::MotionFile;
use sinew_motion::{Clip, Error};
use sinew_response::{Coordinates, Deflection, PreparedClip, Preset, Push, PushFrame, StanceDeviation, Track};
use std::collections::BTreeMap;

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
        let deflection = Deflection::between(pushed, unpushed);
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
                PushReport::of(push, pushed.forces()[index], &deflection, &stance, finite, next)
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
            peak_deflection_deg: peaks_deg(&deflection, f64::NEG_INFINITY, end),
            largest_departure_deg: pushed.largest_departure_rad().to_degrees(),
            recovered_after_s: (last_end > f64::NEG_INFINITY)
                .then(|| deflection.recovered_secs(last_end, end))
                .flatten(),
            stance_deviation_max_m: stance.largest_m(f64::NEG_INFINITY, end),
            finite,
        })
    }
}

impl PushReport {
    fn of(
        push: &Push,
        world_force_n: Option<DVec3>,
        deflection: &Deflection,
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
            peak_deflection_deg: peaks_deg(deflection, push.at_secs, next_secs),
            recovered_after_s: world_force_n
                .and_then(|_| deflection.recovered_secs(push.at_secs + push.for_secs, next_secs)),
            stance_deviation_max_m: stance.largest_m(push.at_secs, next_secs),
            finite,
        }
    }
}

/// The command line's word for a preset.
pub(super) fn preset_name(preset: Preset) -> &'static str {
    match preset {
        Preset::Robust => "robust",
        Preset::Paper => "paper",
        Preset::Literal => "literal",
    }
}

/// The largest angle of every joint over a stretch of time, by the part's name \[deg\].
fn peaks_deg(deflection: &Deflection, from_secs: f64, to_secs: f64) -> BTreeMap<String, f64> {
    let peaks = deflection.peaks_rad(from_secs, to_secs);
    let named = Node::ALL.iter().zip(peaks);
    named.map(|(node, peak)| (node.part().name().to_owned(), peak.to_degrees())).collect()
}
