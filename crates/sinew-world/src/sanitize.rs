//! Sanitizes numbers from outside before the solver uses them: clamps them to their ranges and rejects NaN, infinite
//! and degenerate values. Files, scripts and networks can state anything.

use crate::{Drive, Form, MAX_FORCE_N, Pin, Solid, Surface, WorldSettings};
use glam::{DQuat, DVec3};
use sinew_body::humanoid::{Body, Node};

/// Maximum distance from the origin, and maximum size \[m\].
pub(crate) const MAX_DISTANCE_M: f64 = 1e4;

/// Minimum size of a shape \[m\].
const MIN_SIZE_M: f64 = 1e-4;

/// Maximum speed that can be set \[m/s\]; the solver clamps to it too.
pub(crate) const MAX_SPEED_M_S: f64 = 400.0;

/// Maximum angular velocity that can be set \[rad/s\]: beyond it a step turns a part by more than half a turn.
pub(crate) const MAX_SPIN_RAD_S: f64 = 500.0;

/// Maximum additional torque of a [`Drive`] or a [`Pin`] \[N m\].
const MAX_TORQUE_N_M: f64 = 1e4;

/// Maximum acceleration of a [`Pin`] \[m/s²\].
const MAX_ACCELERATION_M_S2: f64 = 1e5;

/// Maximum factor on gravity.
const MAX_GRAVITY_SCALE: f64 = 100.0;

/// Maximum acceleration of gravity \[m/s²\].
const MAX_GRAVITY_M_S2: f64 = 1000.0;

/// Maximum stiffness and damping, in any unit.
const MAX_GAIN: f64 = 1e9;

/// The normalised rotation; `None` if it is invalid.
pub(crate) fn unit(rotation: DQuat) -> Option<DQuat> {
    let length = rotation.length();
    (length.is_finite() && length > 1e-6).then(|| rotation / length)
}

/// Whether a position is finite and within the world's bounds.
pub(crate) fn is_place(place: DVec3) -> bool {
    place.is_finite() && place.abs().max_element() < MAX_DISTANCE_M
}

/// The velocity, clamped to the maximum speed; `None` if it is not finite.
pub(crate) fn velocity(velocity: DVec3) -> Option<DVec3> {
    velocity.is_finite().then(|| shortened(velocity, MAX_SPEED_M_S))
}

/// The angular velocity, clamped to the maximum; `None` if it is not finite.
pub(crate) fn spin(spin: DVec3) -> Option<DVec3> {
    spin.is_finite().then(|| shortened(spin, MAX_SPIN_RAD_S))
}

/// The force, clamped to [`MAX_FORCE_N`]; `None` if it is not finite.
pub(crate) fn force(force: DVec3) -> Option<DVec3> {
    force.is_finite().then(|| shortened(force, MAX_FORCE_N))
}

/// The factor on gravity, clamped; `None` if it is not finite.
pub(crate) fn gravity_scale(scale: f64) -> Option<f64> {
    scale.is_finite().then(|| scale.clamp(-MAX_GRAVITY_SCALE, MAX_GRAVITY_SCALE))
}

/// Clamps a vector's length; works for finite vectors of any length (the square of 1e200 is infinite).
fn shortened(vector: DVec3, length: f64) -> DVec3 {
    let largest = vector.abs().max_element();
    if largest <= length { vector.clamp_length_max(length) } else { (vector / largest).normalize() * length }
}

/// A valid drive; `None` for numbers that are not finite, gains that are negative or too large, and an invalid
/// rotation.
pub(crate) fn drive(drive: Drive) -> Option<Drive> {
    let gains = (0.0..MAX_GAIN).contains(&drive.stiffness) && (0.0..MAX_GAIN).contains(&drive.damping);
    if !(gains && drive.torque.is_finite()) {
        return None;
    }
    Some(Drive {
        rotation: unit(drive.rotation)?,
        velocity: spin(drive.velocity)?,
        torque: shortened(drive.torque, MAX_TORQUE_N_M),
        ..drive
    })
}

