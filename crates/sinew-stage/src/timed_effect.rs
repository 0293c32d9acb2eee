//! Things that last for a time: the orders that take them back, and when.

use crate::cast::Cast;
use crate::fade::{Fade, Weighs};
use crate::order::{CharacterOrder, Order, StageOrder};
use glam::DVec3;
use sinew_snapshot::snapshot;
use sinew_world::{CharacterId, Entity};

/// A force that lasts.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct LastingPush {
    /// On what.
    pub on: Entity,
    /// Where, in its own frame \[m\]; its centre of mass when `None`.
    pub at: Option<DVec3>,
    /// World axes \[N\].
    pub force: DVec3,
    /// The first step in which it no longer acts.
    pub until_step: u64,
}

/// Timed effects that are under way. Plain data: a clone of it is a snapshot.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct TimedEffects {
    /// The orders that take something back, in the order in which it was begun, each with its step.
    endings: Vec<(u64, Order)>,
    /// Forces that act now.
    pub pushes: Vec<LastingPush>,
    /// Factors on gravity that are on their way.
    pub fades: Vec<Fade>,
}

snapshot!(LastingPush { on, at, force, until_step });
snapshot!(TimedEffects { endings, pushes, fades });

/// Pushes that act at the same time; further ones are refused.
pub const MAX_PUSHES: usize = 1000;

impl TimedEffects {
    /// An order takes something back at a step; never with `None`. What waits already and sets the same thing no longer counts: the
    /// newest command wins. But what that one would have brought back is brought back all the same, so that a value that only
    /// lasts is never taken for the one of before.
    pub fn end_at(&mut self, step: Option<u64>, order: Order) {
        let place = self.endings.iter().position(|(_, other)| other.sets_the_same(&order));
        let before = place.map(|place| self.endings.remove(place).1);
        if let Some(step) = step {
            self.endings.push((step, before.unwrap_or(order)));
        }
    }

    /// Orders that are due at or before a step, in the order in which what they take back was begun.
    pub fn take_due(&mut self, step: u64) -> Vec<Order> {
        if self.endings.iter().all(|(at, _)| *at > step) {
            return Vec::new();
        }
        let due = self.endings.iter().filter(|(at, _)| *at <= step).map(|(_, order)| order.clone()).collect();
        self.endings.retain(|(at, _)| *at > step);
        due
    }

    /// What concerns somebody who is gone is forgotten.
    pub fn forget_stale(&mut self, cast: &Cast) {
        self.endings.retain(|(_, order)| order.stale(cast).is_none());
        self.pushes.retain(|push| cast.has(push.on));
        self.fades.retain(|fade| cast.has(fade.on()));
    }

    /// Gravity of single parts of a character no longer comes back: a command for all of them came.
    pub fn forget_gravity_of_parts(&mut self, character: CharacterId) {
        self.endings.retain(|(_, order)| match order {
            Order::Character { id, order: CharacterOrder::Gravity { node: Some(_), .. } } => *id != character,
            _ => true,
        });
    }

    /// The factor on gravity that something gets back; `None` when what it has stays.
    pub fn gravity_at_end(&self, what: Weighs) -> Option<f64> {
        let scale = |(_, order): &(u64, Order), is_whole: bool| match (order, what) {
            (Order::Character { id, order: CharacterOrder::Gravity { node, scale, .. } }, Weighs::Part(of, part)) => {
                let is_meant = if is_whole { node.is_none() } else { *node == Some(part) };
                (*id == of && is_meant).then_some(*scale)
            }
            (Order::Stage(StageOrder::PropGravity { prop, scale, .. }), Weighs::Prop(of)) => {
                (*prop == of).then_some(*scale)
            }
            _ => None,
        };
        let find = |is_whole| self.endings.iter().find_map(|ending| scale(ending, is_whole));
        find(false).or_else(|| find(true))
    }
}
