//! Collision shapes on top of a part's own, added and removed while the world runs (Shapiro et al. 2007, section 4.2).

use crate::ragdoll::part_collider;
use crate::{CharacterId, Solid, SpecError, World};
use rapier3d_f64::prelude::*;
use sinew_body::humanoid::Node;

/// A shape that was added.
#[derive(Clone)]
pub(crate) struct ExtraShape {
    pub node: Node,
    pub name: String,
    pub collider: ColliderHandle,
    pub solid: Solid,
}

/// Shapes that a character may have on top of its own.
const MAX_EXTRA_SHAPES: usize = 64;

impl World {
    /// Adds a shape to a part, in its frame, under a name; one of that name on that part is replaced. It weighs nothing.
    ///
    /// # Errors
    /// The shape is degenerate, or the character already has 64 of them.
    pub fn add_shape(
        &mut self,
        character: CharacterId,
        node: Node,
        name: &str,
        solid: &Solid,
    ) -> Result<(), SpecError> {
        if self.characters.get(character).is_none() {
            return Err(SpecError::StaleCharacter(character));
        }
        self.remove_shape(character, node, name);
        let Some(one) = self.characters.get_mut(character) else { return Err(SpecError::StaleCharacter(character)) };
        if one.extra_shapes.len() >= MAX_EXTRA_SHAPES {
            return Err(SpecError::TooManyShapes);
        }
        let collider = part_collider(solid, one.spec.surface, character, node).ok_or(SpecError::NoShape)?;
        let body = one.bodies[node.index()];
        let collider = self.engine.colliders.insert_with_parent(collider, body, &mut self.engine.bodies);
        one.extra_shapes.push(ExtraShape { node, name: name.to_owned(), collider, solid: solid.clone() });
        Ok(())
    }

    /// Removes an added shape. False if the part has none of that name.
    pub fn remove_shape(&mut self, character: CharacterId, node: Node, name: &str) -> bool {
        let Some(one) = self.characters.get_mut(character) else {
            self.count_stale();
            return false;
        };
        let Some(place) = one.extra_shapes.iter().position(|extra| extra.node == node && extra.name == name) else {
            return false;
        };
        let extra = one.extra_shapes.remove(place);
        let engine = &mut self.engine;
        let (islands, bodies, soft) = (&mut engine.islands, &mut engine.bodies, &mut engine.soft_bodies);
        engine.colliders.remove(extra.collider, islands, bodies, soft, true);
        true
    }
}
