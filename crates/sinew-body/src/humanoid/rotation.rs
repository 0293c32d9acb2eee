//! Rotation vectors, swing and twist.

use glam::{DQuat, DVec3};

/// The rotation about `vector` by its length \[rad\].
pub fn exp(vector: DVec3) -> DQuat {
    let half_squared = 0.25 * vector.length_squared();
    // Below this the series' next term is under 1e-17 relative.
    if half_squared < 1e-8 {
        let scale = 0.5 * (1.0 - half_squared / 6.0);
        let w = 1.0 - 0.5 * half_squared;
        let v = vector * scale;
        return DQuat::from_xyzw(v.x, v.y, v.z, w);
    }
    let half = half_squared.sqrt();
    let (sin, cos) = libm::sincos(half);
    let v = vector * (0.5 * sin / half);
    DQuat::from_xyzw(v.x, v.y, v.z, cos)
}

/// The rotation vector \[rad\] of length at most π whose [`exp`] is the rotation.
pub fn log(rotation: DQuat) -> DVec3 {
    let rotation = if rotation.w < 0.0 { -rotation } else { rotation };
    let v = DVec3::new(rotation.x, rotation.y, rotation.z);
    let sin_squared = v.length_squared();
    if sin_squared < 1e-16 {
        return v * 2.0;
    }
    let sin = sin_squared.sqrt();
    v * (2.0 * libm::atan2(sin, rotation.w) / sin)
}

/// Splits a rotation into a swing about an axis in the XZ plane and a twist about Y that happens first:
/// `rotation = swing * twist`. Returns the swing's rotation vector's x and z, and the twist angle, in radians.
///
/// A half turn of swing has no unique twist; there the twist is returned as 0.
pub fn swing_twist(rotation: DQuat) -> (f64, f64, f64) {
    let norm = (rotation.w * rotation.w + rotation.y * rotation.y).sqrt();
    let (twist, angle) = if norm < 1e-9 {
        (DQuat::IDENTITY, 0.0)
    } else {
        let sign = if rotation.w < 0.0 { -1.0 } else { 1.0 };
        let (w, y) = (sign * rotation.w / norm, sign * rotation.y / norm);
        (DQuat::from_xyzw(0.0, y, 0.0, w), 2.0 * libm::atan2(y, w))
    };
    let swing = log(rotation * twist.conjugate());
    (swing.x, swing.z, angle)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn log_inverts_exp_below_a_half_turn(x in -1.8..1.8f64, y in -1.8..1.8f64, z in -1.8..1.8f64) {
            let vector = DVec3::new(x, y, z);
            prop_assume!(vector.length() < 3.13);
            // Close to a half turn the logarithm loses digits with 1 / (π - angle).
            prop_assert!((log(exp(vector)) - vector).length() < 1e-11);
        }

        #[test]
        fn swing_times_twist_is_the_rotation(x in -3.0..3.0f64, y in -3.0..3.0f64, z in -3.0..3.0f64) {
            let rotation = exp(DVec3::new(x, y, z));
            let (sx, sz, twist) = swing_twist(rotation);
            let again = exp(DVec3::new(sx, 0.0, sz)) * exp(DVec3::new(0.0, twist, 0.0));
            prop_assert!(log(again.conjugate() * rotation).length() < 1e-9);
        }
    }

    #[test]
    fn a_tiny_rotation_keeps_its_digits() {
        let vector = DVec3::new(3e-9, -4e-9, 1e-12);
        assert!((log(exp(vector)) - vector).length() < 1e-22);
    }
}
