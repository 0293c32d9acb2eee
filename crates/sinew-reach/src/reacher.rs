//! Somebody who reaches: states 0 to 3 of the scheduler, and the pose of every instant.

use crate::compose::{ARMS, ArmNow, Composed, Frame, Now};
use crate::feet::{Feet, Placement};
use crate::glide::Glide;
use crate::hand_path::{HandPath, PRINTED_RATIO, PRINTED_SPEED_M_S};
use crate::outcome::{Outcome, Reason};
use crate::plan::Decision;
use crate::solve::Task;
use crate::walk::Step;
use crate::{Dice, Style, Values};
use glam::{DQuat, DVec3};
use sinew_body::humanoid::{Body, LEGS, Node, Pose, exp, log};

/// Which hands are to reach what \[m\], world.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Goal {
    /// The left hand's target.
    pub left: Option<DVec3>,
    /// The right hand's target.
    pub right: Option<DVec3>,
}

/// The pose that somebody is in when a reach begins, and how it moves.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Start {
    /// The pose.
    pub pose: Pose,
    /// The pose a moment before, and how long before \[s\]; none for a body at rest.
    pub before: Option<(Pose, f64)>,
}

/// An arm over time.
#[derive(Clone, Debug)]
pub(crate) struct Arm {
    pub share: Glide<f64>,
    /// Where the target is now, and what is left of where it was.
    pub target: DVec3,
    pub offset: Glide<DVec3>,
    pub bow: Glide<DVec3>,
    pub swivel: Glide<f64>,
    pub girdle: Glide<DVec3>,
    /// Rotation vectors of shoulder, upper arm, lower arm and hand, carried.
    pub carried: [Glide<DVec3>; 4],
    /// The hand's way under `print`, with its start \[s\].
    pub printed: Option<(HandPath, f64)>,
}

/// A body that reaches for targets. Give it a [`Goal`] and take a pose for every instant; a new goal, or one that moves, is taken
/// up from wherever the body is, without a jump in place, velocity or acceleration.
///
/// ```
/// use glam::DVec3;
/// use sinew_body::humanoid::Body;
/// use sinew_reach::{Goal, Reacher, Start, Style, standing};
/// let body = Body::standard(80.0, 1.7);
/// let start = Start { pose: standing(&body, DVec3::ZERO, 0.0), before: None };
/// let mut reacher = Reacher::new(&body, &Style::default(), &start)?;
/// let target = DVec3::new(-0.2, 1.2, 0.45);
/// let outcome = reacher.reach(&Goal { right: Some(target), ..Goal::default() });
/// assert!(outcome.is_reached());
/// let secs = outcome.arrives_secs;
/// assert!((reacher.hands_at(secs)[1] - target).length() < 1e-3);
/// # Ok::<(), sinew_reach::StyleError>(())
/// ```
#[derive(Clone, Debug)]
pub struct Reacher {
    pub(crate) frame: Frame,
    pub(crate) style: Style,
    pub(crate) dice: Dice,
    pub(crate) now_secs: f64,
    pub(crate) feet: Feet,
    pub(crate) twist: Glide<f64>,
    pub(crate) swing: Glide<DVec3>,
    pub(crate) squat: Glide<f64>,
    pub(crate) lean: Glide<DVec3>,
    pub(crate) look: Glide<f64>,
    pub(crate) arms: [Arm; 2],
    hips: [Glide<DVec3>; 2],
    trunk: [Glide<DVec3>; 3],
    knees: [Glide<f64>; 2],
    pub(crate) steps: Vec<Step>,
    pub(crate) outcome: Outcome,
    pub(crate) goal: [Option<DVec3>; 2],
    pub(crate) planned: [Option<DVec3>; 2],
    pub(crate) replanned_secs: f64,
    pub(crate) obstacles: Vec<crate::Obstacle>,
    /// Where the targets were followed to last, and when [s].
    pub(crate) followed: Option<([Option<DVec3>; 2], f64)>,
    pub(crate) velocity: [DVec3; 2],
}

