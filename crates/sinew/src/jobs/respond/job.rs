//! From a motion file and pushes to an answer.

use super::answer::Answer;
use sinew_body::humanoid::{Person, Reduction, ReductionError, UPPER_DOFS};
use sinew_motion::formats::MotionFile;
use sinew_motion::{Clip, Error, Humanoid, Note, find_cycle, moves_from, repeat};
use sinew_response::{
    Basis, BasisError, Coordinates, Disturbances, GroundJerk, Motion, Preset, Push, Settings, Track, stable_compliance,
};

/// Most frames that a repetition may make: half an hour at 120 Hz.
const MAX_FRAMES: usize = 216_000;

/// What is to happen to a clip.
#[derive(Clone, Debug, Default)]
pub struct RespondJob {
    /// Pushes on the body.
    pub pushes: Vec<Push>,
    /// Jerks of the ground.
    pub ground: Vec<GroundJerk>,
    /// The response's settings.
    pub settings: Settings,
    /// The frames of the cycle from which the basis is made, both ends in; found where not given.
    pub cycle: Option<(usize, usize)>,
    /// How often to play the cycle, seamlessly; 0 leaves the clip as it is.
    pub repeat: usize,
    /// Who the character is.
    pub person: Person,
}

/// Why a clip cannot answer.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum RespondError {
    /// The file, or the body in it.
    #[error(transparent)]
    File(#[from] Error),
    /// The skeleton's proportions or the person.
    #[error(transparent)]
    Body(#[from] ReductionError),
    /// The motion has no coordinates to be found.
    #[error(transparent)]
    Basis(#[from] BasisError),
    /// A cycle that is not in the clip.
    #[error("the cycle {0}..{1} is not within the clip's frames 0..{2}; both ends count from 0 and are included")]
    Cycle(usize, usize, usize),
    /// Nothing to repeat.
    #[error("no gait cycle was found to repeat; give one with --cycle FIRST..LAST")]
    NoCycle,
    /// Too much of it.
    #[error("{0} repetitions of {1} frames are more than {MAX_FRAMES} frames; repeat less often")]
    TooLong(usize, usize),
    /// More coordinates than the upper body has.
    #[error("k = {0} is out of range: the upper body has {UPPER_DOFS} coordinates, so k is 0 to {UPPER_DOFS}")]
    TooManyCoordinates(usize),
    /// A compliance that is out of range, or NaN.
    #[error(
        "a compliance of {0} is out of range: {min} (stiff) to {max} (loose), 1 is the default",
        min = Settings::MIN_COMPLIANCE,
        max = Settings::MAX_COMPLIANCE
    )]
    Compliance(f64),
    /// A compliance for a preset that has no such dial.
    #[error("--compliance is the robust preset's dial; the paper's presets yield by -k")]
    ComplianceOfPaperPreset,
    /// The paper's counter-experiment with the preset that has none.
    #[error("--coordinates high is the paper's counter-experiment; use it with --preset paper")]
    HighCoordinatesOfRobustPreset,
}

impl RespondError {
    /// Whether the job asks for what cannot be, whatever the file: [`RespondJob::settings`] or [`RespondJob::person`] out of range.
    pub fn is_of_job(&self) -> bool {
        use RespondError::{ComplianceOfPaperPreset, HighCoordinatesOfRobustPreset, TooManyCoordinates};
        matches!(
            self,
            TooManyCoordinates(_)
                | RespondError::Compliance(_)
                | ComplianceOfPaperPreset
                | HighCoordinatesOfRobustPreset
                | RespondError::Body(ReductionError::Person { .. })
        )
    }
}

