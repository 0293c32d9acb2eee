//! Hands pass through what they reach for: they have no fingers to close around it, and would push it away, or be kept off it.

use crate::Stage;
use crate::reach_aim::depth;
use sinew_control::source::{Aimed, HANDS};
use sinew_world::{CharacterId, Entity, PropId};

/// How far a hand's centre is from a prop's surface when it is clear of it \[m\]: more than half a hand.
const CLEAR_M: f64 = 0.13;

impl Stage {
    /// The hands that are aimed at props pass through them from now on.
    pub(crate) fn pass_through(&mut self, index: CharacterId, aimed: &[Option<Aimed>; 2]) {
        for (side, aimed) in aimed.iter().enumerate() {
            let Some(Aimed::Prop(prop, _)) = *aimed else { continue };
            self.world.set_passes_prop(index, HANDS[side], prop, true);
            let Some(actor) = self.actors.get_mut(&index) else { continue };
            if !actor.through.contains(&(side, prop)) {
                actor.through.push((side, prop));
            }
        }
    }

    /// Hands that reach for something else by now, or for nothing, push again what they are clear of.
    pub(crate) fn end_passing(&mut self, index: CharacterId) {
        let Some(actor) = self.actors.get_mut(&index).filter(|actor| !actor.through.is_empty()) else { return };
        let mut through = std::mem::take(&mut actor.through);
        through.retain(|&(side, prop)| {
            let reach = self.actors.get(&index).and_then(|actor| actor.sources.reach());
            let is_aimed = reach.is_some_and(|reach| reach.is_aimed(side, prop));
            let stays = is_aimed || !self.is_clear(index, side, prop);
            if !stays {
                self.world.set_passes_prop(index, HANDS[side], prop, false);
            }
            stays
        });
        if let Some(actor) = self.actors.get_mut(&index) {
            actor.through = through;
        }
    }

    fn is_clear(&self, index: CharacterId, side: usize, prop: PropId) -> bool {
        let frame = self.world.frame();
        let (Some(character), Some(state)) = (frame.character(index), frame.prop(prop)) else { return true };
        let away = character.part(HANDS[side]).centre - state.centre;
        let depth = self.solid_of(prop).map_or(0.0, |solid| depth(&solid, state, away.normalize_or_zero()));
        !self.world.is_attached(index, HANDS[side], Entity::Prop(prop)) && away.length() > depth + CLEAR_M
    }
}
