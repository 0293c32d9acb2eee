//! Plans a goal: whether and where to step, and the posture of trunk and arms there.

use crate::Rng;
use crate::compose::ARMS;
use crate::feet::Placement;
use crate::legs::{StepChoice, StepKind, decide_step, ground_direction};
use crate::manner::Manner;
use crate::outcome::{Outcome, Reason};
use crate::reacher::Reacher;
use crate::solve::{Aim, EXACT_M, Judged, Task};
use crate::spine::{reaching_angle, wrapped};
use crate::walk::{Stance, Step};
use glam::{DQuat, DVec3};

/// Where to step.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Walk {
    pub to: Stance,
    /// Which foot goes first.
    pub first: usize,
    pub kind: StepKind,
}

/// A plan.
#[derive(Clone, Debug)]
pub(crate) struct Decision {
    pub targets: [Option<DVec3>; 2],
    pub walk: Option<Walk>,
    pub aim: Aim,
    pub bow: [DVec3; 2],
    /// Distance that each hand moves relative to the body \[m\].
    pub ways_m: [f64; 2],
    /// How far the weight is over the toes there \[1\].
    pub onto_toes: f64,
    /// Turn of the head relative to the chest at the end.
    pub gaze: DVec3,
    /// `parent_from_node` of upper and lower arms there.
    pub arms: [[DQuat; 2]; 2],
    /// Final positions of the hands \[m\]: at their targets, or as near as they come.
    pub ends: [DVec3; 2],
    gap_m: f64,
    reason: Option<Reason>,
    swing_rad: f64,
}

impl Decision {
    pub fn outcome(&self, arrives_secs: f64, steps: &[Step]) -> Outcome {
        Outcome {
            reason: self.reason,
            is_late: false,
            gap_m: self.gap_m,
            arrives_secs,
            hands: self.targets.map(|target| target.is_some()),
            steps: steps.to_vec(),
            twist_rad: self.aim.twist,
            swing_rad: self.swing_rad,
            squat_m: self.aim.squat,
        }
    }
}

/// Maximum gap at which a target counts as reached \[m\].
const REACHED_M: f64 = 5e-4;

/// Tolerated excess over the narrowed limits \[rad\]: a third of their margin.
const EXCESS_RAD: f64 = 0.01;

/// Minimum horizontal distance from shoulder to target after a step [of d_c].
const ROOM: f64 = 0.65;

/// Distances of shoulder and target in candidate stances \[of d_c\], tried in this order.
const STAND_OFF: [f64; 5] = [0.75, 0.5, 0.95, 0.3, 0.1];

fn is_good(judged: &Judged) -> bool {
    judged.gap_m <= EXACT_M && judged.excess_rad <= EXCESS_RAD
}

/// Cost of a plan: first the gap to the target, then the excess over joint limits.
fn price(judged: &Judged) -> f64 {
    judged.gap_m + 2.0 * (judged.excess_rad - EXCESS_RAD).max(0.0)
}

/// A stance and its posture.
struct Trial<'a> {
    task: Task<'a>,
    found: (Aim, Judged),
    walk: Option<Walk>,
}

/// Maximum number of other stances that are searched.
const SEARCHED: usize = 2;

/// The goal in the planner's terms.
struct Errand {
    targets: [Option<DVec3>; 2],
    /// The reaching hand, if there is only one.
    side: Option<usize>,
    /// Middle of the targets, and the vector from the middle of the shoulders to it \[m\].
    middle: DVec3,
    d: DVec3,
    foot_choice: f64,
    near_choice: f64,
}

