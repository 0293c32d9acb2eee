//! Joint limit checks, without trigonometry for joints that are clearly inside.

use glam::DQuat;
use sinew_body::humanoid::{Body, Limit, Node, UPPER_NODES};

/// The limits of the upper body's joints, prepared.
#[derive(Clone, Debug)]
pub(crate) struct Limits([Near; UPPER_NODES]);

/// A limit in a form that is cheap to compare with.
#[derive(Clone, Copy, Debug)]
struct Near {
    /// `node_from_parent` in the middle of the range.
    to_centre: DQuat,
    /// 1 / half-axis of the swing ellipse, by sign (negative, positive) \[1/rad\].
    per_x: [f64; 2],
    per_z: [f64; 2],
    /// Tangents of half the minimum and maximum twist.
    twist: [f64; 2],
}

impl Limits {
    pub(crate) fn of(body: &Body) -> Limits {
        Limits(std::array::from_fn(|node| Near::of(&body.link(Node::ALL[node]).limit)))
    }

    /// Whether a joint's `parent_from_node` rotation is inside its limit: as [`Limit::contains`].
    pub(crate) fn contains(&self, body: &Body, node: usize, local: DQuat) -> bool {
        self.0[node].surely_contains(local) || body.link(Node::ALL[node]).limit.contains(local)
    }

    /// Widens the body's limits to contain a pose's `parent_from_node` rotations.
    pub(crate) fn widen(&mut self, body: &mut Body, locals: &[DQuat; UPPER_NODES]) {
        for (node, near) in self.0.iter_mut().enumerate().skip(1) {
            if near.surely_contains(locals[node]) {
                continue;
            }
            let limit = &mut body.link_mut(Node::ALL[node]).limit;
            if !limit.contains(locals[node]) {
                limit.widen(locals[node]);
                *near = Near::of(limit);
            }
        }
    }
}

impl Near {
    fn of(limit: &Limit) -> Near {
        let half_tangent = |angle: f64| {
            if angle.abs() < std::f64::consts::PI { libm::tan(0.5 * angle) } else { angle * f64::INFINITY }
        };
        let swing = &limit.swing;
        Near {
            to_centre: limit.centre.conjugate(),
            per_x: [1.0 / swing.x_negative, 1.0 / swing.x_positive],
            per_z: [1.0 / swing.z_negative, 1.0 / swing.z_positive],
            twist: [half_tangent(limit.twist.0), half_tangent(limit.twist.1)],
        }
    }

    /// True only inside the limit; false near its edge too. With `rotation = swing * twist`, the tangent of half the
    /// twist is y/w, and the sine s of half the swing the length of (x, z); asin s is at most s + s³/6 + c s⁵, because
    /// the series' coefficients are positive, where c makes it exact at s = 1.
    fn surely_contains(&self, local: DQuat) -> bool {
        const C: f64 = std::f64::consts::FRAC_PI_2 - 1.0 - 1.0 / 6.0;
        let rotation = self.to_centre * local;
        let DQuat { x, y, z, w } = if rotation.w < 0.0 { -rotation } else { rotation };
        if y > w * self.twist[1] || y < w * self.twist[0] {
            return false;
        }
        let (cos_squared, sin_squared) = (w * w + y * y, x * x + z * z);
        // The swing's axis: (x, z) turned by half the twist, here times the cosine of half the swing.
        let (along_x, along_z) = (x * w + z * y, z * w - x * y);
        let a = along_x * self.per_x[usize::from(along_x >= 0.0)];
        let b = along_z * self.per_z[usize::from(along_z >= 0.0)];
        let longer = 2.0 * (1.0 + sin_squared * (1.0 / 6.0 + C * sin_squared));
        (a * a + b * b) * (longer * longer) < cos_squared
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec3;
    use sinew_body::humanoid::exp;

    #[test]
    fn what_is_surely_inside_is_inside_and_most_of_the_inside_is_sure() {
        let body = Body::standard(80.0, 1.7);
        let limits = Limits::of(&body);
        let mut sure = 0;
        let mut inside = 0;
        for node in 1..UPPER_NODES {
            let limit = body.link(Node::ALL[node]).limit;
            for step in 0..20_000 {
                // A lattice that fills the ball of rotations.
                let fraction = |ratio: f64| 2.0 * (f64::from(step) * ratio).fract() - 1.0;
                let vector = DVec3::new(fraction(0.819_172_51), fraction(0.671_043_61), fraction(0.549_700_48));
                let local = limit.centre * exp(vector * std::f64::consts::PI);
                let surely = limits.0[node].surely_contains(local);
                assert!(!surely || limit.contains(local), "{:?} {vector}", Node::ALL[node]);
                sure += usize::from(surely);
                inside += usize::from(limit.contains(local));
            }
        }
        assert!(sure * 10 > inside * 7, "{sure} of {inside}");
    }

    #[test]
    fn a_widened_limit_contains_what_widened_it() {
        let mut body = Body::standard(80.0, 1.7);
        let mut limits = Limits::of(&body);
        let mut locals = [DQuat::IDENTITY; UPPER_NODES];
        locals[Node::LeftHand.index()] = exp(DVec3::new(2.0, 1.0, -0.5));
        let contains = |limits: &Limits, body: &Body| {
            limits.contains(body, Node::LeftHand.index(), locals[Node::LeftHand.index()])
        };
        assert!(!contains(&limits, &body));
        limits.widen(&mut body, &locals);
        assert!(contains(&limits, &body));
        assert!(body.link(Node::LeftHand).limit.contains(locals[Node::LeftHand.index()]));
    }
}
