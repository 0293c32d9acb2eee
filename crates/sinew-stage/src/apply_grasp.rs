//! Commands that take hold of things and let them go.

use crate::Stage;
use crate::apply_command::number;
use crate::event::{Cause, CharacterEffect, Effect};
use sinew_body::humanoid::Node;
use sinew_control::Action;
use sinew_control::graph::Touchable;
use sinew_world::{CharacterId, Entity, Held};

/// A hand takes hold of what its centre of mass is no farther from than this \[m\]: it lies in the open hand.
const REACH_M: f64 = 0.15;

impl Stage {
    /// What was done; `None` when it was so already.
    pub(crate) fn apply_grasp(&mut self, character: CharacterId, action: &Action) -> Result<Option<Effect>, String> {
        let who = self.cast.characters()[character.slot()].clone();
        match action {
            Action::Attach { link, object, soft, break_n } => {
                let node = self.part(character, link)?;
                let thing = self.thing(object, character, node)?;
                if self.world.is_attached(character, node, thing) {
                    return Ok(None);
                }
                let break_force_n = break_n.map(|force| number(force, "break_n")).transpose()?;
                self.world.attach(Held { character, node, object: thing, soft: *soft, break_force_n });
                Ok(Some(Effect::of(who, CharacterEffect::Holds { node, object: self.cast.name_of(thing) })))
            }
            Action::Detach { link, object } => {
                let node = self.part(character, link)?;
                let things: Vec<Entity> = if object.is_empty() {
                    let held = self.world.held().filter(|held| held.character == character && held.node == node);
                    held.map(|held| held.object).collect()
                } else {
                    let thing = self.thing(object, character, node)?;
                    if self.world.is_attached(character, node, thing) { vec![thing] } else { Vec::new() }
                };
                for &thing in &things {
                    self.world.detach(character, node, thing);
                }
                if things.is_empty() {
                    return Ok(None);
                }
                let objects = things.iter().map(|&thing| self.cast.name_of(thing)).collect();
                Ok(Some(Effect::of(who, CharacterEffect::LetsGo { node, objects })))
            }
            _ => Err("this is no command to a hand".to_owned()),
        }
    }

    /// Holds that broke in the last step.
    pub(crate) fn note_broken_holds(&mut self) {
        for at in 0..self.world.broken_holds().len() {
            let (held, force_n) = self.world.broken_holds()[at];
            let who = self.cast.characters().get(held.character.slot()).cloned().unwrap_or_default();
            let loses = CharacterEffect::LosesHold { node: held.node, object: self.cast.name_of(held.object) };
            let max_n = held.break_force_n.unwrap_or(0.0);
            self.note(Cause::HoldOverload { force_n, max_n }, Effect::of(who, loses));
        }
    }

    /// One thing that can be held; the nearest in reach when it has no name.
    fn thing(&self, name: &str, own: CharacterId, node: Node) -> Result<Entity, String> {
        if name.is_empty() {
            return self
                .world
                .nearest_to_part(own, node, REACH_M)
                .ok_or_else(|| format!("nothing is within {REACH_M} m of the {}", node.part()));
        }
        match self.cast.meaning(name, Some(own)) {
            Some(Touchable::One(Entity::Part(owner, _))) if owner == own => {
                Err(format!("`{name}` is a part of its own"))
            }
            Some(Touchable::One(entity)) => Ok(entity),
            Some(Touchable::Character(_)) => {
                Err(format!("`{name}` is a whole character; name a part, `{name}.leftHand`"))
            }
            None => self.prop(name).map(Entity::Prop),
        }
    }
}