impl Reacher {
    /// Makes a new plan. With `again` the target has only moved: no step unless it is needed.
    pub(crate) fn decide(&self, targets: [Option<DVec3>; 2], rng: &mut Rng, again: bool) -> Decision {
        let mut decision = Decision {
            targets,
            walk: None,
            aim: Aim::default(),
            bow: [DVec3::ZERO; 2],
            ways_m: [0.0; 2],
            onto_toes: 0.0,
            gaze: DVec3::ZERO,
            arms: [[DQuat::IDENTITY; 2]; 2],
            ends: targets.map(Option::unwrap_or_default),
            gap_m: 0.0,
            reason: None,
            swing_rad: 0.0,
        };
        let task = self.task(targets);
        let count = targets.iter().flatten().count();
        if count == 0 {
            return decision;
        }
        let shoulders = task.composed(&Aim::default()).shoulders;
        let reaching = (0..2).filter(|side| targets[*side].is_some());
        let middle = targets.iter().flatten().sum::<DVec3>() / count as f64;
        let d = middle - reaching.clone().map(|side| shoulders[side]).sum::<DVec3>() / count as f64;
        let choice = if again { None } else { decide_step(libm::hypot(d.x, d.z), rng, &self.frame.values) };
        let side = if count == 1 { reaching.clone().next() } else { None };
        let errand = Errand { targets, side, middle, d, foot_choice: rng.unit(), near_choice: rng.unit() };
        let mut trial = self.best_trial(task, choice, &errand);
        if !self.style.print {
            trial.task.lay_hands(&mut trial.found);
        }
        if self.manner != Manner::PLAIN {
            trial.task.swivelled(&mut trial.found);
        }
        let (aim, judged) = &trial.found;
        let end = &judged.composed;
        let carried = Task { targets: [None; 2], ..trial.task }.composed(aim).hands;
        for side in reaching {
            decision.ways_m[side] = targets[side].map_or(0.0, |target| (target - carried[side]).length());
            if !self.style.print {
                let forward = end.pose.world[1] * DVec3::Z;
                let out = end.pose.world[1] * DVec3::X * if side == 0 { 1.0 } else { -1.0 };
                let own = DVec3::Y * self.manner.bow[0] + out * self.manner.bow[1];
                decision.bow[side] = self.bow_around(end.shoulders[side], carried[side], end.hands[side], forward)
                    + own * self.frame.values.arm_m;
            }
        }
        decision.arms = ARMS.map(|[_, upper, lower, _]| [upper, lower].map(|node| end.pose.local(node)));
        decision.gap_m = judged.gap_m;
        decision.swing_rad = signed_swing(aim, d);
        (decision.gaze, decision.onto_toes) = (gaze_of(end), end.onto_toes);
        if judged.gap_m > REACHED_M {
            decision.ends = end.hands;
            decision.reason = Some(self.why(targets, end, self.style.print && choice.is_some()));
        }
        (decision.walk, decision.aim) = (trial.walk, *aim);
        decision
    }

    /// The paper's stance if the hand arrives from it, else the best of several.
    fn best_trial<'a>(&'a self, task: Task<'a>, choice: Option<StepChoice>, errand: &Errand) -> Trial<'a> {
        let print = self.style.print;
        let here = Trial { task, found: task.ruled(), walk: None };
        let is_beyond = !print && self.is_beyond(errand);
        let mut best = match choice.and_then(|step| self.step(&step, errand)) {
            Some(walk) if !is_beyond => self.trial(&task, walk).unwrap_or(here),
            _ => here,
        };
        if !is_beyond {
            best.task.better(&mut best.found);
        }
        if is_good(&best.found.1) || print {
            return best;
        }
        // Beyond the paper: step with the other foot, or stand elsewhere. The rules evaluate all, the best are
        // searched.
        let full =
            best.walk.filter(|walk| walk.kind == StepKind::Half).map(|walk| Walk { kind: StepKind::Full, ..walk });
        let mut others = STAND_OFF.map(|share| self.trial(&task, self.stand_off(share, errand)));
        let mut full = full.and_then(|walk| self.trial(&task, walk));
        for _ in 0..SEARCHED {
            let Some(other) = others
                .iter_mut()
                .chain(std::iter::once(&mut full))
                .filter(|other| other.is_some())
                .min_by(|one, other| priced(one).total_cmp(&priced(other)))
                .and_then(Option::take)
            else {
                break;
            };
            let mut other = other;
            other.task.better(&mut other.found);
            if price(&other.found.1) < price(&best.found.1) - 1e-4 {
                best = other;
            }
            if is_good(&best.found.1) || is_beyond {
                break;
            }
        }
        best
    }

