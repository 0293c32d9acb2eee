//! The camera.

use std::f64::consts::{FRAC_PI_2, TAU};

use glam::DVec3;

/// An orthographic camera: equal lengths look equal at any distance.
///
/// ```
/// use glam::DVec3;
/// use sinew_picture::Camera;
/// // From the side, a body that faces +Z walks to the right of the picture.
/// let view = Camera::side().view();
/// assert!(view.right.dot(DVec3::Z) > 0.999);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    /// Azimuth of the viewer \[rad\]: 0 at +Z (in the face of a body that faces +Z), growing towards +X (its left).
    pub azimuth_rad: f64,
    /// Elevation of the viewer above the horizon \[rad\], clamped to ±π/2.
    pub elevation_rad: f64,
}

/// The picture's axes in the world; orthonormal.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct View {
    /// Towards the right of the picture; horizontal.
    pub right: DVec3,
    /// Towards the top of the picture.
    pub up: DVec3,
    /// Towards the viewer.
    pub toward: DVec3,
}

impl Camera {
    /// At the right hand of a body that faces +Z, slightly above: it walks from left to right.
    pub fn side() -> Camera {
        Camera { azimuth_rad: -FRAC_PI_2, elevation_rad: 0.14 }
    }

    /// Half in front, at the right hand of a body that faces +Z, slightly above: sideways pushes show as well.
    pub fn three_quarter() -> Camera {
        Camera { azimuth_rad: -0.92, elevation_rad: 0.21 }
    }

    /// In the face of a body that faces +Z.
    pub fn front() -> Camera {
        Camera { azimuth_rad: 0.0, elevation_rad: 0.14 }
    }

    /// The same camera about a body that faces `forward` instead of +Z. Only its horizontal direction counts; without
    /// any, the camera stays.
    #[must_use]
    pub fn about_heading(mut self, forward: DVec3) -> Camera {
        let turn = libm::atan2(forward.x, forward.z);
        if turn.is_finite() {
            self.azimuth_rad += turn;
        }
        self
    }

    /// The picture's axes in the world. Angles that are not finite count as 0.
    pub fn view(&self) -> View {
        let finite = |angle: f64| if angle.is_finite() { angle } else { 0.0 };
        let azimuth = finite(self.azimuth_rad) % TAU;
        let elevation = finite(self.elevation_rad).clamp(-FRAC_PI_2, FRAC_PI_2);
        let (sin, cos) = (libm::sin(azimuth), libm::cos(azimuth));
        let (rise, level) = (libm::sin(elevation), libm::cos(elevation));
        let right = DVec3::new(cos, 0.0, -sin);
        let toward = DVec3::new(sin * level, rise, cos * level);
        View { right, up: toward.cross(right), toward }
    }
}

impl Default for Camera {
    fn default() -> Camera {
        Camera::three_quarter()
    }
}

impl View {
    /// A direction or offset of the world in picture axes: right, up, toward the viewer.
    pub fn view_from_world(&self, offset: DVec3) -> DVec3 {
        DVec3::new(self.right.dot(offset), self.up.dot(offset), self.toward.dot(offset))
    }
}