/// A valid pin; `None` as for [`drive`].
pub(crate) fn pin(pin: Pin) -> Option<Pin> {
    let gains = [pin.stiffness, pin.damping, pin.turn_stiffness, pin.turn_damping];
    let gains = gains.iter().all(|gain| (0.0..MAX_GAIN).contains(gain));
    let shares = pin.gravity_share.is_finite() && !pin.max_force_n.is_nan();
    if !(gains && shares && is_place(pin.position) && pin.torque.is_finite() && pin.acceleration.is_finite()) {
        return None;
    }
    Some(Pin {
        rotation: unit(pin.rotation)?,
        velocity: velocity(pin.velocity)?,
        angular_velocity: spin(pin.angular_velocity)?,
        acceleration: shortened(pin.acceleration, MAX_ACCELERATION_M_S2),
        torque: shortened(pin.torque, MAX_TORQUE_N_M),
        gravity_share: pin.gravity_share.clamp(0.0, 1.0),
        max_force_n: pin.max_force_n.clamp(0.0, MAX_FORCE_N),
        ..pin
    })
}

/// The settings with every number clamped to its range; those that are not finite become the default.
pub(crate) fn settings(settings: WorldSettings) -> WorldSettings {
    let usual = WorldSettings::default();
    let finite = |number: f64, or: f64| if number.is_finite() { number } else { or };
    WorldSettings {
        physics_hz: finite(settings.physics_hz, usual.physics_hz).clamp(60.0, 2000.0),
        gravity_m_s2: finite(settings.gravity_m_s2, usual.gravity_m_s2).clamp(-MAX_GRAVITY_M_S2, MAX_GRAVITY_M_S2),
        solver_iterations: settings.solver_iterations.clamp(1, 64),
        solver_sweeps: settings.solver_sweeps.clamp(1, 64),
        floor: settings.floor.map(surface),
    }
}

/// The surface with its numbers clamped.
pub(crate) fn surface(surface: Surface) -> Surface {
    let within = |number: f64, most: f64| if number.is_nan() { 0.0 } else { number.clamp(0.0, most) };
    Surface { friction: within(surface.friction, 10.0), bounce: within(surface.bounce, 1.0) }
}

/// Whether a shape is valid: finite, not degenerate and within the bounds of the world.
pub(crate) fn is_solid(solid: &Solid) -> bool {
    let size = |size: f64| (MIN_SIZE_M..MAX_DISTANCE_M).contains(&size);
    let form = match &solid.form {
        Form::Ball { radius_m } => size(*radius_m),
        Form::Box { size_m } => size_m.to_array().into_iter().all(size),
        Form::Capsule { radius_m, length_m } => size(*radius_m) && (0.0..MAX_DISTANCE_M).contains(length_m),
        Form::Ring { radius_m, tube_m } => size(*radius_m) && size(*tube_m) && tube_m < radius_m,
        Form::Mesh { points_m, triangles } => {
            let known = |index: &u32| (*index as usize) < points_m.len();
            points_m.iter().copied().all(is_place)
                && !triangles.is_empty()
                && triangles.iter().all(|triangle| triangle.iter().all(known))
        }
        Form::Hull { points_m } => points_m.iter().copied().all(is_place) && has_volume(points_m),
    };
    form && is_place(solid.centre) && unit(solid.rotation).is_some()
}

/// Whether four of the points span a tetrahedron that is thicker than [`MIN_SIZE_M`] in every direction.
fn has_volume(points: &[DVec3]) -> bool {
    let farthest = |distance: &dyn Fn(DVec3) -> f64| {
        points
            .iter()
            .copied()
            .max_by(|a, b| distance(*a).total_cmp(&distance(*b)))
            .filter(|&far| distance(far) > MIN_SIZE_M)
    };
    let Some(&first) = points.first() else { return false };
    let Some(second) = farthest(&|point| (point - first).length()) else { return false };
    let along = (second - first).normalize();
    let off_line = |point: DVec3| (point - first) - along * (point - first).dot(along);
    let Some(third) = farthest(&|point| off_line(point).length()) else { return false };
    let normal = along.cross(off_line(third).normalize());
    farthest(&|point| (point - first).dot(normal).abs()).is_some()
}

/// The first part of a body that is invalid for a ragdoll.
pub(crate) fn faulty_part(body: &Body) -> Option<Node> {
    Node::ALL.into_iter().find(|&node| {
        let (link, shape) = (body.link(node), body.link(node).shape);
        let size = |size: f64| (MIN_SIZE_M..MAX_DISTANCE_M).contains(&size);
        let sound = (1e-6..1e6).contains(&link.mass_kg)
            && [link.offset, link.tip, link.centre, shape.from, shape.to].into_iter().all(is_place)
            && link.inertia.is_finite()
            && link.inertia.min_element() >= 0.0
            && size(shape.from_radius_m)
            && size(shape.to_radius_m)
            && size(body.stature_m());
        !sound
    })
}
