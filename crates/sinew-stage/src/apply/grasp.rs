//! Orders that take hold of things and let them go.

use super::{Outcome, to_character, wrong_state};
use crate::Stage;
use crate::event::{Cause, CharacterEffect as E, Effect};
use crate::order::{CharacterOrder as O, Undo};
use sinew_world::{CharacterId, Held};

/// A hand takes hold of what its centre of mass is no farther from than this \[m\]: it lies in the open hand.
const REACH_M: f64 = 0.15;

impl Stage {
    pub(super) fn apply_grasp(&mut self, id: CharacterId, order: &O) -> Outcome {
        match order {
            O::Attach { node, object, soft, break_force_n } => {
                let nearest = || self.world.nearest_to_part(id, *node, REACH_M);
                let object = object
                    .or_else(nearest)
                    .ok_or_else(|| wrong_state(format!("nothing is within {REACH_M} m of the {}", node.part())))?;
                if self.world.is_attached(id, *node, object) {
                    return Ok(None);
                }
                let break_force_n = *break_force_n;
                self.world.attach(Held { character: id, node: *node, object, soft: *soft, break_force_n });
                let undo = to_character(id, O::Detach { node: *node, object: Some(object) });
                Ok(Some((E::Holds { node: *node, object: self.cast.name_of(object) }, Undo::Orders(vec![undo]))))
            }
            O::Detach { node, object } => {
                let is_meant = |held: &&Held| {
                    held.character == id && held.node == *node && object.is_none_or(|object| held.object == object)
                };
                let held: Vec<Held> = self.world.held().filter(is_meant).copied().collect();
                if held.is_empty() {
                    return Ok(None);
                }
                for one in &held {
                    self.world.detach(id, *node, one.object);
                }
                let again = |Held { node, object, soft, break_force_n, .. }: &Held| {
                    let (node, object, soft, break_force_n) = (*node, Some(*object), *soft, *break_force_n);
                    to_character(id, O::Attach { node, object, soft, break_force_n })
                };
                let undo = Undo::Orders(held.iter().map(again).collect());
                let objects = held.iter().map(|held| self.cast.name_of(held.object)).collect();
                Ok(Some((E::LetsGo { node: *node, objects }, undo)))
            }
            _ => Ok(None),
        }
    }

    /// Holds that broke in the last step.
    pub(crate) fn note_broken_holds(&mut self) {
        for at in 0..self.world.broken_holds().len() {
            let (held, force_n) = self.world.broken_holds()[at];
            let who = self.cast.character_name(held.character).to_owned();
            let loses = E::LosesHold { node: held.node, object: self.cast.name_of(held.object) };
            let max_n = held.break_force_n.unwrap_or(0.0);
            self.note(Cause::HoldOverload { force_n, max_n }, Effect::of(who, loses));
        }
    }
}