/// A body standing at a place of the floor, facing an angle \[rad about +Y from +Z to +X\], its soles on it.
pub fn standing(body: &Body, place: DVec3, facing_rad: f64) -> Pose {
    let turn = DQuat::from_rotation_y(facing_rad);
    let mut pose = Pose { hips_position: DVec3::ZERO, world: [turn; Node::COUNT] };
    let at = pose.positions(body);
    let sole = sinew_body::humanoid::Sole::of(body, Node::LeftFoot).ankle_m;
    let ankles = (at[Node::LeftFoot.index()] + at[Node::RightFoot.index()]) * 0.5;
    pose.hips_position = place + DVec3::Y * (sole - ankles.y);
    pose
}

/// How far ahead of where it is a foot lands that is on its way when the reach begins \[m\].
fn lands_ahead(start: &Start, body: &Body, foot: Node) -> DVec3 {
    let Some((before, ago)) = &start.before else { return DVec3::ZERO };
    let at = |pose: &Pose| pose.positions(body)[foot.index()];
    let velocity = (at(&start.pose) - at(before)) / ago.max(1e-3);
    let flat = DVec3::new(velocity.x, 0.0, velocity.z);
    let moves = crate::head::smooth(flat.length(), 0.2, 0.8);
    (flat * (LANDS_SECS * moves)).clamp_length_max(0.45 * body.stature_m() / 1.7)
}

/// A foot in the air goes on for so long at its speed, in all, until it stands \[s\].
const LANDS_SECS: f64 = 0.2;

/// How long what is left of the start's pose takes to pass \[s\]: of a body at rest, and of one that moves.
const SETTLES_SECS: (f64, f64) = (0.5, 0.4);

impl Reacher {
    /// Somebody in a pose, with the floor at height 0 below the lower sole of that pose.
    ///
    /// # Errors
    /// When a dial of the style is out of its range.
    pub fn new(body: &Body, style: &Style, start: &Start) -> Result<Reacher, crate::StyleError> {
        style.check()?;
        let frame = Frame::new(body, style);
        let pose = &start.pose;
        let at = pose.positions(body);
        let floor = LEGS.iter().map(|(_, _, foot)| at[foot.index()].y).fold(f64::INFINITY, f64::min) - frame.ankle_m;
        let mut yaw = [0.0; 2];
        let placed = [0, 1].map(|side| {
            let (_, _, foot) = LEGS[side];
            let toes = pose.world[foot.index()] * DVec3::Z;
            yaw[side] = libm::atan2(toes.x, toes.z);
            let ankle = at[foot.index()] + lands_ahead(start, body, foot);
            Placement { ankle: DVec3::new(ankle.x, floor + frame.ankle_m, ankle.z), yaw_rad: yaw[side] }
        });
        let mut placed = placed;
        placed[1].yaw_rad = placed[0].yaw_rad + crate::spine::wrapped(placed[1].yaw_rad - placed[0].yaw_rad);
        let feet = Feet::new(body, placed, style.print);
        let rest = Glide::rest(DVec3::ZERO);
        let arm = |side: usize| Arm {
            share: Glide::rest(0.0),
            target: DVec3::ZERO,
            offset: rest,
            bow: rest,
            swivel: Glide::rest(0.0),
            girdle: rest,
            carried: ARMS[side].map(|node| Glide::rest(log(pose.local(node)))),
            printed: None,
        };
        let mut reacher = Reacher {
            dice: Dice::new(style.seed),
            now_secs: 0.0,
            feet,
            twist: Glide::rest(0.0),
            swing: rest,
            squat: Glide::rest(0.0),
            lean: rest,
            look: Glide::rest(0.0),
            arms: [arm(0), arm(1)],
            hips: [rest; 2],
            trunk: [rest; 3],
            knees: [Glide::rest(0.0); 2],
            steps: Vec::new(),
            outcome: Outcome::default(),
            goal: [None; 2],
            planned: [None; 2],
            replanned_secs: f64::NEG_INFINITY,
            obstacles: Vec::new(),
            followed: None,
            velocity: [DVec3::ZERO; 2],
            frame,
            style: *style,
        };
        reacher.begin(start);
        Ok(reacher)
    }

