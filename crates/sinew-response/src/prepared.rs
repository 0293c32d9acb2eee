//! A motion made ready to be pushed: all that is found once per motion.

use crate::basis::{Basis, BasisError};
use crate::live::Live;
use crate::motion::Motion;
use crate::response::Response;
use crate::settings::{Preset, Settings, SettingsError};
use crate::stability::stable_compliance;
use crate::track::{Disturbances, Track};
use sinew_body::humanoid::{Body, Pose};
use std::ops::Range;
use std::sync::OnceLock;

/// Why a motion cannot be made ready.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum PrepareError {
    /// A setting is out of range.
    #[error(transparent)]
    Settings(#[from] SettingsError),
    /// The motion has no coordinates of actuation.
    #[error(transparent)]
    Basis(#[from] BasisError),
    /// The stated cycle is not in the clip: its first and last frame, and the clip's last frame.
    #[error("the cycle {0}..{1} is not within the clip's frames 0..{2}; both ends count from 0 and are included")]
    Cycle(usize, usize, usize),
    /// There is no cycle to repeat.
    #[error("no gait cycle was found to repeat; state its first and last frame in Excerpt::cycle")]
    NoCycle,
    /// Repetition would make more than [`Excerpt::MAX_FRAMES`](crate::Excerpt::MAX_FRAMES): how often, and the frames of one cycle.
    #[error("{0} repetitions of {1} frames are more than {max} frames; repeat less often", max = crate::Excerpt::MAX_FRAMES)]
    TooLong(usize, usize),
}

/// A motion made ready to be pushed: the body with its limits widened to the motion, the motion at the response's rate, its
/// coordinates of actuation, the settings, and how loose the body may be and still come back.
///
/// Make one per character and motion; it changes no more, and any number of responses can start from it. Of a clip, see
/// [`PreparedClip`](crate::PreparedClip).
///
/// ```
/// use sinew_body::humanoid::{Body, Pose};
/// use sinew_response::{Prepared, Settings};
///
/// let standing = vec![Pose::STANDING; 60]; // an engine's animation, 60 poses a second
/// let prepared = Prepared::of_poses(Body::standard(80.0, 1.7), standing, Settings::default())?;
/// let mut response = prepared.response(&Pose::STANDING);
/// assert!(response.step(&Pose::STANDING, &[]).is_finite());
/// # Ok::<(), sinew_response::PrepareError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Prepared {
    body: Body,
    motion: Motion,
    measured: Range<usize>,
    basis: Basis,
    settings: Settings,
    /// Found when first asked for: the search takes some thousand steps of the response.
    stable_compliance: OnceLock<f64>,
}

impl Prepared {
    /// Poses that follow each other at the settings' time step, all of which the basis is made from. They should be low-pass
    /// filtered (6 Hz): accelerations are second differences.
    ///
    /// # Errors
    /// When a setting is out of range, or the poses are fewer than three or not finite.
    pub fn of_poses(body: Body, poses: Vec<Pose>, settings: Settings) -> Result<Prepared, PrepareError> {
        let measured = 0..poses.len();
        Prepared::of_motion(body, Motion::of_poses(poses, &settings), measured, settings)
    }

    /// A motion, and which of its poses the basis is made from.
    pub(crate) fn of_motion(
        mut body: Body,
        motion: Motion,
        measured: Range<usize>,
        settings: Settings,
    ) -> Result<Prepared, PrepareError> {
        settings.check()?;
        let basis = Basis::of_motion(&body, &motion.poses()[measured.clone()], &settings)?;
        motion.widen(&mut body);
        Ok(Prepared { body, motion, measured, basis, settings, stable_compliance: OnceLock::new() })
    }

    /// The same motion with another preset, k, end of the spectrum or compliance. Time step and gravity stay those that the
    /// motion was prepared for.
    ///
    /// # Errors
    /// When a setting is out of range.
    pub fn with_settings(&self, settings: Settings) -> Result<Prepared, SettingsError> {
        let Settings { time_step_secs, gravity_m_s2, .. } = self.settings;
        let settings = Settings { time_step_secs, gravity_m_s2, ..settings };
        settings.check()?;
        Ok(Prepared { settings, stable_compliance: OnceLock::new(), ..self.clone() })
    }

    /// The same motion with the directions and spectrum of another one's basis: another person's or style's actuation.
    #[must_use]
    pub fn with_directions_of(&self, other: &Basis) -> Prepared {
        let basis = self.basis.with_directions_of(other);
        Prepared { basis, stable_compliance: OnceLock::new(), ..self.clone() }
    }

    /// The body, its joint limits widened to all that the motion does.
    pub fn body(&self) -> &Body {
        &self.body
    }

    /// The motion as the response sees it.
    pub fn motion(&self) -> &Motion {
        &self.motion
    }

    /// The poses of [`Prepared::motion`] from which the basis was made: one gait cycle, or all.
    pub fn measured(&self) -> Range<usize> {
        self.measured.clone()
    }

    /// The coordinates of actuation.
    pub fn basis(&self) -> &Basis {
        &self.basis
    }

    /// The settings as asked for, see [`Prepared::stable_settings`].
    pub fn settings(&self) -> &Settings {
        &self.settings
    }

    /// The settings that a response uses: of the robust preset the compliance, or the loosest below it at which small
    /// deviations die out on this motion within seconds; where they never do so fast, the one at which they die out fastest.
    /// The paper's presets stay as they are.
    ///
    /// The first call searches, which takes some milliseconds to a second; the result is kept.
    pub fn stable_settings(&self) -> Settings {
        if self.settings.preset != Preset::Robust {
            return self.settings;
        }
        let measured = &self.motion.poses()[self.measured.clone()];
        let search = || stable_compliance(&self.body, &self.basis, &self.settings, measured);
        Settings { compliance: *self.stable_compliance.get_or_init(search), ..self.settings }
    }

    /// A response at rest in `first`.
    pub fn response(&self, first: &Pose) -> Response {
        Response::new(self.body.clone(), self.basis.clone(), self.stable_settings(), first)
    }

    /// A response to a live stream that begins at rest in `first`.
    pub fn live(&self, first: &Pose) -> Live {
        Live::new(self.body.clone(), self.basis.clone(), self.stable_settings(), first)
    }

    /// Runs the response through the whole motion.
    ///
    /// ```
    /// use sinew_body::humanoid::{Body, Pose};
    /// use sinew_response::{Disturbances, Prepared, Settings};
    ///
    /// let standing = vec![Pose::STANDING; 60];
    /// let prepared = Prepared::of_poses(Body::standard(80.0, 1.7), standing, Settings::default())?;
    /// let track = prepared.run(Disturbances::default());
    /// assert_eq!(track.poses(), prepared.motion().poses(), "nothing disturbs it");
    /// # Ok::<(), sinew_response::PrepareError>(())
    /// ```
    pub fn run(&self, disturbances: Disturbances) -> Track {
        Track::run(&self.body, &self.basis, &self.stable_settings(), &self.motion, disturbances)
    }
}
