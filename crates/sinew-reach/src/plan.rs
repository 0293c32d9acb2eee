//! What to do about a goal: step or not, and where trunk and arms go then.

use crate::Dice;
use crate::feet::Placement;
use crate::legs::{StepKind, decide_step, ground_direction};
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
    /// How far each hand has to go against the body \[m\].
    pub ways_m: [f64; 2],
    pub turns_head_rad: f64,
    /// Where the hands end \[m\]: at their targets, or as near as they come.
    pub ends: [DVec3; 2],
    gap_m: f64,
    reason: Option<Reason>,
    swing_rad: f64,
}

impl Decision {
    pub fn outcome(&self, arrives_secs: f64, steps: &[Step]) -> Outcome {
        Outcome {
            reason: self.reason,
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

/// A gap up to which a target counts as reached \[m\].
const REACHED_M: f64 = 5e-4;

/// Excess over the narrowed limits that is let pass \[rad\]: a third of what they are narrowed by.
const EXCESS_RAD: f64 = 0.01;

/// How near to the shoulder a step may bring the target over the ground [of d_c].
const ROOM: f64 = 0.65;

/// How near a stance brings the shoulder to the target \[of d_c\], tried in this order.
const STAND_OFF: [f64; 4] = [0.75, 0.5, 0.95, 0.3];

fn is_good(judged: &Judged) -> bool {
    judged.gap_m <= EXACT_M && judged.excess_rad <= EXCESS_RAD
}

/// What of two is better: arriving, then joints in their limits.
fn is_better(one: &Judged, other: &Judged) -> bool {
    let price = |judged: &Judged| judged.gap_m + 0.3 * (judged.excess_rad - EXCESS_RAD).max(0.0);
    price(one) < price(other) - 1e-4
}

impl Reacher {
    /// Decides anew. With `again` the target has only moved on: no step unless it is needed.
    pub(crate) fn decide(&self, targets: [Option<DVec3>; 2], dice: &mut Dice, again: bool) -> Decision {
        let task = self.task(targets);
        let reaching: Vec<(usize, DVec3)> = (0..2).filter_map(|side| Some((side, targets[side]?))).collect();
        let mut decision = Decision {
            targets,
            walk: None,
            aim: Aim::default(),
            bow: [DVec3::ZERO; 2],
            ways_m: [0.0; 2],
            turns_head_rad: 0.0,
            ends: targets.map(Option::unwrap_or_default),
            gap_m: 0.0,
            reason: None,
            swing_rad: 0.0,
        };
        if reaching.is_empty() {
            return decision;
        }
        let middle: DVec3 = reaching.iter().map(|(_, target)| *target).sum::<DVec3>() / reaching.len() as f64;
        let standing = task.composed(&Aim::default());
        let shoulder: DVec3 =
            reaching.iter().map(|(side, _)| standing.shoulders[*side]).sum::<DVec3>() / reaching.len() as f64;
        let d = middle - shoulder;
        let distance = libm::hypot(d.x, d.z);
        let choice = if again { None } else { decide_step(distance, dice, &self.frame.values) };
        let (foot_choice, near_choice) = (dice.unit(), dice.unit());
        let feet = self.feet.last();
        let here = Stance::of(&feet, &self.frame.values);
        let one_side = if let [(side, _)] = reaching[..] { Some(side) } else { None };
        let mut best: Option<(Aim, Judged, Option<Walk>)> = None;
        let mut offer = |aim: Aim, judged: Judged, walk: Option<Walk>| {
            if best.as_ref().is_none_or(|(_, before, _)| is_better(&judged, before)) {
                best = Some((aim, judged, walk));
            }
            is_good(&judged)
        };
        let values = self.frame.values;
        let print = self.style.print;
        let mut done;
        if let Some(step) = choice
            && let Some(direction) = ground_direction(d)
        {
            // The paper's step, as long as EQ9 says; farther targets are walked to.
            let turn = one_side.and_then(|side| {
                let angle = reaching_angle(d, here.yaw_rad, side == 1)?;
                Some(if side == 1 { -angle } else { angle })
            });
            let turn = turn.unwrap_or_else(|| wrapped(libm::atan2(d.x, d.z) - here.yaw_rad));
            let left = distance - values.convenient_m * (0.7 + 0.25 * near_choice);
            let is_far = !print && left > values.longest_step_m;
            // Nobody steps so far that the hand has no room: the root goes half of a half step.
            let root = if step.kind == StepKind::Half { 0.5 } else { 1.0 };
            let room = ((distance - ROOM * values.convenient_m) / root).max(values.shortest_step_m);
            let length = if is_far {
                left
            } else if print {
                step.length_m
            } else {
                step.length_m.min(room)
            };
            let yaw_rad = here.yaw_rad + if is_far { turn } else { 0.35 * turn };
            let first = first_foot(turn, one_side, foot_choice);
            let to = Stance { middle: here.middle + direction * length, yaw_rad, ..here };
            let walk = Walk { to, first, kind: step.kind };
            let (aim, judged) = try_walk(&task, self, &feet, &walk).unwrap_or_else(|| task.solve());
            done = offer(aim, judged, Some(walk));
            if !done && !print && walk.kind == StepKind::Half {
                let walk = Walk { kind: StepKind::Full, ..walk };
                if let Some((aim, judged)) = try_walk(&task, self, &feet, &walk) {
                    done = offer(aim, judged, Some(walk));
                }
            }
        } else {
            let (aim, judged) = task.solve();
            done = offer(aim, judged, None);
        }
        if !done && !print {
            // Past the paper: stand elsewhere, facing the target, at several distances.
            let away = middle - here.middle;
            let facing = libm::atan2(away.x, away.z);
            for share in STAND_OFF {
                let yaw_rad = if libm::hypot(away.x, away.z) > 0.05 { facing } else { here.yaw_rad };
                let forward = DVec3::new(libm::sin(yaw_rad), 0.0, libm::cos(yaw_rad));
                let flat = DVec3::new(middle.x, here.middle.y, middle.z);
                let aside = match one_side {
                    Some(side) => {
                        DQuat::from_rotation_y(yaw_rad) * DVec3::X * if side == 0 { -0.1 } else { 0.1 } * values.arm_m
                            / 0.63
                    }
                    None => DVec3::ZERO,
                };
                let to = Stance { middle: flat - forward * (share * values.convenient_m) + aside, yaw_rad, ..here };
                let turn = wrapped(yaw_rad - here.yaw_rad);
                let walk = Walk { to, first: first_foot(turn, one_side, foot_choice), kind: StepKind::Full };
                if let Some((aim, judged)) = try_walk(&task, self, &feet, &walk)
                    && offer(aim, judged, Some(walk))
                {
                    break;
                }
            }
        }
        let Some((aim, judged, walk)) = best else { return decision };
        let stance = walk.as_ref().map_or(feet, |walk| placed(walk, &feet));
        let task = task.stance(&stance, self.feet.support_of(&stance));
        let end = judged.composed;
        let carried = {
            let none = Task { targets: [None; 2], ..task };
            none.composed(&aim).hands
        };
        decision.ways_m = [0, 1].map(|side| targets[side].map_or(0.0, |target| (target - carried[side]).length()));
        if !print {
            for side in 0..2 {
                if targets[side].is_none() {
                    continue;
                }
                decision.bow[side] =
                    self.bow_around(end.shoulders[side], carried[side], end.hands[side], end.pose.world[1] * DVec3::Z);
            }
        }
        decision.gap_m = judged.gap_m;
        decision.swing_rad = signed_swing(&aim, d);
        decision.turns_head_rad = head_turn(&end);
        if judged.gap_m > REACHED_M {
            decision.ends = end.hands;
            decision.reason = Some(self.why(&reaching, &end, print && choice.is_some()));
        }
        decision.walk = walk;
        decision.aim = aim;
        decision
    }

    /// How the way of a hand is bowed so that it does not come too near to its own shoulder: the arm would have to fold. The
    /// paper's way is straight.
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

    fn why(&self, reaching: &[(usize, DVec3)], end: &crate::compose::Composed, one_step: bool) -> Reason {
        let arm = self.frame.values.arm_m;
        let worst = reaching.iter().max_by(|a, b| {
            let gap = |one: &(usize, DVec3)| (end.hands[one.0] - one.1).length();
            gap(a).total_cmp(&gap(b))
        });
        let Some(&(side, target)) = worst else { return Reason::TooFar };
        let miss = target - end.hands[side];
        let flat = libm::hypot(miss.x, miss.z);
        if end.stretch[side] < self.frame.exact_stretch().0 {
            Reason::TooNear
        } else if miss.y > flat {
            Reason::TooHigh
        } else if -miss.y > flat {
            Reason::TooLow
        } else if reaching.len() == 2 && (reaching[0].1 - reaching[1].1).length() > 2.2 * arm {
            Reason::TooFarApart
        } else if one_step {
            Reason::OneStep
        } else {
            Reason::TooFar
        }
    }
}

/// How far a hand keeps from its shoulder on its way \[1 of the arm's length\].
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

fn try_walk(task: &Task, reacher: &Reacher, feet: &[Placement; 2], walk: &Walk) -> Option<(Aim, Judged)> {
    let mut trial = reacher.feet.clone();
    let mut steps = Vec::new();
    let fits =
        crate::walk::walk(&mut trial, &walk.to, walk.first, walk.kind, 0.0, 1.0, &reacher.frame.values, &mut steps);
    if !fits {
        return None;
    }
    // Of several strides the last foot depends on their number; where the feet really end is what counts.
    let stance = if steps.is_empty() { placed(walk, feet) } else { trial.last() };
    Some(task.stance(&stance, reacher.feet.support_of(&stance)).solve())
}

/// Turning, the foot on that side goes first; else as a rule that of the reaching hand.
fn first_foot(turn_rad: f64, side: Option<usize>, dice: f64) -> usize {
    if turn_rad.abs() > 0.5 {
        return usize::from(turn_rad < 0.0);
    }
    let same = dice < 0.65;
    match side {
        Some(side) if same => side,
        Some(side) => 1 - side,
        None => usize::from(dice < 0.5),
    }
}

/// φ with its sign: how far the trunk swings towards the target.
fn signed_swing(aim: &Aim, d: DVec3) -> f64 {
    let towards = ground_direction(d).map_or(1.0, |flat| aim.swing.dot(DVec3::Y.cross(flat)));
    aim.swing.length() * if towards < 0.0 { -1.0 } else { 1.0 }
}

fn head_turn(end: &crate::compose::Composed) -> f64 {
    use sinew_body::humanoid::{Node, log};
    log(end.pose.local(Node::Neck)).length() + log(end.pose.local(Node::Head)).length()
}
