//! Two-bone inverse kinematics of an arm or a leg, in closed form: from a point in the world to the turns of its joints.
//!
//! The elbow's flexion follows from the distance (the law of cosines), the direction of the upper bone from the target. What is
//! left free is the *swivel*, a turn of the whole limb about the line from its first joint to the target. It stays as near as
//! the joint's limit lets it to where the limb is wanted, so that a limb which follows a moving target never flips.

use super::rotation::{exp, swing_twist};
use super::{Body, Limit, Node};
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

/// Where a limb is to end.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LimbGoal {
    /// Where the shoulder or hip joint is, world \[m\].
    pub joint: DVec3,
    /// `world_from_parent` of what the limb hangs from: the shoulder, or the hips.
    pub world_from_parent: DQuat,
    /// `parent_from_node` of the hand or foot, which keeps its turn against the forearm or shank.
    pub end: DQuat,
    /// The point that is to come to the target, in the frame of the hand or foot \[m\].
    pub effector: DVec3,
    /// Where it is to come, world \[m\].
    pub target: DVec3,
    /// `parent_from_node` of the upper and the lower bone near which the limb is to stay. The lower bone's turn about itself
    /// is kept.
    pub near: [DQuat; 2],
}

/// The turns that bring a limb to its goal.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LimbTurns {
    /// `parent_from_node` of the upper arm or leg.
    pub upper: DQuat,
    /// `parent_from_node` of the lower arm or leg.
    pub lower: DQuat,
    /// How far the effector stays from the target \[m\]. Targets beyond 99 % of the reach are approached ever more slowly.
    pub miss_m: f64,
    /// How far the upper bone's joint is beyond its limit, at the best swivel \[rad\]; 0 wherever there is one inside.
    pub excess_rad: f64,
}

/// Share of the full reach up to which the target is met exactly; from there on the limb nears its full length smoothly. A limb
/// that is followed all the way out straightens at infinite speed.
const EXACT_REACH: f64 = 0.99;

/// Swivels looked at on either side, over half a turn: every 5 degrees, then every half degree.
const COARSE: u32 = 36;
const FINE: u32 = 360;

/// What a swivel of one radian counts against excess, where no swivel is inside the limit: the limb is not thrown round for a
/// little less.
const SWIVEL_PRICE: f64 = 0.1;

/// Halvings of a 5 degree step: to 1e-13 rad.
const HALVINGS: u32 = 40;

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

/// Solves a limb of the body; `None` when a number of the goal is not finite or the limb has no length.
pub fn solve_limb(body: &Body, limb: Limb, goal: &LimbGoal) -> Option<LimbTurns> {
    let [upper, lower, end] = limb.nodes();
    let finite = goal.joint.is_finite()
        && goal.world_from_parent.is_finite()
        && goal.end.is_finite()
        && goal.effector.is_finite()
        && goal.target.is_finite()
        && goal.near.iter().all(|turn| turn.is_finite());
    if !finite {
        return None;
    }
    let elbow = body.link(lower).offset;
    let in_lower = body.link(end).offset + goal.end * goal.effector;
    let hinge = Hinge::new(&body.link(lower).limit, limb, goal.near[1], elbow, in_lower);
    let line = goal.world_from_parent.conjugate() * (goal.target - goal.joint);
    let lower_turn = hinge.at_distance(line.length())?;

    let reach = elbow + lower_turn * in_lower;
    let near = goal.near[0].normalize();
    let from = (near * reach).try_normalize()?;
    // A target in the joint itself says nothing about the direction.
    let to = line.try_normalize().unwrap_or(from);
    let straight = (DQuat::from_rotation_arc(from, to) * near).normalize();
    let (upper_turn, excess_rad) = swivelled(&body.link(upper).limit, straight, to);
    let arrived = goal.joint + goal.world_from_parent * (upper_turn * reach);
    Some(LimbTurns { upper: upper_turn, lower: lower_turn, miss_m: (arrived - goal.target).length(), excess_rad })
}

/// The elbow or knee: at which flexion the limb is how long.
struct Hinge {
    /// Turn of the lower bone about itself, before the flexion.
    twist: DQuat,
    /// Squared length = `mean` + 2 `swing` cos(flexion − `straight`).
    mean: f64,
    swing: f64,
    straight: f64,
    /// Range of the flexion about X \[rad\].
    range: (f64, f64),
    /// -1 for elbows, 1 for knees: the sign of their flexion.
    sign: f64,
}