/// Runs the job. `basis_from` lends its coordinates of actuation, another person's or style's; else the clip's own are used.
///
/// # Errors
/// When the file holds no human body, or the job asks for what cannot be.
pub fn respond(file: &MotionFile, job: &RespondJob, basis_from: Option<&MotionFile>) -> Result<Answer, RespondError> {
    check(&job.settings)?;
    let humanoid = file.body_parts()?;
    let mut notes = Vec::new();
    let first_frame = moves_from(&file.clip, humanoid);
    let cycle = cycle_of(&file.clip, humanoid, job.cycle)?;
    let reduction = Reduction::new(&file.clip, humanoid, file.stature_m, job.person)?;
    let repeated = repeated(file, humanoid, cycle, job.repeat)?;
    let input = match repeated {
        Some(repeated) => {
            let length = cycle.map_or(0, |(first, last)| last - first);
            // A round in the middle: at the ends the filter has less to go by.
            let first = job.repeat / 2 * length;
            Input { clip: repeated.clip, rows: repeated.rows, first_frame: 0, cycle: Some((first, first + length)) }
        }
        None => Input {
            clip: file.clip.clone(),
            rows: (0..file.clip.frames()).collect(),
            first_frame,
            cycle: cycle.map(|(first, last)| (first.max(first_frame), last)),
        },
    };
    let motion = Motion::of_clip(&input.clip, &reduction, input.first_frame, &job.settings);
    let mut body = reduction.body().clone();
    motion.widen(&mut body);
    let cyclic = input.cyclic_part(&motion);
    let mut basis = Basis::of_motion(&body, cyclic, &job.settings)?;
    if let Some(other) = basis_from {
        basis = basis.with_directions_of(&basis_of(other, job)?);
    }
    let mut settings = job.settings;
    if settings.preset == Preset::Robust {
        settings.compliance = stable_compliance(&body, &basis, &settings, cyclic);
        if settings.compliance < job.settings.compliance {
            notes.push(Note::new(format!(
                "compliance {} would not come back on this motion: {:.2} is the loosest that does and is used instead",
                job.settings.compliance, settings.compliance
            )));
        }
    }
    let happens = Disturbances { pushes: &job.pushes, ground: &job.ground };
    let pushed = Track::run(&body, &basis, &settings, &motion, happens);
    let disturbed = !job.pushes.is_empty() || !job.ground.is_empty();
    let unpushed =
        if disturbed { Track::run(&body, &basis, &settings, &motion, Disturbances::default()) } else { pushed.clone() };
    let end_secs = input.clip.duration_secs();
    for (push, _) in job.pushes.iter().zip(pushed.forces()).filter(|(_, force)| force.is_none()) {
        notes.push(Note::new(format!(
            "the push at {} s never acts: it comes after the clip's end at {end_secs:.2} s, or lasts no time; --repeat makes a walk \
             longer",
            push.at_secs
        )));
    }
    Ok(Answer::new(file, humanoid, job, settings, input, cycle, reduction, basis, motion, pushed, unpushed, notes))
}

/// The clip that is answered, after repetition.
pub(super) struct Input {
    pub clip: Clip,
    /// For each frame the frame of the file.
    pub rows: Vec<usize>,
    /// Frames before this one are a rest pose and stay as they are.
    pub first_frame: usize,
    /// In frames of `clip`.
    pub cycle: Option<(usize, usize)>,
}

impl Input {
    /// The poses of the cycle; the whole motion when there is none or it is too short to tell.
    fn cyclic_part<'a>(&self, motion: &'a Motion) -> &'a [sinew_body::humanoid::Pose] {
        let Some((first, last)) = self.cycle else { return motion.poses() };
        let secs = |frame: usize| frame as f64 * self.clip.frame_time_secs();
        let poses = motion.between_secs(secs(first), secs(last));
        if poses.len() < 3 { motion.poses() } else { poses }
    }
}

fn check(settings: &Settings) -> Result<(), RespondError> {
    if settings.k > UPPER_DOFS {
        return Err(RespondError::TooManyCoordinates(settings.k));
    }
    let dial = Settings::MIN_COMPLIANCE..=Settings::MAX_COMPLIANCE;
    if !dial.contains(&settings.compliance) {
        return Err(RespondError::Compliance(settings.compliance));
    }
    if settings.preset != Preset::Robust && settings.compliance != 1.0 {
        return Err(RespondError::ComplianceOfPaperPreset);
    }
    if settings.coordinates == Coordinates::High && settings.preset == Preset::Robust {
        return Err(RespondError::HighCoordinatesOfRobustPreset);
    }
    Ok(())
}

fn cycle_of(
    clip: &Clip,
    humanoid: &Humanoid,
    stated: Option<(usize, usize)>,
) -> Result<Option<(usize, usize)>, RespondError> {
    let Some((first, last)) = stated else {
        return Ok(find_cycle(clip, humanoid).map(|cycle| (cycle.first, cycle.last)));
    };
    if first >= last || last >= clip.frames() {
        return Err(RespondError::Cycle(first, last, clip.frames().saturating_sub(1)));
    }
    Ok(Some((first, last)))
}

fn repeated(
    file: &MotionFile,
    humanoid: &Humanoid,
    cycle: Option<(usize, usize)>,
    times: usize,
) -> Result<Option<sinew_motion::Repeated>, RespondError> {
    if times == 0 {
        return Ok(None);
    }
    let (first, last) = cycle.ok_or(RespondError::NoCycle)?;
    let frames = last - first;
    if frames.saturating_mul(times) > MAX_FRAMES {
        return Err(RespondError::TooLong(times, frames));
    }
    Ok(Some(repeat(&file.clip, humanoid, (first, last), times)))
}

/// The coordinates of actuation of another file's motion, for the same person.
fn basis_of(file: &MotionFile, job: &RespondJob) -> Result<Basis, RespondError> {
    let humanoid = file.body_parts()?;
    let first_frame = moves_from(&file.clip, humanoid);
    let reduction = Reduction::new(&file.clip, humanoid, file.stature_m, job.person)?;
    let motion = Motion::of_clip(&file.clip, &reduction, first_frame, &job.settings);
    let secs = |frame: usize| frame as f64 * file.clip.frame_time_secs();
    let poses = match find_cycle(&file.clip, humanoid) {
        Some(cycle) => motion.between_secs(secs(cycle.first.max(first_frame)), secs(cycle.last)),
        None => motion.poses(),
    };
    Ok(Basis::of_motion(reduction.body(), poses, &job.settings)?)
}
