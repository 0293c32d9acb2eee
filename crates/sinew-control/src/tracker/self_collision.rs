//! Self-collision filter: pairs of parts that the performer brings close pass through each other, because the body's
//! shapes are wider than the performer's.
//!
//! A performer's feet pass within a finger's breadth and arms lie against ribs; the shapes of a simulated body are wider in
//! places, and the floor keeps its feet off those of a capture that dips into it. A pair that comes that near in the wanted
//! pose does not collide, until both poses have it apart again: a foot that caught on the other leg would fall behind, stand on
//! its toes and stay there.

use super::instant::Instant;
use glam::{DQuat, DVec3};
use sinew_body::humanoid::{Body, Node};
use sinew_world::{CharacterFrame, Form, never_collide, part_solid};

/// Distance in the wanted pose below which a pair is filtered \[m\]: the accuracy of captures and skeletons.
const NEAR_M: f64 = 0.015;

/// Distance in the wanted pose above which a pair collides again, if it does not overlap in the body \[m\].
const APART_M: f64 = 0.03;

/// By how much further a pair is filtered at most whose parts are off the wanted pose, by as much as one is off more than the
/// other \[m\].
const MAX_OFF_M: f64 = 0.05;

/// A capsule in a part's frame.
#[derive(Clone, Copy, Debug)]
struct Capsule {
    from: DVec3,
    to: DVec3,
    radius_m: f64,
}

/// The pairs filtered now.
#[derive(Clone, Debug)]
pub(crate) struct SelfCollision {
    capsules: [Capsule; Node::COUNT],
    pairs: Vec<(usize, usize)>,
    /// By part, a bit for every part that it passes through.
    masks: [u32; Node::COUNT],
}

sinew_snapshot::snapshot!(SelfCollision { masks } fixed { capsules, pairs });

impl SelfCollision {
    pub(crate) fn new(body: &Body) -> SelfCollision {
        let never = never_collide(body);
        let mut pairs = Vec::new();
        for one in Node::ALL {
            for other in Node::ALL.into_iter().filter(|other| one < *other) {
                let neighbours = one.parent() == Some(other) || other.parent() == Some(one);
                if !neighbours && !never.contains(&(one, other)) {
                    pairs.push((one.index(), other.index()));
                }
            }
        }
        SelfCollision { capsules: Node::ALL.map(|node| capsule(body, node)), pairs, masks: [0; Node::COUNT] }
    }

    /// Updates with a wanted pose and the body; returns the masks of all parts.
    pub(crate) fn look(&mut self, wanted: &Instant, body: &CharacterFrame) -> [u32; Node::COUNT] {
        for &(one, other) in &self.pairs {
            let passes = self.masks[one] & 1 << other != 0;
            let off = |at: usize| body.parts[at].position - wanted.joints[at];
            let near = (off(one) - off(other)).length().min(MAX_OFF_M) + if passes { APART_M } else { NEAR_M };
            let in_pose = |at: usize| (wanted.joints[at], wanted.rotations[at]);
            let in_body = |at: usize| (body.parts[at].position, body.parts[at].rotation);
            let still = self.nearer(one, other, near, in_pose) || passes && self.nearer(one, other, 0.0, in_body);
            if still != passes {
                self.masks[one] ^= 1 << other;
                self.masks[other] ^= 1 << one;
            }
        }
        self.masks
    }

    fn nearer(&self, one: usize, other: usize, near_m: f64, place: impl Fn(usize) -> (DVec3, DQuat)) -> bool {
        let (a, b) = (self.capsules[one].at(place(one)), self.capsules[other].at(place(other)));
        let reach = near_m + self.capsules[one].radius_m + self.capsules[other].radius_m;
        let span = (a.0 - a.1).length() + (b.0 - b.1).length();
        // Bounding spheres first: twice the distance of the centres against twice the sum of the radii.
        (a.0 + a.1 - b.0 - b.1).length() < 2.0 * reach + span && distance(a, b) < reach
    }
}

impl Capsule {
    fn at(&self, (position, rotation): (DVec3, DQuat)) -> (DVec3, DVec3) {
        (position + rotation * self.from, position + rotation * self.to)
    }
}

/// The capsule of a part's shape; a sole's box as the capsule within its outline.
fn capsule(body: &Body, node: Node) -> Capsule {
    let solid = part_solid(body, node);
    let (half, radius_m) = match solid.form {
        Form::Capsule { radius_m, length_m } => (DVec3::Y * (length_m / 2.0), radius_m),
        Form::Box { size_m } => {
            let radius_m = size_m.x / 2.0;
            (DVec3::Z * (size_m.z / 2.0 - radius_m).max(0.0), radius_m)
        }
        _ => (DVec3::ZERO, 0.0),
    };
    Capsule { from: solid.centre - solid.rotation * half, to: solid.centre + solid.rotation * half, radius_m }
}

/// Distance of two line segments \[m\].
fn distance(a: (DVec3, DVec3), b: (DVec3, DVec3)) -> f64 {
    let (u, v, w) = (a.1 - a.0, b.1 - b.0, a.0 - b.0);
    let (uu, uv, vv, uw, vw) = (u.dot(u), u.dot(v), v.dot(v), u.dot(w), v.dot(w));
    let determinant = uu * vv - uv * uv;
    // The nearest point of the first line, then of the second segment, then of the first again.
    let along = |share: f64| share.clamp(0.0, 1.0);
    let s = if determinant > 1e-12 { along((uv * vw - vv * uw) / determinant) } else { 0.0 };
    let t = along((uv * s + vw) / vv.max(1e-12));
    let s = along((uv * t - uw) / uu.max(1e-12));
    (w + u * s - v * t).length()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn segments_are_as_far_apart_as_their_nearest_points() {
        let x = |from: f64, to: f64, y: f64, z: f64| (DVec3::new(from, y, z), DVec3::new(to, y, z));
        let parallel = distance(x(0.0, 1.0, 0.0, 0.0), x(0.5, 2.0, 0.3, 0.4));
        assert!((parallel - 0.5).abs() < 1e-12);
        let in_line = distance(x(0.0, 1.0, 0.0, 0.0), x(3.0, 4.0, 0.0, 0.0));
        assert!((in_line - 2.0).abs() < 1e-12);
        let crossed = distance(x(-1.0, 1.0, 0.0, 0.0), (DVec3::new(0.0, -1.0, 0.7), DVec3::new(0.0, 1.0, 0.7)));
        assert!((crossed - 0.7).abs() < 1e-12);
        let beyond = distance(x(0.0, 1.0, 0.0, 0.0), (DVec3::new(2.0, 1.0, 0.0), DVec3::new(2.0, 5.0, 0.0)));
        assert!((beyond - 2.0f64.sqrt()).abs() < 1e-12);
    }
}
