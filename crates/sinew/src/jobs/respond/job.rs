//! From a motion file and pushes to an answer.

use super::answer::Answer;
use sinew_body::humanoid::{Person, Reduction, ReductionError};
use sinew_motion::formats::MotionFile;
use sinew_motion::{Error, Note};
use sinew_response::{Disturbances, Excerpt, GroundJerk, PrepareError, PreparedClip, Push, Settings};

/// What is to happen to a clip.
#[derive(Clone, Debug, Default)]
pub struct RespondJob {
    /// Pushes on the body.
    pub pushes: Vec<Push>,
    /// Jerks of the ground.
    pub ground: Vec<GroundJerk>,
    /// The response's settings.
    pub settings: Settings,
    /// First and last frame of the cycle from which the basis is made, see [`Excerpt::cycle`].
    pub cycle: Option<(usize, usize)>,
    /// How often to play the cycle, see [`Excerpt::repeat`].
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
    /// The settings, the cycle, or the motion itself.
    #[error(transparent)]
    Motion(#[from] PrepareError),
}

impl RespondError {
    /// Whether the job asks for what cannot be, whatever the file: [`RespondJob::settings`] or [`RespondJob::person`] out of range.
    pub fn is_of_job(&self) -> bool {
        matches!(
            self,
            RespondError::Motion(PrepareError::Settings(_)) | RespondError::Body(ReductionError::Person { .. })
        )
    }
}

/// Runs the job. `basis_from` lends its coordinates of actuation, another person's or style's; else the clip's own are used.
///
/// ```
/// use sinew::jobs::respond::{RespondJob, respond};
/// use sinew::motion::formats::{MotionFile, ReadOptions};
/// let walk = MotionFile::from_bvh(&sinew::stage::sample_walk_bvh()?, &ReadOptions::default())?;
/// // Nothing pushes it: the answer is the clip.
/// let answer = respond(&walk, &RespondJob::default(), None)?;
/// assert_eq!(answer.clip.frames(), walk.clip.frames());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// When the file holds no human body, or the job asks for what cannot be.
pub fn respond(file: &MotionFile, job: &RespondJob, basis_from: Option<&MotionFile>) -> Result<Answer, RespondError> {
    let mut prepared = prepared(file, job, Excerpt { cycle: job.cycle, repeat: job.repeat })?;
    if let Some(other) = basis_from {
        let other = self::prepared(other, job, Excerpt::default())?;
        prepared = prepared.with_directions_of(other.motion().basis());
    }
    let mut notes = Vec::new();
    let (asked, used) = (job.settings.compliance, prepared.motion().stable_settings().compliance);
    if used < asked {
        notes.push(Note::new(format!(
            "compliance {asked} would not come back on this motion: {used:.2} is the loosest that does and is used instead"
        )));
    }
    let pushed = prepared.motion().run(Disturbances { pushes: &job.pushes, ground: &job.ground });
    let disturbed = !job.pushes.is_empty() || !job.ground.is_empty();
    let unpushed = if disturbed { prepared.motion().run(Disturbances::default()) } else { pushed.clone() };
    let end_secs = prepared.clip().duration_secs();
    for (push, _) in job.pushes.iter().zip(pushed.forces()).filter(|(_, force)| force.is_none()) {
        notes.push(Note::new(format!(
            "the push at {} s never acts: it comes after the clip's end at {end_secs:.2} s, or lasts no time; Excerpt::repeat makes a \
             walk longer",
            push.at_secs
        )));
    }
    Ok(Answer::new(file, job, prepared, pushed, unpushed, notes)?)
}

fn prepared(file: &MotionFile, job: &RespondJob, excerpt: Excerpt) -> Result<PreparedClip, RespondError> {
    let humanoid = file.body_parts()?;
    let reduction = Reduction::new(&file.clip, humanoid, file.stature_m, job.person)?;
    Ok(PreparedClip::new(&file.clip, humanoid, reduction, excerpt, job.settings)?)
}
