//! From a motion file to the same motion on its floor.

use super::report::GroundReport;
use sinew_body::grounding::{GroundSettings, Grounding};
use sinew_body::humanoid::{Person, Reduction, ReductionError};
use sinew_motion::formats::MotionFile;
use sinew_motion::{Clip, Error, Note, moves_from};

/// How a clip is put on its floor.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct GroundJob {
    /// Height of the floor \[m\], in the clip's axes, Y up; -100 to 100. Default `None`: where the clip's soles stand on average.
    pub floor_m: Option<f64>,
    /// Who the character is; the mass counts for no shift.
    pub person: Person,
}

/// Why a clip cannot be grounded.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum GroundError {
    /// The file, or the body in it.
    #[error(transparent)]
    File(#[from] Error),
    /// The skeleton's proportions or the person.
    #[error(transparent)]
    Body(#[from] ReductionError),
    /// [`GroundJob::floor_m`] is out of range.
    #[error("GroundJob::floor_m {0} is out of range; give -100 to 100")]
    Floor(f64),
    /// No foot stands anywhere in the clip.
    #[error(
        "no foot stands flat anywhere in the clip, so nothing tells where the floor is; a swim, a flight or a run of few frames cannot be \
         grounded"
    )]
    NeverStands,
}

impl GroundError {
    /// Whether the job asks for what cannot be, whatever the file.
    pub fn is_of_job(&self) -> bool {
        matches!(self, GroundError::Floor(_) | GroundError::Body(ReductionError::Person { .. }))
    }
}

/// A clip on its floor.
#[derive(Clone, Debug)]
pub struct Grounded {
    /// The motion on the source's own skeleton, metres, Y up.
    pub clip: Clip,
    /// What was found and shifted.
    pub grounding: Grounding,
    /// How the skeleton is seen as a body.
    pub reduction: Reduction,
    /// Frames before this one are a rest pose and stay as they are.
    pub first_frame: usize,
    /// How well it stands, before and after.
    pub report: GroundReport,
    /// What the user should know.
    pub notes: Vec<Note>,
}

/// Runs the job.
///
/// ```
/// use sinew::jobs::ground::{GroundJob, ground};
/// use sinew::motion::formats::{MotionFile, ReadOptions};
/// let walk = MotionFile::from_bvh(&sinew::stage::sample_walk_bvh()?, &ReadOptions::default())?;
/// // A walk that stands well hardly moves.
/// let grounded = ground(&walk, &GroundJob::default())?;
/// assert!(grounded.report.drift_m < 0.03);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// When the file holds no human body, no foot ever stands, or the job asks for what cannot be.
pub fn ground(file: &MotionFile, job: &GroundJob) -> Result<Grounded, GroundError> {
    if let Some(floor) = job.floor_m.filter(|floor| !(-100.0..=100.0).contains(floor)) {
        return Err(GroundError::Floor(floor));
    }
    let humanoid = file.body_parts()?;
    let reduction = Reduction::new(&file.clip, humanoid, file.stature_m, job.person)?;
    let first_frame = moves_from(&file.clip, humanoid);
    let settings = GroundSettings { floor_m: job.floor_m.map(|floor| floor * reduction.scale()) };
    let grounding = Grounding::of_clip(&file.clip, &reduction, first_frame, &settings);
    if grounding.stands_secs(file.clip.fps()) < LEAST_SECS {
        return Err(GroundError::NeverStands);
    }
    let clip = grounding.applied(&file.clip, &reduction, first_frame);
    let report = GroundReport::of(file, &clip, &grounding, &reduction, first_frame);
    let mut notes = Vec::new();
    if grounding.stands_share() < Grounding::SURE_SHARE {
        let percent = 1e2 * grounding.stands_share();
        notes.push(Note::new(format!(
            "soles lie flat for {percent:.0} % of the time only: up to two thirds of how it floats may be left; look at the picture"
        )));
    }
    Ok(Grounded { clip, grounding, reduction, first_frame, report, notes })
}

/// A foot must stand for at least so long in all \[s\].
const LEAST_SECS: f64 = 0.1;
