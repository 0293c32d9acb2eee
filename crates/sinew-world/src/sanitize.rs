//! Numbers from outside, made sound before the solver sees them: files, scripts and networks can state anything.

use crate::{Drive, Form, MAX_FORCE_N, Pin, Solid, Surface, WorldSettings};
use glam::{DQuat, DVec3};
use sinew_body::humanoid::{Body, Node};

/// Farther from the origin than this nothing may be, and nothing may be larger \[m\].
pub(crate) const FARTHEST_M: f64 = 1e4;

/// Thinnest size of a shape \[m\].
const THINNEST_M: f64 = 1e-4;

/// Largest speed that is given to anything \[m/s\]; the solver lets nothing go faster either.
pub(crate) const MAX_SPEED_M_S: f64 = 400.0;

/// Largest angular velocity that is given to anything \[rad/s\]: beyond it a step turns a part by more than half a turn.
pub(crate) const MAX_SPIN_RAD_S: f64 = 500.0;

/// Largest torque of a [`Drive`], or of a [`Pin`] on top of its spring \[N m\].
const MAX_TORQUE_N_M: f64 = 1e4;

/// Largest acceleration that a [`Pin`] asks for \[m/s²\].
const MAX_ACCELERATION_M_S2: f64 = 1e5;

/// Largest factor on gravity.
const MAX_GRAVITY_SCALE: f64 = 100.0;

/// Largest acceleration of gravity \[m/s²\].
const MAX_GRAVITY_M_S2: f64 = 1000.0;

/// Stiffness and damping stay below this, in whatever unit.
const MAX_GAIN: f64 = 1e9;

/// The rotation, normalised; `None` when it is none.
pub(crate) fn unit(rotation: DQuat) -> Option<DQuat> {
    let length = rotation.length();
    (length.is_finite() && length > 1e-6).then(|| rotation / length)
}

/// Whether a place lies in the world.
pub(crate) fn is_place(place: DVec3) -> bool {
    place.is_finite() && place.abs().max_element() < FARTHEST_M
}

/// The velocity, no faster than anything may be; `None` when it is not finite.
pub(crate) fn velocity(velocity: DVec3) -> Option<DVec3> {
    velocity.is_finite().then(|| shortened(velocity, MAX_SPEED_M_S))
}

/// The angular velocity, no faster than anything may be; `None` when it is not finite.
pub(crate) fn spin(spin: DVec3) -> Option<DVec3> {
    spin.is_finite().then(|| shortened(spin, MAX_SPIN_RAD_S))
}

/// The force, no larger than [`MAX_FORCE_N`]; `None` when it is not finite.
pub(crate) fn force(force: DVec3) -> Option<DVec3> {
    force.is_finite().then(|| shortened(force, MAX_FORCE_N))
}

/// The factor on gravity, within its bounds; `None` when it is not finite.
pub(crate) fn gravity_scale(scale: f64) -> Option<f64> {
    scale.is_finite().then(|| scale.clamp(-MAX_GRAVITY_SCALE, MAX_GRAVITY_SCALE))
}

/// Cuts a vector's length; finite vectors of any length (the square of 1e200 is not).
fn shortened(vector: DVec3, length: f64) -> DVec3 {
    let largest = vector.abs().max_element();
    if largest <= length { vector.clamp_length_max(length) } else { (vector / largest).normalize() * length }
}

/// A drive that the solver can take; `None` for numbers that are not finite, gains that are negative or too large, and a rotation
/// that is none.
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

/// A pin that the solver can take; `None` as for [`drive`].
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

/// The settings, every number within its bounds, those that are not finite as the default has them.
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

/// The surface, its numbers within their bounds.
pub(crate) fn surface(surface: Surface) -> Surface {
    let within = |number: f64, most: f64| if number.is_nan() { 0.0 } else { number.clamp(0.0, most) };
    Surface { friction: within(surface.friction, 10.0), bounce: within(surface.bounce, 1.0) }
}

/// Whether a shape has sizes that a thing in the world can have.
pub(crate) fn is_solid(solid: &Solid) -> bool {
    let size = |size: f64| (THINNEST_M..FARTHEST_M).contains(&size);
    let form = match &solid.form {
        Form::Ball { radius_m } => size(*radius_m),
        Form::Box { size_m } => size_m.to_array().into_iter().all(size),
        Form::Capsule { radius_m, length_m } => size(*radius_m) && (0.0..FARTHEST_M).contains(length_m),
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

/// Whether four of the points span a tetrahedron that is thicker than [`THINNEST_M`] in every direction.
fn has_volume(points: &[DVec3]) -> bool {
    let farthest = |distance: &dyn Fn(DVec3) -> f64| {
        points
            .iter()
            .copied()
            .max_by(|a, b| distance(*a).total_cmp(&distance(*b)))
            .filter(|&far| distance(far) > THINNEST_M)
    };
    let Some(&first) = points.first() else { return false };
    let Some(second) = farthest(&|point| (point - first).length()) else { return false };
    let along = (second - first).normalize();
    let off_line = |point: DVec3| (point - first) - along * (point - first).dot(along);
    let Some(third) = farthest(&|point| off_line(point).length()) else { return false };
    let normal = along.cross(off_line(third).normalize());
    farthest(&|point| (point - first).dot(normal).abs()).is_some()
}

/// The first part of a body that no ragdoll can be made of.
pub(crate) fn faulty_part(body: &Body) -> Option<Node> {
    Node::ALL.into_iter().find(|&node| {
        let (link, shape) = (body.link(node), body.link(node).shape);
        let size = |size: f64| (THINNEST_M..FARTHEST_M).contains(&size);
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
