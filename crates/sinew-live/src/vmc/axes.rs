//! Converts between Unity's axes (left-handed: facing +Z, +X to the right, Y up) and ours (right-handed, +X to the
//! left). Both are in metres; the conversion is its own inverse.

use glam::{DQuat, DVec3};

/// A position or direction, mirrored in x.
pub(super) fn mirrored(vector: DVec3) -> DVec3 {
    DVec3::new(-vector.x, vector.y, vector.z)
}

/// A rotation, mirrored: its axis is mirrored, and it turns the other way.
pub(super) fn mirrored_turn(rotation: DQuat) -> DQuat {
    DQuat::from_xyzw(rotation.x, -rotation.y, -rotation.z, rotation.w)
}

#[cfg(test)]
mod tests {
    use super::*;
    use sinew_body::humanoid::exp;

    #[test]
    fn mirroring_and_turning_can_change_places() {
        let (turn, place) = (exp(DVec3::new(0.3, -0.7, 1.1)), DVec3::new(1.0, 2.0, 3.0));
        let apart = mirrored(turn * place) - mirrored_turn(turn) * mirrored(place);
        // Rounding of one rotation.
        assert!(apart.length() < 1e-14);
    }
}
