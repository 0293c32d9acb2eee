//! From the controls of one instant to a pose: trunk, arms and legs by closed form, the hips where the balance puts them.

use crate::feet::Support;
use crate::head::{look, soft};
use crate::spine::{root_shift, swing_shares, twist_shares, wrapped};
use crate::{Style, Values};
use glam::{DQuat, DVec3};
use sinew_body::humanoid::{Body, Limb, LimbGoal, Limit, Node, Pose, Sole, exp, log, solve_limb, swing_twist};

/// Nodes of the arms: shoulder, upper arm, lower arm, hand; left, right.
pub(crate) const ARMS: [[Node; 4]; 2] = [
    [Node::LeftShoulder, Node::LeftUpperArm, Node::LeftLowerArm, Node::LeftHand],
    [Node::RightShoulder, Node::RightUpperArm, Node::RightLowerArm, Node::RightHand],
];
const ARM_LIMBS: [Limb; 2] = [Limb::LeftArm, Limb::RightArm];
const LEG_LIMBS: [Limb; 2] = [Limb::LeftLeg, Limb::RightLeg];

/// An arm at an instant.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct ArmNow {
    /// 0 carried along, 1 at the target.
    pub share: f64,
    /// Where the hand is to come \[m\].
    pub target: DVec3,
    /// How far the way is bowed aside in its middle \[m\].
    pub bow: DVec3,
    /// Turn of the arm about the line from shoulder to hand \[rad\], from the usual one, at the target.
    pub swivel: f64,
    /// Turn of the forearm about itself at the target \[rad\].
    pub pronation: f64,
    /// Lift and forward turn of the shoulder girdle \[rad\].
    pub girdle: DVec3,
    /// `parent_from_node` of shoulder, upper arm, lower arm, hand where the arm is carried.
    pub carried: [DQuat; 4],
}

/// The carried arm in the terms of the reaching one.
#[derive(Clone, Copy, Debug, Default)]
struct Carried {
    swivel: f64,
    pronation: f64,
    /// What the usual arm misses of it: rotation vectors of upper and lower arm.
    missing: [DVec3; 2],
}

/// All controls at an instant.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Now {
    pub feet: [(DVec3, DQuat); 2],
    pub foot_yaw: [f64; 2],
    pub knee_turn: [f64; 2],
    pub support: Support,
    pub twist: f64,
    pub swing: DVec3,
    pub squat: f64,
    /// Left over from the start: hips' shift and turn, then chest, neck, head.
    pub hips_shift: DVec3,
    pub hips_turn: DVec3,
    pub trunk: [DVec3; 3],
    pub look_at: DVec3,
    pub look: f64,
    pub arms: [ArmNow; 2],
    /// Where the root is led ahead of the balance \[m\].
    pub lean: DVec3,
}

/// A body with what composing needs to know about it.
#[derive(Clone, Debug)]
pub(crate) struct Frame {
    pub body: Body,
    /// The same without limits where a swivel is chosen here.
    free: Body,
    pub values: Values,
    /// Hips over the ankles, standing easily \[m\].
    pub stand_m: f64,
    /// From the ankles' middle to the hips over the ground, standing \[m\].
    rest_com: DVec3,
    pub effector: [DVec3; 2],
    folded_m: f64,
    /// Ankle over the sole \[m\].
    pub ankle_m: f64,
    /// The body with limits a little narrower, for plans.
    pub tight: Body,
    /// Limits within which joints are at ease.
    pub easy: Body,
}

/// A pose and what was found on the way.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Composed {
    pub pose: Pose,
    /// Centre of mass \[m\].
    pub centre: DVec3,
    /// Centre of either hand \[m\].
    pub hands: [DVec3; 2],
    /// Distance from the shoulder joint to where the hand should be \[1 of the arm's length\].
    pub stretch: [f64; 2],
    /// Shoulder joints \[m\].
    pub shoulders: [DVec3; 2],
}

/// Share of a leg's length at which it counts as stretched, and how softly that is met \[m\].
const STRETCHED: f64 = 0.997;
const SOFT_M: f64 = 0.003;

