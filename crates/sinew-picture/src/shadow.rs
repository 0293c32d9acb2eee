//! Shadows on the floor: they show how high above it a foot or a thing is.

use glam::{DVec3, Vec2};

use crate::{Capsule, Cuboid};

/// 0 below 0, 1 above 1, and no corner between.
pub(crate) fn smooth(share: f32) -> f32 {
    let share = share.clamp(0.0, 1.0);
    share * share * (3.0 - 2.0 * share)
}

/// A shape projected to the floor; positions from the followed point, x and z \[m\].
pub(crate) struct Shadow {
    footprint: Footprint,
    /// Maximum distance from the footprint at which it still darkens the floor \[m\].
    reach: f32,
}

enum Footprint {
    /// Of a capsule: both ends, each with the height of its underside over the floor and its radius \[m\].
    Line { from: Vec2, to: Vec2, gap: (f32, f32), radius: (f32, f32) },
    /// Of a box: its convex outline, counter-clockwise, and the height of its lowest corner \[m\].
    Outline { corners: Vec<Vec2>, gap: f32 },
}

/// Height above which a shadow is too faint and wide to see \[m\].
const HIGH_M: f32 = 1.3;
/// Rounding of a box's shadow \[m\].
const BOX_M: f32 = 0.03;

impl Shadow {
    pub fn of_capsule(capsule: &Capsule, origin: DVec3) -> Option<Shadow> {
        let gap = |end: DVec3, radius_m: f64| (end.y - origin.y - radius_m).max(0.0) as f32;
        let gap = (gap(capsule.from, capsule.radius_from_m), gap(capsule.to, capsule.radius_to_m));
        let radius = (capsule.radius_from_m as f32, capsule.radius_to_m as f32);
        let reach = radius.0.max(radius.1) * 1.6 + 0.10 + gap.0.max(gap.1) * 0.35;
        let (from, to) = (on_floor(capsule.from, origin), on_floor(capsule.to, origin));
        let footprint = Footprint::Line { from, to, gap, radius };
        (gap.0.min(gap.1) < HIGH_M).then_some(Shadow { footprint, reach })
    }

    pub fn of_box(cuboid: &Cuboid, origin: DVec3) -> Option<Shadow> {
        let corners = cuboid.corners();
        let lowest = corners.iter().map(|corner| corner.y).fold(f64::INFINITY, f64::min);
        let highest = corners.iter().map(|corner| corner.y).fold(f64::NEG_INFINITY, f64::max);
        let gap = (lowest - origin.y).max(0.0) as f32;
        // What lies under the floor throws no shadow on it.
        let shows = gap < HIGH_M && highest > origin.y + 1e-3;
        let footprint = Footprint::Outline { corners: outline(corners.map(|corner| on_floor(corner, origin))), gap };
        shows.then_some(Shadow { footprint, reach: BOX_M * 1.6 + 0.10 + gap * 0.35 })
    }

    /// Whether any of it lies at this distance from the followed point in the direction `away` \[m\].
    pub fn reaches(&self, depth: f32, away: DVec3) -> bool {
        let away = Vec2::new(away.x as f32, away.z as f32);
        let (low, high) = match &self.footprint {
            Footprint::Line { from, to, .. } => (from.dot(away).min(to.dot(away)), from.dot(away).max(to.dot(away))),
            Footprint::Outline { corners, .. } => corners
                .iter()
                .map(|corner| corner.dot(away))
                .fold((f32::INFINITY, f32::NEG_INFINITY), |(low, high), at| (low.min(at), high.max(at))),
        };
        depth >= low - self.reach && depth <= high + self.reach
    }

    /// Contact shadow (dark, close) and ambient shadow (faint, wide) under a point of the floor.
    fn at(&self, point: Vec2) -> (f32, f32) {
        let (away, gap, radius) = match &self.footprint {
            Footprint::Line { from, to, gap, radius } => {
                let axis = *to - *from;
                let share = ((point - *from).dot(axis) / axis.length_squared().max(1e-9)).clamp(0.0, 1.0);
                let away = (point - *from - axis * share).length();
                (away, gap.0 + (gap.1 - gap.0) * share, radius.0 + (radius.1 - radius.0) * share)
            }
            Footprint::Outline { corners, gap } => (outside(corners, point), *gap, BOX_M),
        };
        if away > self.reach {
            return (0.0, 0.0);
        }
        let contact_reach = radius * 1.15 + 0.02 + gap * 0.35;
        let wide_reach = radius * 1.6 + 0.10 + gap * 0.35;
        let steep = gap / 0.045;
        (
            0.62 / (1.0 + steep * steep) * smooth(1.0 - away / contact_reach),
            0.16 / (1.0 + gap * 1.5) * smooth(1.0 - away / wide_reach),
        )
    }
}

