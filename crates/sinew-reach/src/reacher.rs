//! The reacher: takes goals, returns the pose of every instant.

use crate::arm::Arm;
use crate::compose::{ARMS, ArmNow, Composed, Now};
use crate::feet::Feet;
use crate::frame::Frame;
use crate::manner::Manner;
use crate::minimum_jerk::MinimumJerk;
use crate::outcome::{Outcome, Reason};
use crate::solve::Task;
use crate::start::{Start, flat_feet};
use crate::stop::Stop;
use crate::walk::Step;
use crate::{Rng, Style, Values};
use glam::DVec3;
use sinew_body::humanoid::{Body, Node, Pose, exp};

/// Targets of the hands \[m\], world.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Goal {
    /// The left hand's target.
    pub left: Option<DVec3>,
    /// The right hand's target.
    pub right: Option<DVec3>,
}

/// A body that reaches for targets. Give it a [`Goal`] and take a pose for every instant; a new or moving goal is
/// followed from the body's present state, without a jump in position, velocity or acceleration.
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
    pub(crate) rng: Rng,
    pub(crate) manner: Manner,
    pub(crate) now_secs: f64,
    pub(crate) feet: Feet,
    pub(crate) twist: MinimumJerk<f64>,
    pub(crate) swing: MinimumJerk<DVec3>,
    pub(crate) squat: MinimumJerk<f64>,
    pub(crate) lean: MinimumJerk<DVec3>,
    pub(crate) tiptoe: MinimumJerk<f64>,
    pub(crate) onto_toes: MinimumJerk<f64>,
    pub(crate) reserve: MinimumJerk<f64>,
    pub(crate) heels: MinimumJerk<f64>,
    /// How far the head has taken up the gaze \[1\].
    pub(crate) gaze_weight: MinimumJerk<f64>,
    /// Turn of the head relative to the chest with which it faces the target.
    pub(crate) gaze: MinimumJerk<DVec3>,
    pub(crate) arms: [Arm; 2],
    pub(crate) hips: [MinimumJerk<DVec3>; 2],
    pub(crate) trunk: [MinimumJerk<DVec3>; 3],
    pub(crate) knees: [MinimumJerk<f64>; 2],
    pub(crate) leg_turns: [[MinimumJerk<f64>; 2]; 2],
    pub(crate) steps: Vec<Step>,
    pub(crate) outcome: Outcome,
    pub(crate) goal: [Option<DVec3>; 2],
    pub(crate) planned: [Option<DVec3>; 2],
    pub(crate) replanned_secs: f64,
    pub(crate) obstacles: Vec<crate::Obstacle>,
    /// Last positions of followed targets, and their time [s].
    pub(crate) followed: Option<([Option<DVec3>; 2], f64)>,
    pub(crate) velocity: [DVec3; 2],
}

