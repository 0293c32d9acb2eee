//! Intersection of a ray along the view axis with a box: what three slabs have in common.

use glam::Vec3;

/// A box that is prepared for rays along z.
pub(crate) struct Slabs {
    centre: Vec3,
    /// Unit vectors along its edges, perpendicular to each other.
    axes: [Vec3; 3],
    /// Half its length along each.
    half: Vec3,
    /// Half its extent along x, y and z.
    reach: Vec3,
}

impl Slabs {
    /// `None` if there is nothing to draw.
    pub fn new(centre: Vec3, axes: [Vec3; 3], half: Vec3) -> Option<Slabs> {
        let finite = centre.is_finite() && axes.iter().all(|axis| axis.is_finite()) && half.is_finite();
        if !finite || half.min_element() <= 0.0 {
            return None;
        }
        let reach = axes[0].abs() * half.x + axes[1].abs() * half.y + axes[2].abs() * half.z;
        Some(Slabs { centre, axes, half, reach })
    }

    /// Depth of its point nearest to the viewer, and of the one farthest away.
    pub fn depths(&self) -> (f32, f32) {
        (self.centre.z - self.reach.z, self.centre.z + self.reach.z)
    }

    /// Lowest and highest y that it covers.
    pub fn rows(&self) -> (f32, f32) {
        (self.centre.y - self.reach.y, self.centre.y + self.reach.y)
    }

    /// Minimum and maximum x that it covers at any y.
    pub fn columns(&self) -> (f32, f32) {
        (self.centre.x - self.reach.x, self.centre.x + self.reach.x)
    }

    /// Depth and unit normal of the surface nearest to the viewer on the ray through (x, y).
    pub fn hit(&self, x: f32, y: f32) -> Option<(f32, Vec3)> {
        let (right, up) = (x - self.centre.x, y - self.centre.y);
        let (mut near, mut far, mut normal) = (f32::INFINITY, f32::NEG_INFINITY, Vec3::Z);
        // On the ray each slab is an interval of depths.
        for (axis, half) in self.axes.iter().zip(self.half.to_array()) {
            let across = axis.x * right + axis.y * up;
            if axis.z.abs() < 1e-6 {
                if across.abs() > half {
                    return None;
                }
                continue;
            }
            let (one, other) = ((-half - across) / axis.z, (half - across) / axis.z);
            if one.max(other) < near {
                (near, normal) = (one.max(other), *axis * axis.z.signum());
            }
            far = far.max(one.min(other));
        }
        (far <= near && near.is_finite()).then_some((self.centre.z + near, normal))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::Quat;

    #[test]
    fn a_ray_meets_a_box_where_marching_along_it_first_is_inside() {
        let turn = Quat::from_xyzw(0.3, 0.5, -0.2, 0.7).normalize();
        let axes = [turn * Vec3::X, turn * Vec3::Y, turn * Vec3::Z];
        let (centre, half) = (Vec3::new(20.0, -15.0, 3.0), Vec3::new(9.0, 5.0, 12.0));
        let slabs = Slabs::new(centre, axes, half).unwrap();
        let mut met = 0;
        for column in 0..40 {
            for row in 0..30 {
                let (x, y) = (column as f32 + 0.3, -(row as f32) - 0.4);
                let inside = |depth: f32| {
                    let from = Vec3::new(x, y, depth) - centre;
                    axes.iter().zip(half.to_array()).all(|(axis, half)| axis.dot(from).abs() <= half)
                };
                let marched = (0..4_000).map(|step| 30.0 - 0.015 * step as f32).find(|&depth| inside(depth));
                let hit = slabs.hit(x, y);
                if let (Some(marched), Some((depth, normal))) = (marched, hit) {
                    met += 1;
                    // A step of the march.
                    assert!((marched - depth).abs() < 0.016, "{marched} {depth}");
                    assert!((normal.length() - 1.0).abs() < 1e-4 && normal.z > 0.0);
                    let ((low, high), (left, right)) = (slabs.rows(), slabs.columns());
                    assert!(low <= y && y <= high && left <= x && x <= right);
                } else {
                    // At the very rim the march may step over the box.
                    assert!(marched.is_none(), "{x} {y}");
                }
            }
        }
        assert!(met > 200);
    }
}
