//! Intersection of a ray along the view axis with a tapered capsule.
//!
//! A tapered capsule is the convex hull of two balls: two caps and a cone between them, tangent to both. Each is a
//! quadratic in depth.

use glam::{Vec2, Vec3};

/// A tapered capsule prepared for rays along z.
pub(crate) struct Cone {
    from: Vec3,
    to: Vec3,
    radius_from: f32,
    radius_to: f32,
    side: Option<Side>,
}

/// The cone between the balls; there is none when one ball holds the other.
struct Side {
    /// Unit vector from the first ball to the second.
    axis: Vec3,
    length: f32,
    /// Growth of the radius per length, k, and c = √(1 − k²).
    growth: f32,
    cosine: f32,
    /// 1 / A of the quadratic in `hit`.
    per_a: f32,
}

impl Cone {
    /// `None` if there is nothing to draw.
    pub fn new(from: Vec3, to: Vec3, radius_from: f32, radius_to: f32) -> Option<Cone> {
        let finite = from.is_finite() && to.is_finite() && radius_from.is_finite() && radius_to.is_finite();
        if !finite || radius_from <= 0.0 || radius_to <= 0.0 {
            return None;
        }
        let length = (to - from).length();
        let growth = (radius_to - radius_from) / length.max(1e-6);
        let side = (growth.abs() < 0.999 && length > 1e-3).then(|| {
            let axis = (to - from) / length;
            let cosine = (1.0 - growth * growth).sqrt();
            let a = cosine * cosine - axis.z * axis.z;
            Side { axis, length, growth, cosine, per_a: if a.abs() > 1e-6 { 1.0 / a } else { 0.0 } }
        });
        Some(Cone { from, to, radius_from, radius_to, side })
    }

    /// Depth of its point nearest to the viewer.
    pub fn nearest(&self) -> f32 {
        (self.from.z + self.radius_from).max(self.to.z + self.radius_to)
    }

    /// Depth of its point farthest from the viewer.
    pub fn farthest(&self) -> f32 {
        (self.from.z - self.radius_from).min(self.to.z - self.radius_to)
    }

    /// Lowest and highest y that it covers.
    pub fn rows(&self) -> (f32, f32) {
        let low = (self.from.y - self.radius_from).min(self.to.y - self.radius_to);
        (low, (self.from.y + self.radius_from).max(self.to.y + self.radius_to))
    }

    /// Minimum and maximum x that it covers at this y: of its silhouette, the hull of two discs.
    pub fn columns(&self, y: f32) -> Option<(f32, f32)> {
        let mut span: Option<(f32, f32)> = None;
        let mut hold = |low: f32, high: f32| {
            let (left, right) = span.unwrap_or((low, high));
            span = Some((left.min(low), right.max(high)));
        };
        for (centre, radius) in [(self.from, self.radius_from), (self.to, self.radius_to)] {
            let rest = radius * radius - (y - centre.y) * (y - centre.y);
            if rest >= 0.0 {
                let half = rest.sqrt();
                hold(centre.x - half, centre.x + half);
            }
        }
        let (from, to) = (self.from.truncate(), self.to.truncate());
        let length = (to - from).length();
        let growth = (self.radius_to - self.radius_from) / length.max(1e-6);
        if length > 1e-6 && growth.abs() < 1.0 {
            let along = (to - from) / length;
            let lean = (1.0 - growth * growth).sqrt();
            for side in [-1.0, 1.0] {
                let normal = along.perp() * (side * lean) - along * growth;
                let (start, end): (Vec2, Vec2) = (from + normal * self.radius_from, to + normal * self.radius_to);
                let share = (y - start.y) / (end.y - start.y);
                if (0.0..=1.0).contains(&share) {
                    let x = start.x + (end.x - start.x) * share;
                    hold(x, x);
                }
            }
        }
        span
    }

    /// Depth and unit normal of the surface nearest to the viewer on the ray through (x, y).
    #[inline]
    pub fn hit(&self, x: f32, y: f32) -> Option<(f32, Vec3)> {
        if let Some(side) = &self.side {
            // With h along the axis from the first ball, ρ across it and k, c as above, the distance to the surface is
            // c·ρ − k·h − r₀, so the surface is c²ρ² = (r₀ + k·h)². On the ray h = h₀ + s·a and ρ² = u² + s² − h², so
            // A·s² + 2B·s + C = 0 in the depth s, with A = c² − a².
            let (right, up) = (x - self.from.x, y - self.from.y);
            let along = right * side.axis.x + up * side.axis.y;
            let (k, radius) = (side.growth, self.radius_from);
            let b = -side.axis.z * (along + k * radius);
            let c = side.cosine * side.cosine * (right * right + up * up)
                - along * along
                - radius * (2.0 * k * along + radius);
            let root = b * b * side.per_a * side.per_a - c * side.per_a;
            if root >= 0.0 && side.per_a != 0.0 {
                let (middle, half) = (-b * side.per_a, root.sqrt());
                // The body is convex: a point of its surface that faces the viewer is the first the ray meets.
                for depth in [middle + half, middle - half] {
                    if let Some(hit) = self.on_side(side, Vec3::new(right, up, depth)) {
                        return Some(hit);
                    }
                }
            }
        }
        match (ball(self.from, self.radius_from, x, y), ball(self.to, self.radius_to, x, y)) {
            (Some(from), Some(to)) => Some(if to.0 > from.0 { to } else { from }),
            (from, to) => from.or(to),
        }
    }

