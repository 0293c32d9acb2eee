//! Inertial blending from one motion to another: the initial difference to the new motion is kept and decays.

use glam::{DQuat, DVec3};
use sinew_body::humanoid::{Node, Pose, exp, log};
use sinew_snapshot::snapshot;

/// Maximum speed of a part relative to the motion during a blend \[m/s\].
const MAX_M_S: f64 = 0.8;

/// Approximate lever arm of a joint's rotation \[m/rad\].
const REACH_M: f64 = 0.5;

/// The steepest slope of the fading, which is 1 - (6 x⁵ - 15 x⁴ + 10 x³).
const STEEPEST: f64 = 1.875;

/// A decaying difference between shown and wanted pose.
#[derive(Clone, Debug)]
pub(super) struct Blend {
    hips: DVec3,
    /// Rotation vectors in the node's frame: of the hips relative to the world, of all others relative to their
    /// parents.
    turns: [DVec3; Node::COUNT],
    gone_secs: f64,
    lasts_secs: f64,
}

snapshot!(Blend { hips, turns, gone_secs, lasts_secs });

impl Blend {
    /// Nothing to blend.
    pub fn none() -> Blend {
        Blend { hips: DVec3::ZERO, turns: [DVec3::ZERO; Node::COUNT], gone_secs: 0.0, lasts_secs: 0.0 }
    }

    /// Starts at a shown pose; `wanted` is the new motion's pose at the same instant. Lasts at least `for_secs`, and
    /// longer for a large difference.
    pub fn begin(shown: &Pose, wanted: &Pose, least_secs: f64) -> Blend {
        let hips = shown.hips_position - wanted.hips_position;
        let turns = Node::ALL.map(|node| log((wanted.local(node).conjugate() * shown.local(node)).normalize()));
        // The distance of each part: that of the hips, plus those by all rotations from there to it.
        let mut ways = [hips.length(); Node::COUNT];
        for node in Node::ALL {
            let above = node.parent().map_or(hips.length(), |parent| ways[parent.index()]);
            ways[node.index()] = above + REACH_M * turns[node.index()].length();
        }
        let needed = ways.into_iter().fold(0.0, f64::max) / MAX_M_S * STEEPEST;
        Blend { hips, turns, gone_secs: 0.0, lasts_secs: needed.max(least_secs) }
    }

    /// Advances in time.
    pub fn advance(&mut self, step_secs: f64) {
        self.gone_secs = (self.gone_secs + step_secs).min(self.lasts_secs);
    }

    /// The wanted pose plus the remaining difference.
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
