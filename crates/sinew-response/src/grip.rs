//! Hands that hold something between them stay together.
//!
//! Nothing in a motion says that its hands hold a box, but they show it: before the trunk, they keep their distance. While they
//! do, a push of one hand takes the other along: their places relative to each other, as seen from the chest, stay the input's.

use crate::objective::Row;
use crate::task::{push, row_of, share};
use glam::DVec3;
use sinew_body::humanoid::{Body, Node, Pose};
use sinew_snapshot::snapshot;

/// Within this of each other are distances that hands keep, up and down together twice as much \[m for a 1.7 m body\].
const KEPT_M: f64 = 0.01;

/// For so long they have to be kept before the hands are taken to hold something \[s\].
const HELD_SECS: f64 = 0.5;

/// Time in which the hands' hold becomes firm, and in which it comes off \[s\].
const FIRM_SECS: f64 = 0.25;

/// Hands are before the trunk from so far ahead of the chest's joint on, and surely so from there on \[m for a 1.7 m body\].
const AHEAD_M: [f64; 2] = [0.12, 0.2];

/// Largest distance of hands that hold something \[m for a 1.7 m body\].
const WIDEST_M: f64 = 0.7;

/// Time in which a difference from the input's falls to 1/e \[s\].
const WITHIN_SECS: f64 = 0.03;

/// Weight of a step of one hand relative to the other \[1/m\].
const WEIGHT: f64 = 3e4;

const HANDS: [[Node; 4]; 2] = [
    [Node::LeftShoulder, Node::LeftUpperArm, Node::LeftLowerArm, Node::LeftHand],
    [Node::RightShoulder, Node::RightUpperArm, Node::RightLowerArm, Node::RightHand],
];

/// How firmly the hands hold something between them.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Grip {
    /// The distance that they keep \[m\], and for how long they have \[s\].
    kept_m: f64,
    kept_secs: f64,
    /// From 0 to 1.
    firm: f64,
}

snapshot!(Grip { kept_m, kept_secs, firm });

impl Grip {
    /// Looks at the input's next pose.
    pub(crate) fn advance(&mut self, body: &Body, input: &Pose, time_step_secs: f64) {
        let scale = body.stature_m() / 1.7;
        let hands = HANDS.map(|arm| from_chest(body, input, arm));
        let apart_m = hands[0].distance(hands[1]);
        let to_chest = input.world[Node::Chest.index()].conjugate();
        let ahead = hands.map(|hand| (to_chest * hand).z).into_iter().fold(f64::INFINITY, f64::min) / scale;
        let begins = self.kept_m == 0.0;
        if (apart_m - self.kept_m).abs() <= KEPT_M * scale {
            self.kept_secs += time_step_secs;
        } else {
            // A motion that begins with it has done so before.
            (self.kept_m, self.kept_secs) = (apart_m, if begins { HELD_SECS } else { 0.0 });
        }
        let holds = self.kept_secs >= HELD_SECS && apart_m < WIDEST_M * scale;
        let before = ((ahead - AHEAD_M[0]) / (AHEAD_M[1] - AHEAD_M[0])).clamp(0.0, 1.0);
        let wanted = if holds { before } else { 0.0 };
        let most = if begins { 1.0 } else { time_step_secs / FIRM_SECS };
        self.firm += (wanted - self.firm).clamp(-most, most);
    }

    /// Whether they hold something.
    pub(crate) fn holds(&self) -> bool {
        self.firm > 0.0
    }

    /// Appends the rows that keep the hands together: `kept` is the next pose with an unchanged deviation from `input`.
    pub(crate) fn add_rows(
        &self,
        body: &Body,
        kept: &Pose,
        input: &Pose,
        time_step_secs: f64,
        rows: &mut Vec<Row<f64>>,
    ) {
        let joints = kept.positions(body);
        let chest = Node::Chest.index();
        let between = |pose: &Pose| from_chest(body, pose, HANDS[0]) - from_chest(body, pose, HANDS[1]);
        let turned = kept.world[chest] * input.world[chest].conjugate();
        let missing = (turned * between(input) - between(kept)) * share(time_step_secs, WITHIN_SECS);
        let [left, right] = [Node::LeftHand, Node::RightHand];
        let middle = |hand: Node| joints[hand.index()] + kept.world[hand.index()] * (body.link(hand).tip * 0.5);
        let [left_at, right_at] = [left, right].map(middle);
        for axis in DVec3::AXES {
            let ours = row_of(left, kept, &joints, |about, joint| about.cross(left_at - joint).dot(axis));
            let theirs = row_of(right, kept, &joints, |about, joint| about.cross(right_at - joint).dot(axis));
            let direction = std::array::from_fn(|dof| ours[dof] - theirs[dof]);
            push(Row { direction, wanted: missing.dot(axis), weight: WEIGHT * self.firm * self.firm }, rows);
        }
    }
}

/// From the chest's joint to the middle of a hand, world \[m\].
fn from_chest(body: &Body, pose: &Pose, arm: [Node; 4]) -> DVec3 {
    let mut at = DVec3::ZERO;
    let mut parent = Node::Chest;
    for node in arm {
        at += pose.world[parent.index()] * body.link(node).offset;
        parent = node;
    }
    at + pose.world[parent.index()] * (body.link(parent).tip * 0.5)
}
