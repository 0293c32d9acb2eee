//! The answered clip and everything that is known about it.

use super::job::RespondJob;
use super::report::RespondReport;
use sinew_motion::formats::MotionFile;
use sinew_motion::{Clip, Error, Note};
use sinew_response::{PreparedClip, Track};

/// A clip that has answered.
#[derive(Clone, Debug)]
pub struct Answer {
    /// The motion before, and all that was found in it. The compliance used may be less than asked for, see [`Answer::notes`].
    pub prepared: PreparedClip,
    /// The answered motion on the source's own skeleton, metres, Y up.
    pub clip: Clip,
    /// The run.
    pub pushed: Track,
    /// The same without disturbances.
    pub unpushed: Track,
    /// What happened.
    pub report: RespondReport,
    /// What the user should know.
    pub notes: Vec<Note>,
}

impl Answer {
    pub(super) fn new(
        file: &MotionFile,
        job: &RespondJob,
        prepared: PreparedClip,
        pushed: Track,
        unpushed: Track,
        notes: Vec<Note>,
    ) -> Result<Answer, Error> {
        let clip = prepared.applied(&pushed);
        let report = RespondReport::of(file, job, &prepared, &clip, &pushed, &unpushed)?;
        Ok(Answer { prepared, clip, pushed, unpushed, report, notes })
    }

    /// For each frame of [`Answer::clip`] the frame of the file that it came from, as
    /// [`MotionFile::write`](sinew_motion::formats::MotionFile::write) wants it.
    pub fn rows(&self) -> &[usize] {
        self.prepared.rows()
    }
}
