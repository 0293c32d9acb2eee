//! Orders about what a character wants and how it follows.

use super::{Outcome, to_character, wrong_state};
use crate::Stage;
use crate::event::CharacterEffect as E;
use crate::order::{CharacterOrder as O, Undo};
use crate::scripts::Owner;
use glam::DVec3;
use sinew_body::humanoid::Node;
use sinew_control::OrderError;
use sinew_control::source::{Performer, no_performer};
use sinew_world::{CharacterId, Entity};

/// Why a limb does not reach.
const NO_KEY_POSES: &str = "it follows a motion, whose limbs have no IK; give it a pose first, or do = \"reach\"";

impl Stage {
    pub(super) fn apply_to_character(&mut self, id: CharacterId, order: &O) -> Outcome {
        let back = |order: O| Undo::Orders(vec![to_character(id, order)]);
        if let Some(asked) = order.asks() {
            self.actor(id)?.tracker().kind().check(asked)?;
        }
        let done = match order {
            O::Pose { name } => {
                let before = self.source_order(id);
                if !self.actor_mut(id)?.sources.aim(name)? {
                    // It aims there already: a script says so at every step.
                    return Ok(None);
                }
                (E::Pose { pose: name.clone() }, before.map_or(Undo::Impossible, back))
            }
            O::Graph { name, state } => {
                let before = self.source_order(id);
                self.actor_mut(id)?.sources.start_graph(name, state.as_deref())?;
                (E::Graph { graph: name.clone() }, before.map_or(Undo::Impossible, back))
            }
            O::Signal { name } => {
                self.actor_mut(id)?.sources.signal(name);
                (E::Signal { signal: name.clone() }, Undo::Impossible)
            }
            O::LimbReach { node, target } => {
                let limb = node.or_else(|| self.holding_part(id)).unwrap_or(Node::RightHand);
                let effector = self.effector(id, limb);
                let poses = self.actor_mut(id)?.sources.key_poses_mut().ok_or_else(|| wrong_state(NO_KEY_POSES))?;
                if !poses.reach(limb, *target, effector)? {
                    return Ok(None);
                }
                (E::LimbReaches { node: limb, target: *target }, back(O::LimbRelease { node: Some(limb) }))
            }
            O::LimbRelease { node } => {
                if let Some(poses) = self.actor_mut(id)?.sources.key_poses_mut() {
                    poses.stop_reaching(*node);
                }
                (E::ReachEnds, Undo::Impossible)
            }
            O::Reach(order) => match self.begin_reach(id, order)? {
                Some(effect) => (effect, back(O::ReachEnd)),
                None => return Ok(None),
            },
            O::ReachEnd => {
                if !self.end_reach(id) {
                    return Ok(None);
                }
                (E::ReachEnds, Undo::Impossible)
            }
            O::Attach { .. } | O::Detach { .. } => return self.apply_grasp(id, order),
            O::Push { .. } => return self.apply_push(id, order),
            O::Gain { node, factor } => {
                let actor = self.actor_mut(id)?;
                let before = O::Gain { node: *node, factor: actor.gain(*node) };
                actor.set_gain(*node, *factor);
                (E::Gain { node: *node, factor: *factor }, back(before))
            }
            O::ForcesOff { .. } | O::ForcesOn { .. } | O::Plane { .. } | O::PlaneOff | O::Gravity { .. } => {
                return self.apply_to_body(id, order);
            }
            O::Shape { .. } | O::AddShape { .. } | O::RemoveShape { .. } => return self.apply_shape(id, order),
            O::Layer { layer, on } => {
                let actor = self.actor_mut(id)?;
                let before = O::Layer { layer: *layer, on: actor.has_layer(*layer) };
                actor.set_layer(*layer, *on);
                (E::Layer { layer: *layer, on: *on }, back(before))
            }
            O::Reflex { name, on } => {
                let actor = self.actor_mut(id)?;
                let before = O::Reflex { name: name.clone(), on: actor.has_reflex(name) };
                actor.set_reflex(name, *on)?;
                (E::Reflex { reflex: name.clone(), on: *on }, back(before))
            }
            O::Controller { name } => {
                let before = self.scripts.get(&Owner::Character(id)).map(|running| running.name.clone());
                self.start_controller(id, name.as_deref())?;
                (E::Controller { controller: name.clone() }, back(O::Controller { name: before }))
            }
            O::Weights { .. } | O::Kd { .. } | O::Pins { .. } => return self.apply_kd(id, order),
            O::Tracker(kind) => {
                let before = self.actor(id)?.tracker().kind();
                self.set_tracker(id, *kind)?;
                (E::Tracker(*kind), back(O::Tracker(before)))
            }
            O::Perform(sample) => {
                // Many a second: what came of them is counted, not told.
                let now_secs = self.world.frame().time_secs;
                let performer = self.actor_mut(id)?.sources.performer_mut().ok_or_else(no_performer)?;
                performer.source_mut().receive(sample, now_secs);
                return Ok(None);
            }
            O::Live { on } => {
                self.actor_mut(id)?.sources.follow_performer(*on)?;
                (E::Live { on: *on }, back(O::Live { on: !*on }))
            }
            O::Source(source) => {
                let before = self.source_order(id);
                self.follow_source(id, source)?;
                (E::Source { kind: source.kind() }, before.map_or(Undo::Impossible, back))
            }
            O::Say { text } => (E::Says { text: text.clone() }, Undo::Impossible),
        };
        Ok(Some(done))
    }

    /// The order that would bring back what the character follows now; `None` for a clip or a reach, which do not begin again
    /// where they were left.
    fn source_order(&self, id: CharacterId) -> Option<O> {
        let actor = self.actors.get(&id)?;
        if actor.sources.performer().is_some_and(Performer::is_followed) {
            return Some(O::Live { on: true });
        }
        if actor.sources.reach().is_some() {
            return None;
        }
        match actor.graph_state() {
            Some((name, state)) => Some(O::Graph { name: name.to_owned(), state: Some(state.to_owned()) }),
            None => actor.pose().map(|name| O::Pose { name: name.to_owned() }),
        }
    }

    /// The point that is to arrive when a part reaches, in the part's frame \[m\]: the centre of what it holds, else its own.
    fn effector(&self, id: CharacterId, node: Node) -> DVec3 {
        let own = self.world.body(id).map_or(DVec3::ZERO, |body| body.link(node).centre);
        let held = self.world.held().find(|held| held.character == id && held.node == node);
        let Some(Entity::Prop(prop)) = held.map(|held| held.object) else { return own };
        let frame = self.world.frame();
        let (Some(character), Some(prop)) = (frame.character(id), frame.prop(prop)) else { return own };
        let part = character.part(node);
        part.rotation.conjugate() * (prop.centre - part.position)
    }

    /// The part that holds something.
    fn holding_part(&self, id: CharacterId) -> Option<Node> {
        self.world.held().find(|held| held.character == id).map(|held| held.node)
    }

    /// Starts a controller of the scene for a character, in place of the one it has; `None` stops that one.
    pub(crate) fn start_controller(&mut self, id: CharacterId, name: Option<&str>) -> Result<(), OrderError> {
        let owner = Owner::Character(id);
        let running = name.map(|name| self.start_script(name, self.owner_name(owner))).transpose()?;
        match running {
            Some(running) => self.scripts.insert(owner, running),
            None => self.scripts.remove(&owner),
        };
        Ok(())
    }
}
