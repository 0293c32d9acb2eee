//! The support polygon under both soles: convex, seen from above, without heap memory.

use glam::{DVec2, DVec3};

/// Corners of two soles.
const MAX_CORNERS: usize = 8;

/// A convex polygon over the ground, in the world's x and z.
#[derive(Clone, Copy, Debug)]
pub(super) struct Polygon {
    corners: [DVec2; MAX_CORNERS],
    count: usize,
}

/// Over the ground.
pub(super) fn flat(point: DVec3) -> DVec2 {
    DVec2::new(point.x, point.z)
}

impl Polygon {
    /// The hull of up to eight points.
    pub fn hull(points: &[DVec2]) -> Polygon {
        let mut sorted = [DVec2::ZERO; MAX_CORNERS];
        let total = points.len().min(MAX_CORNERS);
        sorted[..total].copy_from_slice(&points[..total]);
        let sorted = &mut sorted[..total];
        sorted.sort_unstable_by(|a, b| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)));
        // Andrew's monotone chain: below from the left, then above from the right.
        let mut chain = [DVec2::ZERO; 2 * MAX_CORNERS];
        let mut count = 0;
        for pass in 0..2 {
            let base = count;
            for index in 0..total {
                let point = if pass == 0 { sorted[index] } else { sorted[total - 1 - index] };
                while count >= base + 2
                    && (chain[count - 1] - chain[count - 2]).perp_dot(point - chain[count - 2]) <= 0.0
                {
                    count -= 1;
                }
                chain[count] = point;
                count += 1;
            }
            count = count.saturating_sub(1);
        }
        let count = count.min(MAX_CORNERS);
        let mut corners = [DVec2::ZERO; MAX_CORNERS];
        corners[..count].copy_from_slice(&chain[..count]);
        if count == 0 && total > 0 {
            corners[0] = sorted[0];
            return Polygon { corners, count: 1 };
        }
        Polygon { corners, count }
    }

    /// The point of the polygon that is nearest to a point.
    pub fn nearest(&self, point: DVec2) -> DVec2 {
        let (mut best, mut distance, mut inside) = (point, f64::INFINITY, self.count >= 3);
        for index in 0..self.count {
            let (from, to) = (self.corners[index], self.corners[(index + 1) % self.count]);
            let line = to - from;
            inside &= line.perp_dot(point - from) >= 0.0;
            let share = ((point - from).dot(line) / line.length_squared().max(1e-12)).clamp(0.0, 1.0);
            let on_edge = from + line * share;
            if on_edge.distance_squared(point) < distance {
                (best, distance) = (on_edge, on_edge.distance_squared(point));
            }
        }
        if inside { point } else { best }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn two_soles() -> Polygon {
        let sole = |x: f64, z: f64| [(x, z), (x + 0.1, z), (x + 0.1, z + 0.25), (x, z + 0.25)];
        let points: Vec<DVec2> =
            sole(-0.15, 0.0).into_iter().chain(sole(0.05, 0.0)).map(|(x, z)| DVec2::new(x, z)).collect();
        Polygon::hull(&points)
    }

    #[test]
    fn inner_corners_of_parallel_soles_are_no_corners_of_the_hull() {
        assert_eq!(two_soles().count, 4);
    }

    #[test]
    fn a_point_inside_stays_and_one_outside_comes_to_the_edge() {
        let polygon = two_soles();
        let inside = DVec2::new(0.02, 0.2);
        assert_eq!(polygon.nearest(inside), inside);
        assert!(polygon.nearest(DVec2::new(0.3, 0.1)).distance(DVec2::new(0.15, 0.1)) < 1e-12);
        assert!(polygon.nearest(DVec2::new(0.3, 0.4)).distance(DVec2::new(0.15, 0.25)) < 1e-12);
    }

    #[test]
    fn few_points_and_equal_points_are_no_trouble() {
        let point = DVec2::new(1.0, 2.0);
        assert_eq!(Polygon::hull(&[]).nearest(point), point);
        assert_eq!(Polygon::hull(&[DVec2::ZERO]).nearest(point), DVec2::ZERO);
        assert_eq!(Polygon::hull(&[DVec2::ZERO; 8]).nearest(point), DVec2::ZERO);
        assert_eq!(Polygon::hull(&[DVec2::ZERO, DVec2::X]).nearest(DVec2::new(0.5, 1.0)), DVec2::new(0.5, 0.0));
    }
}
