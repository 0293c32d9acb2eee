//! Random poses of a limb, the same in every run.
#![allow(dead_code, reason = "tests and benchmark use a part each")]

use glam::{DQuat, DVec3};
use sinew_body::humanoid::{Body, Limb, Limit, exp};

/// A linear congruential generator (Knuth's MMIX multiplier and increment), so that a failure can be had again.
pub struct Random(pub u64);

impl Random {
    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        low + (high - low) * ((self.0 >> 11) as f64 / (1u64 << 53) as f64)
    }

    pub fn rotation(&mut self) -> DQuat {
        exp(DVec3::new(self.between(-2.0, 2.0), self.between(-2.0, 2.0), self.between(-2.0, 2.0)))
    }

    /// A rotation inside a limit; without a twist for joints that have none.
    pub fn within(&mut self, limit: &Limit, twists: bool) -> DQuat {
        loop {
            let swing = DVec3::new(self.between(-2.5, 2.5), 0.0, self.between(-2.5, 2.5));
            let twist = if twists { self.between(limit.twist.0, limit.twist.1) } else { 0.0 };
            let rotation = limit.centre * exp(swing) * exp(DVec3::Y * twist);
            if limit.excess(rotation) <= 0.0 {
                return rotation;
            }
        }
    }

    /// A limb's three rotations, all inside their limits.
    pub fn limb(&mut self, body: &Body, limb: Limb) -> [DQuat; 3] {
        let [upper, lower, end] = limb.nodes();
        let twist = body.link(lower).limit.twist;
        let lower_rotation = if limb.is_leg() {
            exp(DVec3::X * self.between(0.0, 2.6))
        } else {
            exp(DVec3::X * self.between(-2.6, 0.0)) * exp(DVec3::Y * self.between(twist.0, twist.1))
        };
        [self.within(&body.link(upper).limit, true), lower_rotation, self.within(&body.link(end).limit, limb.is_leg())]
    }
}
