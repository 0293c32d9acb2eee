//! Orders about a character's body: modified physics and shapes (Shapiro et al. 2007, section 4).

use super::{Outcome, to_character, wrong_state};
use crate::Stage;
use crate::event::CharacterEffect as E;
use crate::fade::Weighs;
use crate::heading::heading;
use crate::order::{CharacterOrder as O, Order, ShapeChoice, Undo};
use glam::DVec3;
use sinew_body::humanoid::Node;
use sinew_control::OrderError;
use sinew_world::{CharacterId, PartShape};

impl Stage {
    pub(super) fn apply_to_body(&mut self, id: CharacterId, order: &O) -> Outcome {
        Ok(Some(match order {
            O::ForcesOff { nodes, for_secs } => {
                let on = |node: &Node| to_character(id, O::ForcesOn { nodes: vec![*node] });
                let undo = nodes.iter().filter(|node| self.world.has_forces(id, **node)).map(on).collect();
                for &node in nodes {
                    self.world.set_forces(id, node, false);
                }
                self.end_with(*for_secs, &nodes.iter().map(on).collect::<Vec<_>>());
                (E::Forces { nodes: nodes.clone(), on: false }, Undo::Orders(undo))
            }
            O::ForcesOn { nodes } => {
                let off: Vec<Node> = nodes.iter().copied().filter(|&node| !self.world.has_forces(id, node)).collect();
                for &node in nodes {
                    self.world.set_forces(id, node, true);
                    self.end_with(None, &[to_character(id, O::ForcesOn { nodes: vec![node] })]);
                }
                let undo = match off.is_empty() {
                    true => Undo::Nothing,
                    false => Undo::Orders(vec![to_character(id, O::ForcesOff { nodes: off, for_secs: None })]),
                };
                (E::Forces { nodes: nodes.clone(), on: true }, undo)
            }
            O::Plane { facing_deg, for_secs } => {
                let own = || self.world.frame().character(id).map_or(DVec3::Z, |character| character.facing);
                let facing = facing_deg.map_or_else(own, heading);
                self.world.hold_to_plane(id, facing);
                let free = [to_character(id, O::PlaneOff)];
                self.end_with(*for_secs, &free);
                (E::HeldToPlane, Undo::Orders(free.to_vec()))
            }
            O::PlaneOff => {
                self.end_with(None, &[to_character(id, O::PlaneOff)]);
                if !self.world.is_held_to_plane(id) {
                    return Ok(None);
                }
                self.world.free_from_plane(id);
                let held = O::Plane { facing_deg: None, for_secs: None };
                (E::FreeFromPlane, Undo::Orders(vec![to_character(id, held)]))
            }
            O::Gravity { node, scale, over_secs, for_secs } => {
                let undo = self.gravity_orders(id, *node);
                if node.is_none() {
                    self.timed_effects.forget_gravity_of_parts(id);
                }
                let nodes = node.map_or(Node::ALL.to_vec(), |node| vec![node]);
                let things: Vec<Weighs> = nodes.iter().map(|&node| Weighs::Part(id, node)).collect();
                self.weigh(&things, *scale, *over_secs);
                self.end_with(*for_secs, &undo);
                (E::Gravity { node: *node, scale: *scale, over_secs: *over_secs }, Undo::Orders(undo))
            }
            _ => return Ok(None),
        }))
    }

    /// The orders that bring back gravity as it is for a part, or for all.
    fn gravity_orders(&self, id: CharacterId, node: Option<Node>) -> Vec<Order> {
        let order = |node, scale| to_character(id, O::Gravity { node, scale, over_secs: None, for_secs: None });
        let scale = |node| self.scale_without_timed(Weighs::Part(id, node));
        if let Some(node) = node {
            return vec![order(Some(node), scale(node))];
        }
        let whole = scale(Node::Hips);
        let others = Node::ALL.into_iter().filter(|&node| scale(node) != whole);
        std::iter::once(order(None, whole)).chain(others.map(|node| order(Some(node), scale(node)))).collect()
    }

    pub(super) fn apply_shape(&mut self, id: CharacterId, order: &O) -> Outcome {
        let added =
            |node: Node, shape: &str| to_character(id, O::AddShape { node, shape: shape.to_owned(), for_secs: None });
        let removed = |node: Node, shape: &str| to_character(id, O::RemoveShape { node, shape: shape.to_owned() });
        Ok(Some(match order {
            O::Shape { node, shape, for_secs } => {
                let solid = match shape {
                    ShapeChoice::Own => PartShape::Own,
                    ShapeChoice::None => PartShape::None,
                    ShapeChoice::Named(name) => PartShape::Other(self.shape(name)?),
                };
                self.world.set_shape(id, *node, solid.clone()).map_err(|error| wrong_state(error.to_string()))?;
                let before = match shape {
                    ShapeChoice::Own => self.shapes.remove(&(id, *node)),
                    _ => self.shapes.insert((id, *node), (shape.clone(), solid)),
                };
                let before = before.map_or(ShapeChoice::Own, |(shape, _)| shape);
                let undo = [to_character(id, O::Shape { node: *node, shape: before, for_secs: None })];
                self.end_with(*for_secs, &undo);
                (E::Shape { node: *node, shape: shape.clone() }, Undo::Orders(undo.to_vec()))
            }
            O::AddShape { node, shape, for_secs } => {
                let solid = self.shape(shape)?;
                self.world.add_shape(id, *node, shape, &solid).map_err(|error| wrong_state(error.to_string()))?;
                let undo = [removed(*node, shape)];
                self.end_with(*for_secs, &undo);
                (E::ShapeAdded { node: *node, shape: shape.clone() }, Undo::Orders(undo.to_vec()))
            }
            O::RemoveShape { node, shape } => {
                if !self.world.remove_shape(id, *node, shape) {
                    return Err(wrong_state(format!("no shape `{shape}` was added to the {}", node.part())));
                }
                self.end_with(None, &[removed(*node, shape)]);
                (E::ShapeRemoved { node: *node, shape: shape.clone() }, Undo::Orders(vec![added(*node, shape)]))
            }
            _ => return Ok(None),
        }))
    }

    /// A shape of the scene.
    fn shape(&self, name: &str) -> Result<sinew_world::Solid, OrderError> {
        let solid = self.scene.shapes.get(name).and_then(crate::scene::ShapeSpec::solid);
        solid.ok_or_else(|| wrong_state(format!("the scene has no shape `{name}` any more")))
    }
}
