//! The posture in which hands reach their targets from a stance: the paper's rules first, then a search where they do not do.

use crate::compose::{ARMS, Composed, Frame, Now};
use crate::feet::{Placement, Support};
use crate::spine::{search_twist, squat_for, swing_axis};
use crate::{Style, Values};
use glam::{DQuat, DVec3};
use sinew_body::humanoid::Node;

/// Where the trunk and the arms go.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Aim {
    pub twist: f64,
    pub swing: DVec3,
    pub squat: f64,
    pub lean: DVec3,
    pub arms: [ArmAim; 2],
}

#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct ArmAim {
    pub swivel: f64,
    pub girdle: DVec3,
}

/// How good an aim is.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Judged {
    pub composed: Composed,
    /// How far the worse hand stays from its target \[m\].
    pub gap_m: f64,
    /// How far joints are beyond the narrowed limits, summed \[rad\].
    pub excess_rad: f64,
    /// How far upper arms are beyond the range in which they are at ease \[rad\].
    unease_rad: f64,
    cost: f64,
}

/// What is to be reached, from where.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Task<'a> {
    pub frame: &'a Frame,
    pub style: &'a Style,
    /// The instant with the stance in it, trunk straight.
    pub now: Now,
    pub targets: [Option<DVec3>; 2],
}

/// A gap that counts as none \[m\].
pub(crate) const EXACT_M: f64 = 2e-4;

