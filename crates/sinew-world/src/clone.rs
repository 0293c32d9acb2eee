//! A world kept in memory: its clone.

use crate::World;
use crate::engine::Engine;
use crate::readback::Readback;
use rapier3d_f64::prelude::*;

/// A clone goes on with the same bits as the world that it was taken from: warm starts, contacts, joints, holds, planes, sleep and
/// ids are all in it. So a clone that is put aside is a snapshot in memory, and putting it back is a seek. A clone steps on
/// one thread until [`World::set_threads`].
///
/// ```
/// # use sinew_world::{Form, Motion, PropSpec, Solid, World, WorldSettings};
/// # use glam::DVec3;
/// let mut world = World::new(WorldSettings::default());
/// let ball = Solid::new(Form::Ball { radius_m: 0.1 });
/// world.add_prop(PropSpec::new(ball, Motion::Dynamic { mass_kg: 1.0 }, DVec3::Y))?;
/// let kept = world.clone();
/// let mut run = |mut world: World| {
///     (0..240).for_each(|_| world.step());
///     world.hash()
/// };
/// assert_eq!(run(world), run(kept));
/// # Ok::<(), sinew_world::SpecError>(())
/// ```
impl Clone for World {
    fn clone(&self) -> World {
        World {
            settings: self.settings,
            engine: self.engine.clone(),
            characters: self.characters.clone(),
            props: self.props.clone(),
            attachments: self.attachments.clone(),
            broken_holds: self.broken_holds.clone(),
            prop_joints: self.prop_joints.clone(),
            frame: self.frame.clone(),
            // Buffers of a step.
            readback: Readback::default(),
            stale_calls: self.stale_calls,
        }
    }
}

impl Clone for Engine {
    fn clone(&self) -> Engine {
        let mut engine = Engine {
            // Workspace without state: a new one finds all that it needs in the sets.
            pipeline: PhysicsPipeline::new(),
            parameters: self.parameters,
            islands: self.islands.clone(),
            broad_phase: self.broad_phase.clone(),
            narrow_phase: self.narrow_phase.clone(),
            bodies: self.bodies.clone(),
            colliders: self.colliders.clone(),
            joints: self.joints.clone(),
            // Always empty here.
            multibody_joints: MultibodyJointSet::new(),
            soft_bodies: SoftBodySet::new(),
            ccd: self.ccd.clone(),
            gravity: self.gravity,
            ground: self.ground,
            collision_filter: self.collision_filter.clone(),
            removed_joints: self.removed_joints.clone(),
        };
        engine.set_threads(1);
        engine
    }
}
