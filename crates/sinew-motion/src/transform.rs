//! A rigid transform.

use glam::{DQuat, DVec3};
use std::ops::Mul;

/// A rotation followed by a translation: `parent_from_child * point_in_child`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Transform {
    /// Unit quaternion.
    pub rotation: DQuat,
    /// Position of the child's origin in the parent's frame \[m\].
    pub translation: DVec3,
}

impl Transform {
    /// No rotation, no translation.
    pub const IDENTITY: Transform = Transform { rotation: DQuat::IDENTITY, translation: DVec3::ZERO };

    /// The transform with this rotation and translation.
    pub const fn new(rotation: DQuat, translation: DVec3) -> Transform {
        Transform { rotation, translation }
    }

    /// The point, given in the child's frame, in the parent's frame \[m\].
    pub fn point(&self, point_in_child: DVec3) -> DVec3 {
        self.rotation * point_in_child + self.translation
    }

    /// `child_from_parent`.
    pub fn inverse(&self) -> Transform {
        let rotation = self.rotation.conjugate();
        Transform { rotation, translation: -(rotation * self.translation) }
    }
}

impl Mul for Transform {
    type Output = Transform;

    fn mul(self, other: Transform) -> Transform {
        Transform { rotation: self.rotation * other.rotation, translation: self.point(other.translation) }
    }
}
