//! The collision filter: pairs that pass through each other instead of colliding.

use crate::engine::untag;
use crate::sliding::{oppose_slip, set_hook};
use crate::{CharacterId, Entity, PropId, World};
use rapier3d_f64::prelude::*;
use sinew_body::humanoid::Node;

/// The filter as a hook of the rigid-body library.
#[derive(Clone, Default)]
pub(crate) struct CollisionFilter {
    /// Self-collision, by character and part: a bit for each of its own parts that it passes through.
    pub own: Vec<[u32; Node::COUNT]>,
    /// Characters' parts and the props that they pass through.
    pub props: Vec<(CharacterId, Node, PropId)>,
    /// Characters' parts that pass through the floor.
    pub floor: Vec<(CharacterId, Node)>,
}

sinew_snapshot::snapshot!(CollisionFilter { own, props, floor });

impl CollisionFilter {
    /// Makes room for a character, which passes through nothing.
    pub fn add_character(&mut self, character: CharacterId) {
        self.own.resize(self.own.len().max(character.slot() + 1), [0; Node::COUNT]);
        self.own[character.slot()] = [0; Node::COUNT];
        // Both legs: filtering them allocates nothing.
        self.floor.reserve(6);
    }

    /// Forgets a character.
    pub fn remove_character(&mut self, character: CharacterId) {
        self.add_character(character);
        self.props.retain(|(owner, ..)| *owner != character);
        self.floor.retain(|(owner, _)| *owner != character);
    }

    /// Forgets a prop.
    pub fn remove_prop(&mut self, prop: PropId) {
        self.props.retain(|(.., other)| *other != prop);
    }

    /// Whether a part passes through anything.
    fn asks(&self, character: CharacterId, node: Node) -> bool {
        self.own.get(character.slot()).is_some_and(|masks| masks[node.index()] != 0)
            || self.props.iter().any(|(owner, part, _)| (*owner, *part) == (character, node))
            || self.floor.contains(&(character, node))
    }
}

impl PhysicsHooks for CollisionFilter {
    fn filter_contact_pair(&self, context: &PairFilterContext) -> Option<SolverFlags> {
        let entity = |handle: ColliderHandle| untag(context.colliders.get(handle)?.user_data);
        match (entity(context.collider1), entity(context.collider2)) {
            (Some(Entity::Part(one, node)), Some(Entity::Part(other, part))) if one == other => {
                let passes = self.own.get(one.slot()).is_some_and(|masks| masks[node.index()] & 1 << part.index() != 0);
                (!passes).then(SolverFlags::default)
            }
            (Some(Entity::Part(owner, node)), Some(Entity::Prop(prop)))
            | (Some(Entity::Prop(prop)), Some(Entity::Part(owner, node))) => {
                // The two are in contact, without a force.
                let passes = self.props.contains(&(owner, node, prop));
                Some(if passes { SolverFlags::empty() } else { SolverFlags::default() })
            }
            (Some(Entity::Part(owner, node)), Some(Entity::Floor))
            | (Some(Entity::Floor), Some(Entity::Part(owner, node))) => {
                let passes = self.floor.contains(&(owner, node));
                Some(if passes { SolverFlags::empty() } else { SolverFlags::default() })
            }
            _ => Some(SolverFlags::default()),
        }
    }

    fn modify_solver_contacts(&self, context: &mut ContactModificationContext<'_>) {
        oppose_slip(context);
    }
}

impl World {
    /// Which of its own parts pass through each other instead of colliding: by [`Node::index`], a bit for each other part; pairs
    /// are named from both sides.
    pub fn set_passes_own(&mut self, character: CharacterId, masks: [u32; Node::COUNT]) {
        if self.characters.get(character).is_none() {
            return self.count_stale();
        }
        let Some(passing) = self.engine.collision_filter.own.get_mut(character.slot()) else { return };
        let before = std::mem::replace(passing, masks);
        for node in Node::ALL {
            if (before[node.index()] == 0) != (masks[node.index()] == 0) {
                self.let_ask(character, node);
            }
        }
    }

    /// Filters collisions between a part and a prop, or stops filtering. Takes effect once one of the two moves. The
    /// [`Frame`](crate::Frame) keeps reporting their contacts. For hands, which have no fingers to close around an
    /// object that they reach for.
    pub fn set_passes_prop(&mut self, character: CharacterId, node: Node, prop: PropId, on: bool) {
        if self.characters.get(character).is_none() || self.props.get(prop).is_none() {
            return self.count_stale();
        }
        let props = &mut self.engine.collision_filter.props;
        let pair = (character, node, prop);
        match props.iter().position(|other| *other == pair) {
            None if on => props.push(pair),
            Some(at) if !on => drop(props.swap_remove(at)),
            _ => return,
        }
        self.let_ask(character, node);
    }

    /// Filters collisions between a part and the floor, or stops filtering. Takes effect once the part moves. The
    /// [`Frame`](crate::Frame) keeps reporting their contacts. For legs that are held to a motion which stands on the floor already.
    pub fn set_passes_floor(&mut self, character: CharacterId, node: Node, on: bool) {
        if self.characters.get(character).is_none() {
            return self.count_stale();
        }
        let floor = &mut self.engine.collision_filter.floor;
        match floor.iter().position(|other| *other == (character, node)) {
            None if on => floor.push((character, node)),
            Some(at) if !on => drop(floor.swap_remove(at)),
            _ => return,
        }
        self.let_ask(character, node);
    }

    /// The hook has a cost for every contact in each step, so it is active only for filtered parts.
    fn let_ask(&mut self, character: CharacterId, node: Node) {
        let asks = self.engine.collision_filter.asks(character, node);
        let Some(one) = self.characters.get(character) else { return };
        set_hook(&mut self.engine.colliders, one.colliders[node.index()], ActiveHooks::FILTER_CONTACT_PAIRS, asks);
    }
}