fn on_floor(point: DVec3, origin: DVec3) -> Vec2 {
    Vec2::new((point.x - origin.x) as f32, (point.z - origin.z) as f32)
}

/// The convex outline of points, counter-clockwise (Andrew's monotone chain).
fn outline(mut points: [Vec2; 8]) -> Vec<Vec2> {
    points.sort_by(|a, b| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)));
    let mut corners: Vec<Vec2> = Vec::with_capacity(9);
    let add = |least: usize, corners: &mut Vec<Vec2>, point: Vec2| {
        while let [.., before, last] = corners[..]
            && corners.len() > least
            && (last - before).perp_dot(point - last) <= 0.0
        {
            corners.pop();
        }
        corners.push(point);
    };
    for point in points {
        add(1, &mut corners, point);
    }
    let least = corners.len();
    for point in points.into_iter().rev().skip(1) {
        add(least, &mut corners, point);
    }
    corners.pop();
    corners
}

/// Distance of a point from a convex outline; 0 inside.
fn outside(corners: &[Vec2], point: Vec2) -> f32 {
    let mut nearest = f32::INFINITY;
    let mut inside = true;
    for (index, &from) in corners.iter().enumerate() {
        let to = corners[(index + 1) % corners.len()];
        let axis = to - from;
        inside &= axis.perp_dot(point - from) >= 0.0;
        let share = ((point - from).dot(axis) / axis.length_squared().max(1e-12)).clamp(0.0, 1.0);
        nearest = nearest.min((point - from - axis * share).length());
    }
    if inside { 0.0 } else { nearest }
}

/// How dark all shadows together make a point of the floor, 0 to 1.
pub(crate) fn total(shadows: &[&Shadow], point: Vec2) -> f32 {
    let (mut contact, mut light) = (0.0f32, 1.0f32);
    for shadow in shadows {
        let (close, wide) = shadow.at(point);
        contact = contact.max(close);
        light *= 1.0 - wide;
    }
    1.0 - (1.0 - contact) * light.max(0.72)
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DQuat;

    #[test]
    fn a_lifted_foot_leaves_a_fainter_shadow_than_one_on_the_floor() {
        let foot = |height: f64| {
            let ends = (DVec3::new(0.0, height, 0.0), DVec3::new(0.0, height, 0.2));
            Shadow::of_capsule(&crate::Capsule::new(ends.0, ends.1, 0.04, crate::Shade::Left), DVec3::ZERO)
        };
        let dark = |height: f64| total(&[&foot(height).unwrap()], Vec2::new(0.0, 0.1));
        assert!(dark(0.04) > 1.5 * dark(0.09), "{} {}", dark(0.04), dark(0.09));
    }

    #[test]
    fn the_shadow_of_a_box_is_as_dark_under_its_middle_as_under_its_rim_and_ends_beside_it() {
        let cuboid = Cuboid {
            centre: DVec3::new(0.0, 0.25, 0.0),
            rotation: DQuat::from_rotation_y(0.4),
            size_m: DVec3::new(1.0, 0.5, 0.6),
            shade: crate::Shade::Object,
        };
        let shadow = Shadow::of_box(&cuboid, DVec3::ZERO).unwrap();
        let rim = (DQuat::from_rotation_y(0.4) * DVec3::new(0.49, 0.0, 0.29)).as_vec3();
        let dark = |x: f32, z: f32| total(&[&shadow], Vec2::new(x, z));
        assert_eq!(dark(0.0, 0.0), dark(rim.x, rim.z));
        assert!(dark(0.0, 0.0) > 0.5 && dark(rim.x * 1.5, rim.z * 1.5) < 0.05);
    }
}