/// How far carried arms keep hanging as the trunk bends \[1\].
const HANGS: f64 = 0.75;

/// How far they come forward at most, and less than half so far aside: the shoulder's range \[rad\].
const MOST_HANG_RAD: f64 = 1.1;

/// Rounds in which the hips find their place under the centre of mass; each leaves about a tenth of the error.
const ROUNDS: usize = 5;

/// Where the centre of mass is let go without correction \[1 of the support's radius\], and how far it may be pushed out.
const FREE: f64 = 0.35;
const MOST: f64 = 0.72;

impl Frame {
    pub fn new(body: &Body, style: &Style) -> Frame {
        let mut free = body.clone();
        for limb in Limb::ALL {
            free.link_mut(limb.nodes()[0]).limit = Limit::NONE;
        }
        let values = Values::of(body, style);
        let rest = Pose::STANDING;
        let at = rest.positions(body);
        let ankles = (at[Node::LeftFoot.index()] + at[Node::RightFoot.index()]) * 0.5;
        let centre = body.centre_of_mass(&rest);
        let upper = body.link(Node::RightLowerArm).offset.length();
        let lower = values.arm_m - upper;
        let limit = &body.link(Node::RightLowerArm).limit;
        let most = (2.0 * libm::atan2(limit.centre.x, limit.centre.w) - limit.swing.x_negative).clamp(-2.7, 0.0);
        let folded = upper * upper + lower * lower + 2.0 * upper * lower * libm::cos(most);
        Frame {
            free,
            values,
            stand_m: -ankles.y - (1.0 - STRETCHED) * values.leg_m - SOFT_M,
            rest_com: DVec3::new(centre.x, 0.0, centre.z),
            effector: ARMS.map(|arm| body.link(arm[3]).centre),
            folded_m: folded.max(0.0).sqrt(),
            ankle_m: Sole::of(body, Node::LeftFoot).ankle_m,
            tight: tightened(body, 1.0, SPARE_RAD),
            easy: tightened(body, EASY, 0.0),
            body: body.clone(),
        }
    }

    /// The arm from straight ahead: C, from which its usual turn follows for every direction.
    fn usual(side: usize) -> DQuat {
        let outward = if side == 0 { 0.3 } else { -0.3 };
        DQuat::from_rotation_arc(-DVec3::Y, DVec3::new(outward, -0.35, 0.85).normalize())
    }

    /// Upper and lower arm for a hand at a point, by the usual turn and a swivel.
    pub fn arm(
        &self,
        side: usize,
        parent: (DVec3, DQuat),
        target: DVec3,
        hand: DQuat,
        swivel: f64,
        pronation: f64,
    ) -> Option<(DQuat, DQuat)> {
        let goal = LimbGoal {
            joint: parent.0,
            world_from_parent: parent.1,
            end: hand,
            effector: self.effector[side],
            target,
            near: [Frame::usual(side), exp(DVec3::X * -0.3) * exp(DVec3::Y * pronation)],
        };
        let turns = solve_limb(&self.free, ARM_LIMBS[side], &goal)?;
        let line = (parent.1.conjugate() * (target - parent.0)).try_normalize()?;
        Some(((exp(line * swivel) * turns.upper).normalize(), turns.lower))
    }

    /// How far the hand may be from the shoulder for a wanted distance \[m\]: not so far that the arm snaps straight, not so near
    /// that it cannot fold.
    fn within_reach(&self, distance: f64) -> f64 {
        let arm = self.values.arm_m;
        let (far, most) = (self.values.stretch.1 * arm, 0.988 * arm);
        let (near, least) = (1.2 * self.folded_m, 1.03 * self.folded_m);
        if distance > far {
            far + (most - far) * libm::tanh((distance - far) / (most - far))
        } else if distance < near {
            near - (near - least) * libm::tanh((near - distance) / (near - least))
        } else {
            distance
        }
    }

    /// Distances \[1 of the arm's length\] between which a hand arrives exactly.
    pub fn exact_stretch(&self) -> (f64, f64) {
        (1.2 * self.folded_m / self.values.arm_m, self.values.stretch.1)
    }