    /// What the start's pose has and a standing body has not, to pass in a while.
    fn begin(&mut self, start: &Start) {
        let body = self.frame.body.clone();
        let plain = self.composed_at(0.0).pose;
        let (own, before) = (start.pose, start.before);
        let lasts = if before.is_some() { SETTLES_SECS.1 } else { SETTLES_SECS.0 };
        let glide = |now: DVec3, then: Option<(DVec3, f64)>| {
            let velocity = then.map_or(DVec3::ZERO, |(then, ago)| (now - then) / ago.max(1e-3));
            Glide::moving(0.0, now, velocity.clamp_length_max(20.0), DVec3::ZERO, lasts)
        };
        // A body that moves goes on for a little: it comes to stand where its feet land.
        let turn = |pose: &Pose| log(pose.world[0] * plain.world[0].conjugate());
        self.hips = [
            glide(
                own.hips_position - plain.hips_position,
                before.map(|(pose, ago)| (pose.hips_position - plain.hips_position, ago)),
            ),
            glide(turn(&own), before.map(|(pose, ago)| (turn(&pose), ago))),
        ];
        for (index, node) in [Node::Chest, Node::Neck, Node::Head].into_iter().enumerate() {
            let left = |pose: &Pose| log(plain.local(node).conjugate() * pose.local(node));
            self.trunk[index] = glide(left(&own), before.map(|(pose, ago)| (left(&pose), ago)));
        }
        if let Some((pose, ago)) = before {
            for side in 0..2 {
                for (index, node) in ARMS[side].into_iter().enumerate() {
                    let (now, then) = (log(own.local(node)), log(pose.local(node)));
                    self.arms[side].carried[index] =
                        Glide::moving(0.0, now, (now - then) / ago.max(1e-3), now * CARRIED_ON, lasts);
                }
            }
        }
        let at = own.positions(&body);
        let ago_at = before.map(|(pose, ago)| (pose.positions(&body), pose, ago));
        for side in 0..2 {
            let (_, lower, foot) = LEGS[side];
            let (ankle, sole) = self.feet.foot(side, 0.0);
            let shift = at[foot.index()] - ankle;
            let turned = log(own.world[foot.index()] * sole.conjugate());
            let then = ago_at.map(|(at, pose, ago)| {
                (at[foot.index()] - ankle, log(pose.world[foot.index()] * sole.conjugate()), ago)
            });
            self.feet.rests[side] =
                (glide(shift, then.map(|then| (then.0, then.2))), glide(turned, then.map(|then| (then.1, then.2))));
            // Where the knee points, against where the toes do.
            let hinge = own.world[lower.index()] * DVec3::X;
            let forward = hinge.cross(DVec3::Y);
            let yaw = crate::spine::wrapped(libm::atan2(forward.x, forward.z) - self.feet.planted[side].yaw_rad);
            let turn = if forward.length() > 0.3 { yaw.clamp(-0.8, 0.8) } else { 0.0 };
            self.knees[side] = Glide::moving(0.0, turn, 0.0, 0.0, lasts);
        }
    }

    /// All controls at a time \[s\].
    pub(crate) fn now(&self, secs: f64) -> Now {
        let arms = [0, 1].map(|side| {
            let arm = &self.arms[side];
            let share = match &arm.printed {
                Some((path, start)) => path.share_at(secs - start).clamp(0.0, 1.0),
                None => arm.share.at(secs),
            };
            ArmNow {
                share,
                target: arm.target + arm.offset.at(secs),
                bow: arm.bow.at(secs),
                swivel: arm.swivel.at(secs),
                pronation: 0.0,
                girdle: arm.girdle.at(secs),
                carried: arm.carried.map(|turn| exp(turn.at(secs))),
            }
        });
        Now {
            feet: [0, 1].map(|side| self.feet.foot(side, secs)),
            foot_yaw: [0, 1].map(|side| {
                let toes = self.feet.foot(side, secs).1 * DVec3::Z;
                libm::atan2(toes.x, toes.z)
            }),
            knee_turn: self.knees.map(|turn| turn.at(secs)),
            support: self.feet.support(secs),
            twist: self.twist.at(secs),
            swing: self.swing.at(secs),
            squat: self.squat.at(secs),
            hips_shift: self.hips[0].at(secs),
            hips_turn: self.hips[1].at(secs),
            trunk: self.trunk.map(|turn| turn.at(secs)),
            look_at: self.looks_at(secs),
            look: self.look.at(secs),
            arms,
            lean: self.lean.at(secs),
        }
    }

