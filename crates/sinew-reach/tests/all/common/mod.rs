//! What tests and the long program measure of a reach.
#![allow(
    dead_code,
    clippy::disallowed_methods,
    reason = "each test uses its own part, and may use the platform's mathematics"
)]

pub mod motion;

use glam::{DQuat, DVec3};
use sinew_body::humanoid::{Body, Node, Pose, Sole, log};
use sinew_reach::{Goal, Outcome, Reacher, Rng, Start, Style, standing};

/// The two bodies of the claims: 80 kg and 1.7 m, 40 kg and 1.5 m.
pub fn bodies() -> [Body; 2] {
    [Body::standard(80.0, 1.7), Body::standard(40.0, 1.5)]
}

pub fn reacher(body: &Body, style: &Style) -> Reacher {
    let start = Start { pose: standing(body, DVec3::ZERO, 0.0), before: None };
    Reacher::new(body, style, &start).expect("a style in range")
}

/// The hand that a person would use, as the command line chooses it.
pub fn goal(target: DVec3) -> Goal {
    if target.x < 0.06 {
        Goal { right: Some(target), ..Goal::default() }
    } else {
        Goal { left: Some(target), ..Goal::default() }
    }
}

/// A target all around a body: from its feet to over its head, up to beyond what one step brings in reach.
pub fn any_target(rng: &mut Rng, stature_m: f64) -> DVec3 {
    let (angle, away) = (rng.between(-std::f64::consts::PI, std::f64::consts::PI), rng.between(0.2, 1.3));
    DVec3::new(angle.sin() * away, rng.between(-0.1, 1.45), angle.cos() * away) * stature_m
}

pub fn hand(body: &Body, pose: &Pose, right: bool) -> DVec3 {
    let node = if right { Node::RightHand } else { Node::LeftHand };
    pose.positions(body)[node.index()] + pose.world[node.index()] * body.link(node).centre
}

/// How a reach went.
#[derive(Debug)]
pub struct Measured {
    pub outcome: Outcome,
    /// Hand to target at the end [m].
    pub error_m: f64,
    /// Most that a joint is beyond its limit [rad], and which.
    pub excess_rad: f64,
    pub excess_of: Option<(Node, f64)>,
    /// Most that a planted foot moves [m]: the front edge of its sole always, the ankle too while the heel is down.
    pub slip_m: f64,
    /// How high a heel comes while its foot is planted [m].
    pub heel_m: f64,
    /// Least margin of the centre of mass while both feet stand [m].
    pub margin_m: f64,
    pub finite: bool,
}

pub fn measure(body: &Body, style: &Style, target: DVec3, hz: f64) -> Measured {
    let goal = goal(target);
    let right = goal.right.is_some();
    let mut reacher = reacher(body, style);
    let outcome = reacher.reach(&goal).clone();
    let end = reacher.done_secs();
    let frames = (end * hz).ceil() as usize + 2;
    let mut measured = Measured {
        outcome,
        error_m: 0.0,
        excess_rad: 0.0,
        excess_of: None,
        slip_m: 0.0,
        heel_m: 0.0,
        margin_m: f64::INFINITY,
        finite: true,
    };
    let mut planted: [Option<[DVec3; 2]>; 2] = [None; 2];
    for frame in 0..frames {
        let secs = (frame as f64 / hz).min(end);
        let pose = reacher.pose_at(secs);
        measured.finite &= pose.is_finite();
        for node in Node::ALL {
            let excess = body.link(node).limit.excess(pose.local(node));
            if excess > measured.excess_rad {
                measured.excess_rad = excess;
                measured.excess_of = Some((node, secs));
            }
        }
        let strides = reacher.feet().strides();
        for side in 0..2 {
            let is_off = strides
                .iter()
                .any(|one| one.side == side && one.start_secs < secs && secs < one.start_secs + one.for_secs);
            let foot = [Node::LeftFoot, Node::RightFoot][side];
            let (ankle, turn) = (pose.positions(body)[foot.index()], pose.world[foot.index()]);
            let toe = ankle + turn * Sole::of(body, foot).toe();
            planted[side] = (!is_off).then(|| planted[side].unwrap_or([toe, ankle]));
            if let Some([toe_before, ankle_before]) = planted[side] {
                measured.slip_m = measured.slip_m.max((toe - toe_before).length());
                let heel_m = heel_height(body, &pose, foot);
                measured.heel_m = measured.heel_m.max(heel_m);
                if heel_m < DOWN_M {
                    // The lever of the ankle is shorter than that of the heel.
                    measured.slip_m = measured.slip_m.max((ankle - ankle_before).length() - heel_m);
                }
            }
        }
        if planted.iter().all(|foot| foot.is_some()) {
            measured.margin_m = measured.margin_m.min(margin(body, &pose));
        }
        measured.error_m = (hand(body, &pose, right) - target).length();
    }
    measured
}

impl Measured {
    /// What is wrong with it, if anything is.
    pub fn fault(&self) -> Option<&'static str> {
        if !self.finite {
            Some("a pose is not finite")
        } else if self.outcome.reason.is_none() && self.error_m > 1e-3 {
            Some("the hand does not arrive")
        } else if self.outcome.reason.is_some() && (self.error_m - self.outcome.gap_m).abs() > 1e-3 {
            // The plan knows where the hand ends.
            Some("the hand does not end where the plan says")
        } else if self.excess_rad > 0.0175 {
            // A degree: a table of ranges means no less.
            Some("a joint passes its limit")
        } else if self.slip_m > 1e-3 {
            Some("a planted foot slips")
        } else if self.margin_m <= 0.0 {
            Some("the centre of mass leaves the support")
        } else {
            None
        }
    }
}

