//! The rigid-body library's own sets, in one place: its types are private to this crate.

use crate::collision_filter::CollisionFilter;
use crate::{CharacterId, Entity, PropId, WorldSettings};
use glam::DVec3;
use rapier3d_f64::prelude::*;
use sinew_body::humanoid::Node;

pub(crate) struct Engine {
    pub pipeline: PhysicsPipeline,
    pub parameters: IntegrationParameters,
    pub islands: IslandManager,
    pub broad_phase: DefaultBroadPhase,
    pub narrow_phase: NarrowPhase,
    pub bodies: RigidBodySet,
    pub colliders: ColliderSet,
    pub joints: ImpulseJointSet,
    pub multibody_joints: MultibodyJointSet,
    pub soft_bodies: SoftBodySet,
    pub ccd: CCDSolver,
    pub gravity: DVec3,
    /// The fixed body that carries the floor and the planes that hold characters.
    pub ground: RigidBodyHandle,
    pub collision_filter: CollisionFilter,
    /// Joints that are taken out before the next step, and before another one is added. Taken out at once, the library would
    /// keep until the next step that they are gone, and leave it out of what it serialises.
    pub removed_joints: Vec<ImpulseJointHandle>,
}

impl Engine {
    pub fn new(settings: &WorldSettings) -> Engine {
        let parameters = IntegrationParameters {
            dt: settings.step_secs(),
            num_solver_iterations: settings.solver_iterations,
            contact_clustering: false,
            // Springs act through the whole body: one sweep a sub-step propagates changes by one joint only, and feet
            // that carry 80 kg by an ankle's spring bounce.
            num_internal_pgs_iterations: settings.solver_sweeps,
            num_internal_stabilization_iterations: settings.solver_sweeps.div_ceil(4),
            friction_model: FrictionModel::Coulomb,
            ..IntegrationParameters::default()
        };
        let mut engine = Engine {
            pipeline: PhysicsPipeline::new(),
            parameters,
            islands: IslandManager::new(),
            broad_phase: DefaultBroadPhase::new(),
            narrow_phase: NarrowPhase::new(),
            bodies: RigidBodySet::new(),
            colliders: ColliderSet::new(),
            joints: ImpulseJointSet::new(),
            multibody_joints: MultibodyJointSet::new(),
            soft_bodies: SoftBodySet::new(),
            ccd: CCDSolver::new(),
            gravity: DVec3::new(0.0, -settings.gravity_m_s2, 0.0),
            ground: RigidBodyHandle::invalid(),
            collision_filter: CollisionFilter::default(),
            removed_joints: Vec::new(),
        };
        // With its feature on, the library would take every core of the machine.
        engine.set_threads(1);
        engine.ground = engine.bodies.insert(RigidBodyBuilder::fixed());
        if let Some(surface) = settings.floor {
            let floor = ColliderBuilder::new(SharedShape::halfspace(DVec3::Y))
                .friction(surface.friction)
                .friction_combine_rule(CoefficientCombineRule::GeometricMean)
                .restitution(surface.bounce)
                .restitution_combine_rule(CoefficientCombineRule::Max)
                .user_data(tag(Entity::Floor));
            engine.colliders.insert_with_parent(floor, engine.ground, &mut engine.bodies);
        }
        engine
    }

    #[cfg(feature = "threads")]
    pub fn set_threads(&mut self, threads: usize) -> usize {
        // Where the system gives no threads, the step runs on those that it had.
        let _ = self.pipeline.configure_thread_pool(threads);
        self.pipeline.num_threads().unwrap_or(1)
    }

    #[cfg(not(feature = "threads"))]
    pub fn set_threads(&mut self, _threads: usize) -> usize {
        1
    }

    #[cfg(feature = "threads")]
    fn threads(&self) -> usize {
        self.pipeline.num_threads().unwrap_or(1)
    }

    #[cfg(not(feature = "threads"))]
    fn threads(&self) -> usize {
        1
    }

    /// The library's buffers of a step, which know the sets that were there, are made anew.
    pub fn forget_buffers(&mut self) {
        let threads = self.threads();
        (self.pipeline, self.ccd) = (PhysicsPipeline::new(), CCDSolver::new());
        self.set_threads(threads);
    }

    /// Takes out the joints that are to be.
    pub fn remove_joints(&mut self) {
        for handle in self.removed_joints.drain(..) {
            self.joints.remove(handle, true);
        }
    }

    pub fn insert_joint(
        &mut self,
        one: RigidBodyHandle,
        other: RigidBodyHandle,
        joint: GenericJoint,
    ) -> ImpulseJointHandle {
        self.remove_joints();
        self.joints.insert(one, other, joint, true)
    }

    pub fn step(&mut self) {
        self.pipeline.step(
            self.gravity,
            &self.parameters,
            &mut self.islands,
            &mut self.broad_phase,
            &mut self.narrow_phase,
            &mut self.bodies,
            &mut self.colliders,
            &mut self.joints,
            &mut self.multibody_joints,
            &mut self.soft_bodies,
            &mut self.ccd,
            &self.collision_filter,
            &(),
        );
    }
}

/// The owner of a collider, as the library's user data.
pub(crate) fn tag(entity: Entity) -> u128 {
    match entity {
        Entity::Floor => 1,
        Entity::Prop(prop) => 2 | packed(prop.slot(), prop.generation()),
        Entity::Part(character, node) => {
            3 | (node.index() as u128) << 8 | packed(character.slot(), character.generation())
        }
    }
}

fn packed(slot: usize, generation: u32) -> u128 {
    (slot as u128) << 16 | u128::from(generation) << 64
}

pub(crate) fn untag(tag: u128) -> Option<Entity> {
    let slot = usize::try_from(tag >> 16 & 0xffff_ffff).ok()?;
    let generation = u32::try_from(tag >> 64).ok()?;
    match tag & 0xff {
        1 => Some(Entity::Floor),
        2 => Some(Entity::Prop(PropId::new(slot, generation))),
        3 => {
            let node = *Node::ALL.get(usize::try_from(tag >> 8 & 0xff).ok()?)?;
            Some(Entity::Part(CharacterId::new(slot, generation), node))
        }
        _ => None,
    }
}