    /// Whether no stance can reach the target: it is higher than the hand of a body on its toes with the arm straight
    /// up.
    fn is_beyond(&self, errand: &Errand) -> bool {
        let floor = self.feet.planted[0].ankle.y - self.frame.ankle_m;
        errand.targets.iter().flatten().any(|target| target.y - floor > self.frame.highest_m)
    }

    /// The paper's step, with the length of EQ9; farther targets need a walk.
    fn step(&self, step: &StepChoice, errand: &Errand) -> Option<Walk> {
        let (values, print, d) = (&self.frame.values, self.style.print, errand.d);
        let direction = ground_direction(d)?;
        let distance = libm::hypot(d.x, d.z);
        let here = Stance::of(&self.feet.last(), values);
        let turn = errand.side.and_then(|side| {
            let angle = reaching_angle(d, here.yaw_rad, side == 1)?;
            Some(if side == 1 { -angle } else { angle })
        });
        let turn = turn.unwrap_or_else(|| wrapped(libm::atan2(d.x, d.z) - here.yaw_rad));
        let left = distance - values.convenient_m * (0.7 + 0.25 * errand.near_choice);
        let is_far = !print && left > values.longest_step_m;
        // The step is limited so that the hand keeps room: the root moves half of a half step.
        let root = if step.kind == StepKind::Half { 0.5 } else { 1.0 };
        let room = ((distance - ROOM * values.convenient_m) / root).max(values.shortest_step_m);
        let length = match (is_far, print) {
            (true, _) => left,
            (false, true) => step.length_m,
            (false, false) => step.length_m.min(room),
        };
        // What is behind is turned to, not twisted to.
        let share = 0.35 + 0.65 * crate::head::smooth(turn.abs(), 0.7, 1.6);
        let yaw_rad = here.yaw_rad
            + if is_far {
                turn
            } else if print {
                0.35 * turn
            } else {
                share * turn
            };
        let to = Stance { middle: here.middle + direction * length, yaw_rad, ..here };
        Some(Walk { to, first: first_foot(turn, errand.side, errand.foot_choice), kind: step.kind })
    }

    /// A stance at a share of d_c from the target, facing it.
    fn stand_off(&self, share: f64, errand: &Errand) -> Walk {
        let values = &self.frame.values;
        let here = Stance::of(&self.feet.last(), values);
        let away = errand.middle - here.middle;
        let yaw_rad = if libm::hypot(away.x, away.z) > 0.05 { libm::atan2(away.x, away.z) } else { here.yaw_rad };
        let forward = DVec3::new(libm::sin(yaw_rad), 0.0, libm::cos(yaw_rad));
        let flat = DVec3::new(errand.middle.x, here.middle.y, errand.middle.z);
        let aside = errand.side.map_or(DVec3::ZERO, |side| {
            DQuat::from_rotation_y(yaw_rad) * DVec3::X * if side == 0 { -0.1 } else { 0.1 } * values.arm_m / 0.63
        });
        let to = Stance { middle: flat - forward * (share * values.convenient_m) + aside, yaw_rad, ..here };
        let turn = wrapped(yaw_rad - here.yaw_rad);
        Walk { to, first: first_foot(turn, errand.side, errand.foot_choice), kind: StepKind::Full }
    }

    /// The posture by the rules after a walk; `None` if it is too far.
    fn trial<'a>(&'a self, task: &Task<'a>, walk: Walk) -> Option<Trial<'a>> {
        let mut feet = self.feet.clone();
        let mut steps = Vec::new();
        let fits =
            crate::walk::walk(&mut feet, &walk.to, walk.first, walk.kind, 0.0, 1.0, &self.frame.values, &mut steps);
        if !fits {
            return None;
        }
        // The last foot depends on the number of strides; the final placements count.
        let stance = if steps.is_empty() { placed(&walk, &self.feet.last()) } else { feet.last() };
        let task = task.stance(&stance, self.feet.supports_of(&stance));
        Some(Trial { task, found: task.ruled(), walk: Some(walk) })
    }

