//! A body with precomputed constants for composing poses.

use crate::compose::ARMS;
use crate::{Style, Values};
use glam::{DQuat, DVec3};
use sinew_body::humanoid::{Body, Limb, Limit, Node, Pose, Sole};

/// A body with precomputed constants for composing poses.
#[derive(Clone, Debug)]
pub(crate) struct Frame {
    pub body: Body,
    /// The same without limits, for limbs whose swivel is chosen here.
    pub free: Body,
    pub values: Values,
    /// Height of the hips above the ankles, standing straight \[m\].
    pub straight_m: f64,
    /// From the ankles' middle to the hips over the ground, standing \[m\].
    pub rest_com: DVec3,
    pub effector: [DVec3; 2],
    /// The arm straight ahead, which defines its default rotation for every direction.
    pub usual: [DQuat; 2],
    /// Distance from shoulder to hand of the folded arm \[m\].
    pub folded_m: f64,
    /// Maximum height of a hand above the floor, on the toes, shoulder lifted, arm straight up, with a small margin
    /// \[m\].
    pub highest_m: f64,
    /// Ankle over the sole \[m\].
    pub ankle_m: f64,
    /// The axis about which feet rise on their toes, in their frames \[m\].
    pub toes: [DVec3; 2],
    /// Whether heels rise; not under `print`.
    pub has_heels: bool,
    /// The body with slightly narrower limits, for plans.
    pub tight: Body,
    /// Comfortable joint limits.
    pub easy: Body,
}

/// Share of a leg's length at which it counts as stretched, and the width of the soft clamp \[m\].
pub(crate) const STRETCHED: f64 = 0.997;
pub(crate) const SOFT_M: f64 = 0.003;

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
        let toes = [Node::LeftFoot, Node::RightFoot].map(|foot| Sole::of(body, foot).toe());
        let offset = |node: Node| body.link(node).offset;
        let shoulder =
            offset(Node::Chest).y + offset(Node::RightShoulder).y + 0.45 * offset(Node::RightUpperArm).length();
        let highest_m = 0.6 * toes[1].z - ankles.y + Sole::of(body, Node::RightFoot).ankle_m + shoulder + values.arm_m;
        Frame {
            free,
            highest_m,
            values,
            straight_m: -ankles.y,
            rest_com: DVec3::new(centre.x, 0.0, centre.z),
            effector: ARMS.map(|arm| body.link(arm[3]).centre),
            usual: [0.3, -0.3]
                .map(|outward| DQuat::from_rotation_arc(-DVec3::Y, DVec3::new(outward, -0.35, 0.85).normalize())),
            folded_m: folded.max(0.0).sqrt(),
            ankle_m: Sole::of(body, Node::LeftFoot).ankle_m,
            toes,
            has_heels: !style.print,
            tight: tightened(body, 1.0, SPARE_RAD),
            easy: tightened(body, EASY, 0.0),
            body: body.clone(),
        }
    }
}

/// Margin by which the limits of a plan are narrower than the body's \[rad\], as reserve for the motion.
const SPARE_RAD: f64 = 0.045;

/// Share of its range in which a joint is comfortable \[1\].
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
