//! From the controls of one instant to a pose: trunk, arms and legs by closed form, the hips where the balance puts them.

use crate::frame::Frame;
use crate::head::{gaze_rotation, shared};
use crate::heel::{Heel, raised};
use crate::leg_place::Foot;
use crate::spine::{root_shift, swing_shares, twist_shares};
use crate::weight::Support;
use glam::{DQuat, DVec3};
use sinew_body::humanoid::{Node, Pose, exp};

/// Nodes of the arms: shoulder, upper arm, lower arm, hand; left, right.
pub(crate) const ARMS: [[Node; 4]; 2] = [
    [Node::LeftShoulder, Node::LeftUpperArm, Node::LeftLowerArm, Node::LeftHand],
    [Node::RightShoulder, Node::RightUpperArm, Node::RightLowerArm, Node::RightHand],
];

/// An arm at an instant.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct ArmNow {
    /// 0 carried, 1 at the target.
    pub share: f64,
    /// Target of the hand \[m\].
    pub target: DVec3,
    /// Sideways bow of the path at its middle \[m\].
    pub bow: DVec3,
    /// Swivel of the arm about the line from shoulder to hand \[rad\], relative to the default one, at the target.
    pub swivel: f64,
    /// Twist of the forearm at the target \[rad\].
    pub pronation: f64,
    /// Lift and forward turn of the shoulder girdle \[rad\].
    pub girdle: DVec3,
    /// `parent_from_node` of shoulder, upper arm, lower arm, hand while the arm is carried.
    pub carried: [DQuat; 4],
    /// Turn of the hand against the forearm at the target \[rad\].
    pub wrist: DVec3,
    /// How far the carried upper arm is held away from the body \[rad\].
    pub clear: f64,
    /// Blend from a path of the hand's position to joint interpolation \[1\], and upper and lower arm at its end.
    pub by_joints: f64,
    pub end: [DQuat; 2],
}

/// All controls at an instant.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Now {
    /// Feet flat on the floor or in the air, before heels rise.
    pub feet: [Foot; 2],
    pub foot_yaw: [f64; 2],
    pub knee_turn: [f64; 2],
    /// Decaying rest of the initial pose: turns of upper and lower leg about their own bones.
    pub leg_turn: [[f64; 2]; 2],
    /// Support of flat feet, and of feet on their toes.
    pub support: [Support; 2],
    pub twist: f64,
    pub swing: DVec3,
    pub squat: f64,
    /// Heel rise of a body on its toes, including the lean before it \[rad\].
    pub tiptoe: f64,
    /// How far the weight is over the toes \[1\]; `None` in plans, where heels and tiptoe say it.
    pub onto_toes: Option<f64>,
    /// Share of the legs' reserve that is kept \[1\]: its square is how far the stretched leg stays below its full length.
    pub reserve: f64,
    /// How far the body is carried by its own motion, in a walk \[1\], and the rise of each heel in it \[rad\].
    pub walks: f64,
    pub heel_off: [f64; 2],
    /// Blend of the heel rise that ankle flexion requires \[1\]: 0 in the initial pose of a reach.
    pub heels: f64,
    /// Decaying rest of the initial pose: hips' shift and rotation, then chest, neck, head.
    pub hips_shift: DVec3,
    pub hips_turn: DVec3,
    pub trunk: [DVec3; 3],
    /// What the head faces, in plans; `None` when `head` says how it is turned.
    pub look_at: Option<DVec3>,
    /// Turn of the head relative to the chest.
    pub head: DVec3,
    pub arms: [ArmNow; 2],
    /// Offset of the root ahead of the balance \[m\].
    pub lean: DVec3,
}

/// A pose and by-products of its computation.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Composed {
    pub pose: Pose,
    /// Centre of either hand \[m\].
    pub hands: [DVec3; 2],
    /// Distance from the shoulder joint to the hand's target \[1 of the arm's length\].
    pub stretch: [f64; 2],
    /// How far the weight is over the toes \[1\].
    pub onto_toes: f64,
    /// Shoulder joints \[m\].
    pub shoulders: [DVec3; 2],
}

/// Iterations that place hips and heels under the centre of mass; each leaves less than a tenth of the error.
const ROUNDS: usize = 4;

/// The hips move more than the centre of mass: the feet stay.
const GAIN: f64 = 1.18;

/// Distance from the middle up to which the centre of mass is not corrected \[1 of the support's radius\], and its
/// maximum.
const FREE: f64 = 0.35;
const MAX_OFFSET: f64 = 0.72;

