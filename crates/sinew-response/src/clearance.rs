//! Arms stay out of the body.
//!
//! The response's dynamics know no contacts: a pushed hand would go through the chest. Here forearms and hands approach trunk,
//! head and thighs ever slower, by at most a share of the remaining distance in a step (velocity dampers: B. Faverjon and
//! P. Tournassoud, *A local based approach for path planning of manipulators with a high number of degrees of freedom*, 1987).
//! Where the input is nearer, or inside, so may they be: an input that is not disturbed is never changed.

use crate::objective::Row;
use crate::task::{push, row_of, share};
use crate::upper_body::Coordinates24;
use glam::DVec3;
use sinew_body::humanoid::{Body, Node, Pose};
use sinew_body::measure::nearest_points;
use sinew_snapshot::snapshot;

const ARMS: [Node; 4] = [Node::LeftLowerArm, Node::LeftHand, Node::RightLowerArm, Node::RightHand];
const OBSTACLES: [Node; 4] = [Node::Chest, Node::Head, Node::LeftUpperLeg, Node::RightUpperLeg];

/// Distance of the surfaces up to which an arm may come, where the input's is larger \[m for a 1.7 m body\].
const MARGIN_M: f64 = 0.02;

/// Distance beyond that below which the approach is slowed \[m for a 1.7 m body\].
const BAND_M: f64 = 0.08;

/// Time in which the remaining distance falls to 1/e at most \[s\].
const APPROACH_SECS: f64 = 0.08;

/// Time in which an arm that the input carries into the body gets out of it, to 1/e \[s\].
const RETURN_SECS: f64 = 0.02;

/// Distance from where the input has an arm at which it is on its own \[m for a 1.7 m body\].
const OWN_M: f64 = 0.02;

/// Highest speed at which it gets out \[m/s for a 1.7 m body\].
const MAX_RETURN_M_PER_S: f64 = 2.0;

/// Weight of a step along the line between the surfaces \[1/m\].
const WEIGHT: f64 = 3e4;

/// For so long after a push an arm stays out of the body, and in so long more it ceases to \[s\]: one that came to hang on the
/// wrong side of a thigh would never come back.
const ALERT_SECS: f64 = 0.6;
const CALM_SECS: f64 = 1.0;

/// How long ago the last push was.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Alert {
    /// Seconds of [`ALERT_SECS`] and [`CALM_SECS`] that are left.
    left_secs: f64,
}

snapshot!(Alert { left_secs });

impl Alert {
    pub(crate) fn advance(&mut self, is_pushed: bool, time_step_secs: f64) {
        let left_secs = (self.left_secs - time_step_secs).max(0.0);
        self.left_secs = if is_pushed { ALERT_SECS + CALM_SECS } else { left_secs };
    }

    pub(crate) fn is_on(&self) -> bool {
        self.left_secs > 0.0
    }

    /// From 1 to 0.
    pub(crate) fn share(&self) -> f64 {
        (self.left_secs / CALM_SECS).min(1.0)
    }
}

/// The approaches that are slowed in one step.
#[derive(Clone, Debug)]
pub(crate) struct Clearance(Vec<Barrier>);

/// An arm near an obstacle.
#[derive(Clone, Copy, Debug)]
struct Barrier {
    /// By how much a step takes the two apart \[m/rad\].
    apart: Coordinates24,
    /// By how much it has to at least; negative where it may bring them together \[m\].
    least: f64,
    added: bool,
}

impl Clearance {
    pub(crate) fn new() -> Clearance {
        Clearance(Vec::with_capacity(ARMS.len() * OBSTACLES.len()))
    }

    /// No approach is slowed.
    pub(crate) fn clear(&mut self) {
        self.0.clear();
    }

