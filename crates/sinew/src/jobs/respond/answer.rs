//! The answered clip and everything that is known about it.

use super::job::{Input, RespondJob};
use super::report::RespondReport;
use sinew_body::humanoid::{Overlay, Reduction};
use sinew_motion::formats::MotionFile;
use sinew_motion::{Clip, Humanoid, Note};
use sinew_response::{Basis, Motion, Settings, Track};

/// A clip that has answered.
#[derive(Clone, Debug)]
pub struct Answer {
    /// The answered motion on the source's own skeleton, metres, Y up.
    pub clip: Clip,
    /// The motion before: the file's, or its cycle repeated.
    pub input: Clip,
    /// For each frame the frame of the file that it came from.
    pub rows: Vec<usize>,
    /// Frames before this one are a rest pose and stayed as they are.
    pub first_frame: usize,
    /// The cycle in the file's own frames, both ends in, where there is one.
    pub cycle: Option<(usize, usize)>,
    /// How the skeleton is seen as a body.
    pub reduction: Reduction,
    /// The coordinates of actuation used.
    pub basis: Basis,
    /// The settings used; the compliance may be less than asked for, see [`Answer::notes`].
    pub settings: Settings,
    /// The motion as the response saw it.
    pub motion: Motion,
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
    #[allow(clippy::too_many_arguments, reason = "the one place where the job's results are put together")]
    pub(super) fn new(
        file: &MotionFile,
        humanoid: &Humanoid,
        job: &RespondJob,
        settings: Settings,
        input: Input,
        cycle: Option<(usize, usize)>,
        reduction: Reduction,
        basis: Basis,
        motion: Motion,
        pushed: Track,
        unpushed: Track,
        notes: Vec<Note>,
    ) -> Answer {
        let clip = answered(&input, &reduction, &pushed);
        let report =
            RespondReport::of(file, humanoid, job, &settings, &input, cycle, &clip, &reduction, &pushed, &unpushed);
        Answer {
            clip,
            input: input.clip,
            rows: input.rows,
            first_frame: input.first_frame,
            cycle,
            reduction,
            basis,
            settings,
            motion,
            pushed,
            unpushed,
            report,
            notes,
        }
    }
}

/// The clip with the track's deviations on its own joints, at its own rate.
fn answered(input: &Input, reduction: &Reduction, track: &Track) -> Clip {
    let mut clip = input.clip.clone();
    let mut overlay = Overlay::new(reduction, clip.moving());
    let mut world = Vec::with_capacity(clip.skeleton().len());
    let moving = clip.moving().to_vec();
    for frame in input.first_frame..clip.frames() {
        let secs = frame as f64 * clip.frame_time_secs();
        let deviation = track.deviation_at(secs).with_shifts_scaled(1.0 / reduction.scale());
        input.clip.world_into(frame, &mut world);
        let mut moved = None;
        overlay.apply(
            &world,
            &deviation,
            |joint, rotation| clip.set_rotation(frame, joint, rotation),
            |joint, translation| moved = Some((joint, translation)),
        );
        if let Some((joint, translation)) = moved
            && moving.contains(&joint)
        {
            clip.set_translation(frame, joint, translation);
        }
    }
    clip
}
