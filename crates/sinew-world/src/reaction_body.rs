//! What a character's pins push off from: nothing, or a prop that gets the opposite of what they give the body.

use crate::World;
use crate::engine::Engine;
use crate::external_force::Before;
use glam::DVec3;
use rapier3d_f64::prelude::*;
use sinew_body::humanoid::Node;

/// A prop, and what the pins do to it.
#[derive(Clone, Copy)]
pub(crate) struct ReactionBody {
    prop: RigidBodyHandle,
    /// Force of the pins on the body, and torque about the prop's centre of mass, as far as the prop feels them by now.
    force: DVec3,
    torque: DVec3,
}

impl World {
    /// What a character's pins push off from from now on. A prop that physics moves gets the opposite of their forces and
    /// torques, so that it bears the body that they hold over it; with `None`, and for any other prop, they come from nowhere.
    ///
    /// The prop feels them a few steps late: by the ratio of the body's mass, and of its moment of inertia about the prop, to the
    /// prop's own. Pins take no account of how a light prop gives way under them, and would shake it.
    pub fn set_reaction_body(&mut self, character: usize, prop: Option<usize>) {
        let handle = prop.and_then(|prop| Some(self.props.get(prop)?.handle));
        let Some(character) = self.characters.get_mut(character) else { return };
        if character.reaction_body.map(|reaction_body| reaction_body.prop) != handle {
            character.reaction_body = handle.map(|prop| ReactionBody { prop, force: DVec3::ZERO, torque: DVec3::ZERO });
        }
    }
}

impl ReactionBody {
    /// Gives the prop what it gets in the next step.
    pub fn press(&mut self, engine: &mut Engine, parts: &[RigidBodyHandle; Node::COUNT], pins: &[Before; Node::COUNT]) {
        let Some(prop) = engine.bodies.get(self.prop).filter(|prop| prop.is_dynamic()) else { return };
        let (centre, mass, own) = (prop.center_of_mass(), prop.mass(), prop.mass_properties().local_mprops);
        // Along its axes, so that a long prop feels soon what turns it slowly.
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

/// Share of what is new that a prop feels within a step: what heavier things do it feels more slowly.
fn share(body: f64, prop: f64) -> f64 {
    let share = prop / (prop + body);
    if share.is_finite() { share } else { 0.0 }
}