/// A heel so high counts as down [m]: its pad and the sole of a shoe give by as much.
const DOWN_M: f64 = 5e-3;

/// How much higher a foot's heel is than its toes [m].
pub fn heel_height(body: &Body, pose: &Pose, foot: Node) -> f64 {
    let [heel, toe, ..] = Sole::world_corners(body, pose, foot);
    heel.y - toe.y
}

/// How far the centre of mass lies inside the hull of what bears [m]: by its supporting lines in 720 directions. A foot whose heel
/// is up bears from the ball to the toes' end, which lie where they lie flat: toes bend.
pub fn margin(body: &Body, pose: &Pose) -> f64 {
    let at = pose.positions(body);
    let corners: Vec<DVec3> = [Node::LeftFoot, Node::RightFoot]
        .into_iter()
        .flat_map(|foot| {
            let (mut sole, mut ankle, mut turn) = (Sole::of(body, foot), at[foot.index()], pose.world[foot.index()]);
            if heel_height(body, pose, foot) > DOWN_M {
                sole.heel_m = sole.ball_m();
                let (toe, left) = (sole.toe(), turn * DVec3::X);
                let flat = DQuat::from_rotation_y((-left.z).atan2(left.x));
                ankle += turn * toe - flat * toe;
                turn = flat;
            }
            sole.corners().map(|corner| ankle + turn * corner)
        })
        .collect();
    let centre = body.centre_of_mass(pose);
    (0..720)
        .map(|index| {
            let (sin, cos) = (f64::from(index) * 0.5_f64.to_radians()).sin_cos();
            let out = DVec3::new(sin, 0.0, cos);
            corners.iter().map(|corner| (*corner - centre).dot(out)).fold(f64::NEG_INFINITY, f64::max)
        })
        .fold(f64::INFINITY, f64::min)
}

/// Whether velocities and accelerations of the hand and of all joints are continuous, by finite differences at two time steps: what
/// is continuous, its derivative bounded, changes a quarter as much from step to step when steps are a quarter as long; what jumps
/// changes by the same. Half divides the two. Says what jumps.
pub fn jump(body: &Body, reacher: &Reacher, right: bool, hz: f64) -> Option<String> {
    let end = reacher.done_secs() + 0.1;
    let coarse = jumps(body, reacher, right, -0.05, end, hz);
    let fine = jumps(body, reacher, right, -0.05, end, 4.0 * hz);
    [
        ("the hand's velocity", fine.hand[0], coarse.hand[0]),
        ("the hand's acceleration", fine.hand[1], coarse.hand[1]),
        ("a joint's velocity", fine.joint[0], coarse.joint[0]),
        ("a joint's acceleration", fine.joint[1], coarse.joint[1]),
    ]
    .into_iter()
    .find(|(_, fine, coarse)| *fine >= 0.5 * coarse + 1e-3)
    .map(|(what, fine, coarse)| format!("{what} jumps: {fine} after {coarse}"))
}

/// Most that a velocity and an acceleration change from one step to the next, of hand [m/s, m/s²] and joints [rad/s, rad/s²].
#[derive(Clone, Copy, Debug, Default)]
pub struct Jumps {
    pub hand: [f64; 2],
    pub joint: [f64; 2],
    pub joint_of: Option<(Node, f64)>,
}

pub fn jumps(body: &Body, reacher: &Reacher, right: bool, from: f64, to: f64, hz: f64) -> Jumps {
    let step = 1.0 / hz;
    let frames = ((to - from) * hz) as usize;
    let mut most = Jumps::default();
    let poses: Vec<Pose> = (0..=frames).map(|frame| reacher.pose_at(from + frame as f64 * step)).collect();
    let hands: Vec<DVec3> = poses.iter().map(|pose| hand(body, pose, right)).collect();
    let look = |velocities: &[DVec3], into: &mut [f64; 2]| -> Option<usize> {
        let accelerations: Vec<DVec3> = velocities.windows(2).map(|pair| (pair[1] - pair[0]) / step).collect();
        for pair in velocities.windows(2) {
            into[0] = into[0].max((pair[1] - pair[0]).length());
        }
        let mut at = None;
        for (index, pair) in accelerations.windows(2).enumerate() {
            let jump = (pair[1] - pair[0]).length();
            if jump > into[1] {
                into[1] = jump;
                at = Some(index);
            }
        }
        at
    };
    let velocities: Vec<DVec3> = hands.windows(2).map(|pair| (pair[1] - pair[0]) / step).collect();
    look(&velocities, &mut most.hand);
    for node in Node::ALL {
        let locals: Vec<DQuat> = poses.iter().map(|pose| pose.local(node)).collect();
        let velocities: Vec<DVec3> = locals.windows(2).map(|pair| log(pair[0].conjugate() * pair[1]) / step).collect();
        if let Some(at) = look(&velocities, &mut most.joint) {
            most.joint_of = Some((node, from + at as f64 * step));
        }
    }
    most
}
