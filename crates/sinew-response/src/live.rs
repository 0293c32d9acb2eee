//! A response on a stream.
//!
//! The torque that a motion uses at one instant needs the poses before and after it, twice differentiated, so it needs
//! low-pass filtering. Over a clip that is done forward and backward, without delay. On a stream only the past is
//! known: the filter is causal, and its output lags by its group delay, about 37 ms at 6 Hz. That matters little,
//! because the response only uses by how much its own motion *differs* from the filtered one: the resulting deviation
//! is applied to the wanted pose itself, unfiltered and without lag.

use crate::basis::Basis;
use crate::force::PointForce;
use crate::response::{Report, Response};
use crate::settings::{CUTOFF_HZ, Settings};
use glam::DVec3;
use sinew_body::humanoid::{Body, Deviation, Node, Pose};
use sinew_motion::{LowPass, LowPassStream};
use sinew_snapshot::snapshot;

/// A character that responds to pushes while it follows a live stream of poses: one [`advance`](Live::advance) a frame.
///
/// A force that the engine computes on the pose of one frame is passed with the next wanted pose and takes effect in
/// the returned pose: one frame of delay, and no more. No call allocates or panics; a pose that is not finite is
/// replaced by the last good one.
///
/// ```
/// use glam::DVec3;
/// use sinew_body::humanoid::{Body, Node, Pose};
/// use sinew_response::{PointForce, Prepared, Settings};
///
/// // A stream has no clip to measure: the basis comes from a take of the performer, or from any clip of the kind.
/// let take = vec![Pose::STANDING; 60];
/// let prepared = Prepared::of_poses(Body::standard(80.0, 1.7), take, Settings::default())?;
/// let mut live = prepared.live(&Pose::STANDING);
/// for _frame in 0..10 {
///     let wanted = Pose::STANDING; // from the capture system
///     let shown = live.advance(&wanted, &[PointForce::at_centre(Node::Head, DVec3::X * 50.0)]);
///     assert!(shown.is_finite());
/// }
/// # Ok::<(), sinew_response::PrepareError>(())
/// ```
#[derive(Clone, Debug)]
pub struct Live {
    response: Response,
    hips: LowPassStream<3>,
    joints: [LowPassStream<4>; Node::COUNT],
    last: Pose,
}

snapshot!(Live { response, hips, joints, last });

impl Live {
    /// A stream that begins at rest in `first`.
    pub fn new(body: Body, basis: Basis, settings: Settings, first: &Pose) -> Live {
        let filter = LowPass::new(CUTOFF_HZ, 1.0 / settings.time_step_secs);
        Live {
            response: Response::new(body, basis, settings, first),
            hips: LowPassStream::new(filter),
            joints: std::array::from_fn(|_| LowPassStream::new(filter)),
            last: *first,
        }
    }

    /// Advances one frame: `wanted` is the stream's new pose, `forces` those that act on the pose returned last.
    pub fn advance(&mut self, wanted: &Pose, forces: &[PointForce]) -> Pose {
        self.advance_on_moving_ground(wanted, forces, DVec3::ZERO)
    }

    /// As [`Live::advance`], on ground that accelerates \[m/s², world\].
    pub fn advance_on_moving_ground(&mut self, wanted: &Pose, forces: &[PointForce], ground: DVec3) -> Pose {
        if wanted.is_finite() {
            self.last = *wanted;
        }
        let wanted = self.last;
        let smooth = self.filtered(&wanted);
        self.response.step_on_moving_ground(&smooth, forces, ground);
        wanted.deviated(self.response.body(), &self.response.deviation())
    }

    /// The deviation of the last returned pose from the wanted one, see [`Response::deviation`].
    pub fn deviation(&self) -> Deviation {
        self.response.deviation()
    }

    /// Report of the last step.
    pub fn report(&self) -> Report {
        self.response.report()
    }

    fn filtered(&mut self, wanted: &Pose) -> Pose {
        let position = self.hips.step_vector(wanted.hips_position);
        let locals = Node::ALL.map(|node| self.joints[node.index()].step_rotation(wanted.local(node)));
        Pose::from_locals(position, &locals)
    }
}
