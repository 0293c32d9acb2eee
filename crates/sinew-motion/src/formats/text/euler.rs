//! Euler angles: composed to a rotation, and extracted on the branch nearest to given angles.

use glam::{DMat3, DQuat, DVec3};
use std::f64::consts::PI;

/// A coordinate axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Axis {
    X,
    Y,
    Z,
}

impl Axis {
    /// 0, 1, 2.
    pub(crate) fn index(self) -> usize {
        self as usize
    }

    /// The axis as a letter.
    pub(crate) fn letter(self) -> char {
        ['X', 'Y', 'Z'][self.index()]
    }

    /// The axis of a letter, in any case.
    pub(crate) fn of(letter: u8) -> Option<Axis> {
        match letter.to_ascii_uppercase() {
            b'X' => Some(Axis::X),
            b'Y' => Some(Axis::Y),
            b'Z' => Some(Axis::Z),
            _ => None,
        }
    }

    /// A rotation about this axis \[rad\].
    fn turn(self, angle: f64) -> DQuat {
        let (sin, cos) = libm::sincos(angle / 2.0);
        let mut parts = [0.0, 0.0, 0.0, cos];
        parts[self.index()] = sin;
        DQuat::from_array(parts)
    }

    /// The angle about this axis whose turn comes nearest to the rotation \[rad\].
    fn twist(self, rotation: DQuat) -> f64 {
        2.0 * libm::atan2(rotation.to_array()[self.index()], rotation.w)
    }
}

/// The product of the turns, first axis outermost: about the axes of the turning body (intrinsic) in the order
/// given, or about fixed axes in the reverse order \[deg\].
pub(crate) fn compose(axes: &[Axis], degrees: &[f64]) -> DQuat {
    let turns = axes.iter().zip(degrees).map(|(axis, angle)| axis.turn(angle.to_radians()));
    turns.reduce(|all, turn| all * turn).unwrap_or(DQuat::IDENTITY)
}

/// Angles for a rotation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Angles {
    /// One per axis, the rest 0 \[deg\].
    pub(crate) degrees: [f64; 3],
    /// How far the angles are from the rotation, where there are fewer than three axes \[rad\].
    pub(crate) loss_rad: f64,
}

/// The angles about up to three different axes that make the rotation (see [`compose`]), of all that do those
/// nearest to `reference` \[deg\]. With fewer than three axes the angles come as near to the rotation as they can.
///
/// `None` for a quaternion without direction (zero or not finite).
pub(crate) fn nearest(rotation: DQuat, axes: &[Axis], reference: &[f64]) -> Option<Angles> {
    let length = rotation.length();
    if !(length.is_finite() && length > 1e-6) {
        return None;
    }
    let rotation = rotation / length;
    let mut near = [0.0; 3];
    for (near, reference) in near.iter_mut().zip(reference) {
        *near = *reference;
    }
    let radians = match *axes {
        [] => [0.0; 3],
        [a] => [a.twist(rotation), 0.0, 0.0],
        [a, b] => two(rotation, a, b, near),
        [a, b, c, ..] => three(rotation, [a, b, c], near),
    };
    let mut degrees = [0.0; 3];
    for index in 0..axes.len().min(3) {
        degrees[index] = unwind(radians[index].to_degrees(), near[index]);
    }
    let rest = compose(axes, &degrees).conjugate() * rotation;
    let loss_rad = 2.0 * libm::atan2(DVec3::new(rest.x, rest.y, rest.z).length(), rest.w.abs());
    Some(Angles { degrees, loss_rad })
}

/// The angle, whole turns added, nearest to the reference \[deg\].
fn unwind(angle: f64, reference: f64) -> f64 {
    angle + 360.0 * ((reference - angle) / 360.0).round()
}

/// Squared distance from the reference over whole turns \[deg²\].
fn distance(radians: [f64; 3], reference: [f64; 3]) -> f64 {
    let apart = |index: usize| unwind(radians[index].to_degrees(), reference[index]) - reference[index];
    (0..3).map(|index| apart(index) * apart(index)).sum()
}

/// Both solutions are `(α, β, γ)` and `(α + π, π - β, γ + π)`. The first angle comes from the matrix; the other two
/// from what is left when it is taken off, so that its error at gimbal lock, where only the sum or difference of the
/// outer angles is known, goes into the third.
fn three(rotation: DQuat, axes: [Axis; 3], reference: [f64; 3]) -> [f64; 3] {
    // Below this cosine of the middle angle (gimbal lock) the first angle is noise: the reference's is as good.
    const LOCKED: f64 = 1e-8;
    let [a, b, c] = axes.map(Axis::index);
    let sign = if (a + 1) % 3 == b { 1.0 } else { -1.0 };
    let matrix = DMat3::from_quat(rotation);
    let (sin, cos) = (-sign * matrix.col(c)[b], matrix.col(c)[c]);
    let rest = |first: f64| {
        let left = DMat3::from_quat(axes[0].turn(-first) * rotation);
        let middle = libm::atan2(sign * left.col(c)[a], left.col(c)[c]);
        [first, middle, libm::atan2(sign * left.col(a)[b], left.col(b)[b])]
    };
    if libm::hypot(sin, cos) < LOCKED {
        return rest(reference[0].to_radians());
    }
    let first = libm::atan2(sin, cos);
    let (one, other) = (rest(first), rest(first + PI));
    if distance(one, reference) <= distance(other, reference) { one } else { other }
}

