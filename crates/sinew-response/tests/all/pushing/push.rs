//! One push, and what it does.

use super::Case;
use glam::{DQuat, DVec3};
use sinew_body::humanoid::{Node, Pose, log};
use sinew_response::{PointForce, Response, Settings};

/// Where the claims push.
pub const PARTS: [(&str, Node); 6] = [
    ("hand", Node::LeftHand),
    ("forearm", Node::LeftLowerArm),
    ("upperArm", Node::LeftUpperArm),
    ("shoulder", Node::LeftShoulder),
    ("head", Node::Head),
    ("chest", Node::Chest),
];

/// To the character's left and right, forward and backward.
pub const DIRECTIONS: [(&str, DVec3); 4] =
    [("left", DVec3::X), ("right", DVec3::NEG_X), ("forward", DVec3::Z), ("backward", DVec3::NEG_Z)];

/// Phases of the cycle.
pub const PHASES: usize = 8;

/// Every joint within this of the run without the push has recovered \[rad\].
pub const RECOVERED: f64 = 2.0 * std::f64::consts::PI / 180.0;

/// A run ends early once every joint has stayed within this for a second \[rad\].
const QUIET: f64 = 0.5 * std::f64::consts::PI / 180.0;

/// A response on the way, about to be pushed.
pub struct Start<'a> {
    pub case: &'a Case,
    pub onset: usize,
    response: Response,
    shown: Pose,
    /// The run without the push, from the first pose.
    unpushed: &'a [Pose],
}

/// The same preset's run without a push, and a start at each onset.
pub fn starts<'a>(
    case: &'a Case,
    settings: &Settings,
    onsets: &[usize],
    unpushed: &'a mut Vec<Pose>,
) -> Vec<Start<'a>> {
    let input = case.motion().poses();
    let mut response = Response::new(case.body().clone(), case.basis().clone(), *settings, &input[0]);
    let backward = {
        let locals = Node::ALL.map(|node| {
            let (a, b) = (input[0].local(node), input[1].local(node));
            (a * (b.conjugate() * a)).normalize()
        });
        Pose::from_locals(input[0].hips_position * 2.0 - input[1].hips_position, &locals)
    };
    response.restart(&backward, &input[0]);
    let mut waiting = Vec::new();
    unpushed.clear();
    unpushed.push(input[0]);
    for now in 0..input.len() - 1 {
        if onsets.contains(&now) {
            waiting.push((now, response.clone(), unpushed[now]));
        }
        unpushed.push(response.step(&input[now + 1], &[]));
    }
    let unpushed: &'a [Pose] = unpushed;
    waiting.into_iter().map(|(onset, response, shown)| Start { case, onset, response, shown, unpushed }).collect()
}

/// What a push did.
#[derive(Clone, Debug)]
pub struct Outcome {
    pub finite: bool,
    /// From the end of the push until every joint stays within 2 degrees \[s\]; `None` if never.
    pub recovered_secs: Option<f64>,
    /// By node, the largest angle from the run without the push \[deg\].
    pub peak_deg: [f64; Node::COUNT],
    /// Largest distance of a standing ankle from the input's \[m\].
    pub stance_m: f64,
    /// The same in any frame.
    pub ankle_m: f64,
    /// Furthest that a joint was beyond its limit \[rad\], and which.
    pub excess: (f64, Node),
    /// Largest turn of the trunk in the world from the run without the push \[deg\].
    pub trunk_deg: f64,
    /// How long was looked at after the end of the push \[s\].
    pub looked_secs: f64,
    /// Largest joint angle in the last pose looked at \[deg\].
    pub last_deg: f64,
}

impl Outcome {
    /// The largest deflection of any joint \[deg\].
    pub fn peak(&self) -> f64 {
        self.peak_deg.iter().copied().fold(0.0, f64::max)
    }

    /// Whether every joint came back within so many seconds.
    pub fn back_within(&self, secs: f64) -> bool {
        self.recovered_secs.is_some_and(|recovered| recovered <= secs)
    }
}

/// Pushes for some frames with a force in facing axes \[N\] and looks on for at most `window_secs` after its end.
pub fn push(start: &Start, node: Node, force_n: DVec3, frames: usize, window_secs: f64) -> Outcome {
    let case = start.case;
    let input = case.motion().poses();
    let dt = case.motion().time_step_secs();
    let force = PointForce::at_centre(node, facing(&start.shown) * force_n);
    let mut response = start.response.clone();
    let mut outcome = Outcome {
        finite: true,
        recovered_secs: None,
        peak_deg: [0.0; Node::COUNT],
        stance_m: 0.0,
        ankle_m: 0.0,
        excess: (0.0, Node::Hips),
        trunk_deg: 0.0,
        looked_secs: 0.0,
        last_deg: 0.0,
    };
    let ends = start.onset + frames;
    let stop = (ends + (window_secs / dt).round() as usize).min(input.len() - 1);
    let (mut away, mut quiet) = (ends, 0);
    let mut last = start.onset;
    for now in start.onset..stop {
        let forces = if now < ends { std::slice::from_ref(&force) } else { &[] };
        let pose = response.step(&input[now + 1], forces);
        last = now + 1;
        if !pose.is_finite() {
            outcome.finite = false;
            return outcome;
        }
        let reference = &start.unpushed[last];
        let mut largest: f64 = 0.0;
        for node in Node::ALL {
            let (ours, theirs) = (pose.local(node), reference.local(node));
            let angle = log(theirs.conjugate() * ours).length();
            largest = largest.max(angle);
            let peak = &mut outcome.peak_deg[node.index()];
            *peak = peak.max(angle.to_degrees());
            if node != Node::Hips {
                let excess = case.body().link(node).limit.excess(ours);
                if excess > outcome.excess.0 {
                    outcome.excess = (excess, node);
                }
            }
        }
        let chest = Node::Chest.index();
        let trunk = log(reference.world[chest].conjugate() * pose.world[chest]).length();
        outcome.trunk_deg = outcome.trunk_deg.max(trunk.to_degrees());
        for (gap, stands) in case.ankle_gap(&pose, &input[last]).into_iter().zip(case.stance[last]) {
            outcome.ankle_m = outcome.ankle_m.max(gap);
            if stands {
                outcome.stance_m = outcome.stance_m.max(gap);
            }
        }
        if largest > RECOVERED {
            away = away.max(last);
        }
        outcome.last_deg = largest.to_degrees();
        quiet = if largest <= QUIET && last > ends { quiet + 1 } else { 0 };
        if quiet as f64 * dt > 1.0 {
            break;
        }
    }
    outcome.looked_secs = last.saturating_sub(ends) as f64 * dt;
    // As the report counts: the first pose from which on nothing is away; the end of the window must not be.
    if away < last {
        outcome.recovered_secs = Some(if away == ends { 0.0 } else { (away + 1 - ends) as f64 * dt });
    }
    outcome
}

/// `world_from_facing` of a pose: x to the body's left by hips and chest, y up.
fn facing(pose: &Pose) -> DQuat {
    let left = pose.world[Node::Hips.index()] * DVec3::X + pose.world[Node::Chest.index()] * DVec3::X;
    DQuat::from_rotation_arc(DVec3::X, DVec3::new(left.x, 0.0, left.z).normalize())
}