impl Hinge {
    fn new(limit: &Limit, limb: Limb, near: DQuat, elbow: DVec3, in_lower: DVec3) -> Hinge {
        let twist = if limb.is_leg() {
            DQuat::IDENTITY
        } else {
            let (_, _, twist) = swing_twist(near.normalize());
            exp(DVec3::Y * twist.clamp(limit.twist.0, limit.twist.1))
        };
        let end = twist * in_lower;
        let (along, across) = (elbow.y * end.y + elbow.z * end.z, elbow.z * end.y - elbow.y * end.z);
        let centre = 2.0 * libm::atan2(limit.centre.x, limit.centre.w);
        Hinge {
            twist,
            mean: elbow.length_squared() + end.length_squared() + 2.0 * elbow.x * end.x,
            swing: (along * along + across * across).sqrt(),
            straight: libm::atan2(across, along),
            range: (centre - limit.swing.x_negative, centre + limit.swing.x_positive),
            sign: if limb.is_leg() { 1.0 } else { -1.0 },
        }
    }

    fn length_at(&self, flexion: f64) -> f64 {
        (self.mean + 2.0 * self.swing * libm::cos(flexion - self.straight)).max(0.0).sqrt()
    }

    /// The lower bone's turn at which the effector is so far from the limb's first joint \[m\].
    fn at_distance(&self, distance: f64) -> Option<DQuat> {
        if self.swing < 1e-9 || self.range.0 > self.range.1 {
            return None;
        }
        let longest = self.length_at(self.straight.clamp(self.range.0, self.range.1));
        let distance = soft_minimum(distance, longest);
        let cosine = (distance * distance - self.mean) / (2.0 * self.swing);
        let flexion = self.straight + self.sign * libm::acos(cosine.clamp(-1.0, 1.0));
        let flexion = flexion.clamp(self.range.0, self.range.1);
        Some((exp(DVec3::X * flexion) * self.twist).normalize())
    }
}

/// The value itself up to [`EXACT_REACH`] of the limit, then ever slower up to the limit, without a kink.
fn soft_minimum(value: f64, limit: f64) -> f64 {
    let from = EXACT_REACH * limit;
    let room = limit - from;
    if value <= from || room <= 0.0 { value.min(limit) } else { from - room * libm::expm1(-(value - from) / room) }
}

/// The turn about `line` that is smallest among those after which the limit holds, applied; where none does, the one that
/// exceeds it least, with some preference for small ones. Returns the excess \[rad\] with it.
fn swivelled(limit: &Limit, straight: DQuat, line: DVec3) -> (DQuat, f64) {
    let turned = |angle: f64| (exp(line * angle) * straight).normalize();
    let excess = |angle: f64| limit.excess(turned(angle));
    let here = excess(0.0);
    if here <= 0.0 {
        return (straight, 0.0);
    }
    let (mut best, mut least) = (0.0, here);
    for count in [COARSE, FINE] {
        let step = std::f64::consts::PI / f64::from(count);
        for index in 1..=count {
            let mut nearest: Option<f64> = None;
            for sign in [1.0, -1.0] {
                let angle = sign * step * f64::from(index);
                let there = excess(angle);
                if there <= 0.0 {
                    let edge = edge_between(angle - sign * step, angle, excess);
                    nearest = Some(nearest.map_or(edge, |other| if edge.abs() < other.abs() { edge } else { other }));
                } else if there + SWIVEL_PRICE * angle.abs() < least {
                    (best, least) = (angle, there + SWIVEL_PRICE * angle.abs());
                }
            }
            if let Some(angle) = nearest {
                return (turned(angle), 0.0);
            }
        }
    }
    let step = std::f64::consts::PI / f64::from(FINE);
    let angle = lowest_between(best - step, best + step, |angle| excess(angle) + SWIVEL_PRICE * angle.abs());
    (turned(angle), excess(angle))
}

/// The angle at the edge of the range in which there is no excess, by halving: `inside` has none.
fn edge_between(outside: f64, inside: f64, excess: impl Fn(f64) -> f64) -> f64 {
    let (mut outside, mut inside) = (outside, inside);
    for _ in 0..HALVINGS {
        let middle = 0.5 * (outside + inside);
        if excess(middle) <= 0.0 {
            inside = middle;
        } else {
            outside = middle;
        }
    }
    inside
}

/// Where a function with one valley between two angles is lowest, by thirds.
fn lowest_between(low: f64, high: f64, value: impl Fn(f64) -> f64) -> f64 {
    let (mut low, mut high) = (low, high);
    for _ in 0..2 * HALVINGS {
        let (a, b) = (low + (high - low) / 3.0, high - (high - low) / 3.0);
        if value(a) <= value(b) {
            high = b;
        } else {
            low = a;
        }
    }
    0.5 * (low + high)
}

#[cfg(test)]
#[path = "limb_tests.rs"]
mod tests;
