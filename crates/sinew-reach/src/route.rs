//! Checks a hand's path before the motion: joints within their limits, arms clear of obstacles. If they are not, the
//! path is bowed and the elbow swivelled; if that is not enough, the hand stops before it touches.

use crate::arm_place::Moment;
use crate::compose::{ARMS, Composed};
use crate::minimum_jerk::MinimumJerk;
use crate::outcome::Reason;
use crate::reacher::Reacher;
use glam::{DQuat, DVec3};
use sinew_body::humanoid::{Node, log};

/// Number of samples on the path.
const PATH_SAMPLES: usize = 48;

/// Minimum clearance of an arm \[m\], and the radius around its target in which obstacles are ignored: they are the
/// object that is reached for.
const CLEAR_M: f64 = 0.012;
const AT_TARGET_M: f64 = 0.11;

/// Maximum excess over the narrowed limits of plans along the path \[rad\].
const EXCESS_RAD: f64 = 0.042;

/// Maximum angular speed of an upper arm \[rad/s\]: above it the hand passes so near to its own shoulder that the arm
/// whips around.
const MAX_SPEED_RAD_S: f64 = 11.0;

/// Bows that are tried in order: up, out, in, forward, back, down, by shares of the arm.
const BOWS: [f64; 3] = [0.2, 0.4, 0.6];
const SWIVELS: [f64; 6] = [0.4, -0.4, 0.8, -0.8, 1.3, -1.3];

/// Violations along a path.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Fault {
    /// Maximum penetration of the arm into obstacles and their clearance \[m\].
    deep_m: f64,
    /// Maximum excess over joint limits \[rad\].
    excess_rad: f64,
    /// Maximum angular speed of the upper arm relative to its shoulder \[rad/s\].
    fastest_rad_s: f64,
    /// Time of the first touch \[s\].
    touches_secs: Option<f64>,
}

impl Fault {
    fn is_none(&self) -> bool {
        self.deep_m <= 0.0 && self.excess_rad <= EXCESS_RAD && self.fastest_rad_s <= MAX_SPEED_RAD_S
    }

    fn price(&self) -> f64 {
        10.0 * self.deep_m
            + (self.excess_rad - EXCESS_RAD).max(0.0)
            + 0.02 * (self.fastest_rad_s - MAX_SPEED_RAD_S).max(0.0)
    }
}

impl Reacher {
    /// Sets the obstacles of the arms. Takes effect at the next goal.
    pub fn set_obstacles(&mut self, obstacles: &[crate::Obstacle]) {
        self.obstacles = obstacles.iter().copied().filter(crate::Obstacle::is_finite).take(MAX_OBSTACLES).collect();
    }

    /// Checks the planned path and repairs it if a bow or a swivel suffices.
    pub(crate) fn mend_way(&mut self, now: f64) {
        for side in 0..2 {
            if self.goal[side].is_some() {
                self.mend_arm(side, now);
            }
        }
    }

    fn mend_arm(&mut self, side: usize, now: f64) {
        let mut samples = self.path_samples(side, now);
        let path = Path { bow: self.arms[side].bow.goal(), swivel: self.arms[side].swivel.goal(), by_joints: false };
        let mut best = (self.fault_of(side, &path, &mut samples), path);
        if best.0.is_none() {
            return;
        }
        for other in self.other_ways(side, &path, best.0.deep_m > 0.0, now) {
            let fault = self.fault_of(side, &other, &mut samples);
            if fault.price() < best.0.price() - 1e-9 {
                best = (fault, other);
                if fault.is_none() {
                    break;
                }
            }
        }
        let arm = &mut self.arms[side];
        (arm.bow, arm.swivel) = (MinimumJerk::rest(best.1.bow), MinimumJerk::rest(best.1.swivel));
        if best.1.by_joints {
            let end = self.outcome.arrives_secs;
            arm.by_joints = led_by_joints(arm.share.begins_secs().clamp(now, end), end);
        }
        if let Some(secs) = best.0.touches_secs
            && best.0.deep_m > 0.0
        {
            self.stop_before(side, secs, now);
        }
    }

    /// Alternative paths, the most promising first.
    fn other_ways(&self, side: usize, usual: &Path, touches: bool, now: f64) -> impl Iterator<Item = Path> + use<> {
        let usual = *usual;
        let outward = if side == 0 { 1.0 } else { -1.0 };
        let turn = DQuat::from_rotation_y(self.feet.support(now).yaw_rad);
        let arm_m = self.frame.values.arm_m;
        let paths = [DVec3::Y, DVec3::X * outward, DVec3::Z, DVec3::X * -outward, -DVec3::Z, -DVec3::Y];
        let bows = move || {
            let aside =
                BOWS.into_iter().flat_map(move |share| paths.map(|path| usual.bow + turn * path * (share * arm_m)));
            [usual.bow, DVec3::ZERO].into_iter().chain(aside)
        };
        // If only joint limits are violated, the path is interpolated in joint space.
        let by_joints = (!touches).then_some(Path { by_joints: true, ..usual });
        let swung = std::iter::once(0.0).chain(SWIVELS);
        by_joints.into_iter().chain(
            swung.flat_map(move |by| bows().map(move |bow| Path { bow, swivel: usual.swivel + by, by_joints: false })),
        )
    }

