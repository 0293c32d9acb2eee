//! What each order does, and how it is taken back.

mod body;
mod character;
mod grasp;
mod kd;
mod push;
mod stage;

use crate::Stage;
use crate::event::{Cause, CharacterEffect, Effect};
use crate::order::{CharacterOrder, Order, Resolver, StageOrder, Undo};
use crate::step::step_of;
use sinew_control::{Command, OrderError, OrderErrorKind};
use sinew_world::{CharacterId, PropId};

/// What came of an order.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Applied {
    /// What happened; `None` when it is not worth a note: it was so already, or a script says it at every step.
    pub effect: Option<Effect>,
    /// How it is taken back.
    pub undo: Undo,
}

/// What came of an order for a character, before its name is put to it.
type Outcome = Result<Option<(CharacterEffect, Undo)>, OrderError>;

impl Stage {
    /// Understands a command for this stage: looks up its names, checks its numbers. Nothing happens yet.
    ///
    /// # Errors
    /// As [`Resolver::resolve`].
    pub fn resolve(&self, command: &Command) -> Result<Order, OrderError> {
        Resolver { scene: &self.scene, cast: &self.cast }.resolve(command)
    }

    /// Understands and carries out a command, and notes what came of it.
    pub(crate) fn carry_out_command(&mut self, command: &Command, cause: Cause) {
        match self.resolve(command) {
            Ok(order) => drop(self.carry_out(&order, cause)),
            Err(error) => self.note(cause, Effect::Refused(error)),
        }
    }

    /// Carries out an order and notes what came of it. Returns how it is taken back.
    pub(crate) fn carry_out(&mut self, order: &Order, cause: Cause) -> Undo {
        match self.apply(order) {
            Ok(applied) => {
                if let Some(effect) = applied.effect {
                    self.note(cause, effect);
                }
                applied.undo
            }
            Err(error) => {
                self.note(cause, Effect::Refused(error));
                Undo::Nothing
            }
        }
    }

    /// Carries out an order.
    ///
    /// # Errors
    /// When the stage is not in a state for it, or something that it names was removed: never for a number. All then stays as it was.
    pub(crate) fn apply(&mut self, order: &Order) -> Result<Applied, OrderError> {
        if let Some(what) = order.stale(&self.cast) {
            return Err(OrderError::new(OrderErrorKind::NotFound, format!("{what} is not there any more")));
        }
        match order {
            Order::Character { id, order } => {
                let outcome = self.apply_to_character(*id, order)?;
                let who = || self.cast.character_name(*id).to_owned();
                Ok(match outcome {
                    Some((effect, undo)) => Applied { effect: Some(Effect::of(who(), effect)), undo },
                    None => Applied { effect: None, undo: Undo::Nothing },
                })
            }
            Order::Stage(order) => self.apply_to_stage(order),
        }
    }

    /// What has lasted for its time is taken back, unless that makes no sense any more, as when the character follows in another
    /// way by now.
    pub(crate) fn end_timed_effects(&mut self, step: u64) {
        for order in self.timed_effects.take_due(step) {
            if let Ok(Applied { effect: Some(effect), .. }) = self.apply(&order) {
                self.note(Cause::TimeOver, effect.at_its_end());
            }
        }
    }

    /// These orders take back what lasts, when its time is over.
    fn end_with(&mut self, for_secs: Option<f64>, orders: &[Order]) {
        let step_secs = self.world.settings().step_secs();
        let steps = for_secs.map(|secs| step_of(secs, step_secs).max(1));
        let until = steps.map(|steps| self.world.frame().step.saturating_add(steps));
        for order in orders {
            self.timed_effects.end_at(until, order.clone());
        }
    }
}

fn to_character(id: CharacterId, order: CharacterOrder) -> Order {
    Order::Character { id, order }
}

fn prop_gravity(prop: PropId, scale: f64) -> Order {
    Order::Stage(StageOrder::PropGravity { prop, scale, over_secs: None, for_secs: None })
}

/// The stage is not in a state for an order.
fn wrong_state(problem: impl Into<String>) -> OrderError {
    OrderError::new(OrderErrorKind::WrongState, problem)
}
