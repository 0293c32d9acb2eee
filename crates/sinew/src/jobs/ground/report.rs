//! The report of a grounding: the JSON of `--report`.

use serde::Serialize;
use sinew_body::grounding::{Grounding, Quality};
use sinew_body::humanoid::Reduction;
use sinew_motion::Clip;
use sinew_motion::formats::MotionFile;

/// The report of a grounding. Units are in the names; lengths are those of the clip.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct GroundReport {
    /// The file.
    pub file: String,
    /// Frames written.
    pub frames: usize,
    /// Frames per second.
    pub fps: f64,
    /// Height of the floor \[m\].
    pub floor_m: f64,
    /// How far the body was shifted over the ground from its first frame to its last \[m\].
    pub drift_m: f64,
    /// Lowest and highest shift up \[m\]: how far it floated (negative) and sank.
    pub lifted_m: [f64; 2],
    /// Estimated jitter of the root before, largest standard deviation of the three axes \[m\].
    pub jitter_m: f64,
    /// Time in which the left or right foot stands flat, both added \[s\].
    pub stands_s: f64,
    /// Largest change of any joint's rotation \[deg\].
    pub largest_turn_deg: f64,
    /// How the clip stood before.
    pub before: GroundQuality,
    /// How it stands now.
    pub after: GroundQuality,
}

/// How well a motion stands on its floor.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct GroundQuality {
    /// Mean speed of standing feet over the ground \[m/s\].
    pub slide_mean_m_s: f64,
    /// 95th percentile of that speed \[m/s\].
    pub slide_95_m_s: f64,
    /// Root mean square of the height of standing feet over the floor \[m\].
    pub height_rms_m: f64,
    /// Largest height of a standing foot over the floor \[m\].
    pub float_m: f64,
    /// Largest depth of heel or toes in the floor \[m\].
    pub penetration_m: f64,
    /// Residual root force, root mean square \[1 of the body's weight\]: what no contact of feet with the floor can give.
    pub residual_force_weights: f64,
    /// Residual root moment, root mean square \[1 of weight times stature\].
    pub residual_moment_weights: f64,
}

impl GroundReport {
    pub(super) fn of(
        file: &MotionFile,
        clip: &Clip,
        grounding: &Grounding,
        reduction: &Reduction,
        first_frame: usize,
    ) -> GroundReport {
        let scale = 1.0 / reduction.scale();
        let shifts = &grounding.body_shifts;
        let ends = shifts.first().zip(shifts.last());
        let drift = ends.map_or(0.0, |(first, last)| (*last - *first).with_y(0.0).length());
        let fold = |start: f64, of: fn(f64, f64) -> f64| shifts.iter().map(|shift| shift.y).fold(start, of);
        let turn = |frame: usize, joint: usize| {
            file.clip.rotation(frame, joint).angle_between(clip.rotation(frame, joint)).to_degrees()
        };
        let turns =
            (0..clip.frames()).flat_map(|frame| (0..clip.skeleton().len()).map(move |joint| turn(frame, joint)));
        let quality = |clip: &Clip| GroundQuality::of(&grounding.quality(clip, reduction, first_frame), scale);
        GroundReport {
            file: file.path.display().to_string(),
            frames: clip.frames(),
            fps: clip.fps(),
            floor_m: grounding.floor_m * scale,
            drift_m: drift * scale,
            lifted_m: if shifts.is_empty() {
                [0.0; 2]
            } else {
                [fold(f64::INFINITY, f64::min) * scale, fold(f64::NEG_INFINITY, f64::max) * scale]
            },
            jitter_m: grounding.jitter_m.max_element() * scale,
            stands_s: grounding.stands_secs(clip.fps()),
            largest_turn_deg: turns.fold(0.0, f64::max),
            before: quality(&file.clip),
            after: quality(clip),
        }
    }
}

impl GroundQuality {
    /// Lengths are scaled from the body to the clip.
    fn of(quality: &Quality, scale: f64) -> GroundQuality {
        GroundQuality {
            slide_mean_m_s: quality.slide_mean_m_s * scale,
            slide_95_m_s: quality.slide_95_m_s * scale,
            height_rms_m: quality.height_rms_m * scale,
            float_m: quality.float_m * scale,
            penetration_m: quality.penetration_m * scale,
            residual_force_weights: quality.residual_force,
            residual_moment_weights: quality.residual_moment,
        }
    }
}