    /// The pose of an instant.
    pub fn compose(&self, now: &Now) -> Composed {
        let yaw = now.support.yaw_rad;
        let twists = twist_shares(now.twist);
        let swings = swing_shares(now.swing, self.values.hips_share_of_swing);
        let plain = exp(swings[0]) * DQuat::from_rotation_y(yaw + twists[0]);
        let chest = exp(now.swing) * DQuat::from_rotation_y(yaw + now.twist);
        let mut pose = Pose::STANDING;
        let mut set = |node: Node, world: DQuat| pose.world[node.index()] = world.normalize();
        let hips = exp(now.hips_turn) * plain;
        let chest = hips * (plain.conjugate() * chest * exp(now.trunk[0]));
        set(Node::Hips, hips);
        set(Node::Chest, chest);
        // Where the trunk's joints are from the hips.
        let offset = |node: Node| self.body.link(node).offset;
        let chest_at = hips * offset(Node::Chest);
        let neck_at = chest_at + chest * offset(Node::Neck);
        let mut hips_at = self.led_hips(now);
        let mut composed = Composed {
            pose,
            centre: DVec3::ZERO,
            hands: [DVec3::ZERO; 2],
            stretch: [0.0; 2],
            shoulders: [DVec3::ZERO; 2],
        };
        let mut arms = now.arms;
        for arm in &mut arms {
            // Carried arms hang down as the trunk bends, most of the way.
            let girdle = chest * arm.carried[0] * exp(arm.girdle);
            let hang = girdle.conjugate() * now.swing * -HANGS;
            let hang = DVec3::new(soft(hang.x, MOST_HANG_RAD), 0.0, soft(hang.z, 0.4 * MOST_HANG_RAD));
            arm.carried[1] = (exp(hang) * arm.carried[1]).normalize();
        }
        let carried = [0, 1].map(|side| self.carried(side, &arms[side]).unwrap_or_default());
        let mut goal = None;
        for round in 0..ROUNDS {
            hips_at.y = self.hips_height(now, hips, hips_at);
            composed.pose.hips_position = hips_at;
            let eye = chest.conjugate() * (now.look_at - hips_at - neck_at);
            let (neck, head) = look(eye, now.look);
            let neck = chest * (neck * exp(now.trunk[1]));
            composed.pose.world[Node::Neck.index()] = neck.normalize();
            composed.pose.world[Node::Head.index()] = (neck * (head * exp(now.trunk[2]))).normalize();
            for side in 0..2 {
                self.place_arm(side, &arms[side], &carried[side], (hips_at + chest_at, chest), &mut composed);
                self.place_leg(side, now, (hips_at, hips), &mut composed.pose);
            }
            composed.centre = self.body.centre_of_mass(&composed.pose);
            // Where the led hips would have it, pulled into the support; once, from the first round.
            let wanted = *goal.get_or_insert_with(|| self.over_support(now, composed.centre));
            let miss = wanted - composed.centre;
            if round + 1 < ROUNDS {
                hips_at += DVec3::new(miss.x, 0.0, miss.z) * GAIN;
            }
        }
        composed
    }

    /// The hips led by the step, EQ8 and the lean, before any balance.
    fn led_hips(&self, now: &Now) -> DVec3 {
        let turn = DQuat::from_rotation_y(now.support.yaw_rad);
        now.support.rest - turn * self.rest_com + root_shift(now.swing, &self.values) + now.lean + now.hips_shift
    }

    /// Where a centre of mass may be: itself near the middle of the support, pulled in farther out.
    fn over_support(&self, now: &Now, centre: DVec3) -> DVec3 {
        let out = DVec3::new(centre.x - now.support.centre.x, 0.0, centre.z - now.support.centre.z);
        // What is left of the start's shift is not the balance's business: a walking body is not balanced.
        let start = DVec3::new(now.hips_shift.x, 0.0, now.hips_shift.z);
        let out = out - start;
        let length = out.length();
        let (free, most) = (FREE * now.support.radius_m, MOST * now.support.radius_m);
        let held =
            if length <= free { length } else { free + (most - free) * libm::tanh((length - free) / (most - free)) };
        let scale = if length > 1e-12 { held / length } else { 1.0 };
        now.support.centre + out * scale + start
    }

