//! From one motion to another without a pop: what is shown keeps its distance from the new motion at first, and the distance
//! then dies out.

use glam::{DQuat, DVec3};
use sinew_body::humanoid::{Node, Pose, exp, log};

/// How fast a blend may move the hips on top of the motion \[m/s\].
const HIPS_M_S: f64 = 1.0;

/// How fast a blend may turn a joint on top of the motion \[rad/s\].
const TURN_RAD_S: f64 = 2.0;

/// The steepest slope of the fading, which is 1 - (6 x⁵ - 15 x⁴ + 10 x³).
const STEEPEST: f64 = 1.875;

/// A distance between shown and wanted that dies out.
#[derive(Clone, Debug)]
pub(super) struct Blend {
    hips: DVec3,
    /// Of the hips in the world, of all others against their parents, as rotation vectors in the node's frame.
    turns: [DVec3; Node::COUNT],
    gone_secs: f64,
    lasts_secs: f64,
}

impl Blend {
    /// Nothing to blend.
    pub fn none() -> Blend {
        Blend { hips: DVec3::ZERO, turns: [DVec3::ZERO; Node::COUNT], gone_secs: 0.0, lasts_secs: 0.0 }
    }

    /// Begins at a shown pose; `wanted` is what the new motion has at the same instant. Lasts at least so long, and longer where
    /// the way is far.
    pub fn begin(shown: &Pose, wanted: &Pose, least_secs: f64) -> Blend {
        let hips = shown.hips_position - wanted.hips_position;
        let turns = Node::ALL.map(|node| log((wanted.local(node).conjugate() * shown.local(node)).normalize()));
        let widest = turns.iter().map(|turn| turn.length()).fold(0.0, f64::max);
        let needed = (hips.length() / HIPS_M_S).max(widest / TURN_RAD_S) * STEEPEST;
        Blend { hips, turns, gone_secs: 0.0, lasts_secs: needed.max(least_secs) }
    }

    /// Time goes by.
    pub fn advance(&mut self, step_secs: f64) {
        self.gone_secs = (self.gone_secs + step_secs).min(self.lasts_secs);
    }

    /// The wanted pose with what is left of the distance.
    pub fn over(&self, wanted: &Pose) -> Pose {
        if self.gone_secs >= self.lasts_secs {
            return *wanted;
        }
        let x = self.gone_secs / self.lasts_secs;
        let left = 1.0 - x * x * x * (x * (6.0 * x - 15.0) + 10.0);
        let locals: [DQuat; Node::COUNT] = Node::ALL.map(|node| {
            let local = wanted.local(node) * exp(self.turns[node.index()] * left);
            local.normalize()
        });
        Pose::from_locals(wanted.hips_position + self.hips * left, &locals)
    }
}
