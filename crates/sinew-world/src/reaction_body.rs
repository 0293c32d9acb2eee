//! The reaction body of a character's pins: a prop that receives the opposite of their forces, or none.

use crate::engine::Engine;
use crate::external_force::Before;
use crate::snapshot::Handle;
use crate::{CharacterId, PropId, World};
use glam::DVec3;
use rapier3d_f64::prelude::*;
use sinew_body::humanoid::Node;
use sinew_snapshot::{Reader, Snapshot, SnapshotError, Writer};

/// A prop, and the reaction of the pins on it.
#[derive(Clone, Copy, Default)]
pub(crate) struct ReactionBody {
    prop: RigidBodyHandle,
    /// Low-pass filtered force of the pins on the body, and torque about the prop's centre of mass.
    force: DVec3,
    torque: DVec3,
}

impl Snapshot for ReactionBody {
    fn save(&self, to: &mut Writer) {
        self.prop.save_to(to);
        (self.force, self.torque).save(to);
    }
    fn restore(&mut self, from: &mut Reader<'_>) -> Result<(), SnapshotError> {
        self.prop = RigidBodyHandle::restored(from)?;
        self.force.restore(from)?;
        self.torque.restore(from)
    }
}

impl World {
    /// Sets the reaction body of a character's pins. A dynamic prop receives the opposite of their forces and torques,
    /// so that it carries the body; with `None`, and for any other prop, the pins' forces are external. Takes effect in
    /// the next step.
    ///
    /// The prop receives them through a low-pass filter, a few steps late: by the ratio of the body's mass, and of its
    /// moment of inertia about the prop, to the prop's own. Pins do not account for the motion of a light prop under
    /// them, and would shake it.
    pub fn set_reaction_body(&mut self, character: CharacterId, prop: Option<PropId>) {
        let handle = prop.and_then(|prop| Some(self.props.get(prop)?.handle));
        let (Some(character), true) = (self.characters.get_mut(character), prop.is_some() == handle.is_some()) else {
            return self.count_stale();
        };
        if character.reaction_body.map(|reaction_body| reaction_body.prop) != handle {
            character.reaction_body = handle.map(|prop| ReactionBody { prop, force: DVec3::ZERO, torque: DVec3::ZERO });
        }
    }
}

impl ReactionBody {
    /// Whether the pins push off from this body.
    pub fn is_on(&self, handle: RigidBodyHandle) -> bool {
        self.prop == handle
    }

    /// Applies the reaction to the prop for the next step.
    pub fn press(&mut self, engine: &mut Engine, parts: &[RigidBodyHandle; Node::COUNT], pins: &[Before; Node::COUNT]) {
        let Some(prop) = engine.bodies.get(self.prop).filter(|prop| prop.is_dynamic()) else { return };
        let (centre, mass, own) = (prop.center_of_mass(), prop.mass(), prop.mass_properties().local_mprops);
        // Along its axes, so that a long prop responds quickly about its slow axes.
        let axes = *prop.rotation() * own.principal_inertia_local_frame;
        let (mut force, mut torque) = (DVec3::ZERO, DVec3::ZERO);
        let (mut body_mass, mut body_inertia) = (0.0, DVec3::ZERO);
        for (handle, pin) in parts.iter().zip(pins) {
            let Some(part) = engine.bodies.get(*handle) else { continue };
            let arm = part.center_of_mass() - centre;
            force += pin.pin_force;
            torque += pin.pin_torque + arm.cross(pin.pin_force);
            let along = axes.conjugate() * arm;
            let square = along * along;
            body_mass += part.mass();
            body_inertia += DVec3::new(square.y + square.z, square.z + square.x, square.x + square.y) * part.mass();
        }
        self.force += (force - self.force) * share(body_mass, mass);
        let inertia = own.principal_inertia();
        let shares = DVec3::new(
            share(body_inertia.x, inertia.x),
            share(body_inertia.y, inertia.y),
            share(body_inertia.z, inertia.z),
        );
        self.torque += axes * ((axes.conjugate() * (torque - self.torque)) * shares);
        if let Some(prop) = engine.bodies.get_mut(self.prop) {
            prop.add_force(-self.force, true);
            prop.add_torque(-self.torque, true);
        }
    }
}

/// Filter coefficient for a step: slower for heavier bodies relative to the prop.
fn share(body: f64, prop: f64) -> f64 {
    let share = prop / (prop + body);
    if share.is_finite() { share } else { 0.0 }
}
