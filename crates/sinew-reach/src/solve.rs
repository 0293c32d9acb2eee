//! The posture in which hands reach their targets from a stance: the paper's rules first, then a search if they are not
//! sufficient.

use crate::compose::{ARMS, Composed, Now};
use crate::feet::Placement;
use crate::frame::Frame;
use crate::heel::{LEAN_FIRST_RAD, MAX_RAD};
use crate::manner::Manner;
use crate::spine::{search_twist, squat_for, swing_axis};
use crate::weight::Support;
use crate::{Style, Values};
use glam::{DQuat, DVec3};
use sinew_body::humanoid::Node;

/// A posture of trunk and arms.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Aim {
    pub twist: f64,
    pub swing: DVec3,
    pub squat: f64,
    pub lean: DVec3,
    /// Heel rise of the body on its toes, including the lean before it \[rad\].
    pub tiptoe: f64,
    pub arms: [ArmAim; 2],
}

#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct ArmAim {
    pub swivel: f64,
    pub girdle: DVec3,
    /// Turn of the hand against the forearm.
    pub wrist: DVec3,
}

/// The cost of an aim.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Judged {
    pub composed: Composed,
    /// Gap between the worse hand and its target \[m\].
    pub gap_m: f64,
    /// Sum of the joints' excess over the narrowed limits \[rad\].
    pub excess_rad: f64,
    /// How deep reaching forearms are in trunk, thighs and head, beyond what is put up with \[m\].
    pub inside_m: f64,
    /// Excess of the upper arms over their comfortable range \[rad\].
    unease_rad: f64,
    cost: f64,
}

/// The targets, and the stance from which they are reached.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Task<'a> {
    pub frame: &'a Frame,
    pub style: &'a Style,
    pub manner: &'a Manner,
    /// Whether arms keep out of the rest of the body.
    pub minds_touch: bool,
    /// The instant with the stance in it, trunk straight.
    pub now: Now,
    pub targets: [Option<DVec3>; 2],
}

/// Tolerance of the gap \[m\].
pub(crate) const EXACT_M: f64 = 2e-4;

