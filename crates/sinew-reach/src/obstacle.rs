//! Obstacles for the arms.

use glam::{DQuat, DVec3};

/// An obstacle, at rest while a path is planned.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Obstacle {
    /// A sphere or a capsule.
    Capsule {
        /// Centre of one end \[m\], world.
        from: DVec3,
        /// Centre of the other end \[m\].
        to: DVec3,
        /// Its radius \[m\].
        radius_m: f64,
    },
    /// A box.
    Box {
        /// Its centre \[m\], world.
        centre: DVec3,
        /// `world_from_box`.
        turn: DQuat,
        /// Half of its edges \[m\].
        half_m: DVec3,
    },
}

sinew_snapshot::snapshot!(enum Obstacle { 0: Capsule { from, to, radius_m }, 1: Box { centre, turn, half_m } });

/// A ball without a size at the world's origin.
impl Default for Obstacle {
    fn default() -> Obstacle {
        Obstacle::Capsule { from: DVec3::ZERO, to: DVec3::ZERO, radius_m: 0.0 }
    }
}

impl Obstacle {
    /// Signed distance of a point \[m\]; negative inside.
    ///
    /// ```
    /// use glam::{DQuat, DVec3};
    /// use sinew_reach::Obstacle;
    /// let table = Obstacle::Box { centre: DVec3::ZERO, turn: DQuat::IDENTITY, half_m: DVec3::new(0.5, 0.02, 0.3) };
    /// assert!((table.distance(DVec3::Y * 0.12) - 0.1).abs() < 1e-12);
    /// ```
    pub fn distance(&self, point: DVec3) -> f64 {
        match *self {
            Obstacle::Capsule { from, to, radius_m } => {
                let line = to - from;
                let share = ((point - from).dot(line) / line.length_squared().max(1e-12)).clamp(0.0, 1.0);
                (point - from - line * share).length() - radius_m
            }
            Obstacle::Box { centre, turn, half_m } => {
                let out = (turn.conjugate() * (point - centre)).abs() - half_m;
                out.max(DVec3::ZERO).length() + out.max_element().min(0.0)
            }
        }
    }

    /// Whether all its numbers are finite.
    pub fn is_finite(&self) -> bool {
        match self {
            Obstacle::Capsule { from, to, radius_m } => from.is_finite() && to.is_finite() && radius_m.is_finite(),
            Obstacle::Box { centre, turn, half_m } => centre.is_finite() && turn.is_finite() && half_m.is_finite(),
        }
    }
}