    fn looks_at(&self, secs: f64) -> DVec3 {
        let target = |side: usize| self.arms[side].target + self.arms[side].offset.at(secs);
        match self.goal {
            [Some(_), Some(_)] => (target(0) + target(1)) * 0.5,
            [Some(_), None] => target(0),
            _ => target(1),
        }
    }

    pub(crate) fn composed_at(&self, secs: f64) -> Composed {
        self.frame.compose(&self.now(secs))
    }

    /// The pose at a time \[s\], 0 being the start. Times before the last goal was given show the new plan.
    pub fn pose_at(&self, secs: f64) -> Pose {
        self.composed_at(secs).pose
    }

    /// The centres of both hands at a time \[m\].
    pub fn hands_at(&self, secs: f64) -> [DVec3; 2] {
        self.composed_at(secs).hands
    }

    /// The body's open values.
    pub fn values(&self) -> &Values {
        &self.frame.values
    }

    /// How it reaches.
    pub fn style(&self) -> &Style {
        &self.style
    }

    /// How it is to reach from the next goal on. The random choices go on as they were.
    ///
    /// # Errors
    /// When a dial is out of its range; all stays as it was.
    pub fn set_style(&mut self, style: &Style) -> Result<(), crate::StyleError> {
        style.check()?;
        self.frame.values = Values::of(&self.frame.body, style);
        self.style = *style;
        Ok(())
    }

    /// What was decided, and how it is to end.
    pub fn outcome(&self) -> &Outcome {
        &self.outcome
    }

    /// When all that is planned is done \[s\].
    pub fn done_secs(&self) -> f64 {
        self.outcome.arrives_secs.max(self.feet.lands_secs().unwrap_or(0.0))
    }

    /// Where the feet stand when all is done, and what they can carry.
    pub fn feet(&self) -> &Feet {
        &self.feet
    }

    /// Goes on to a time \[s\]: strides that are over become part of where the feet stand. Times never go back.
    pub fn advance(&mut self, secs: f64) {
        self.now_secs = self.now_secs.max(secs);
        self.feet.settle(self.now_secs);
    }

    /// Reaches for a goal from now on. The outcome is known at once, because the whole way is planned.
    pub fn reach(&mut self, goal: &Goal) -> &Outcome {
        let now = self.now_secs;
        self.feet.stop(now);
        self.steps.retain(|step| step.start_secs <= now);
        let targets = [goal.left, goal.right].map(|target| target.filter(|target| target.is_finite()));
        let composed = self.composed_at(now);
        self.goal = targets;
        self.planned = targets;
        self.followed = None;
        self.replanned_secs = now;
        let mut dice = self.dice;
        let decision = self.decide(targets, &mut dice, false);
        self.dice = dice;
        for side in (0..2).filter(|side| targets[*side].is_some()) {
            // Out of reach, the hand goes straight to the nearest point.
            let (arm, end) = (&mut self.arms[side], decision.ends[side]);
            if arm.share.at(now) <= 0.0 {
                arm.offset = Glide::rest(DVec3::ZERO);
            } else {
                arm.offset.shift(arm.target - end);
            }
            arm.target = end;
        }
        self.schedule(&decision, &composed, now);
        if !self.style.print {
            self.mend_way(now);
        }
        if self.outcome.reason.is_some() {
            let hands = self.hands_at(self.outcome.arrives_secs);
            let gaps = (0..2).filter_map(|side| Some((hands[side] - targets[side]?).length()));
            self.outcome.gap_m = gaps.fold(0.0, f64::max);
        }
        &self.outcome
    }

    /// Lets go: arms back to the sides, trunk upright, feet where they are.
    pub fn release(&mut self) {
        let now = self.now_secs;
        self.goal = [None; 2];
        self.planned = [None; 2];
        let lasts = 0.9;
        self.twist.go(now, 0.0, 0.0, lasts);
        self.swing.go(now, DVec3::ZERO, 0.0, lasts);
        self.squat.go(now, 0.0, 0.0, lasts);
        self.lean.go(now, DVec3::ZERO, 0.0, lasts);
        self.look.go(now, 0.0, 0.0, lasts);
        for arm in &mut self.arms {
            arm.printed = None;
            arm.share.go(now, 0.0, 0.0, lasts);
            arm.girdle.go(now, DVec3::ZERO, 0.0, lasts);
        }
        self.outcome = Outcome { arrives_secs: now + lasts, reason: Some(Reason::Released), ..Outcome::default() };
    }

