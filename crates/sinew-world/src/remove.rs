//! Taking things out of a world while it runs.

use crate::engine::Engine;
use crate::{CharacterId, Entity, PropId, PropJointId, SpecError, World};
use rapier3d_f64::prelude::*;

impl World {
    /// Takes a character out of the world, with all that it holds and all that holds it. Joints of props that were fastened to it
    /// are cut: they stay, not whole, until [`World::remove_prop_joint`]. At once its id is stale and its slot in the frame vacant;
    /// the next character that is added takes the first vacant slot. What rested on it wakes.
    ///
    /// ```
    /// # use sinew_body::humanoid::{Body, Pose};
    /// # use sinew_world::{CharacterId, CharacterSpec, Surface, World, WorldSettings};
    /// # use glam::DVec3;
    /// let mut world = World::new(WorldSettings::default());
    /// let (body, pose) = (Body::standard(80.0, 1.7), Pose::STANDING);
    /// let spec = CharacterSpec { body, pose, velocity: DVec3::ZERO, surface: Surface::BODY };
    /// let first = world.add_character(spec.clone())?;
    /// world.remove_character(first)?;
    /// assert!(world.frame().character(first).is_none());
    ///
    /// let second = world.add_character(spec)?;
    /// assert_eq!((second.slot(), second.generation()), (0, 1));
    /// assert!(world.remove_character(first).is_err());
    /// # Ok::<(), sinew_world::SpecError>(())
    /// ```
    ///
    /// # Errors
    /// When the id is stale.
    pub fn remove_character(&mut self, character: CharacterId) -> Result<(), SpecError> {
        let removed = self.characters.remove(character).ok_or(SpecError::StaleCharacter(character))?;
        self.let_go_of(|entity| matches!(entity, Entity::Part(owner, _) if owner == character));
        self.attachments.retain(|attachment| attachment.held.character != character);
        for handle in removed.bodies {
            self.engine.remove_body(handle);
        }
        self.engine.collision_filter.remove_character(character);
        self.frame.characters[character.slot()] = crate::CharacterFrame::EMPTY;
        self.frame.character_ids[character.slot()] = None;
        Ok(())
    }

    /// Takes a prop out of the world, out of all hands that hold it. As [`World::remove_character`].
    ///
    /// # Errors
    /// When the id is stale.
    pub fn remove_prop(&mut self, prop: PropId) -> Result<(), SpecError> {
        let removed = self.props.remove(prop).ok_or(SpecError::StaleProp(prop))?;
        self.let_go_of(|entity| entity == Entity::Prop(prop));
        for character in self.characters.values_mut() {
            character.reaction_body.take_if(|reaction_body| reaction_body.is_on(removed.handle));
        }
        self.engine.remove_body(removed.handle);
        self.engine.collision_filter.remove_prop(prop);
        self.frame.props[prop.slot()] = crate::BodyState::REST;
        self.frame.prop_ids[prop.slot()] = None;
        Ok(())
    }

    /// Takes a joint of props out of the world, whole or not. Its id is stale from now on.
    ///
    /// # Errors
    /// When the id is stale.
    pub fn remove_prop_joint(&mut self, joint: PropJointId) -> Result<(), SpecError> {
        let mut removed = self.prop_joints.remove(joint).ok_or(SpecError::StalePropJoint(joint))?;
        removed.cut(&mut self.engine.removed_joints);
        Ok(())
    }

    /// Ends what fastens things to something, and its contacts in the frame.
    fn let_go_of(&mut self, is_it: impl Fn(Entity) -> bool) {
        let joints = &mut self.engine.removed_joints;
        self.attachments.retain(|attachment| {
            let stays = !is_it(attachment.held.object);
            if !stays {
                attachment.release(joints);
            }
            stays
        });
        for joint in self.prop_joints.values_mut().filter(|joint| joint.fastens(&is_it)) {
            joint.cut(joints);
        }
        self.frame.contacts.retain(|contact| !is_it(contact.a) && !is_it(contact.b));
    }
}

impl Engine {
    /// Takes a body out, with its colliders and joints.
    fn remove_body(&mut self, handle: RigidBodyHandle) {
        self.remove_joints();
        // The library wakes what rested on a collider only when that is taken out by itself.
        let colliders = self.bodies.get(handle).map(|body| body.colliders().to_vec()).unwrap_or_default();
        for collider in colliders {
            let (islands, bodies, soft) = (&mut self.islands, &mut self.bodies, &mut self.soft_bodies);
            self.colliders.remove(collider, islands, bodies, soft, true);
        }
        self.bodies.remove(
            handle,
            &mut self.islands,
            &mut self.colliders,
            &mut self.joints,
            &mut self.multibody_joints,
            &mut self.soft_bodies,
            true,
        );
    }
}
