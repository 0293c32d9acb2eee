//! A prop in the world.

use crate::engine::{Engine, tag};
use crate::solid::Form;
use crate::{Entity, Motion, PropId, PropSpec, SpecError, sanitize};
use glam::DVec3;
use rapier3d_f64::prelude::*;

#[derive(Clone)]
pub(crate) struct Prop {
    pub spec: PropSpec,
    pub handle: RigidBodyHandle,
    /// Of a moving prop \[m/s²\].
    pub acceleration: DVec3,
}

sinew_snapshot::snapshot!(Prop { acceleration } fixed { spec, handle });

impl Prop {
    pub fn build(engine: &mut Engine, spec: PropSpec, id: PropId) -> Result<Prop, SpecError> {
        let (Some(rotation), Some(velocity), Some(spin), Some(gravity_scale)) = (
            sanitize::unit(spec.rotation).filter(|_| sanitize::is_place(spec.position)),
            sanitize::velocity(spec.velocity),
            sanitize::spin(spec.spin),
            sanitize::gravity_scale(spec.gravity_scale),
        ) else {
            return Err(SpecError::NotFinite);
        };
        let drag = if spec.drag_per_s.is_finite() { spec.drag_per_s.clamp(0.0, 1e3) } else { 0.0 };
        let surface = sanitize::surface(spec.surface);
        let shape = spec.solid.shape().ok_or(SpecError::NoShape)?;
        let (kind, mass) = match spec.motion {
            Motion::Fixed => (RigidBodyType::Fixed, None),
            Motion::Moving => (RigidBodyType::KinematicVelocityBased, None),
            Motion::Dynamic { mass_kg } => (RigidBodyType::Dynamic, Some(mass_kg)),
        };
        if mass.is_some() && matches!(spec.solid.form, Form::Mesh { .. }) {
            return Err(SpecError::HollowMesh);
        }
        if mass.is_some_and(|mass| !(1e-6..1e9).contains(&mass)) {
            return Err(SpecError::NoMass("a dynamic prop"));
        }
        let rigid = RigidBodyBuilder::new(kind)
            .pose(Pose::from_parts(spec.position, rotation))
            .linvel(velocity)
            .angvel(spin)
            .ccd_enabled(mass.is_some())
            .gravity_scale(gravity_scale)
            .linear_damping(drag)
            .angular_damping(drag);
        let handle = engine.bodies.insert(rigid);
        let mut collider = ColliderBuilder::new(shape)
            .position(spec.solid.placement())
            .friction(surface.friction)
            .friction_combine_rule(CoefficientCombineRule::GeometricMean)
            .restitution(surface.bounce)
            .restitution_combine_rule(CoefficientCombineRule::Max)
            .sensor(spec.is_sensor)
            .user_data(tag(Entity::Prop(id)));
        if spec.is_sensor {
            // A sensor also detects fixed and kinematic bodies.
            collider = collider.active_collision_types(ActiveCollisionTypes::all());
        }
        collider = match mass {
            Some(mass) => collider.mass(mass),
            None => collider.density(0.0),
        };
        engine.colliders.insert_with_parent(collider, handle, &mut engine.bodies);
        Ok(Prop { spec, handle, acceleration: DVec3::ZERO })
    }

    pub fn prepare(&mut self, engine: &mut Engine, step_secs: f64) {
        if self.acceleration != DVec3::ZERO
            && let Some(body) = engine.bodies.get_mut(self.handle)
        {
            let velocity = body.linvel() + self.acceleration * step_secs;
            body.set_linvel(velocity.clamp_length_max(sanitize::MAX_SPEED_M_S), true);
        }
    }
}