    /// The task from where the feet will stand, trunk straight, nothing left of the start.
    pub(crate) fn task(&self, targets: [Option<DVec3>; 2]) -> Task<'_> {
        let mut now = self.now(self.now_secs);
        (now.twist, now.swing, now.squat, now.lean) = (0.0, DVec3::ZERO, 0.0, DVec3::ZERO);
        (now.hips_shift, now.hips_turn, now.trunk, now.knee_turn) =
            (DVec3::ZERO, DVec3::ZERO, [DVec3::ZERO; 3], [0.0; 2]);
        for side in 0..2 {
            let arm = &mut now.arms[side];
            (arm.share, arm.bow, arm.girdle) = (0.0, DVec3::ZERO, DVec3::ZERO);
            arm.carried = self.arms[side].carried.map(|turn| exp(turn.goal()));
        }
        now.look = 1.0;
        if let Some(target) = targets[1].or(targets[0]) {
            now.look_at = target;
        }
        let feet = self.feet.last();
        Task { frame: &self.frame, style: &self.style, now, targets }.stance(&feet, self.feet.support_of(&feet))
    }

    /// Sets every glide on its way: the scheduler's states 0 to 3.
    fn schedule(&mut self, decision: &Decision, composed: &Composed, now: f64) {
        let mut pace = 1.0;
        if let Some(time) = self.style.time_secs {
            let natural = self.timing(decision, composed, now, 1.0).end - now;
            pace = time / natural.max(1e-3);
        }
        let timing = self.timing(decision, composed, now, pace);
        // State 0: step.
        if let Some(walk) = &decision.walk {
            let values = self.frame.values;
            crate::walk::walk(
                &mut self.feet,
                &walk.to,
                walk.first,
                walk.kind,
                now.max(timing.free),
                pace,
                &values,
                &mut self.steps,
            );
        }
        let arms_secs = timing.end - timing.arm;
        let from = |at: f64| (at - now).max(0.0);
        let aim = &decision.aim;
        // State 1: arm, head and twist. The default looks first, as people do.
        let head = if self.style.print { timing.arm } else { now };
        self.look.go(now, 1.0, from(head), timing.head);
        self.twist.go(now, aim.twist, from(timing.arm), timing.twist);
        for side in 0..2 {
            let reaches = decision.targets[side].is_some();
            let arm = &mut self.arms[side];
            arm.printed = None;
            arm.share.go(now, if reaches { 1.0 } else { 0.0 }, from(timing.arm), arms_secs);
            arm.girdle.go(now, aim.arms[side].girdle, from(timing.arm), arms_secs);
            if reaches {
                arm.offset.go(now, DVec3::ZERO, 0.0, from(timing.end));
                if arm.share.at(now) <= 0.0 {
                    arm.swivel = Glide::rest(aim.arms[side].swivel);
                    arm.bow = Glide::rest(decision.bow[side]);
                } else {
                    arm.bow.go(now, decision.bow[side], 0.0, from(timing.end));
                    arm.swivel.go(now, aim.arms[side].swivel, 0.0, from(timing.end));
                }
                if self.style.print {
                    let speed = self.style.speed_m_s.unwrap_or(PRINTED_SPEED_M_S);
                    let path = HandPath::new(composed.hands[side], arm.target, speed, PRINTED_RATIO);
                    arm.printed = Some((path, timing.arm));
                }
            }
        }
        // State 2: swing, squat and the balance's lean.
        self.swing.go(now, aim.swing, from(timing.swing), timing.swings);
        self.squat.go(now, aim.squat, from(timing.swing), timing.swings);
        self.lean.go(now, aim.lean, from(timing.swing), timing.swings);
        // State 3: the arm has arrived.
        self.outcome = decision.outcome(timing.end, &self.steps);
    }

    /// Sends the body elsewhere while the hand stays on its way or on its target.
    pub(crate) fn schedule_again(&mut self, decision: &Decision, now: f64) {
        let composed = self.composed_at(now);
        let timing = self.timing(decision, &composed, now, 1.0);
        let mut landed = now;
        if let Some(walk) = &decision.walk {
            let values = self.frame.values;
            let from = now.max(timing.free);
            crate::walk::walk(&mut self.feet, &walk.to, walk.first, walk.kind, from, 1.0, &values, &mut self.steps);
            landed = self.feet.lands_secs().unwrap_or(now);
        }
        let aim = &decision.aim;
        // A body that must keep up with a target may not take its time.
        let lasts = (timing.twist.max(timing.swings)).clamp(0.35, 0.6).max(landed - now);
        self.twist.go(now, aim.twist, 0.0, lasts);
        self.swing.go(now, aim.swing, 0.0, lasts);
        self.squat.go(now, aim.squat, 0.0, lasts);
        self.lean.go(now, aim.lean, 0.0, lasts);
        let mut arrives = now;
        for side in 0..2 {
            if decision.targets[side].is_none() {
                continue;
            }
            let arm = &mut self.arms[side];
            arm.swivel.go(now, aim.arms[side].swivel, 0.0, lasts);
            arm.girdle.go(now, aim.arms[side].girdle, 0.0, lasts);
            if arm.share.end_secs() > now {
                let left = (arm.share.end_secs() - now).max(landed - now);
                arm.share.go(now, 1.0, 0.0, left);
            }
            arrives = arm.share.end_secs().max(arrives);
        }
        let before = self.outcome.arrives_secs;
        let arrives = if arrives > now { arrives } else { before };
        self.outcome = decision.outcome(arrives.max(landed), &self.steps);
    }

    /// When each controller begins and how long it takes.
    fn timing(&self, decision: &Decision, composed: &Composed, now: f64, pace: f64) -> Timing {
        let values = &self.frame.values;
        let free = self.feet.lands_secs().unwrap_or(now).max(now);
        let (mut arm, mut landed) = (now, now);
        if let Some(walk) = &decision.walk {
            let mut feet = self.feet.clone();
            let before = feet.strides().len();
            crate::walk::walk(&mut feet, &walk.to, walk.first, walk.kind, free, pace, values, &mut Vec::new());
            landed = feet.lands_secs().unwrap_or(free);
            // Of several steps the last counts.
            let strides = &feet.strides()[before..];
            let last = strides.len().saturating_sub(2);
            let from = strides.get(last).map_or(now, |stride| stride.start_secs);
            arm = from + self.style.overlap_step * (landed - from);
        }
        let turn = (decision.aim.twist - self.twist.at(now)).abs();
        let twist = pace * (0.35 + turn / 1.6);
        let swing = if turn > 0.01 { arm + self.style.overlap_twist * twist } else { arm };
        let bend = (decision.aim.swing - self.swing.at(now)).length();
        let sink = (decision.aim.squat - self.squat.at(now)).abs() / values.leg_m;
        let swings = pace * (0.45 + (bend / 1.7).max(sink / 0.42));
        let mut hands: f64 = 0.0;
        for side in 0..2 {
            if decision.targets[side].is_some() {
                let way = decision.ways_m[side];
                let printed = 2.0 * (composed.hands[side] - self.arms[side].target).length()
                    / (self.style.speed_m_s.unwrap_or(PRINTED_SPEED_M_S) * (1.0 + PRINTED_RATIO));
                hands = hands.max(if self.style.print { printed } else { values.hand_secs(way, &self.style) });
            }
        }
        let settled = self.hips[0].end_secs();
        let mut end = (arm + pace * hands).max(arm + twist).max(swing + swings).max(landed + 0.05);
        if self.style.time_secs.is_none() {
            end = end.max(settled);
        }
        let look = decision.turns_head_rad / self.style.head_speed_rad_s;
        Timing { free, arm, swing, end, twist, swings, head: pace * look.max(0.25) }
    }
}

struct Timing {
    /// When the feet are free for new steps \[s\].
    free: f64,
    /// When arm and twist begin, when the swing does, when the hand arrives \[s\].
    arm: f64,
    swing: f64,
    end: f64,
    /// How long twist, swing and the head's turn take \[s\].
    twist: f64,
    swings: f64,
    head: f64,
}

/// Share of a moving body's carried arms that stays when it stands.
const CARRIED_ON: f64 = 0.35;
