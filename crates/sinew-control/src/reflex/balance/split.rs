//! Distribution of one centre of pressure over two feet.

use super::sole::Footing;
use super::stance::Stance;
use glam::DVec2;

/// Load and centre of pressure of each foot.
#[derive(Clone, Copy, Debug)]
pub(super) struct Split {
    /// Share of the weight \[1\].
    pub shares: [f64; 2],
    /// Centre of pressure under each foot \[m\].
    pub points: [DVec2; 2],
}

/// Tolerance of the centre of pressure \[m\].
const MET_M: f64 = 5e-4;

impl Split {
    /// For a centre of pressure over the ground. If possible, the shares follow from the position between the feet's
    /// resting points; towards the edges of the polygon they deviate.
    pub fn of(stance: &Stance, pressure: DVec2) -> Split {
        let feet = &stance.feet;
        match stance.stands {
            [true, true] => {}
            [left, right] => {
                let shares = [left, right].map(|stands| if stands { 1.0 } else { 0.0 });
                return Split { shares, points: [0, 1].map(|side| feet[side].nearest(pressure)) };
            }
        }
        let line = feet[1].rest - feet[0].rest;
        let along = (pressure - feet[0].rest).dot(line) / line.length_squared().max(1e-9);
        let liked = along.clamp(0.0, 1.0);
        let at = |right: f64| Split::shared(feet, pressure, right);
        let missed = |split: &Split| {
            (split.points[0] * split.shares[0] + split.points[1] * split.shares[1]).distance_squared(pressure)
        };
        let first = at(liked);
        if missed(&first) < MET_M * MET_M {
            return first;
        }
        // The error is a convex function of the share, and so is the small penalty for deviating from the preferred
        // one.
        let cost = |right: f64| missed(&at(right)) + 1e-6 * (right - liked) * (right - liked);
        let (mut low, mut high) = (0.0, 1.0);
        for _ in 0..24 {
            let third = (high - low) / 3.0;
            if cost(low + third) < cost(high - third) {
                high -= third;
            } else {
                low += third;
            }
        }
        at(0.5 * (low + high))
    }

    /// With this share on the right foot, the points under both feet that come nearest to the centre of pressure.
    fn shared(feet: &[Footing; 2], pressure: DVec2, right: f64) -> Split {
        let shares = [1.0 - right, right];
        let offset = pressure - (feet[0].rest * shares[0] + feet[1].rest * shares[1]);
        let mut points = [0, 1].map(|side| feet[side].nearest(feet[side].rest + offset));
        for _ in 0..4 {
            for side in 0..2 {
                if shares[side] > 1e-3 {
                    let rest = pressure - points[1 - side] * shares[1 - side];
                    points[side] = feet[side].nearest(rest / shares[side]);
                }
            }
        }
        Split { shares, points }
    }
}
