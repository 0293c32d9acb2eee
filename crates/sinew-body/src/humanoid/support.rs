//! The support polygon: the convex hull of a character's support points, seen from above.

use glam::DVec3;

/// Leaves in `points` the corners of their hull over the ground, counter-clockwise seen from above, starting with the
/// smallest x. Heights stay those of the corners.
pub fn keep_support_hull(points: &mut Vec<DVec3>, scratch: &mut Vec<DVec3>) {
    points.sort_by(|a, b| a.x.total_cmp(&b.x).then(a.z.total_cmp(&b.z)));
    points.dedup_by(|a, b| a.x == b.x && a.z == b.z);
    if points.len() < 3 {
        return;
    }
    scratch.clear();
    // Andrew's monotone chain. Seen from above (x right, z down the page) counter-clockwise has negative cross products in x, z.
    let turn = |a: DVec3, b: DVec3, c: DVec3| (b.x - a.x) * (c.z - a.z) - (b.z - a.z) * (c.x - a.x);
    let mut lower = 0;
    for pass in 0..2 {
        let base = if pass == 0 { 0 } else { lower };
        for index in 0..points.len() {
            let point = if pass == 0 { points[index] } else { points[points.len() - 1 - index] };
            while scratch.len() >= base + 2
                && turn(scratch[scratch.len() - 2], scratch[scratch.len() - 1], point) >= -1e-12
            {
                scratch.pop();
            }
            scratch.push(point);
        }
        scratch.pop();
        lower = scratch.len();
    }
    std::mem::swap(points, scratch);
}

/// Distance over the ground from a point to the polygon's edge \[m\]: positive inside, negative outside; −∞ without a
/// polygon. `corners` as [`keep_support_hull`] leaves them.
pub fn support_margin_m(corners: &[DVec3], point: DVec3) -> f64 {
    let flat = |v: DVec3| DVec3::new(v.x, 0.0, v.z);
    let point = flat(point);
    if corners.len() < 3 {
        let nearest = |from: DVec3, to: DVec3| {
            let line = to - from;
            let share = (point - from).dot(line) / line.length_squared().max(1e-12);
            (from + line * share.clamp(0.0, 1.0) - point).length()
        };
        return match corners {
            [] => f64::NEG_INFINITY,
            [one] => -(flat(*one) - point).length(),
            [one, other, ..] => -nearest(flat(*one), flat(*other)),
        };
    }
    let mut inside = f64::INFINITY;
    let mut outside = f64::INFINITY;
    let mut is_inside = true;
    for (index, corner) in corners.iter().enumerate() {
        let (from, to) = (flat(*corner), flat(corners[(index + 1) % corners.len()]));
        let line = to - from;
        let length = line.length().max(1e-12);
        // Inward is to the left of the edge, counter-clockwise seen from above.
        let inward = DVec3::Y.cross(line) / length;
        let distance = (point - from).dot(inward);
        is_inside &= distance >= 0.0;
        inside = inside.min(distance);
        let share = ((point - from).dot(line) / (length * length)).clamp(0.0, 1.0);
        outside = outside.min((from + line * share - point).length());
    }
    if is_inside { inside } else { -outside }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn square() -> Vec<DVec3> {
        let mut points: Vec<DVec3> =
            [(0.0, 0.0), (0.5, 0.5), (1.0, 0.0), (1.0, 1.0), (0.2, 0.7), (0.0, 1.0), (0.5, 0.0)]
                .into_iter()
                .map(|(x, z)| DVec3::new(x, 0.0, z))
                .collect();
        keep_support_hull(&mut points, &mut Vec::new());
        points
    }

    #[test]
    fn only_corners_stay() {
        assert_eq!(square().len(), 4);
    }

    #[test]
    fn the_margin_is_the_distance_to_the_nearest_edge_and_negative_outside() {
        let corners = square();
        assert!((support_margin_m(&corners, DVec3::new(0.3, 9.0, 0.5)) - 0.3).abs() < 1e-12);
        assert!((support_margin_m(&corners, DVec3::new(0.5, 0.0, 0.1)) - 0.1).abs() < 1e-12);
        assert!((support_margin_m(&corners, DVec3::new(1.3, 0.0, 1.4)) + 0.5).abs() < 1e-12);
        assert_eq!(support_margin_m(&[], DVec3::ZERO), f64::NEG_INFINITY);
    }
}