impl Task<'_> {
    pub fn stance(mut self, feet: &[Placement; 2], support: Support) -> Self {
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
        for side in 0..2 {
            let arm = &mut now.arms[side];
            (arm.swivel, arm.girdle) = (aim.arms[side].swivel, aim.arms[side].girdle);
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
        let elbows: f64 = aim.arms.iter().map(|arm| (arm.swivel - USUAL_SWIVEL) * (arm.swivel - USUAL_SWIVEL)).sum();
        let effort = 0.12 * aim.twist * aim.twist
            + 0.04 * aim.swing.length_squared()
            + 0.3 / (self.style.flexibility * self.style.flexibility) * (aim.squat / scale) * (aim.squat / scale)
            + 0.5 * aim.lean.length_squared() / (scale * scale)
            + 0.01 * elbows;
        let beyond = (aim.swing.length() - self.values().most_swing_rad).max(0.0)
            + (aim.squat - self.values().most_squat_m).max(0.0)
            + (-aim.squat).max(0.0);
        let cost = 40.0 * gaps / scale + 6.0 * excess_rad + 8.0 * strain + 0.3 * unease_rad + effort + 100.0 * beyond;
        Judged { composed, gap_m, excess_rad, unease_rad, cost }
    }

    /// The paper's rules: twist by search, squat by the stoop range, swing until the hand reaches.
    fn by_rule(&self) -> Aim {
        let mut aim = Aim::default();
        aim.arms.iter_mut().for_each(|arm| arm.swivel = USUAL_SWIVEL);
        let reaching: Vec<(usize, DVec3)> = (0..2).filter_map(|side| Some((side, self.targets[side]?))).collect();
        let Some(&(first, target)) = reaching.first() else { return aim };
        let yaw = self.now.support.yaw_rad;
        if let [(side, target)] = reaching[..] {
            let shoulder = |twist: f64| self.composed(&Aim { twist, ..aim }).shoulders[side];
            aim.twist = search_twist(target, yaw, side == 1, self.values(), shoulder);
        } else {
            // Both hands: the trunk faces the middle of the two.
            let middle = (reaching[0].1 + reaching[1].1) * 0.5;
            let away = middle - self.now.support.rest;
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
        aim.squat = squat_for(-d.y, self.style.flexibility, self.values());
        self.lift_girdles(&mut aim, &standing);
        let axis = swing_axis(d, yaw + aim.twist);
        let worst = |aim: &Aim| {
            let composed = self.composed(aim);
            reaching.iter().map(|(side, _)| composed.stretch[*side]).fold(0.0, f64::max)
        };
        let enough = self.values().stretch.0;
        let mut best = (worst(&aim), 0.0);
        if best.0 > enough {
            let step = 3.0_f64.to_radians();
            let most = (self.values().most_swing_rad / step) as i32;
            for sign in [1.0, -1.0] {
                // Leaning away lifts a shoulder towards what is high; nobody leans far that way.
                let most = if sign > 0.0 {
                    most
                } else if d.y > self.values().start_swing_m {
                    8
                } else {
                    0
                };
                for index in 1..=most {
                    let angle = sign * step * f64::from(index);
                    let stretch = worst(&Aim { swing: axis * angle, ..aim });
                    let less = angle.abs() < f64::abs(best.1) && stretch <= enough;
                    if (best.0 > enough && stretch < best.0) || less {
                        best = (stretch, angle);
                    }
                    if stretch <= enough || stretch > best.0 + 0.2 {
                        break;
                    }
                }
            }
        }
        aim.swing = axis * best.1;
        aim
    }

    /// The shoulder girdle goes up with a high target and forward with a far one.
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

    /// The best aim that is found.
    pub fn solve(&self) -> (Aim, Judged) {
        let mut aim = self.by_rule();
        let mut judged = self.judge(&aim);
        if judged.excess_rad > 0.0 || judged.unease_rad > 0.0 {
            self.swivel_arms(&mut aim, &mut judged);
        }
        let strained = judged
            .composed
            .stretch
            .iter()
            .zip(self.targets)
            .any(|(stretch, target)| target.is_some() && *stretch > self.values().stretch.0 + 0.005);
        if judged.gap_m > EXACT_M || judged.excess_rad > 0.0 || (strained && !self.style.print) {
            self.search(&mut aim, &mut judged);
        }
        (aim, judged)
    }

    fn swivel_arms(&self, aim: &mut Aim, judged: &mut Judged) {
        for side in 0..2 {
            if self.targets[side].is_none() {
                continue;
            }
            for index in -9..=9 {
                let mut other = *aim;
                other.arms[side].swivel = USUAL_SWIVEL + f64::from(index) * 0.2;
                let there = self.judge(&other);
                if there.cost < judged.cost {
                    (*aim, *judged) = (other, there);
                }
            }
        }
    }

    /// Goes downhill one coordinate at a time with ever smaller steps.
    fn search(&self, aim: &mut Aim, judged: &mut Judged) {
        let yaw = self.now.support.yaw_rad + aim.twist;
        let (sin, cos) = libm::sincos(yaw);
        let (across, along) = (DVec3::new(cos, 0.0, -sin), DVec3::new(sin, 0.0, cos));
        let leg = self.values().leg_m;
        let mut scale = 1.0;
        while scale > SMALLEST {
            let mut better = false;
            for coordinate in 0..COORDINATES {
                for sign in [1.0, -1.0] {
                    let by = sign * scale;
                    let mut other = *aim;
                    match coordinate {
                        0 => {
                            other.twist = (aim.twist + 0.2 * by)
                                .clamp(-self.values().most_twist_rad, self.values().most_twist_rad)
                        }
                        1 => other.swing += across * (0.2 * by),
                        2 => other.swing += along * (0.2 * by),
                        3 => other.squat += 0.08 * leg * by,
                        4 => other.lean += along * (0.03 * leg * by),
                        5 => other.lean += across * (0.03 * leg * by),
                        6 if self.targets[0].is_some() => other.arms[0].swivel += 0.4 * by,
                        7 if self.targets[1].is_some() => other.arms[1].swivel += 0.4 * by,
                        _ => continue,
                    }
                    let there = self.judge(&other);
                    if there.cost < judged.cost - 1e-9 {
                        (*aim, *judged) = (other, there);
                        better = true;
                        break;
                    }
                }
            }
            if !better {
                scale *= 0.5;
            }
        }
    }
}

/// How far out the elbow is by habit \[rad\].
pub(crate) const USUAL_SWIVEL: f64 = 0.0;

const COORDINATES: usize = 8;

/// The search ends at this share of its first steps.
const SMALLEST: f64 = 0.004;
