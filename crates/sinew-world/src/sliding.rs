//! Sliding friction that points against the sliding (Coulomb's law).
//!
//! The rigid-body library changes a contact's friction impulse by −K⁻¹ v and cuts it to μ N, with v the slip velocity and K the
//! inverse mass of the contact point in the tangent plane, a 2 × 2 matrix. While a contact slides, that ends where the impulse is
//! parallel to K⁻¹ v, not to v: a box is braked by too little along its edges, and bends its way askew to them. A tangent velocity
//! w = (K / κ − 1) v makes it parallel to v, because K⁻¹ (v + w) = v / κ. With κ the larger eigenvalue of K, w only lessens v.

use crate::character::Character;
use crate::engine::Engine;
use crate::prop::Prop;
use glam::DVec3;
use rapier3d_f64::geometry::NEW_CONTACT_BIT;
use rapier3d_f64::prelude::*;

/// Speed \[m/s\] and spin \[rad/s\] from which on a body's contacts may slide: less is stopped within a step by a friction of 0.1 or
/// more. The library recomputes the contacts of bodies with a hook in every step, which resting ones need not pay for.
const MAY_SLIDE_M_S: f64 = 0.03;
const MAY_SLIDE_RAD_S: f64 = 0.3;

/// Lets the library ask about the contacts of bodies that move.
pub(crate) fn prepare<'a>(
    engine: &mut Engine,
    characters: impl Iterator<Item = &'a Character>,
    props: impl Iterator<Item = &'a Prop>,
) {
    let parts = characters.flat_map(|character| character.bodies);
    for handle in parts.chain(props.map(|prop| prop.handle)) {
        let Some(body) = engine.bodies.get(handle) else { continue };
        let moves = !body.is_sleeping()
            && (body.linvel().length_squared() > MAY_SLIDE_M_S * MAY_SLIDE_M_S
                || body.angvel().length_squared() > MAY_SLIDE_RAD_S * MAY_SLIDE_RAD_S);
        for &collider in body.colliders() {
            set_hook(&mut engine.colliders, collider, ActiveHooks::MODIFY_SOLVER_CONTACTS, moves);
        }
    }
}

/// Switches one of a collider's hooks; the others stay.
pub(crate) fn set_hook(colliders: &mut ColliderSet, handle: ColliderHandle, hook: ActiveHooks, on: bool) {
    let Some(before) = colliders.get(handle).map(Collider::active_hooks) else { return };
    let mut hooks = before;
    hooks.set(hook, on);
    // Mutable access marks a collider as changed in the library.
    if hooks != before
        && let Some(collider) = colliders.get_mut(handle)
    {
        collider.set_active_hooks(hooks);
    }
}

/// Gives the contacts that slide the tangent velocity by which their friction opposes the slip.
pub(crate) fn oppose_slip(context: &mut ContactModificationContext<'_>) {
    let sides = [context.rigid_body1, context.rigid_body2].map(|handle| Side::of(context.bodies, handle));
    let Some(manifold) = context.rigid_mut() else { return };
    let normal = *manifold.normal;
    let [across, along] = tangents(normal);
    let friction = *manifold.friction;
    for contact in manifold.solver_contacts.iter_mut() {
        let id = usize::try_from(contact.contact_id[0] & !NEW_CONTACT_BIT).ok();
        let Some(known) = id.and_then(|id| manifold.manifold.points.get(id)) else { continue };
        let point = (contact.anchor1 + contact.anchor2) * 0.5;
        let slip = sides[0].velocity(point) - sides[1].velocity(point);
        let slip = [slip.dot(across), slip.dot(along)];
        let mobility = |direction: DVec3| sides[0].mobility(point, direction) + sides[1].mobility(point, direction);
        let (a, b) = (mobility(across), mobility(along));
        let (k11, k12, k22) = (a.dot(across), a.dot(along), b.dot(along));
        let turned = askew([k11, k12, k22], slip, friction * known.data.impulse);
        contact.tangent_velocity += across * turned[0] + along * turned[1];
    }
}

/// w of the module's page; nothing where friction can end the slip within the step. `most` is the largest friction impulse \[N s\], as
/// of the last step.
fn askew([k11, k12, k22]: [f64; 3], slip: [f64; 2], most: f64) -> [f64; 2] {
    let determinant = k11 * k22 - k12 * k12;
    let (mean, half) = ((k11 + k22) / 2.0, (k11 - k22) / 2.0);
    let largest = mean + (half * half + k12 * k12).sqrt();
    // A contact that is new bore nothing yet.
    if !(most > 0.0 && determinant > 0.0 && largest > 0.0) {
        return [0.0; 2];
    }
    let stop = [k22 * slip[0] - k12 * slip[1], k11 * slip[1] - k12 * slip[0]].map(|impulse| impulse / determinant);
    let stop = (stop[0] * stop[0] + stop[1] * stop[1]).sqrt();
    let share = (stop / most - 1.0).clamp(0.0, 1.0) / largest;
    [((k11 - largest) * slip[0] + k12 * slip[1]) * share, (k12 * slip[0] + (k22 - largest) * slip[1]) * share]
}

/// Two directions across a normal and each other.
fn tangents(normal: DVec3) -> [DVec3; 2] {
    let across = normal.any_orthonormal_vector();
    [across, normal.cross(across)]
}

/// One of the two bodies of a contact; the world itself has neither velocity nor mobility.
#[derive(Clone, Copy)]
struct Side<'a> {
    body: Option<&'a RigidBody>,
}

impl<'a> Side<'a> {
    fn of(bodies: &'a RigidBodySet, handle: Option<RigidBodyHandle>) -> Side<'a> {
        Side { body: handle.and_then(|handle| bodies.get(handle)) }
    }

    fn velocity(&self, point: DVec3) -> DVec3 {
        self.body.map_or(DVec3::ZERO, |body| body.velocity_at_point(point))
    }

    /// The change of a point's velocity by a unit impulse on it \[1/kg\].
    fn mobility(&self, point: DVec3, direction: DVec3) -> DVec3 {
        let Some(body) = self.body.filter(|body| body.is_dynamic()) else { return DVec3::ZERO };
        let properties = body.mass_properties();
        let arm = point - properties.world_com;
        let turn = properties.effective_world_inv_inertia * arm.cross(direction);
        properties.effective_inv_mass * direction + turn.cross(arm)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_slides_is_braked_against_its_slip_whatever_the_mobility() {
        let k = [3.0, 0.8, 1.2];
        for slip in [[1.0, 0.0], [0.0, -2.0], [0.6, 0.9]] {
            let added = askew(k, slip, 1e-3);
            let whole = [slip[0] + added[0], slip[1] + added[1]];
            let determinant = k[0] * k[2] - k[1] * k[1];
            let impulse = [k[2] * whole[0] - k[1] * whole[1], k[0] * whole[1] - k[1] * whole[0]]
                .map(|impulse| impulse / determinant);
            let cross = impulse[0] * slip[1] - impulse[1] * slip[0];
            // Rounding.
            assert!(cross.abs() < 1e-12 && impulse[0] * slip[0] + impulse[1] * slip[1] > 0.0, "{slip:?} {impulse:?}");
        }
    }

    #[test]
    fn what_friction_can_stop_within_the_step_is_left_to_stop() {
        assert_eq!(askew([3.0, 0.8, 1.2], [0.1, 0.1], 1.0), [0.0; 2]);
        assert_eq!(askew([3.0, 0.8, 1.2], [0.1, 0.1], 0.0), [0.0; 2], "and what bore nothing yet");
    }
}