    /// As high as wanted, as low as the legs need \[m\].
    fn hips_height(&self, now: &Now, hips: DQuat, hips_at: DVec3) -> f64 {
        let wanted = now.support.centre.y + self.ankle_m + self.stand_m - now.squat + now.hips_shift.y;
        let longest = STRETCHED * self.values.leg_m;
        let mut sum = 0.0;
        let least = [0, 1].map(|side| {
            let joint = hips * self.body.link(LEG_LIMBS[side].nodes()[0]).offset;
            let ankle = now.feet[side].0;
            let away = DVec3::new(hips_at.x + joint.x - ankle.x, 0.0, hips_at.z + joint.z - ankle.z).length_squared();
            ankle.y + (longest * longest - away).max(0.01 * longest * longest).sqrt() - joint.y
        });
        let lowest = wanted.min(least[0]).min(least[1]);
        for value in [wanted, least[0], least[1]] {
            sum += libm::exp(-(value - lowest) / SOFT_M);
        }
        lowest - SOFT_M * libm::log(sum)
    }

    /// The carried arm as the closed form would have it, with what that misses.
    fn carried(&self, side: usize, arm: &ArmNow) -> Option<Carried> {
        if arm.share <= 0.0 {
            return None;
        }
        let [_, upper_turn, lower_turn, hand_turn] = arm.carried;
        let lower = upper_turn * lower_turn;
        let wrist = upper_turn * self.body.link(ARMS[side][2]).offset + lower * self.body.link(ARMS[side][3]).offset;
        let at = wrist + lower * hand_turn * self.effector[side];
        let distance = at.length().max(1e-9);
        let at = at * (self.within_reach(distance) / distance);
        let pronation = swing_twist(lower_turn).2;
        let (usual, bent) = self.arm(side, (DVec3::ZERO, DQuat::IDENTITY), at, hand_turn, 0.0, pronation)?;
        let line = at.try_normalize()?;
        let turn = upper_turn * usual.conjugate();
        let swivel = wrapped(2.0 * libm::atan2(DVec3::new(turn.x, turn.y, turn.z).dot(line), turn.w));
        let turned = exp(line * swivel) * usual;
        let missing = [log(turned.conjugate() * upper_turn), log(bent.conjugate() * lower_turn)];
        Some(Carried { swivel, pronation, missing })
    }

    fn place_arm(&self, side: usize, arm: &ArmNow, start: &Carried, chest: (DVec3, DQuat), composed: &mut Composed) {
        let [shoulder, upper, lower, hand] = ARMS[side];
        let mut set = |node: Node, world: DQuat| composed.pose.world[node.index()] = world.normalize();
        let girdle = chest.1 * (arm.carried[0] * exp(arm.girdle));
        let joint = chest.0 + chest.1 * self.body.link(shoulder).offset + girdle * self.body.link(upper).offset;
        let reach_upper = girdle * arm.carried[1];
        let reach_lower = reach_upper * arm.carried[2];
        let wrist = joint + reach_upper * self.body.link(lower).offset + reach_lower * self.body.link(hand).offset;
        let carried = wrist + reach_lower * arm.carried[3] * self.effector[side];
        set(shoulder, girdle);
        composed.shoulders[side] = joint;
        composed.stretch[side] = (arm.target - joint).length() / self.values.arm_m;
        if arm.share > 0.0 {
            let s = arm.share;
            let bowed = 4.0 * s * (1.0 - s);
            let wanted = carried + (arm.target - carried) * s + arm.bow * bowed;
            let line = wanted - joint;
            let distance = line.length().max(1e-9);
            let wanted = joint + line * (self.within_reach(distance) / distance);
            let turn = between(arm.carried[3], DQuat::IDENTITY, s);
            let swivel = start.swivel + wrapped(arm.swivel - start.swivel) * s;
            let pronation = start.pronation + (arm.pronation - start.pronation) * s;
            if let Some((one, other)) = self.arm(side, (joint, girdle), wanted, turn, swivel, pronation) {
                let left = (1.0 - s) * (1.0 - s) * (1.0 - s);
                let one = girdle * (one * exp(start.missing[0] * left));
                let other = one * (other * exp(start.missing[1] * left));
                set(upper, one);
                set(lower, other);
                set(hand, other * turn);
                let wrist = joint + one * self.body.link(lower).offset + other * self.body.link(hand).offset;
                composed.hands[side] = wrist + other * turn * self.effector[side];
                return;
            }
        }
        set(upper, reach_upper);
        set(lower, reach_lower);
        set(hand, reach_lower * arm.carried[3]);
        composed.hands[side] = carried;
    }

