//! An arm over time.

use crate::compose::{ARMS, ArmNow};
use crate::hand_path::HandPath;
use crate::minimum_jerk::MinimumJerk;
use glam::{DQuat, DVec3};
use sinew_body::humanoid::{Pose, exp, log};
use sinew_snapshot::snapshot;

/// An arm over time.
#[derive(Clone, Debug)]
pub(crate) struct Arm {
    pub share: MinimumJerk<f64>,
    /// The target's present position, and the decaying offset from its previous one.
    pub target: DVec3,
    pub bow: MinimumJerk<DVec3>,
    pub swivel: MinimumJerk<f64>,
    pub girdle: MinimumJerk<DVec3>,
    /// Turn of the hand against the forearm at the target \[rad\].
    pub wrist: MinimumJerk<DVec3>,
    /// How far the carried upper arm is held away from the body \[rad\].
    pub clear: MinimumJerk<f64>,
    /// Rotations of shoulder, upper arm, lower arm and hand while the arm is carried (does not reach).
    pub carried: [Carried; 4],
    /// Blend from a hand path to joint interpolation \[1\], and the rotations of upper and lower arm at its end.
    pub by_joints: MinimumJerk<f64>,
    pub end: [DQuat; 2],
    /// The hand's path under `print`, with its start \[s\].
    pub printed: Option<(HandPath, f64)>,
}

/// A joint of a carried arm: a rotation, and a decaying deviation from it as a rotation vector.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Carried {
    base: DQuat,
    passes: MinimumJerk<DVec3>,
    /// The rotation after release.
    home: DQuat,
}

snapshot!(Arm { share, target, bow, swivel, girdle, wrist, clear, carried, by_joints, end, printed });
snapshot!(Carried { base, passes, home });

/// Time for which a joint that is taken over while it moves keeps its speed, total, and the time in which it comes to
/// rest \[s\].
const GOES_ON_SECS: f64 = 0.12;
const RESTS_SECS: f64 = 0.4;

/// Maximum speed with which a joint is taken over \[rad/s\].
const MAX_SPEED_RAD_S: f64 = 20.0;

impl Carried {
    fn rest(turn: DQuat) -> Carried {
        Carried { base: DQuat::IDENTITY, passes: MinimumJerk::rest(log(turn)), home: turn }
    }

    /// The joint of a moving body: most of its deviation decays.
    pub fn moving(now: DQuat, velocity: DVec3, share: f64, lasts: f64) -> Carried {
        let turn = log(now);
        Carried {
            base: DQuat::IDENTITY,
            passes: MinimumJerk::moving(0.0, turn, velocity, turn * share, lasts),
            home: exp(turn * share),
        }
    }

    fn at(&self, secs: f64) -> DQuat {
        self.base * exp(self.passes.at(secs))
    }

    /// Its rotation at rest.
    pub fn goal(&self) -> DQuat {
        self.base * exp(self.passes.goal())
    }

    /// Carries it from its present rotation on. `turns`: its rotation a moment before, now, and a moment after.
    fn continue_from(&mut self, now: f64, turns: [DQuat; 3], moment: f64) {
        let [before, at, after] = turns;
        let (back, on) = (log(at.conjugate() * before), log(at.conjugate() * after));
        let velocity = ((on - back) / (2.0 * moment)).clamp_length_max(MAX_SPEED_RAD_S);
        let acceleration = (on + back) / (moment * moment);
        self.base = at;
        self.passes =
            MinimumJerk::between(now, RESTS_SECS, DVec3::ZERO, velocity, acceleration, velocity * GOES_ON_SECS);
    }

    fn go_home(&mut self, now: f64, lasts: f64) {
        self.passes.go(now, log(self.base.conjugate() * self.home), 0.0, lasts);
    }
}

impl Arm {
    /// An arm carried as in a pose.
    pub fn carried(side: usize, pose: &Pose) -> Arm {
        let rest = MinimumJerk::rest(DVec3::ZERO);
        Arm {
            share: MinimumJerk::rest(0.0),
            target: DVec3::ZERO,
            bow: rest,
            swivel: MinimumJerk::rest(0.0),
            girdle: rest,
            wrist: rest,
            clear: MinimumJerk::rest(0.0),
            carried: ARMS[side].map(|node| Carried::rest(pose.local(node))),
            by_joints: MinimumJerk::rest(0.0),
            end: [DQuat::IDENTITY; 2],
            printed: None,
        }
    }

    /// Its controls at a time \[s\].
    pub fn at(&self, secs: f64) -> ArmNow {
        let share = match &self.printed {
            Some((path, start)) => path.share_at(secs - start).clamp(0.0, 1.0),
            None => self.share.at(secs),
        };
        ArmNow {
            share,
            target: self.target,
            bow: self.bow.at(secs),
            swivel: self.swivel.at(secs),
            pronation: 0.0,
            girdle: self.girdle.at(secs),
            wrist: self.wrist.at(secs),
            clear: self.clear.at(secs),
            carried: self.carried.map(|joint| joint.at(secs)),
            by_joints: self.by_joints.at(secs),
            end: self.end,
        }
    }

    /// If it reaches or holds a target, carries it from its present rotations on, so that it can start anew. `turns`:
    /// upper arm, lower arm and hand a moment before, now, and after.
    pub fn set_out(&mut self, now: f64, turns: [[DQuat; 3]; 3], moment: f64) {
        for joint in 0..3 {
            self.carried[1 + joint].continue_from(now, turns.map(|all| all[joint]), moment);
        }
        self.share = MinimumJerk::rest(0.0);
        self.by_joints = MinimumJerk::rest(0.0);
        self.printed = None;
    }

    /// Releases the target within `for_secs` seconds.
    pub fn let_go(&mut self, now: f64, lasts: f64) {
        self.printed = None;
        self.share.go(now, 0.0, 0.0, lasts);
        self.girdle.go(now, DVec3::ZERO, 0.0, lasts);
        self.clear.go(now, 0.0, 0.0, lasts);
        for joint in &mut self.carried[1..] {
            joint.go_home(now, lasts);
        }
    }
}
