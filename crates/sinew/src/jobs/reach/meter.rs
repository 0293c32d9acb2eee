//! Looks at a reach frame by frame, for its report.

use super::report::{ReachReport, SIDES, StepReport};
use glam::DVec3;
use sinew_body::humanoid::{Body, Node, Pose, Sole};
use sinew_reach::{Goal, Reacher, Reason};
use sinew_world::{keep_hull, margin};

/// What was seen of one reach so far. The body may be elsewhere than the reach wants it: what is measured is the body.
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
#[derive(Clone, Copy, Debug)]
pub struct Instant<'a> {
    /// Who plans it.
    pub reacher: &'a Reacher,
    /// When, in the reacher's time \[s\].
    pub secs: f64,
    /// Where the hands are to be \[m\].
    pub goal: Goal,
    /// The body, and where it is.
    pub body: &'a Body,
    /// Its pose.
    pub pose: &'a Pose,
}

const HANDS: [Node; 2] = [Node::LeftHand, Node::RightHand];
const FEET: [Node; 2] = [Node::LeftFoot, Node::RightFoot];

/// A foot is planted when the front edge of its sole is to stay within this for so long before and after \[m, s\]. A step of a
/// tenth of a metre goes ten times as far in its first frame.
const STILL_M: f64 = 1e-6;
const STILL_SECS: f64 = 1.0 / 60.0;

/// What of a sole is higher than its lowest corner by this carries nothing \[m\].
const RISEN_M: f64 = 0.01;

/// Distance from its target at which a body counts as arrived \[m\]: bodies held by springs yield by millimetres.
const THERE_M: f64 = 0.02;

impl ReachMeter {
    /// Looks at the next frame, `frame_secs` after the last.
    pub fn watch(&mut self, now: &Instant<'_>, frame_secs: f64) {
        let at = now.pose.positions(now.body);
        let hands = HANDS.map(|node| at[node.index()] + now.pose.world[node.index()] * now.body.link(node).centre);
        let targets = [now.goal.left, now.goal.right];
        self.hand_error_m = (0..2).filter_map(|side| Some((hands[side] - targets[side]?).length())).fold(0.0, f64::max);
        if let Some(before) = self.hands {
            let ways = (0..2).filter(|side| targets[*side].is_some()).map(|side| (hands[side] - before[side]).length());
            self.hand_speed_max_m_s = ways.fold(self.hand_speed_max_m_s, |most, way| most.max(way / frame_secs));
        }
        self.hands = Some(hands);
        let soles = FEET.map(|foot| Sole::world_corners(now.body, now.pose, foot));
        let planted = [0, 1].map(|side| is_planted(now, side));
        for side in 0..2 {
            let toes = (soles[side][1] + soles[side][2]) * 0.5;
            let stood = self.stands[side].unwrap_or(toes);
            self.stands[side] = planted[side].then_some(stood);
            if planted[side] {
                self.planted_slip_m = self.planted_slip_m.max((toes - stood).length());
            }
        }
        if planted == [true; 2] {
            let here = margin_over(&soles, now.body, now.body.centre_of_mass(now.pose));
            self.com_margin_m = Some(self.com_margin_m.map_or(here, |least| least.min(here)));
        }
    }

    /// The report of what was seen, with what the plan says; `since_secs` is when the goal was given, `now_secs` the last frame.
    pub fn report(&self, reacher: &Reacher, since_secs: f64, now_secs: f64) -> ReachReport {
        let outcome = reacher.outcome();
        let is_there = self.hand_error_m < THERE_M;
        let reason = match outcome.reason.map(Reason::text) {
            None if is_there => None,
            None if now_secs < outcome.arrives_secs => Some("still on its way at the end"),
            None => Some("held off its way; the body is not where the reach wants it"),
            planned => planned,
        };
        let steps = outcome.steps.iter().filter(|step| step.start_secs >= since_secs - 1e-9);
        ReachReport {
            reached: outcome.is_reached() && is_there,
            reason: reason.map(str::to_owned),
            hands: (0..2).filter(|side| outcome.hands[*side]).map(|side| SIDES[side]).collect(),
            hand_error_m: self.hand_error_m,
            duration_s: outcome.arrives_secs - since_secs,
            steps: steps
                .map(|step| StepReport { foot: SIDES[step.side], kind: step.kind.name(), length_m: step.length_m })
                .collect(),
            twist_deg: outcome.twist_rad.to_degrees(),
            swing_deg: outcome.swing_rad.to_degrees(),
            squat_m: outcome.squat_m,
            com_margin_m: self.com_margin_m,
            planted_slip_m: self.planted_slip_m,
            hand_speed_max_m_s: self.hand_speed_max_m_s,
            seed: reacher.style().seed,
        }
    }
}

/// Whether the plan keeps a foot where it is: it may rise on its toes.
fn is_planted(now: &Instant<'_>, side: usize) -> bool {
    let sole = Sole::of(now.body, FEET[side]);
    let toes = |secs: f64| {
        let (ankle, turn) = now.reacher.feet().foot(side, secs);
        ankle + turn * DVec3::new(sole.middle_m, -sole.ankle_m, sole.toes_m)
    };
    let here = toes(now.secs);
    [-STILL_SECS, STILL_SECS].into_iter().all(|ago| (toes(now.secs + ago) - here).length() < STILL_M)
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
    keep_hull(&mut corners, &mut Vec::new());
    margin(&corners, point)
}
