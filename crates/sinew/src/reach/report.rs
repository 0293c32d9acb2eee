//! What came of a reach, in numbers.

use glam::DVec3;
use serde::Serialize;
use sinew_body::humanoid::{Body, Node, Pose, Sole};
use sinew_reach::{Goal, Reacher};
use sinew_world::{keep_hull, margin};

/// The report of `sinew reach`. Keys carry their units.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ReachReport {
    /// Whether the hand arrived.
    pub reached: bool,
    /// Why not, where it did not.
    pub reason: Option<String>,
    /// Which hands reached.
    pub hands: Vec<&'static str>,
    /// Distance of the hand from its target at the end \[m\]; of the worse of two.
    pub hand_error_m: f64,
    /// From the start until the hand arrives \[s\].
    pub duration_s: f64,
    /// The steps, in order.
    pub steps: Vec<StepReport>,
    /// Twist of the spine θ \[degrees about the upward axis\].
    pub twist_deg: f64,
    /// Swing of the spine φ \[degrees\], below 0 away from the target.
    pub swing_deg: f64,
    /// How far the hips sink \[m\].
    pub squat_m: f64,
    /// How far the centre of mass stays inside the support polygon while both feet stand, at its least \[m\].
    pub com_margin_m: Option<f64>,
    /// How far a planted foot's ankle moves, at most \[m\].
    pub planted_slip_m: f64,
    /// Fastest that the hand goes \[m/s\].
    pub hand_speed_max_m_s: f64,
    /// Where every random choice came from.
    pub seed: u64,
}

/// One step.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct StepReport {
    /// `left` or `right`: which foot goes first.
    pub foot: &'static str,
    /// `half`: the other stays; `full`: it follows.
    pub kind: &'static str,
    /// How far that foot goes \[m\].
    pub length_m: f64,
}

const SIDES: [&str; 2] = ["left", "right"];

impl ReachReport {
    pub(super) fn of(body: &Body, reacher: &Reacher, poses: &[Pose], goal: &Goal, hz: f64) -> ReachReport {
        let outcome = reacher.outcome();
        let hands = [Node::LeftHand, Node::RightHand];
        let hand = |pose: &Pose, side: usize| {
            let node = hands[side];
            pose.positions(body)[node.index()] + pose.world[node.index()] * body.link(node).centre
        };
        let targets = [goal.left, goal.right];
        let error = |pose: &Pose| {
            let errors = (0..2).filter_map(|side| Some((hand(pose, side) - targets[side]?).length()));
            errors.fold(0.0, f64::max)
        };
        let mut speed: f64 = 0.0;
        for pair in poses.windows(2) {
            for side in (0..2).filter(|side| targets[*side].is_some()) {
                speed = speed.max((hand(&pair[1], side) - hand(&pair[0], side)).length() * hz);
            }
        }
        ReachReport {
            reached: outcome.is_reached(),
            reason: outcome.reason.map(|reason| reason.text().to_owned()),
            hands: (0..2).filter(|side| outcome.hands[*side]).map(|side| SIDES[side]).collect(),
            hand_error_m: poses.last().map_or(f64::INFINITY, error),
            duration_s: outcome.arrives_secs,
            steps: outcome
                .steps
                .iter()
                .map(|step| StepReport { foot: SIDES[step.side], kind: step.kind.name(), length_m: step.length_m })
                .collect(),
            twist_deg: outcome.twist_rad.to_degrees(),
            swing_deg: outcome.swing_rad.to_degrees(),
            squat_m: outcome.squat_m,
            com_margin_m: least_margin(body, poses),
            planted_slip_m: slip(body, poses),
            hand_speed_max_m_s: speed,
            seed: reacher.style().seed,
        }
    }
}

/// Height of an ankle up to which its foot counts as planted, over the lowest \[m\], and how fast it may go \[m a frame\].
const PLANTED_M: f64 = 1e-4;

fn ankles(body: &Body, pose: &Pose) -> [DVec3; 2] {
    let at = pose.positions(body);
    [Node::LeftFoot, Node::RightFoot].map(|foot| at[foot.index()])
}

fn is_planted(body: &Body, poses: &[Pose], frame: usize) -> [bool; 2] {
    let floor = Sole::of(body, Node::LeftFoot).ankle_m + PLANTED_M;
    let low = |pose: &Pose| ankles(body, pose).map(|ankle| ankle.y <= floor);
    let (here, next) = (low(&poses[frame]), low(&poses[(frame + 1).min(poses.len() - 1)]));
    let before = low(&poses[frame.saturating_sub(1)]);
    [0, 1].map(|side| here[side] && next[side] && before[side])
}

/// The least margin of the centre of mass over all frames in which both feet stand.
fn least_margin(body: &Body, poses: &[Pose]) -> Option<f64> {
    let mut least: Option<f64> = None;
    let mut scratch = Vec::new();
    for (frame, pose) in poses.iter().enumerate() {
        if is_planted(body, poses, frame) != [true; 2] {
            continue;
        }
        let feet = [Node::LeftFoot, Node::RightFoot];
        let mut corners: Vec<DVec3> = feet.into_iter().flat_map(|foot| Sole::world_corners(body, pose, foot)).collect();
        keep_hull(&mut corners, &mut scratch);
        let here = margin(&corners, body.centre_of_mass(pose));
        least = Some(least.map_or(here, |before| before.min(here)));
    }
    least
}

/// How far planted feet move in all, at most.
fn slip(body: &Body, poses: &[Pose]) -> f64 {
    let mut worst: f64 = 0.0;
    let mut since: [Option<DVec3>; 2] = [None; 2];
    for (frame, pose) in poses.iter().enumerate() {
        let (planted, at) = (is_planted(body, poses, frame), ankles(body, pose));
        for side in 0..2 {
            since[side] = planted[side].then(|| since[side].unwrap_or(at[side]));
            if let Some(from) = since[side] {
                worst = worst.max((at[side] - from).length());
            }
        }
    }
    worst
}
