//! Arms that pass through the body or the floor.

use crate::humanoid::{Body, Node, Pose};
use glam::DVec3;

/// Stature for which radii are stated \[m\].
const STATURE_M: f64 = 1.7;

/// Radii of the capsules \[m\] at [`STATURE_M`].
const TRUNK_M: f64 = 0.12;
const HEAD_M: f64 = 0.09;
const FOREARM_M: f64 = 0.035;
const THIGH_M: f64 = 0.075;

/// How deep forearm and hand of an arm are in other things \[m\], negative where they are clear of it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Overlaps {
    /// In the trunk: a capsule of 12 cm radius from the hips' joint to 12 cm below the neck's.
    pub trunk_m: f64,
    /// In the head: 9 cm about the line from the head's joint to its end.
    pub head_m: f64,
    /// In the nearer thigh: 7.5 cm about the line from hip to knee.
    pub thighs_m: f64,
    /// Under the floor.
    pub floor_m: f64,
}

impl Overlaps {
    /// The deepest of them that a pose adds to what its input has \[m\]; 0 where it adds none.
    ///
    /// ```
    /// use sinew_body::measure::Overlaps;
    /// let input = Overlaps { trunk_m: 0.02, head_m: -0.3, thighs_m: -0.2, floor_m: -0.5 };
    /// let ours = Overlaps { trunk_m: 0.05, head_m: 0.01, ..input };
    /// assert!((ours.beyond(&input) - 0.03).abs() < 1e-12);
    /// ```
    pub fn beyond(&self, input: &Overlaps) -> f64 {
        let added = |ours: f64, input: f64| ours.max(0.0) - input.max(0.0);
        added(self.trunk_m, input.trunk_m)
            .max(added(self.head_m, input.head_m))
            .max(added(self.thighs_m, input.thighs_m))
            .max(added(self.floor_m, input.floor_m))
            .max(0.0)
    }
}

/// The overlaps of the left and the right forearm and hand, a capsule of 3.5 cm radius from elbow to fingertips, with the rest
/// of the body and with a floor at `floor_m` \[m\]. Radii are for a stature of 1.7 m.
pub fn overlaps(body: &Body, pose: &Pose, floor_m: f64) -> [Overlaps; 2] {
    let scale = body.stature_m() / STATURE_M;
    let joints = pose.positions(body);
    let at = |node: Node| joints[node.index()];
    let end = |node: Node| at(node) + pose.world[node.index()] * body.link(node).tip;
    let neck = at(Node::Neck);
    let below = (at(Node::Hips) - neck).normalize_or_zero() * (TRUNK_M * scale);
    let trunk = ([at(Node::Hips), neck + below], TRUNK_M);
    let head = ([at(Node::Head), end(Node::Head)], HEAD_M);
    let thighs = [[Node::LeftUpperLeg, Node::LeftLowerLeg], [Node::RightUpperLeg, Node::RightLowerLeg]]
        .map(|ends| (ends.map(at), THIGH_M));
    [(Node::LeftLowerArm, Node::LeftHand), (Node::RightLowerArm, Node::RightHand)].map(|(lower, hand)| {
        let bones = [[at(lower), at(hand)], [at(hand), end(hand)]];
        let depth = |(line, radius): ([DVec3; 2], f64)| {
            let nearest = bones.iter().map(|&bone| distance(bone, line)).fold(f64::INFINITY, f64::min);
            (radius + FOREARM_M) * scale - nearest
        };
        let lowest = bones.iter().flatten().map(|point| point.y).fold(f64::INFINITY, f64::min);
        Overlaps {
            trunk_m: depth(trunk),
            head_m: depth(head),
            thighs_m: thighs.map(depth).into_iter().fold(f64::NEG_INFINITY, f64::max),
            floor_m: floor_m - (lowest - FOREARM_M * scale),
        }
    })
}

/// Distance between the hands' middles \[m\].
pub fn hands_apart_m(body: &Body, pose: &Pose) -> f64 {
    let joints = pose.positions(body);
    let [left, right] = [Node::LeftHand, Node::RightHand]
        .map(|hand| joints[hand.index()] + pose.world[hand.index()] * (body.link(hand).tip * 0.5));
    left.distance(right)
}

/// Distance between two line segments \[m\].
pub(super) fn distance(ours: [DVec3; 2], theirs: [DVec3; 2]) -> f64 {
    let [s, t] = nearest_points(ours, theirs);
    (ours[0] + (ours[1] - ours[0]) * s).distance(theirs[0] + (theirs[1] - theirs[0]) * t)
}

/// Where two line segments are nearest: the share of the way along each, from its first point \[1\] (C. Ericson, *Real-Time
/// Collision Detection*, section 5.1.9).
///
/// ```
/// use glam::DVec3;
/// use sinew_body::measure::nearest_points;
/// let across = [DVec3::new(0.5, 1.0, -1.0), DVec3::new(0.5, 1.0, 1.0)];
/// assert_eq!(nearest_points([DVec3::ZERO, DVec3::X], across), [0.5, 0.5]);
/// ```
pub fn nearest_points([a, b]: [DVec3; 2], [c, d]: [DVec3; 2]) -> [f64; 2] {
    let (ours, theirs, between) = (b - a, d - c, a - c);
    let (long, other, mixed) = (ours.length_squared(), theirs.length_squared(), ours.dot(theirs));
    let (along, across) = (ours.dot(between), theirs.dot(between));
    let determinant = long * other - mixed * mixed;
    // Parallel or without length: any point of ours will do, the other follows.
    let s = if determinant > 1e-12 { ((mixed * across - along * other) / determinant).clamp(0.0, 1.0) } else { 0.0 };
    let t = if other > 1e-12 { ((mixed * s + across) / other).clamp(0.0, 1.0) } else { 0.0 };
    let s = if long > 1e-12 { ((mixed * t - along) / long).clamp(0.0, 1.0) } else { 0.0 };
    [s, t]
}