    /// A leg by the law of cosines, its knee over the toes. Unlike an arm it is met up to its full length: the hips keep within it.
    fn place_leg(&self, side: usize, now: &Now, hips: (DVec3, DQuat), pose: &mut Pose) {
        let [upper, lower, foot] = LEG_LIMBS[side].nodes();
        let (ankle, sole) = now.feet[side];
        pose.world[foot.index()] = sole;
        let joint = hips.0 + hips.1 * self.body.link(upper).offset;
        let (thigh, shank) = (self.body.link(lower).offset, self.body.link(foot).offset);
        let (thigh_m, shank_m) = (thigh.length(), shank.length());
        let way = ankle - joint;
        let (yaw_sin, yaw_cos) = libm::sincos(now.foot_yaw[side] + now.knee_turn[side]);
        let left = DVec3::new(yaw_cos, 0.0, -yaw_sin);
        let length = way.length().clamp((thigh_m - shank_m).abs() + 1e-6, thigh_m + shank_m);
        let Some(line) = way.try_normalize() else { return };
        let Some(hinge) = (left - line * left.dot(line)).try_normalize() else { return };
        let cosine = (thigh_m * thigh_m + length * length - shank_m * shank_m) / (2.0 * thigh_m * length);
        // The knee goes to the front of the line: about the hinge, which points left.
        let knee = exp(hinge * -libm::acos(cosine.clamp(-1.0, 1.0))) * line * thigh_m;
        pose.world[upper.index()] = along(knee, hinge) * along(thigh, DVec3::X).conjugate();
        pose.world[lower.index()] = along(line * length - knee, hinge) * along(shank, DVec3::X).conjugate();
    }
}

/// The frame of a bone: its −Y along it, its X as near to the hinge as that allows.
fn along(bone: DVec3, hinge: DVec3) -> DQuat {
    let y = -bone.normalize_or(-DVec3::Y);
    let x = (hinge - y * hinge.dot(y)).normalize_or(DVec3::X);
    DQuat::from_mat3(&glam::DMat3::from_cols(x, y, x.cross(y))).normalize()
}

/// Limits that a plan keeps are narrower than the body's by this \[rad\], so that what happens on the way has room.
const SPARE_RAD: f64 = 0.03;

/// Share of its range in which a joint is at ease \[1\].
const EASY: f64 = 0.8;

fn tightened(body: &Body, share: f64, spare_rad: f64) -> Body {
    let mut tight = body.clone();
    for node in Node::ALL {
        let limit = &mut tight.link_mut(node).limit;
        for axis in [
            &mut limit.swing.x_negative,
            &mut limit.swing.x_positive,
            &mut limit.swing.z_negative,
            &mut limit.swing.z_positive,
        ] {
            *axis = (share * *axis - spare_rad).max(0.5 * *axis);
        }
        limit.twist = (share * limit.twist.0 + spare_rad, share * limit.twist.1 - spare_rad);
    }
    tight
}

/// The hips move more than the centre of mass: the feet stay.
const GAIN: f64 = 1.25;

/// From one rotation to another, the short way.
pub(crate) fn between(from: DQuat, to: DQuat, share: f64) -> DQuat {
    (from * exp(log(from.conjugate() * to) * share)).normalize()
}
