//! Two-bone inverse kinematics of an arm or a leg, in closed form: from a point in the world to the rotations of its
//! joints.
//!
//! The elbow's flexion follows from the distance (the law of cosines), the direction of the upper bone from the target.
//! The remaining freedom is the *swivel* (swivel angle), a rotation of the whole limb about the line from its first
//! joint to the target. It stays as near to the preferred pose as the joint's limit allows, so that a limb that follows
//! a moving target does not flip, unless the range of swivels in which it is closes and another one is open.

mod aim;
mod hinge;
mod sweep;
mod swivel;
mod turned;

pub use self::turned::{TurnedLimb, solve_limb_turned};

use self::aim::{Aim, Flexed};
use self::hinge::{Hinge, Side};
use super::{Body, Node};
use glam::{DQuat, DVec3};

/// An arm or a leg.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
#[allow(missing_docs, reason = "the names say it")]
pub enum Limb {
    LeftArm,
    RightArm,
    LeftLeg,
    RightLeg,
}

/// The goal of a limb.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LimbGoal {
    /// Position of the shoulder or hip joint, world \[m\].
    pub joint: DVec3,
    /// `world_from_parent` of the limb's parent: the shoulder, or the hips.
    pub world_from_parent: DQuat,
    /// `parent_from_node` of the hand or foot, which keeps its rotation relative to the forearm or shank.
    pub end: DQuat,
    /// The effector, a point in the frame of the hand or foot \[m\].
    pub effector: DVec3,
    /// The target of the effector, world \[m\].
    pub target: DVec3,
    /// Preferred `parent_from_node` of the upper and the lower bone. The lower bone keeps this twist.
    pub near: [DQuat; 2],
}

/// The joint rotations that bring a limb to its goal.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LimbTurns {
    /// `parent_from_node` of the upper arm or leg, inside its limit.
    pub upper: DQuat,
    /// `parent_from_node` of the lower arm or leg.
    pub lower: DQuat,
    /// Remaining distance from effector to target \[m\]. Targets beyond 99 % of the reach are approached smoothly and
    /// not reached exactly.
    pub miss_m: f64,
    /// Excess over the limit of the upper bone's joint that the target would need \[rad\]: 0 if any swivel is inside
    /// the limit. The returned rotation is clamped to the limit.
    pub excess_rad: f64,
}

impl Limb {
    /// All four.
    pub const ALL: [Limb; 4] = [Limb::LeftArm, Limb::RightArm, Limb::LeftLeg, Limb::RightLeg];

    /// Position in [`Limb::ALL`].
    pub const fn index(self) -> usize {
        self as usize
    }

    /// Upper bone, lower bone, and the hand or foot.
    pub const fn nodes(self) -> [Node; 3] {
        match self {
            Limb::LeftArm => [Node::LeftUpperArm, Node::LeftLowerArm, Node::LeftHand],
            Limb::RightArm => [Node::RightUpperArm, Node::RightLowerArm, Node::RightHand],
            Limb::LeftLeg => [Node::LeftUpperLeg, Node::LeftLowerLeg, Node::LeftFoot],
            Limb::RightLeg => [Node::RightUpperLeg, Node::RightLowerLeg, Node::RightFoot],
        }
    }

    /// The limb that a node is one of the three bones of.
    pub fn of(node: Node) -> Option<Limb> {
        Limb::ALL.into_iter().find(|limb| limb.nodes().contains(&node))
    }

    /// Whether it is a leg.
    pub const fn is_leg(self) -> bool {
        matches!(self, Limb::LeftLeg | Limb::RightLeg)
    }
}

