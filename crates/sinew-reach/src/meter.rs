//! Measures a reach frame by frame: how near the hand comes, how fast it goes, whether the body stands.

use crate::outcome::Reason;
use crate::reacher::{Goal, Reacher};
use glam::DVec3;
use sinew_body::humanoid::{Body, Node, Pose, Sole, keep_support_hull, support_margin_m};

/// What was seen of one reach so far. The body may be elsewhere than the reach wants it: what is measured is the body.
///
/// ```
/// use glam::DVec3;
/// use sinew_body::humanoid::Body;
/// use sinew_reach::{Goal, ReachFrame, ReachMeter, Reacher, Start, Style, standing};
///
/// let body = Body::standard(80.0, 1.7);
/// let start = Start { pose: standing(&body, DVec3::ZERO, 0.0), before: None };
/// let mut reacher = Reacher::new(&body, &Style::default(), &start)?;
/// let goal = Goal { right: Some(DVec3::new(-0.2, 1.2, 0.45)), ..Goal::default() };
/// let arrives_secs = reacher.reach(&goal).arrives_secs;
/// let mut meter = ReachMeter::default();
/// for index in 0..=(arrives_secs * 60.0) as usize + 1 {
///     let secs = index as f64 / 60.0;
///     meter.watch(&reacher, &body, &ReachFrame { secs, goal, pose: reacher.pose_at(secs) }, 1.0 / 60.0);
/// }
/// assert!(meter.is_there() && meter.hand_speed_max_m_s() > 0.1);
/// # Ok::<(), sinew_reach::StyleError>(())
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ReachMeter {
    hand_error_m: f64,
    hand_speed_max_m_s: f64,
    com_margin_m: Option<f64>,
    planted_slip_m: f64,
    hands: Option<[DVec3; 2]>,
    /// Where each foot has stood since it was planted.
    stands: [Option<DVec3>; 2],
}

/// One instant of a reach.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ReachFrame {
    /// When, in the reacher's time \[s\].
    pub secs: f64,
    /// Where the hands are to be \[m\], world.
    pub goal: Goal,
    /// The body's pose.
    pub pose: Pose,
}

const HANDS: [Node; 2] = [Node::LeftHand, Node::RightHand];
const FEET: [Node; 2] = [Node::LeftFoot, Node::RightFoot];

/// A foot is planted when the front edge of its sole is to stay within this for so long before and after \[m, s\]. A step of a
/// tenth of a metre goes ten times as far in its first frame.
const STILL_M: f64 = 1e-6;
const STILL_SECS: f64 = 1.0 / 60.0;

/// What of a sole is higher than its lowest corner by this carries nothing \[m\].
const RISEN_M: f64 = 0.01;

/// A body within this of its target is there \[m\]: what springs hold gives way by millimetres.
const THERE_M: f64 = 0.02;

impl ReachMeter {
    /// Looks at the next frame, `frame_secs` after the last. `reacher` plans it, `body` is in the frame's pose.
    pub fn watch(&mut self, reacher: &Reacher, body: &Body, now: &ReachFrame, frame_secs: f64) {
        let at = now.pose.positions(body);
        let hands = HANDS.map(|node| at[node.index()] + now.pose.world[node.index()] * body.link(node).centre);
        let targets = [now.goal.left, now.goal.right];
        self.hand_error_m = (0..2).filter_map(|side| Some((hands[side] - targets[side]?).length())).fold(0.0, f64::max);
        if let Some(before) = self.hands {
            let ways = (0..2).filter(|side| targets[*side].is_some()).map(|side| (hands[side] - before[side]).length());
            self.hand_speed_max_m_s = ways.fold(self.hand_speed_max_m_s, |most, way| most.max(way / frame_secs));
        }
        self.hands = Some(hands);
        let soles = FEET.map(|foot| Sole::world_corners(body, &now.pose, foot));
        let planted = [0, 1].map(|side| is_planted(reacher, body, now.secs, side));
        for side in 0..2 {
            let toes = (soles[side][1] + soles[side][2]) * 0.5;
            let stood = self.stands[side].unwrap_or(toes);
            self.stands[side] = planted[side].then_some(stood);
            if planted[side] {
                self.planted_slip_m = self.planted_slip_m.max((toes - stood).length());
            }
        }
        if planted == [true; 2] {
            let here = margin_over(&soles, body, body.centre_of_mass(&now.pose));
            self.com_margin_m = Some(self.com_margin_m.map_or(here, |least| least.min(here)));
        }
    }

    /// Distance of the hand from its target in the last frame \[m\]; of the worse of two.
    pub fn hand_error_m(&self) -> f64 {
        self.hand_error_m
    }

    /// Whether the hand is at its target, within 2 cm: what springs hold gives way by millimetres.
    pub fn is_there(&self) -> bool {
        self.hand_error_m < THERE_M
    }

    /// Why the hand is not there in the last frame, at `now_secs`; `None` when it is.
    pub fn reason(&self, reacher: &Reacher, now_secs: f64) -> Option<&'static str> {
        let outcome = reacher.outcome();
        match outcome.reason.map(Reason::text) {
            None if self.is_there() => None,
            None if now_secs < outcome.arrives_secs => Some("still on its way at the end"),
            None => Some("held off its way; the body is not where the reach wants it"),
            planned => planned,
        }
    }

    /// Fastest that a reaching hand went \[m/s\].
    pub fn hand_speed_max_m_s(&self) -> f64 {
        self.hand_speed_max_m_s
    }

    /// How far the centre of mass stayed inside the support polygon while both feet stood, at its minimum \[m\]; negative
    /// outside, `None` when they never did.
    pub fn com_margin_m(&self) -> Option<f64> {
        self.com_margin_m
    }

    /// How far the toes of a planted foot moved, at most \[m\].
    pub fn planted_slip_m(&self) -> f64 {
        self.planted_slip_m
    }
}

/// Whether the plan keeps a foot where it is: it may rise on its toes.
fn is_planted(reacher: &Reacher, body: &Body, now_secs: f64, side: usize) -> bool {
    let sole = Sole::of(body, FEET[side]);
    let toes = |secs: f64| {
        let (ankle, turn) = reacher.feet().foot(side, secs);
        ankle + turn * DVec3::new(sole.middle_m, -sole.ankle_m, sole.toes_m)
    };
    let here = toes(now_secs);
    [-STILL_SECS, STILL_SECS].into_iter().all(|ago| (toes(now_secs + ago) - here).length() < STILL_M)
}

/// How far a point lies inside what both soles carry \[m\]: one whose heel is up from its ball to its front edge, as they lie flat,
/// for toes bend.
fn margin_over(soles: &[[DVec3; 4]; 2], body: &Body, point: DVec3) -> f64 {
    let floor = soles.iter().flatten().map(|corner| corner.y).fold(f64::INFINITY, f64::min) + RISEN_M;
    let mut corners = Vec::with_capacity(8);
    for (corners_of, foot) in soles.iter().zip(FEET) {
        let [left_heel, left_toe, right_toe, right_heel] = *corners_of;
        let sole = Sole::of(body, foot);
        let back = (left_heel - left_toe).with_y(0.0).normalize_or_zero() * (sole.toes_m - sole.ball_m());
        for (heel, toe) in [(left_heel, left_toe), (right_heel, right_toe)] {
            if toe.y <= floor {
                corners.push(toe);
                corners.push(if heel.y <= floor { heel } else { toe + back });
            } else if heel.y <= floor {
                corners.push(heel);
            }
        }
    }
    keep_support_hull(&mut corners, &mut Vec::new());
    support_margin_m(&corners, point)
}