    /// Finds the approaches of a step, while an arm is `alert` from 1 to 0, from `now` to `kept`, the next pose with an unchanged deviation from the input; of each the
    /// input's pose beside it.
    pub(crate) fn look(&mut self, body: &Body, now: [&Pose; 2], kept: [&Pose; 2], alert: f64, time_step_secs: f64) {
        let scale = body.stature_m() / 1.7;
        let place = |pose: &Pose| pose.positions(body);
        let (now_at, kept_at) = (now.map(place), kept.map(place));
        for arm in ARMS {
            for obstacle in OBSTACLES {
                let near = Gap::between(body, kept[0], &kept_at[0], arm, obstacle);
                if near.distance_m > (MARGIN_M + BAND_M) * scale || near.normal == DVec3::ZERO {
                    continue;
                }
                let input_m = Gap::between(body, kept[1], &kept_at[1], arm, obstacle).distance_m;
                // What the input's motion closes, as far as the arm is where the input does not have it.
                let own = ((input_m - near.distance_m).abs() / (OWN_M * scale)).min(1.0);
                let free = (1.0 - alert) * BAND_M * scale;
                let left = near.distance_m - input_m.min(MARGIN_M * scale) + free;
                if left > BAND_M * scale {
                    continue;
                }
                let before = [0, 1].map(|at| Gap::between(body, now[at], &now_at[at], arm, obstacle).distance_m);
                let left_before = before[0] - before[1].min(MARGIN_M * scale) + free;
                let closed = (left_before - left).max(0.0) * own;
                let gone = share(time_step_secs, if left > 0.0 { APPROACH_SECS } else { RETURN_SECS });
                let least = ((1.0 - gone) * closed - gone * left).min(MAX_RETURN_M_PER_S * scale * time_step_secs);
                let apart =
                    row_of(arm, kept[0], &kept_at[0], |about, joint| about.cross(near.at - joint).dot(near.normal));
                self.0.push(Barrier { apart, least, added: false });
            }
        }
    }

    /// Appends a row for each approach that a step does not slow enough, once; whether there was one.
    pub(crate) fn add_missed(&mut self, step: &Coordinates24, rows: &mut Vec<Row<f64>>) -> bool {
        let mut any = false;
        for barrier in self.0.iter_mut().filter(|barrier| !barrier.added) {
            let along: f64 = barrier.apart.iter().zip(step).map(|(apart, step)| apart * step).sum();
            if along < barrier.least {
                push(Row { direction: barrier.apart, wanted: barrier.least, weight: WEIGHT }, rows);
                (barrier.added, any) = (true, true);
            }
        }
        any
    }
}

/// Where an arm and an obstacle are nearest.
struct Gap {
    /// Distance of the surfaces, negative inside \[m\].
    distance_m: f64,
    /// The point of the arm's axis, world \[m\].
    at: DVec3,
    /// Unit vector from the obstacle to the arm, world; zero where their axes cross.
    normal: DVec3,
}

impl Gap {
    fn between(body: &Body, pose: &Pose, joints: &[DVec3; Node::COUNT], arm: Node, obstacle: Node) -> Gap {
        let (ours, theirs) = (axis(body, pose, joints, arm), axis(body, pose, joints, obstacle));
        let [s, t] = nearest_points(ours, theirs);
        let at = ours[0].lerp(ours[1], s);
        let between = at - theirs[0].lerp(theirs[1], t);
        let distance_m = between.length() - radius_m(body, arm) - radius_m(body, obstacle);
        Gap { distance_m, at, normal: between.normalize_or_zero() }
    }
}

/// The axis of a part's capsule, world \[m\]: the bone. The chest stands for the trunk, from the hips' joint to below the neck's.
fn axis(body: &Body, pose: &Pose, joints: &[DVec3; Node::COUNT], node: Node) -> [DVec3; 2] {
    let from = joints[node.index()];
    if node == Node::Chest {
        let (hips, neck) = (joints[0], joints[Node::Neck.index()]);
        return [hips, neck + (hips - neck).normalize_or_zero() * radius_m(body, node)];
    }
    [from, from + pose.world[node.index()] * body.link(node).tip]
}

/// The radius of a part's capsule \[m\]: its shape's mean; a hand is as thick as a forearm, a thigh as at its thicker end.
fn radius_m(body: &Body, node: Node) -> f64 {
    let shape = match node {
        Node::LeftHand => &body.link(Node::LeftLowerArm).shape,
        Node::RightHand => &body.link(Node::RightLowerArm).shape,
        _ => &body.link(node).shape,
    };
    let thinner = if node.is_leg() { shape.from_radius_m } else { shape.to_radius_m };
    0.5 * (shape.from_radius_m + thinner)
}
