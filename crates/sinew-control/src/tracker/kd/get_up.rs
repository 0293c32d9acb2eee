//! Get-up: from lying on the ground through a crouch to standing, at the same place; then the approach to the
//! performer.

use super::inertial_blend::sole_m;
use super::ramp::smooth;
use glam::{DQuat, DVec3};
use sinew_body::humanoid::{Body, Node, Pose, exp};

/// A get-up motion. First the body gathers its feet under itself, then it stands up into the wanted pose and starts to
/// move with it; then it closes the distance to the performer.
#[derive(Clone, Debug, Default)]
pub(super) struct GetUp {
    lying: Pose,
    /// Against the parents; the hips' in the world.
    crouch: [DQuat; Node::COUNT],
    /// Position of the hips over the ground, and their initial velocity \[m, m/s\].
    place: DVec3,
    drift: DVec3,
    /// The wanted hips a step ago.
    before: DVec3,
    /// Height of the lowest point of the soles at the start \[m\].
    sole_m: f64,
    lift_m: f64,
    aside_m: f64,
    gone_secs: f64,
    over_secs: f64,
}

/// Duration for a body of 1.7 m \[s\].
const UP_SECS: f64 = 2.2;

/// Shares of that time: until the legs are folded, until the body begins to turn upright, until the feet are under the
/// body, until it begins to stand up \[1\].
const FOLDED: f64 = 0.4;
const TURNS: f64 = 0.1;
const GATHERED: f64 = 0.6;
const STANDS_UP: f64 = 0.4;

/// Height of gathered feet above the floor; they come down flat as the body stands up \[m\]: dragged along it their
/// toes would fold under.
const CLEAR_M: f64 = 0.05;

/// The same for feet during the approach to the performer, whose heels would dig in \[m\].
const HOVERS_M: f64 = 0.02;

/// Approach speed in addition to the performer's own speed, and the time of arrival \[m/s, s\].
const AFTER_M_S: f64 = 0.8;
const ARRIVES_SECS: f64 = 0.5;

/// Distance at which the approach ends \[m\].
const REACHED_M: f64 = 1e-5;

/// Time in which the initial velocity decays \[s\].
const DRIFT_SECS: f64 = 0.4;

/// Maximum vertical component of the up axis of lying hips \[1\].
const LIES: f64 = 0.5;

/// Smoothing time of the lift off the floor \[s\].
const LIFT_SECS: f64 = 0.03;

sinew_snapshot::snapshot!(GetUp { lying, crouch, place, drift, before, sole_m, lift_m, aside_m, gone_secs, over_secs });

impl GetUp {
    /// Whether a pose needs a get-up: hips low and not upright.
    pub(super) fn is_from(body: &Body, pose: &Pose) -> bool {
        let low = pose.hips_position.y - sole_m(body, pose).min(pose.hips_position.y) < 0.3 * body.stature_m();
        low && (pose.world[0] * DVec3::Y).y < LIES
    }

    /// A get-up from a pose to a wanted one, with the velocity of the hips \[m/s\]; lasts at least this time.
    pub(super) fn between(body: &Body, from: &Pose, to: &Pose, velocity: DVec3, least_secs: f64) -> GetUp {
        let up_secs = UP_SECS * (body.stature_m() / 1.7).sqrt();
        GetUp {
            lying: *from,
            crouch: crouch(to),
            place: from.hips_position,
            drift: velocity,
            before: to.hips_position,
            sole_m: sole_m(body, from),
            lift_m: 0.0,
            aside_m: f64::MAX,
            gone_secs: 0.0,
            over_secs: up_secs.max(least_secs),
        }
    }

    /// Advances by a step; returns the pose at its end.
    pub(super) fn step(&mut self, body: &Body, pose: &Pose, step_secs: f64) -> Pose {
        self.gone_secs += step_secs;
        let share = self.gone_secs / self.over_secs;
        let (folded, stands) = (smooth(share / FOLDED), self.progress());
        let gathered = smooth((share - TURNS) / (GATHERED - TURNS));
        let local = |pose: &Pose, node: Node| if node == Node::Hips { pose.world[0] } else { pose.local(node) };
        let locals = Node::ALL.map(|node| {
            let come = if node == Node::Hips { gathered } else { folded };
            let low = local(&self.lying, node).slerp(self.crouch[node.index()], come);
            low.slerp(local(pose, node), stands).normalize()
        });
        let drifting = (1.0 - self.gone_secs / DRIFT_SECS).max(0.0);
        let drift = self.drift * (drifting * drifting);
        let hurry = self.go(pose, drift, stands, step_secs);

        let floor_m = self.sole_m.min(sole_m(body, pose));
        let crouching = Pose::from_locals(DVec3::ZERO, &self.crouch);
        let crouch_m = floor_m - sole_m(body, &crouching);
        let lying_m = self.lying.hips_position.y + drift.y * self.gone_secs;
        let low_m = lying_m + (crouch_m - lying_m) * gathered;
        let height_m = low_m + (pose.hips_position.y - low_m) * stands;
        let mut posed = Pose::from_locals(self.place.with_y(height_m), &locals);
        // The lowest point of the soles may jump; the lift is smoothed.
        let lift_m = (floor_m - sole_m(body, &posed)).max(0.0);
        self.lift_m += (lift_m - self.lift_m) * (step_secs / LIFT_SECS).min(1.0);
        posed.hips_position.y += self.lift_m + (CLEAR_M * folded * (1.0 - stands)).max(HOVERS_M * hurry);
        posed
    }

    /// Motion over the ground: with the performer by its standing progress, plus the approach. Returns the approach
    /// speed \[1 of [`AFTER_M_S`]\].
    fn go(&mut self, pose: &Pose, drift: DVec3, stands: f64, step_secs: f64) -> f64 {
        let along = pose.hips_position - self.before;
        self.before = pose.hips_position;
        self.place += along.with_y(0.0) * stands + drift.with_y(0.0) * step_secs;
        let aside = (pose.hips_position - self.place).with_y(0.0);
        self.aside_m = aside.length();
        let speed = (self.aside_m / ARRIVES_SECS).min(AFTER_M_S) * stands;
        self.place += aside.normalize_or_zero() * (speed * step_secs).min(self.aside_m);
        speed / AFTER_M_S
    }

    /// Progress of standing up, 0 to 1.
    pub(super) fn progress(&self) -> f64 {
        smooth((self.gone_secs / self.over_secs - STANDS_UP) / (1.0 - STANDS_UP))
    }

    pub(super) fn is_over(&self) -> bool {
        self.gone_secs >= self.over_secs && self.aside_m < REACHED_M
    }
}

/// A crouch with the heading of a pose: feet under the hips, the trunk ahead of them.
fn crouch(to: &Pose) -> [DQuat; Node::COUNT] {
    let ahead = to.world[0] * DVec3::Z;
    let facing = DQuat::from_rotation_y(libm::atan2(ahead.x, ahead.z));
    let bent = |degrees: f64| exp(DVec3::X * degrees.to_radians());
    Node::ALL.map(|node| match node {
        Node::Hips => facing * bent(30.0),
        Node::Chest => bent(20.0),
        Node::Neck => bent(-25.0),
        Node::LeftUpperLeg | Node::RightUpperLeg => bent(-105.0),
        Node::LeftLowerLeg | Node::RightLowerLeg => bent(115.0),
        Node::LeftFoot | Node::RightFoot => bent(-30.0),
        Node::LeftUpperArm | Node::RightUpperArm => bent(-35.0),
        Node::LeftLowerArm | Node::RightLowerArm => bent(-30.0),
        _ => DQuat::IDENTITY,
    })
}