impl Frame {
    /// The pose of an instant.
    pub fn compose(&self, now: &Now) -> Composed {
        let yaw = now.support[0].yaw_rad;
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
        // Positions of the trunk's joints relative to the hips.
        let offset = |node: Node| self.body.link(node).offset;
        let chest_at = hips * offset(Node::Chest);
        let neck_at = chest_at + chest * offset(Node::Neck);
        let mut hips_at = self.led_hips(now);
        let mut composed =
            Composed { pose, hands: [DVec3::ZERO; 2], stretch: [0.0; 2], onto_toes: 0.0, shoulders: [DVec3::ZERO; 2] };
        let mut arms = now.arms;
        for (side, arm) in arms.iter_mut().enumerate() {
            arm.carried[1] = (self.hang(side, arm, chest, now.swing) * arm.carried[1]).normalize();
        }
        let carried = [0, 1].map(|side| self.carried(side, &arms[side]).unwrap_or_default());
        let flat = Heel::of(0.0, 0.0, now.tiptoe);
        let mut heels = now.heel_off.map(|off| if self.has_heels { flat.and(off) } else { Heel::default() });
        let mut led = None;
        for round in 0..ROUNDS {
            let feet = [0, 1].map(|side| raised(now.feet[side], self.toes[side], heels[side].pitch_rad));
            hips_at.y = self.hips_height(now, &feet, hips, hips_at);
            composed.pose.hips_position = hips_at;
            // Head and arms move rigidly with the trunk between iterations: the error of the centre of mass is a
            // millimetre or two.
            if round == 0 || round + 1 == ROUNDS {
                let faced = |at: DVec3| gaze_rotation(chest.conjugate() * (at - hips_at - neck_at));
                let (neck, head) = shared(now.look_at.map_or(now.head, faced));
                let neck = chest * (neck * exp(now.trunk[1]));
                composed.pose.world[Node::Neck.index()] = neck.normalize();
                composed.pose.world[Node::Head.index()] = (neck * (head * exp(now.trunk[2]))).normalize();
                for side in 0..2 {
                    self.place_arm(side, &arms[side], &carried[side], (hips_at + chest_at, chest), &mut composed);
                }
            }
            for side in 0..2 {
                self.place_leg(side, now, feet[side], (hips_at, hips), &mut composed.pose);
            }
            if round + 1 < ROUNDS {
                if self.has_heels {
                    heels = [0, 1].map(|side| self.heel(side, now, (hips_at, hips)));
                }
                // The centre of mass of the hips before balance, pulled into the support.
                let centre = self.body.centre_of_mass(&composed.pose);
                let led = *led.get_or_insert(centre);
                composed.onto_toes = now.onto_toes.unwrap_or(0.5 * (heels[0].forward + heels[1].forward));
                let held = over_support(now, led, composed.onto_toes);
                let miss = held + (led - held) * now.walks - centre;
                hips_at += DVec3::new(miss.x, 0.0, miss.z) * GAIN;
            }
        }
        composed
    }

    /// Approximate position of a shoulder joint at an instant, before balance \[m\].
    pub fn led_shoulder(&self, side: usize, now: &Now) -> DVec3 {
        let yaw = now.support[0].yaw_rad;
        let [hips_twist, ..] = twist_shares(now.twist);
        let [hips_swing, ..] = swing_shares(now.swing, self.values.hips_share_of_swing);
        let hips = exp(hips_swing) * DQuat::from_rotation_y(yaw + hips_twist);
        let chest = exp(now.swing) * DQuat::from_rotation_y(yaw + now.twist);
        let [shoulder, upper, ..] = ARMS[side];
        let mut hips_at = self.led_hips(now);
        hips_at.y = self.hips_height(now, &now.feet, hips, hips_at);
        let girdle = chest * now.arms[side].carried[0] * exp(now.arms[side].girdle);
        hips_at
            + hips * self.body.link(Node::Chest).offset
            + chest * self.body.link(shoulder).offset
            + girdle * self.body.link(upper).offset
    }

    /// Position of the hips by the step, EQ8 and the lean, before balance.
    fn led_hips(&self, now: &Now) -> DVec3 {
        let turn = DQuat::from_rotation_y(now.support[0].yaw_rad);
        now.support[0].rest - turn * self.rest_com + root_shift(now.swing, &self.values) + now.lean + now.hips_shift
    }
}

/// Soft clamp of a centre of mass to the support: unchanged near the middle, pulled in farther out; over the toes as
/// far as the weight goes forward.
fn over_support(now: &Now, led: DVec3, forward: f64) -> DVec3 {
    let [flat, toes] = &now.support;
    let out = DVec3::new(led.x - flat.centre.x, 0.0, led.z - flat.centre.z);
    // The rest of the initial shift is excluded from balance: a walking body is not balanced.
    let start = DVec3::new(now.hips_shift.x, 0.0, now.hips_shift.z);
    let out = out - start;
    let length = out.length();
    let radius = flat.radius_m + (toes.radius_m - flat.radius_m) * forward;
    // On the toes the support is smaller.
    let radius = radius * (1.0 - 0.5 * forward);
    let (free, max) = (FREE * radius, MAX_OFFSET * radius);
    let held = if length <= free { length } else { free + (max - free) * libm::tanh((length - free) / (max - free)) };
    let scale = if length > 1e-12 { held / length } else { 1.0 };
    flat.centre + (toes.centre - flat.centre) * forward + out * scale + start
}