/// The joint rotations that bring a limb to its goal, with the hand or foot rotated relative to the lower bone as the
/// goal says; `None` when a number of the goal is not finite or the limb has no length.
///
/// Both rotations are inside their joints' limits. A target out of reach is approached along the line to it. One in a
/// direction outside the upper joint's limit is approached by clamping that joint's rotation to its range; the
/// remaining distance is then larger than the minimum: in the middle by 2 cm for arms and 6 cm for legs, over targets
/// all round, and by less than half a centimetre where the joint would be up to 9 degrees beyond its range.
///
/// ```
/// use glam::{DQuat, DVec3};
/// use sinew_body::humanoid::{Body, Limb, LimbGoal, Node, solve_limb};
///
/// let body = Body::standard(80.0, 1.7);
/// // The left hand's centre to a point 40 cm in front of the shoulder, from an arm that hangs.
/// let shoulder = DVec3::new(0.19, 1.4, 0.0);
/// let goal = LimbGoal {
///     joint: shoulder,
///     world_from_parent: DQuat::IDENTITY,
///     end: DQuat::IDENTITY,
///     effector: body.link(Node::LeftHand).centre,
///     target: shoulder + DVec3::new(0.0, -0.1, 0.4),
///     near: [DQuat::IDENTITY; 2],
/// };
/// let turns = solve_limb(&body, Limb::LeftArm, &goal).expect("a sound goal");
/// assert!(turns.miss_m < 1e-9 && turns.excess_rad == 0.0);
/// ```
pub fn solve_limb(body: &Body, limb: Limb, goal: &LimbGoal) -> Option<LimbTurns> {
    place(body, limb, goal, |_| Side::Bent)
}

/// As [`solve_limb`], with the elbow or knee first searched on the side `first`.
fn place(body: &Body, limb: Limb, goal: &LimbGoal, first: impl Fn(&Hinge) -> Side) -> Option<LimbTurns> {
    if !goal.is_finite() {
        return None;
    }
    let [upper, lower, end] = limb.nodes();
    let elbow = body.link(lower).offset;
    let in_lower = body.link(end).offset + goal.end * goal.effector;
    let hinge = Hinge::new(&body.link(lower).limit, limb, goal.near[1], elbow, in_lower);
    if !hinge.is_sound() {
        return None;
    }
    let limit = &body.link(upper).limit;
    let aim = Aim::new(goal, elbow, in_lower);
    let soft = hinge.softened(aim.distance);
    let met = |way: &Flexed, upper: DQuat| LimbTurns {
        upper,
        lower: way.lower,
        miss_m: (upper * way.reach - aim.line).length(),
        excess_rad: 0.0,
    };
    let fits = |way: &Flexed| swivel::nearest(&[way.upper_sweep(limit)]);
    let side = first(&hinge);
    for side in [side, side.other()] {
        let Some(way) = aim.flexed(&hinge, side, soft) else { continue };
        if limit.excess(way.straight) <= 0.0 {
            return Some(met(&way, way.straight));
        }
        if let Some(angle) = fits(&way) {
            return Some(met(&way, way.swivelled(angle)));
        }
    }
    if let Some((angle, way)) = aim.straighter(&hinge, soft, fits) {
        return Some(met(&way, way.swivelled(angle)));
    }
    let way = aim.flexed(&hinge, Side::Bent, aim.distance)?;
    let wanted = way.swivelled(swivel::least(&[(way.upper_sweep(limit), 1.0)]));
    let (upper, lower) = aim.neared(&hinge, limit, limit.clamp(wanted));
    let miss_m = (upper * (elbow + lower * in_lower) - aim.line).length();
    Some(LimbTurns { upper, lower, miss_m, excess_rad: limit.excess(wanted) })
}

impl LimbGoal {
    fn is_finite(&self) -> bool {
        self.joint.is_finite()
            && self.world_from_parent.is_finite()
            && self.end.is_finite()
            && self.effector.is_finite()
            && self.target.is_finite()
            && self.near.iter().all(|turn| turn.is_finite())
    }
}

// Integration tests and a benchmark use it too: its `sinew_body` is this crate, see `lib.rs`.
#[cfg(test)]
mod limb_random;

#[cfg(test)]
mod tests;