impl Reacher {
    /// A reacher in an initial pose; the floor is at height 0 below the lower sole of that pose.
    ///
    /// # Errors
    /// A parameter of the style is out of range.
    pub fn new(body: &Body, style: &Style, start: &Start) -> Result<Reacher, crate::StyleError> {
        style.check()?;
        let frame = Frame::new(body, style);
        let mut stop = Stop::of(start, body, &frame.values, frame.ankle_m);
        let placed = stop.as_ref().map_or_else(|| flat_feet(&start.pose, body, frame.ankle_m), |stop| stop.placed);
        let mut feet = Feet::new(body, placed, style.print);
        if let Some(stop) = &mut stop {
            stop.stride(&mut feet, &frame.values);
        }
        let rest = MinimumJerk::rest(DVec3::ZERO);
        let arms = [0, 1].map(|side| Arm::carried(side, &start.pose));
        let mut reacher = Reacher {
            rng: Rng::new(style.seed),
            manner: if style.print { Manner::PLAIN } else { Manner::of(style.manner_seed.unwrap_or(style.seed)) },
            now_secs: 0.0,
            feet,
            twist: MinimumJerk::rest(0.0),
            swing: rest,
            squat: MinimumJerk::rest(0.0),
            lean: rest,
            tiptoe: MinimumJerk::rest(0.0),
            onto_toes: MinimumJerk::rest(0.0),
            reserve: MinimumJerk::rest(1.0),
            heels: MinimumJerk::rest(0.0),
            gaze_weight: MinimumJerk::rest(0.0),
            gaze: rest,
            arms,
            hips: [rest; 2],
            trunk: [rest; 3],
            knees: [MinimumJerk::rest(0.0); 2],
            leg_turns: [[MinimumJerk::rest(0.0); 2]; 2],
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
        reacher.begin(start, stop.as_ref());
        Ok(reacher)
    }

    /// All controls at a time \[s\].
    pub(crate) fn now(&self, secs: f64) -> Now {
        Now {
            feet: [0, 1].map(|side| self.feet.foot(side, secs)),
            foot_yaw: [0, 1].map(|side| {
                let toes = self.feet.foot(side, secs).1 * DVec3::Z;
                libm::atan2(toes.x, toes.z)
            }),
            knee_turn: self.knees.map(|turn| turn.at(secs)),
            leg_turn: self.leg_turns.map(|both| both.map(|turn| turn.at(secs))),
            support: self.feet.supports(secs),
            twist: self.twist.at(secs),
            swing: self.swing.at(secs),
            squat: self.squat.at(secs),
            tiptoe: self.tiptoe.at(secs),
            onto_toes: Some(self.onto_toes.at(secs)),
            reserve: self.reserve.at(secs),
            walks: self.feet.walks(secs),
            heel_off: [0, 1].map(|side| self.feet.heel_off_rad(side, secs)),
            heels: self.heels.at(secs),
            hips_shift: self.hips[0].at(secs),
            hips_turn: self.hips[1].at(secs),
            trunk: self.trunk.map(|turn| turn.at(secs)),
            look_at: None,
            head: self.gaze.at(secs) * self.gaze_weight.at(secs),
            arms: [0, 1].map(|side| self.arm_at(side, secs)),
            lean: self.lean.at(secs),
        }
    }

    /// An arm's controls at a time \[s\], swinging with the strides where it is carried.
    fn arm_at(&self, side: usize, secs: f64) -> ArmNow {
        let mut arm = self.arms[side].at(secs);
        if !self.style.print {
            let swing = ARM_SWING_RAD * self.feet.arm_swing(side, secs, self.frame.values.usual_step_m);
            arm.carried[1] = exp(DVec3::X * -swing) * arm.carried[1];
        }
        arm
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

    /// The style.
    pub fn style(&self) -> &Style {
        &self.style
    }

    /// Sets the style; it takes effect at the next goal. The random sequence continues.
    ///
    /// # Errors
    /// A parameter is out of range; nothing changes then.
    pub fn set_style(&mut self, style: &Style) -> Result<(), crate::StyleError> {
        style.check()?;
        self.frame.values = Values::of(&self.frame.body, style);
        self.frame.has_heels = !style.print;
        self.style = *style;
        Ok(())
    }

    /// The present plan and its expected result.
    pub fn outcome(&self) -> &Outcome {
        &self.outcome
    }

    /// Time at which the plan is complete \[s\].
    pub fn done_secs(&self) -> f64 {
        self.outcome.arrives_secs.max(self.feet.rests_secs().unwrap_or(0.0))
    }

    /// Placements of the feet at the end of the plan, and their support.
    pub fn feet(&self) -> &Feet {
        &self.feet
    }

    /// Advances to a time \[s\]: completed strides become part of the planted feet. Times must not decrease.
    pub fn advance(&mut self, secs: f64) {
        self.now_secs = self.now_secs.max(secs);
        self.feet.settle(self.now_secs);
    }

    /// Starts to reach for a goal now. The outcome is known at once, because the whole motion is planned.
    pub fn reach(&mut self, goal: &Goal) -> &Outcome {
        let now = self.now_secs;
        let targets = [goal.left, goal.right].map(|target| target.filter(|target| target.is_finite()));
        self.set_out(targets, now);
        self.feet.stop(now);
        let last = self.feet.lands_secs().unwrap_or(now);
        self.steps.retain(|step| step.start_secs < last);
        let composed = self.composed_at(now);
        self.goal = targets;
        self.planned = targets;
        self.followed = None;
        self.replanned_secs = now;
        let mut rng = self.rng;
        let decision = self.decide(targets, &mut rng, false);
        self.rng = rng;
        for side in (0..2).filter(|side| targets[*side].is_some()) {
            // If the target is out of reach, the hand moves straight to the nearest point.
            self.arms[side].target = decision.ends[side];
            self.arms[side].end = decision.arms[side];
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

    /// Arms that already reach or hold a target start anew from their present state: their path is then planned and
    /// checked like any other.
    fn set_out(&mut self, targets: [Option<DVec3>; 2], now: f64) {
        let sets_out = [0, 1].map(|side| targets[side].is_some() && self.arms[side].share.at(now) > 0.0);
        if sets_out == [false; 2] {
            return;
        }
        let moments = [now - MOMENT_SECS, now, now + MOMENT_SECS].map(|secs| {
            let controls = self.now(secs);
            let pose = self.frame.compose(&controls).pose;
            [0, 1].map(|side| {
                let hang = self.frame.hang(side, &controls.arms[side], pose.world[Node::Chest.index()], controls.swing);
                let swing = self.arms[side].at(secs).carried[1] * controls.arms[side].carried[1].conjugate();
                let [_, upper, lower, hand] = ARMS[side].map(|node| pose.local(node));
                [swing * hang.conjugate() * upper, lower, hand]
            })
        });
        for side in (0..2).filter(|side| sets_out[*side]) {
            self.arms[side].set_out(now, moments.map(|both| both[side]), MOMENT_SECS);
        }
    }

    /// Releases all targets: arms back to the sides, trunk upright, feet where they are.
    pub fn release(&mut self) {
        let now = self.now_secs;
        self.goal = [None; 2];
        self.planned = [None; 2];
        let lasts = 0.9;
        self.twist.go(now, 0.0, 0.0, lasts);
        self.swing.go(now, DVec3::ZERO, 0.0, lasts);
        self.squat.go(now, 0.0, 0.0, lasts);
        self.lean.go(now, DVec3::ZERO, 0.0, lasts);
        self.tiptoe.go(now, 0.0, 0.0, 0.8 * lasts);
        self.onto_toes.go(now, 0.0, 0.2 * lasts, 0.8 * lasts);
        self.gaze_weight.go(now, 0.0, 0.0, lasts);
        for arm in &mut self.arms {
            arm.let_go(now, lasts);
        }
        self.outcome = Outcome { arrives_secs: now + lasts, reason: Some(Reason::Released), ..Outcome::default() };
    }

    /// The task from the final placements of the feet, trunk straight, without the rest of the initial pose.
    pub(crate) fn task(&self, targets: [Option<DVec3>; 2]) -> Task<'_> {
        let mut now = self.now(self.now_secs);
        (now.twist, now.swing, now.squat, now.lean) = (0.0, DVec3::ZERO, 0.0, DVec3::ZERO);
        (now.tiptoe, now.onto_toes, now.reserve) = (0.0, None, 1.0);
        now.leg_turn = [[0.0; 2]; 2];
        (now.hips_shift, now.hips_turn, now.trunk, now.knee_turn) =
            (DVec3::ZERO, DVec3::ZERO, [DVec3::ZERO; 3], [0.0; 2]);
        for side in 0..2 {
            let arm = &mut now.arms[side];
            (arm.share, arm.bow, arm.girdle) = (0.0, DVec3::ZERO, DVec3::ZERO);
            arm.by_joints = 0.0;
            arm.carried = self.arms[side].carried.map(|joint| joint.goal());
        }
        (now.heels, now.walks, now.heel_off) = (1.0, 0.0, [0.0; 2]);
        now.look_at = middle_of(targets);
        let feet = self.feet.last();
        Task { frame: &self.frame, style: &self.style, manner: &self.manner, minds_touch: true, now, targets }
            .stance(&feet, self.feet.supports_of(&feet))
    }
}

/// What is looked at: the middle of the targets \[m\].
pub(crate) fn middle_of(targets: [Option<DVec3>; 2]) -> Option<DVec3> {
    let count = targets.iter().flatten().count();
    (count > 0).then(|| targets.iter().flatten().sum::<DVec3>() / count as f64)
}

/// Amplitude of the arm swing of a usual step \[rad\].
const ARM_SWING_RAD: f64 = 0.3;

/// Time step for measuring the velocity of an arm that starts anew \[s\]. The error is of second order in it.
const MOMENT_SECS: f64 = 1e-3;
