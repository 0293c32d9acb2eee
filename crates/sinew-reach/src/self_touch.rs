//! Whether arms are inside the rest of the body: capsules, as wide as a clothed body of its stature.

use crate::compose::{ARMS, Composed};
use crate::frame::Frame;
use glam::DVec3;
use sinew_body::humanoid::{LEGS, Node};

/// Radii of trunk, thighs, head and forearms for a stature of 1.7 m \[m\].
const TRUNK_M: f64 = 0.12;
const THIGH_M: f64 = 0.075;
const HEAD_M: f64 = 0.09;
const ARM_M: f64 = 0.035;

/// Least height of fingertips over the floor \[m\].
const OVER_FLOOR_M: f64 = 0.008;

/// Flesh gives way by this \[m\].
const GIVES_M: f64 = 0.008;

impl Frame {
    /// How deep the forearms of reaching arms are in trunk, thighs and head, beyond what flesh gives, and their fingertips in a floor at a
    /// height \[m\]; the sum over both.
    pub fn arms_inside_m(&self, composed: &Composed, targets: [Option<DVec3>; 2], floor_m: f64) -> f64 {
        let scale = self.body.stature_m() / 1.7;
        let pose = &composed.pose;
        let step = |at: DVec3, of: Node, to: Node| at + pose.world[of.index()] * self.body.link(to).offset;
        let hips = pose.hips_position;
        let chest = step(hips, Node::Hips, Node::Chest);
        let neck = step(chest, Node::Chest, Node::Neck);
        let head = step(neck, Node::Neck, Node::Head);
        let crown = head + pose.world[Node::Head.index()] * self.body.link(Node::Head).tip;
        let mut inside = 0.0;
        for side in (0..2).filter(|side| targets[*side].is_some()) {
            let [_, upper, lower, hand] = ARMS[side];
            let elbow = step(composed.shoulders[side], upper, lower);
            let wrist = step(elbow, lower, hand);
            let tip = wrist + pose.world[hand.index()] * self.body.link(hand).tip;
            inside += (floor_m + OVER_FLOOR_M - tip.y).max(0.0);
            let mut deep = |from: DVec3, to: DVec3, radius: f64| {
                let apart = apart_m(elbow, tip, from, to);
                inside += ((radius + ARM_M) * scale - GIVES_M - apart).max(0.0);
            };
            deep(hips, neck, TRUNK_M);
            deep(head, crown, HEAD_M);
            for (thigh, shank, _) in LEGS {
                let hip = step(hips, Node::Hips, thigh);
                deep(hip, step(hip, thigh, shank), THIGH_M);
            }
        }
        inside
    }
}

/// Distance of two segments \[m\] (Ericson 2005, section 5.1.9).
fn apart_m(p: DVec3, p_end: DVec3, q: DVec3, q_end: DVec3) -> f64 {
    let (u, v, w) = (p_end - p, q_end - q, p - q);
    let (a, b, e) = (u.length_squared().max(1e-12), u.dot(v), v.length_squared().max(1e-12));
    let (c, f) = (u.dot(w), v.dot(w));
    let across = a * e - b * b;
    let s = if across > 1e-12 { ((b * f - c * e) / across).clamp(0.0, 1.0) } else { 0.0 };
    let t = ((b * s + f) / e).clamp(0.0, 1.0);
    let s = ((b * t - c) / a).clamp(0.0, 1.0);
    (p + u * s - q - v * t).length()
}