impl Task<'_> {
    pub fn stance(mut self, feet: &[Placement; 2], support: [Support; 2]) -> Self {
        self.now.feet = feet.map(|foot| (foot.ankle, DQuat::from_rotation_y(foot.yaw_rad)));
        self.now.foot_yaw = feet.map(|foot| foot.yaw_rad);
        self.now.support = support;
        self
    }

    fn values(&self) -> &Values {
        &self.frame.values
    }

    /// The instant with an aim in it.
    fn with(&self, aim: &Aim) -> Now {
        let mut now = self.now;
        (now.twist, now.swing, now.squat, now.lean) = (aim.twist, aim.swing, aim.squat, aim.lean);
        now.tiptoe = aim.tiptoe;
        for side in 0..2 {
            let arm = &mut now.arms[side];
            (arm.swivel, arm.girdle) = (aim.arms[side].swivel, aim.arms[side].girdle);
            arm.wrist = aim.arms[side].wrist;
            if let Some(target) = self.targets[side] {
                (arm.share, arm.target) = (1.0, target);
            }
        }
        now
    }

    pub fn composed(&self, aim: &Aim) -> Composed {
        self.frame.compose(&self.with(aim))
    }

    pub fn judge(&self, aim: &Aim) -> Judged {
        let composed = self.composed(aim);
        let (mut gap_m, mut strain, mut gaps): (f64, f64, f64) = (0.0, 0.0, 0.0);
        for side in 0..2 {
            let Some(target) = self.targets[side] else { continue };
            let gap = (composed.hands[side] - target).length();
            gap_m = gap_m.max(gap);
            gaps += gap;
            let over = (composed.stretch[side] - self.values().stretch.0).max(0.0);
            strain += over * over;
        }
        let excess_rad: f64 =
            Node::ALL.into_iter().map(|node| self.frame.tight.link(node).limit.excess(composed.pose.local(node))).sum();
        let unease_rad: f64 = (0..2)
            .filter(|side| self.targets[*side].is_some())
            .map(|side| {
                let node = ARMS[side][1];
                self.frame.easy.link(node).limit.excess(composed.pose.local(node))
            })
            .sum();
        let scale = self.values().arm_m;
        let inside_m = if self.style.print || !self.minds_touch {
            0.0
        } else {
            self.frame.arms_inside_m(&composed, self.targets, self.now.support[0].centre.y)
        };
        let elbows: f64 = aim.arms.iter().map(|arm| (arm.swivel - USUAL_SWIVEL) * (arm.swivel - USUAL_SWIVEL)).sum();
        let effort = 0.12 * aim.twist * aim.twist
            + 0.04 * aim.swing.length_squared()
            + 0.3 / libm::pow(self.style.flexibility, 4.0) * (aim.squat / scale) * (aim.squat / scale)
            + 0.5 * aim.lean.length_squared() / (scale * scale)
            + 0.5 * aim.tiptoe * aim.tiptoe
            + 0.01 * elbows;
        let beyond = (aim.swing.length() - self.values().most_swing_rad).max(0.0)
            + (aim.squat - self.values().most_squat_m).max(0.0)
            + (-aim.squat).max(0.0)
            + (aim.tiptoe - MAX_TIPTOE_RAD).max(0.0)
            + (-aim.tiptoe).max(0.0);
        let cost = 40.0 * gaps / scale + 30.0 * excess_rad + 8.0 * strain + 0.3 * unease_rad + effort + 100.0 * beyond;
        let cost = cost + 7.0 * inside_m / scale;
        Judged { composed, gap_m, excess_rad, inside_m, unease_rad, cost }
    }

    /// The paper's rules: twist by search, squat by the stoop range, swing until the hand reaches.
    fn by_rule(&self) -> Aim {
        let mut aim = Aim::default();
        aim.arms.iter_mut().for_each(|arm| arm.swivel = USUAL_SWIVEL);
        let reaching: Vec<(usize, DVec3)> = (0..2).filter_map(|side| Some((side, self.targets[side]?))).collect();
        let Some(&(first, target)) = reaching.first() else { return aim };
        let yaw = self.now.support[0].yaw_rad;
        if let [(side, target)] = reaching[..] {
            let shoulder = |twist: f64| self.frame.led_shoulder(side, &self.with(&Aim { twist, ..aim }));
            aim.twist = search_twist(target, yaw, side == 1, self.values(), shoulder);
            aim.twist = self.turned(aim.twist, target, yaw);
        } else {
            // Both hands: the trunk faces the middle of the two.
            let middle = (reaching[0].1 + reaching[1].1) * 0.5;
            let away = middle - self.now.support[0].rest;
            let turn = crate::spine::wrapped(libm::atan2(away.x, away.z) - yaw);
            let far = libm::hypot(away.x, away.z) > 0.3 * self.values().arm_m;
            aim.twist = if far { turn.clamp(-self.values().most_twist_rad, self.values().most_twist_rad) } else { 0.0 };
        }
        let target = if reaching.len() == 2 { (reaching[0].1 + reaching[1].1) * 0.5 } else { target };
        let shoulder_of = |composed: &Composed| {
            if reaching.len() == 2 {
                (composed.shoulders[0] + composed.shoulders[1]) * 0.5
            } else {
                composed.shoulders[first]
            }
        };
        let standing = self.composed(&aim);
        let d = target - shoulder_of(&standing);
        aim.squat = squat_for(-d.y, self.style.flexibility * self.manner.flexibility, self.values());
        self.lift_girdles(&mut aim, &standing);
        let axis = swing_axis(d, yaw + aim.twist);
        let worst = |aim: &Aim| {
            let composed = self.composed(aim);
            reaching.iter().map(|(side, _)| composed.stretch[*side]).fold(0.0, f64::max)
        };
        let enough = self.values().stretch.0;
        let mut best = (worst(&aim), 0.0);
        if best.0 > self.values().stretch.1 && d.y > self.values().start_swing_m && self.frame.has_heels {
            // Rise on the toes if the stretched arm is not sufficient, as far as needed.
            for share in TIPTOES {
                let tiptoe = share * MAX_TIPTOE_RAD;
                let stretch = worst(&Aim { tiptoe, ..aim });
                if stretch < best.0 - 1e-3 {
                    (aim.tiptoe, best.0) = (tiptoe, stretch);
                }
                if stretch <= enough {
                    break;
                }
            }
        }
        if best.0 > enough {
            // Leaning away lifts a shoulder towards a high target; people do not lean far that way.
            let back = if d.y > self.values().start_swing_m { 24.0_f64.to_radians() } else { 0.0 };
            for (sign, most) in [(1.0, self.values().most_swing_rad), (-1.0, back)] {
                let (mut inside, mut angle) = (0.0, 0.0);
                while angle + 0.5 * SWING_STEP_RAD < most {
                    angle += SWING_STEP_RAD;
                    let stretch = worst(&Aim { swing: axis * (sign * angle), ..aim });
                    if best.0 > enough && stretch < best.0 || stretch <= enough && angle < f64::abs(best.1) {
                        best = (stretch, sign * angle);
                    }
                    if stretch <= enough || stretch > best.0 + 0.2 {
                        break;
                    }
                    inside = angle;
                }
                if best.0 <= enough && best.1 == sign * angle {
                    // The smallest sufficient value.
                    let mut enough_at = angle;
                    for _ in 0..SWING_HALVINGS {
                        let middle = 0.5 * (inside + enough_at);
                        let stretch = worst(&Aim { swing: axis * (sign * middle), ..aim });
                        if stretch <= enough {
                            (enough_at, best) = (middle, (stretch, sign * middle));
                        } else {
                            inside = middle;
                        }
                    }
                }
            }
        }
        aim.swing = axis * (best.1 + self.manner.swing_rad);
        aim
    }

    /// A twist with which the chest takes its share of the gaze shift, and with that of the manner.
    fn turned(&self, twist: f64, target: DVec3, yaw: f64) -> f64 {
        if self.style.print {
            return twist;
        }
        let away = target - self.now.support[0].rest;
        let left = crate::spine::wrapped(libm::atan2(away.x, away.z) - yaw - twist);
        let is_seen = left.abs() < LOOKS_BEHIND_RAD && libm::hypot(away.x, away.z) > 0.3 * self.values().arm_m;
        let looks = if is_seen { CHEST_SHARE * left } else { 0.0 };
        let most = self.values().most_twist_rad;
        (twist + looks + self.manner.twist_rad).clamp(-most, most)
    }

    /// Hands whose fingers would be in the floor bend at the wrist.
    pub fn lay_hands(&self, (aim, judged): &mut (Aim, Judged)) {
        let floor = self.now.support[0].centre.y;
        for side in 0..2 {
            let Some(target) = self.targets[side] else { continue };
            if target.y - floor > NEAR_FLOOR_M || judged.inside_m <= 0.0 {
                continue;
            }
            let mut best = (*aim, *judged);
            for angle in WRISTS_RAD {
                let mut other = *aim;
                other.arms[side].wrist = DVec3::Z * angle;
                let there = self.judge(&other);
                if there.cost < best.1.cost {
                    best = (other, there);
                }
            }
            self.better(&mut best);
            (*aim, *judged) = best;
        }
    }

    /// The elbow where the manner has it, or as near to that as the joints allow.
    pub fn swivelled(&self, (aim, judged): &mut (Aim, Judged)) {
        for share in SWIVELS {
            let mut other = *aim;
            for side in 0..2 {
                let outward = if side == 0 { 1.0 } else { -1.0 };
                other.arms[side].swivel += outward * share * self.manner.swivel_rad;
            }
            let there = self.judge(&other);
            if there.excess_rad <= judged.excess_rad
                && there.inside_m <= judged.inside_m
                && there.gap_m <= judged.gap_m.max(EXACT_M)
            {
                (*aim, *judged) = (other, there);
                return;
            }
        }
    }

    /// The shoulder girdle rises for a high target and moves forward for a far one.
    fn lift_girdles(&self, aim: &mut Aim, composed: &Composed) {
        for side in 0..2 {
            let Some(target) = self.targets[side] else { continue };
            let chest = composed.pose.world[Node::Chest.index()];
            let line = chest.conjugate() * (target - composed.shoulders[side]);
            let far = crate::head::smooth(line.length() / self.values().arm_m, 0.75, 1.15);
            let direction = line.normalize_or_zero();
            let raise = 0.42 * crate::head::smooth(direction.y, -0.1, 0.95);
            let forward = 0.3 * far * direction.z.max(0.0) * (1.0 - direction.y.abs());
            let sign = if side == 0 { 1.0 } else { -1.0 };
            aim.arms[side].girdle = DVec3::new(0.0, -sign * forward, sign * raise);
        }
    }

    /// The paper's rules, with the swivel of least cost for the arm's joints.
    pub fn ruled(&self) -> (Aim, Judged) {
        let mut aim = self.by_rule();
        let mut judged = self.judge(&aim);
        if judged.excess_rad > 0.0 || judged.unease_rad > 0.0 || judged.inside_m > 0.0 {
            self.swivel_arms(&mut aim, &mut judged);
        }
        (aim, judged)
    }

    /// Continues with a search if the hand does not arrive, or not comfortably.
    pub fn better(&self, (aim, judged): &mut (Aim, Judged)) {
        let is_strained = (0..2).any(|side| {
            self.targets[side].is_some() && judged.composed.stretch[side] > self.values().stretch.0 + 0.005
        });
        if judged.gap_m > EXACT_M
            || judged.excess_rad > 0.0
            || judged.inside_m > 0.0
            || (is_strained && !self.style.print)
        {
            self.search(aim, judged);
        }
        if self.minds_touch && judged.gap_m > EXACT_M && judged.gap_m < NEARLY_M {
            // Arriving comes first.
            let task = Task { minds_touch: false, ..*self };
            let mut other = task.ruled();
            task.better(&mut other);
            if other.1.gap_m < judged.gap_m - 1e-5 {
                (*aim, *judged) = (other.0, self.judge(&other.0));
            }
        }
    }

    /// The swivel of each arm with the least cost, all else unchanged.
    fn swivel_arms(&self, aim: &mut Aim, judged: &mut Judged) {
        let mut other = *aim;
        for side in (0..2).filter(|side| self.targets[*side].is_some()) {
            let mut best = (f64::INFINITY, aim.arms[side].swivel);
            for index in -9..=9 {
                let swivel = USUAL_SWIVEL + f64::from(index) * 0.2;
                let price = self.price_of_arm(&judged.composed, side, swivel, aim.arms[side].wrist);
                if price < best.0 {
                    best = (price, swivel);
                }
            }
            other.arms[side].swivel = best.1;
        }
        let there = self.judge(&other);
        if there.cost < judged.cost {
            (*aim, *judged) = (other, there);
        }
    }

    /// The cost of a swivel for a given posture of the rest of the body, as in [`Task::judge`].
    fn price_of_arm(&self, composed: &Composed, side: usize, swivel: f64, wrist: DVec3) -> f64 {
        let [shoulder, upper, lower, _] = ARMS[side];
        let Some(target) = self.targets[side] else { return 0.0 };
        let parent = (composed.shoulders[side], composed.pose.world[shoulder.index()]);
        let Some((one, other)) = self.frame.arm_to(side, parent, target, swivel, wrist) else { return f64::INFINITY };
        let excess = self.frame.tight.link(upper).limit.excess(one) + self.frame.tight.link(lower).limit.excess(other);
        let unease = self.frame.easy.link(upper).limit.excess(one);
        30.0 * excess + 0.3 * unease + 0.01 * (swivel - USUAL_SWIVEL) * (swivel - USUAL_SWIVEL)
    }

    /// Coordinate descent with a step size for each coordinate that shrinks if neither direction improves.
    fn search(&self, aim: &mut Aim, judged: &mut Judged) {
        let yaw = self.now.support[0].yaw_rad + aim.twist;
        let mut steps = [1.0; COORDINATES];
        let mut evaluations = 0;
        let is_done = |judged: &Judged| judged.gap_m <= EXACT_M && judged.excess_rad <= 0.0 && judged.inside_m <= 0.0;
        while evaluations < MAX_EVALUATIONS && steps.iter().any(|step: &f64| step.abs() > MIN_STEP) {
            for coordinate in 0..COORDINATES {
                if steps[coordinate].abs() <= MIN_STEP {
                    continue;
                }
                let mut better = false;
                for _ in 0..2 {
                    let Some(other) = self.changed(aim, coordinate, steps[coordinate], yaw) else {
                        steps[coordinate] = 0.0;
                        break;
                    };
                    evaluations += 1;
                    let there = self.judge(&other);
                    if there.cost < judged.cost - 1e-9 {
                        (*aim, *judged) = (other, there);
                        better = true;
                        break;
                    }
                    steps[coordinate] = -steps[coordinate];
                }
                steps[coordinate] *= if better { 1.4 } else { 0.5 };
                if is_done(judged) && evaluations >= ENOUGH_LOOKS {
                    return;
                }
            }
        }
    }

    /// An aim changed along one coordinate; `None` if that coordinate cannot change.
    fn changed(&self, aim: &Aim, coordinate: usize, by: f64, yaw: f64) -> Option<Aim> {
        let (sin, cos) = libm::sincos(yaw);
        let (across, along) = (DVec3::new(cos, 0.0, -sin), DVec3::new(sin, 0.0, cos));
        let (leg, most_twist) = (self.values().leg_m, self.values().most_twist_rad);
        let mut other = *aim;
        match coordinate {
            0 => other.twist = (aim.twist + 0.2 * by).clamp(-most_twist, most_twist),
            1 => other.swing += across * (0.2 * by),
            2 => other.swing += along * (0.2 * by),
            3 => other.squat += 0.08 * leg * by * self.style.flexibility.min(1.0),
            4 => other.lean += along * (0.03 * leg * by),
            5 => other.lean += across * (0.03 * leg * by),
            6 if self.frame.has_heels => other.tiptoe = (aim.tiptoe + 0.2 * by).max(0.0),
            7 if self.targets[0].is_some() => other.arms[0].swivel += 0.4 * by,
            8 if self.targets[1].is_some() => other.arms[1].swivel += 0.4 * by,
            _ => return None,
        }
        Some(other)
    }
}