    /// The hand moves as far as the path is clear.
    fn stop_before(&mut self, side: usize, secs: f64, now: f64) {
        let end = self.outcome.arrives_secs;
        let begins = self.arms[side].share.begins_secs().clamp(now, end);
        let share = self.arms[side].share.at((secs - (end - begins) / PATH_SAMPLES as f64).max(now));
        let from = (self.arms[side].share.end_secs() - now).max(0.2);
        self.arms[side].share.go(now, share.clamp(0.0, 1.0), 0.0, from);
        self.outcome.reason = Some(Reason::Blocked);
    }

    /// The body at samples of the path.
    fn path_samples(&self, side: usize, now: f64) -> Vec<PathSample> {
        let end = self.outcome.arrives_secs;
        // Before that time the arm is only carried.
        let now = self.arms[side].share.begins_secs().clamp(now, end);
        let sample = |index: usize| {
            let secs = now + (end - now) * index as f64 / PATH_SAMPLES as f64;
            let controls = self.now(secs);
            PathSample { secs, led: led_by_joints(now, end).at(secs), moment: self.frame.moment(side, &controls) }
        };
        (0..=PATH_SAMPLES).map(sample).collect()
    }

    fn fault_of(&self, side: usize, path: &Path, samples: &mut [PathSample]) -> Fault {
        let mut fault = Fault::default();
        let mut at_start = Fault::default();
        let mut before: Option<(f64, DQuat)> = None;
        for (index, sample) in samples.iter_mut().enumerate() {
            let arm = &mut sample.moment.arm;
            (arm.bow, arm.swivel) = (path.bow, path.swivel);
            arm.by_joints = if path.by_joints { sample.led } else { 0.0 };
            self.frame.place_again(side, &mut sample.moment);
            let there = self.fault_at(side, &sample.moment.composed);
            let upper = sample.moment.composed.pose.local(ARMS[side][1]);
            if let Some((secs, turn)) = before {
                let speed = log(turn.conjugate() * upper).length() / (sample.secs - secs).max(1e-6);
                fault.fastest_rad_s = fault.fastest_rad_s.max(speed);
            }
            before = Some((sample.secs, upper));
            if index == 0 {
                at_start = there;
                continue;
            }
            // A motion that begins beyond a limit or in contact may continue from there.
            let deep = there.deep_m.min((there.deep_m - at_start.deep_m).max(0.0));
            if deep > 0.0 && fault.touches_secs.is_none() {
                fault.touches_secs = Some(sample.secs);
            }
            fault.deep_m = fault.deep_m.max(deep);
            fault.excess_rad = fault.excess_rad.max(there.excess_rad - at_start.excess_rad);
        }
        fault
    }

    fn fault_at(&self, side: usize, composed: &Composed) -> Fault {
        let pose = &composed.pose;
        let tight = &self.frame.tight;
        let excess =
            ARMS[side].iter().map(|node| tight.link(*node).limit.excess(pose.local(*node))).fold(0.0, f64::max);
        let mut fault = Fault { excess_rad: excess, ..Fault::default() };
        if self.obstacles.is_empty() {
            return fault;
        }
        let body = &self.frame.body;
        let at = pose.positions(body);
        let [_, upper, lower, hand] = ARMS[side];
        let target = self.goal[side].unwrap_or(composed.hands[side]);
        let bone = |node: Node, from: DVec3, to: DVec3, fault: &mut Fault| {
            let shape = &body.link(node).shape;
            for index in 0..=4 {
                let share = f64::from(index) / 4.0;
                let point = from.lerp(to, share);
                if (point - target).length() < AT_TARGET_M {
                    continue;
                }
                let radius = shape.from_radius_m + (shape.to_radius_m - shape.from_radius_m) * share;
                for obstacle in &self.obstacles {
                    fault.deep_m = fault.deep_m.max(radius + CLEAR_M - obstacle.distance(point));
                }
            }
        };
        let tip = at[hand.index()] + pose.world[hand.index()] * body.link(hand).tip;
        bone(upper, at[upper.index()], at[lower.index()], &mut fault);
        bone(lower, at[lower.index()], at[hand.index()], &mut fault);
        bone(hand, at[hand.index()], tip, &mut fault);
        fault
    }
}

/// Weight of joint interpolation along a path \[1\]: at the end, when the trunk has nearly arrived, the hand's position
/// is interpolated.
fn led_by_joints(begins: f64, end: f64) -> MinimumJerk<f64> {
    let mut led = MinimumJerk::rest(1.0);
    led.go(begins, 0.0, 0.85 * (end - begins), 0.15 * (end - begins));
    led
}

/// The path of an arm.
#[derive(Clone, Copy, Debug)]
struct Path {
    bow: DVec3,
    swivel: f64,
    by_joints: bool,
}

/// The body at a sample of the path.
struct PathSample {
    secs: f64,
    /// Weight of joint interpolation, if it is used.
    led: f64,
    moment: Moment,
}

/// Maximum number of obstacles; more are ignored.
pub const MAX_OBSTACLES: usize = 64;
