//! Pushes: forces that last.

use super::{Applied, Outcome};
use crate::Stage;
use crate::event::{CharacterEffect, Effect};
use crate::order::{CharacterOrder, Undo};
use crate::step::step_of;
use crate::timed_effect::{LastingPush, MAX_PUSHES};
use glam::DVec3;
use sinew_control::{OrderError, OrderErrorKind};
use sinew_world::{CharacterId, Entity, PropId};

impl Stage {
    /// Pushes that act in the present step: on what, where \[m\] and with which force \[N\], both in world axes.
    pub fn pushes(&self) -> impl Iterator<Item = (Entity, DVec3, DVec3)> {
        let frame = self.world.frame();
        self.timed_effects.pushes.iter().filter_map(move |push| {
            let body = match push.on {
                Entity::Floor => return None,
                Entity::Prop(prop) => frame.prop(prop)?,
                Entity::Part(character, node) => frame.character(character)?.part(node),
            };
            Some((push.on, push.at.map_or(body.centre, |at| body.point(at)), push.force))
        })
    }

    pub(super) fn apply_push(&mut self, id: CharacterId, order: &CharacterOrder) -> Outcome {
        let CharacterOrder::Push { node, force, facing, at, for_secs } = order else { return Ok(None) };
        let mut force = *force;
        if *facing && let Some(frame) = self.world.frame().character(id) {
            force = frame.left() * force.x + DVec3::Y * force.y + frame.facing * force.z;
        }
        if !self.start_push(Entity::Part(id, *node), force, *at, *for_secs)? {
            return Ok(None);
        }
        let effect = CharacterEffect::Pushed { node: *node, force_n: force.length(), for_secs: *for_secs };
        Ok(Some((effect, Undo::Impossible)))
    }

    pub(super) fn apply_prop_push(
        &mut self,
        prop: PropId,
        force: DVec3,
        at: Option<DVec3>,
        for_secs: f64,
    ) -> Result<Applied, OrderError> {
        let is_new = self.start_push(Entity::Prop(prop), force, at, for_secs)?;
        let name = self.cast.name_of(Entity::Prop(prop));
        let effect = Effect::PropPushed { prop: name, force_n: force.length(), for_secs };
        Ok(Applied { effect: is_new.then_some(effect), undo: Undo::Impossible })
    }

    /// Begins a push. False when it is one of a row that a script gives step by step: only its first is worth a note.
    fn start_push(&mut self, on: Entity, force: DVec3, at: Option<DVec3>, for_secs: f64) -> Result<bool, OrderError> {
        if self.timed_effects.pushes.len() >= MAX_PUSHES {
            return Err(OrderError::new(OrderErrorKind::TooLarge, format!("{MAX_PUSHES} pushes act already")));
        }
        let steps = step_of(for_secs, self.world.settings().step_secs()).max(1);
        let until_step = self.world.frame().step.saturating_add(steps);
        let goes_on = steps == 1 && self.timed_effects.pushes.iter().any(|push| push.on == on);
        self.timed_effects.pushes.push(LastingPush { on, at, force, until_step });
        Ok(!goes_on)
    }
}