/// Heel rise of a body on its toes, including the lean before it \[rad\], and the shares that are tried.
const MAX_TIPTOE_RAD: f64 = LEAN_FIRST_RAD + MAX_RAD;
const TIPTOES: [f64; 4] = [0.35, 0.5, 0.75, 1.0];

/// Number of steps in which the swing grows, and of bisections of the last one: to about a degree.
const SWING_STEP_RAD: f64 = 9.0 * std::f64::consts::PI / 180.0;
const SWING_HALVINGS: usize = 3;

/// Share of a gaze shift that the chest takes \[1\], up to what is looked at over the shoulder \[rad\].
const CHEST_SHARE: f64 = 1.0 / 6.0;
const LOOKS_BEHIND_RAD: f64 = 1.9;

/// A gap that may be left by what keeps arms out of the body \[m\]; larger ones are the target's.
const NEARLY_M: f64 = 0.05;

/// Below this height a hand may reach into the floor \[m\]; turns of the wrist that are tried \[rad\].
const NEAR_FLOOR_M: f64 = 0.2;
const WRISTS_RAD: [f64; 4] = [0.3, -0.3, 0.5, -0.5];

/// Shares of a manner's swivel that are tried.
const SWIVELS: [f64; 3] = [1.0, 0.5, -0.5];

/// Preferred swivel of the elbow outwards \[rad\].
pub(crate) const USUAL_SWIVEL: f64 = 0.0;

const COORDINATES: usize = 9;

/// The search ends when all steps are smaller than this share of the first ones, after this maximum number of
/// evaluations, or after fewer once the hand arrives within all limits.
const MIN_STEP: f64 = 0.012;
const MAX_EVALUATIONS: usize = 150;
const ENOUGH_LOOKS: usize = 30;