    /// The bow of a hand's path that keeps it away from its own shoulder, where the arm would have to fold. The paper's
    /// path is straight.
    fn bow_around(&self, shoulder: DVec3, from: DVec3, to: DVec3, forward: DVec3) -> DVec3 {
        let way = to - from;
        let share = ((shoulder - from).dot(way) / way.length_squared().max(1e-9)).clamp(0.2, 0.8);
        let near = from + way * share - shoulder;
        let wanted = ROUND * self.frame.values.arm_m;
        let out = (near.normalize_or_zero() * 0.6 + forward).normalize_or_zero();
        let lacks = (wanted - near.length()).max(0.0);
        let hump = 4.0 * share * (1.0 - share);
        out * (lacks / hump.max(0.5)).min(wanted)
    }

    fn why(&self, targets: [Option<DVec3>; 2], end: &crate::compose::Composed, one_step: bool) -> Reason {
        let arm = self.frame.values.arm_m;
        let gap = |side: usize| targets[side].map_or(0.0, |target| (end.hands[side] - target).length());
        let side = usize::from(gap(1) > gap(0));
        let Some(target) = targets[side] else { return Reason::TooFar };
        let miss = target - end.hands[side];
        let flat = libm::hypot(miss.x, miss.z);
        if end.stretch[side] < self.frame.exact_stretch().0 {
            Reason::TooNear
        } else if miss.y > flat {
            Reason::TooHigh
        } else if -miss.y > flat {
            Reason::TooLow
        } else if let [Some(left), Some(right)] = targets
            && (left - right).length() > 2.2 * arm
        {
            Reason::TooFarApart
        } else if one_step {
            Reason::OneStep
        } else {
            Reason::TooFar
        }
    }
}

/// Minimum distance of a hand from its shoulder on its path \[1 of the arm's length\].
const ROUND: f64 = 0.72;

/// The stance after a walk.
fn placed(walk: &Walk, feet: &[Placement; 2]) -> [Placement; 2] {
    let mut stance = [0, 1].map(|side| walk.to.foot(side));
    if walk.kind == StepKind::Half {
        let stays = 1 - walk.first;
        stance[stays] = feet[stays];
    }
    for side in 0..2 {
        stance[side].yaw_rad = feet[side].yaw_rad + wrapped(stance[side].yaw_rad - feet[side].yaw_rad);
    }
    stance
}

fn priced(trial: &Option<Trial>) -> f64 {
    trial.as_ref().map_or(f64::INFINITY, |trial| price(&trial.found.1))
}

/// In a turn the foot on that side goes first; otherwise, as a rule, that of the reaching hand.
fn first_foot(turn_rad: f64, side: Option<usize>, rng: f64) -> usize {
    if turn_rad.abs() > 0.5 {
        return usize::from(turn_rad < 0.0);
    }
    let same = rng < 0.65;
    match side {
        Some(side) if same => side,
        Some(side) => 1 - side,
        None => usize::from(rng < 0.5),
    }
}

/// φ with its sign: swing of the trunk towards the target.
fn signed_swing(aim: &Aim, d: DVec3) -> f64 {
    let towards = ground_direction(d).map_or(1.0, |flat| aim.swing.dot(DVec3::Y.cross(flat)));
    aim.swing.length() * if towards < 0.0 { -1.0 } else { 1.0 }
}

/// Turn of the head relative to the chest.
fn gaze_of(end: &crate::compose::Composed) -> DVec3 {
    use sinew_body::humanoid::{Node, log};
    log((end.pose.local(Node::Neck) * end.pose.local(Node::Head)).normalize())
}