/// Two axes hold only some rotations: of the others the nearest is approached by turns about each axis.
fn two(rotation: DQuat, a: Axis, b: Axis, reference: [f64; 3]) -> [f64; 3] {
    const EXACT: f64 = 1e-9;
    const ROUNDS: usize = 64;
    let third = [Axis::X, Axis::Y, Axis::Z].into_iter().find(|&axis| axis != a && axis != b).unwrap_or(Axis::X);
    let [mut first, mut second, rest] = three(rotation, [a, b, third], reference);
    // Of the two solutions with a third axis, the one that turns less about it.
    if rest.abs() > PI / 2.0 {
        (first, second) = (first + PI, PI - second);
    }
    if libm::sin(rest).abs() < EXACT {
        return [first, second, 0.0];
    }
    for _ in 0..ROUNDS {
        let before = (first, second);
        first = a.twist(rotation * b.turn(-second));
        second = b.twist(a.turn(-first) * rotation);
        if (first - before.0).abs() + (second - before.1).abs() < 1e-12 {
            break;
        }
    }
    [first, second, 0.0]
}

#[cfg(test)]
mod tests {
    use super::*;

    const ORDERS: [[Axis; 3]; 6] = [
        [Axis::X, Axis::Y, Axis::Z],
        [Axis::X, Axis::Z, Axis::Y],
        [Axis::Y, Axis::X, Axis::Z],
        [Axis::Y, Axis::Z, Axis::X],
        [Axis::Z, Axis::X, Axis::Y],
        [Axis::Z, Axis::Y, Axis::X],
    ];

    #[test]
    fn angles_come_back_as_they_were_on_every_branch() {
        for order in ORDERS {
            for angles in [[10.0, 20.0, 30.0], [-170.0, 100.0, 400.0], [0.0, -95.0, -725.0], [179.9, 89.0, 3.0]] {
                let found = nearest(compose(&order, &angles), &order, &angles).unwrap();
                for index in 0..3 {
                    // 1e-11: a few rounding errors over cos 89 degrees, in degrees.
                    assert!((found.degrees[index] - angles[index]).abs() < 1e-11, "{order:?} {angles:?} {found:?}");
                }
            }
        }
    }

    #[test]
    fn gimbal_lock_keeps_the_first_angle_of_the_reference() {
        for order in ORDERS {
            for middle in [90.0, -90.0, 270.0] {
                let angles = [37.0, middle, -12.0];
                let found = nearest(compose(&order, &angles), &order, &angles).unwrap();
                for index in 0..3 {
                    // 1e-6 degrees: the cosine below which a middle angle counts as locked.
                    assert!((found.degrees[index] - angles[index]).abs() < 1e-6, "{order:?} {angles:?} {found:?}");
                }
                // Another reference: other angles, the same rotation.
                let other = nearest(compose(&order, &angles), &order, &[0.0, 0.0, 0.0]).unwrap();
                let apart = compose(&order, &other.degrees).angle_between(compose(&order, &angles));
                assert!(apart < 1e-7, "{apart}");
            }
        }
    }

    #[test]
    fn fewer_axes_come_as_near_as_they_can() {
        let exact = compose(&[Axis::Z, Axis::X], &[130.0, -50.0]);
        let found = nearest(exact, &[Axis::Z, Axis::X], &[0.0, 0.0]).unwrap();
        assert!(found.loss_rad < 1e-9, "{found:?}");
        let bent = compose(&[Axis::Z, Axis::X, Axis::Y], &[30.0, -50.0, 10.0]);
        let found = nearest(bent, &[Axis::Z, Axis::X], &[30.0, -50.0]).unwrap();
        assert!(found.loss_rad > 0.01 && found.loss_rad <= 10f64.to_radians(), "{found:?}");
        for step in [0.01, -0.01] {
            for index in 0..2 {
                let mut near = found.degrees;
                near[index] += step;
                let apart = compose(&[Axis::Z, Axis::X], &near).conjugate() * bent;
                let apart = 2.0 * libm::asin(apart.xyz().length());
                assert!(apart >= found.loss_rad, "a neighbour is nearer: {apart} {found:?}");
            }
        }
        let alone = nearest(compose(&[Axis::Y], &[200.0]), &[Axis::Y], &[190.0]).unwrap();
        assert!((alone.degrees[0] - 200.0).abs() < 1e-9 && alone.loss_rad < 1e-12);
        assert!(nearest(exact, &[], &[]).unwrap().loss_rad > 1.0);
    }
}