    /// Depth and normal at a point of the cone, from the first ball's centre, if it lies between the balls and faces the
    /// viewer.
    #[inline]
    fn on_side(&self, side: &Side, point: Vec3) -> Option<(f32, Vec3)> {
        let along = point.dot(side.axis);
        // r₀ + k·h = c·ρ, so this is ρ/c; and the ball that touches the surface here lies at h + k·ρ/c.
        let across = (self.radius_from + side.growth * along) / (side.cosine * side.cosine);
        let centre = along + side.growth * across;
        let radius = self.radius_from + side.growth * centre;
        let faces = point.z >= side.axis.z * centre;
        (faces && across > 0.0 && centre >= 0.0 && centre <= side.length)
            .then(|| (self.from.z + point.z, (point - side.axis * centre) / radius))
    }
}

#[inline]
fn ball(centre: Vec3, radius: f32, x: f32, y: f32) -> Option<(f32, Vec3)> {
    let (right, up) = (x - centre.x, y - centre.y);
    let rest = radius * radius - right * right - up * up;
    (rest >= 0.0).then(|| {
        let depth = rest.sqrt();
        (centre.z + depth, Vec3::new(right, up, depth) / radius)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The depth at which marching towards the body first meets one of very many balls strung along the axis.
    fn hit_of_strung_balls(cone: &Cone, x: f32, y: f32) -> Option<f32> {
        (0..=4_000)
            .filter_map(|step| {
                let share = step as f32 / 4_000.0;
                let centre = cone.from.lerp(cone.to, share);
                ball(centre, cone.radius_from + (cone.radius_to - cone.radius_from) * share, x, y)
            })
            .map(|(depth, _)| depth)
            .fold(None, |best: Option<f32>, depth| Some(best.map_or(depth, |best| best.max(depth))))
    }

    #[test]
    fn a_tapered_capsule_is_the_hull_of_balls_strung_along_it() {
        let shapes = [
            (Vec3::new(10.0, -40.0, 5.0), Vec3::new(60.0, -20.0, -30.0), 12.0, 5.0),
            (Vec3::new(30.0, -30.0, 0.0), Vec3::new(31.0, -30.0, 60.0), 9.0, 14.0),
            (Vec3::new(30.0, -30.0, 60.0), Vec3::new(35.0, -33.0, 0.0), 6.0, 15.0),
            (Vec3::new(20.0, -20.0, 0.0), Vec3::new(22.0, -20.0, 0.0), 15.0, 4.0),
            (Vec3::new(20.0, -50.0, 0.0), Vec3::new(60.0, -50.0, 0.0), 8.0, 8.0),
        ];
        for (from, to, radius_from, radius_to) in shapes {
            let cone = Cone::new(from, to, radius_from, radius_to).unwrap();
            for row in 0..70 {
                for column in 0..80 {
                    let (x, y) = (column as f32 + 0.37, -(row as f32) - 0.61);
                    let expected = hit_of_strung_balls(&cone, x, y);
                    let found = cone.hit(x, y);
                    if expected.is_some() {
                        let ((low, high), (left, right)) = (cone.rows(), cone.columns(y).unwrap());
                        assert!(low <= y && y <= high && left <= x && x <= right, "{x} {y} is outside the silhouette");
                    }
                    match (expected, found) {
                        // The string of balls is bumpy by far less than this; the rim is steep.
                        (Some(expected), Some((found, normal))) => {
                            assert!((expected - found).abs() < 0.3, "{expected} {found} at {x} {y}");
                            assert!((normal.length() - 1.0).abs() < 0.02);
                        }
                        (None, None) => {}
                        // Only the very rim may differ, where the string of balls is a hair too thin.
                        (None, Some((_, normal))) => assert!(normal.z.abs() < 0.1, "{normal} at {x} {y}"),
                        (Some(_), None) => panic!("hole at {x} {y}"),
                    }
                }
            }
        }
    }
}
