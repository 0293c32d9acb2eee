//! Gravity that changes over a time: balloons that fill, characters that grow light.

use crate::Stage;
use crate::step::step_of;
use sinew_body::humanoid::Node;
use sinew_snapshot::snapshot;
use sinew_world::{CharacterId, Entity, PropId};

/// Something that gravity acts on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Weighs {
    /// A part of a character.
    Part(CharacterId, Node),
    /// A prop.
    Prop(PropId),
}

/// A factor on gravity on its way.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Fade {
    what: Weighs,
    from: f64,
    to: f64,
    begin_step: u64,
    end_step: u64,
}

impl Fade {
    /// What it acts on.
    pub fn on(&self) -> Entity {
        match self.what {
            Weighs::Part(character, node) => Entity::Part(character, node),
            Weighs::Prop(prop) => Entity::Prop(prop),
        }
    }
}

/// The hips of the first character.
impl Default for Weighs {
    fn default() -> Weighs {
        Weighs::Part(CharacterId::default(), Node::Hips)
    }
}

snapshot!(enum Weighs { 0: Part(character, node), 1: Prop(prop) });
snapshot!(Fade { what, from, to, begin_step, end_step } valid |fade| fade.begin_step < fade.end_step);

impl Stage {
    /// Brings factors on gravity to a value, over a time or at once. Whatever was on its way stops.
    pub(crate) fn weigh(&mut self, things: &[Weighs], scale: f64, over_secs: Option<f64>) {
        let step = self.world.frame().step;
        let steps = over_secs.map_or(0, |secs| step_of(secs, self.world.settings().step_secs()));
        for &what in things {
            self.timed_effects.fades.retain(|fade| fade.what != what);
            if steps == 0 {
                self.set_scale(what, scale);
                continue;
            }
            let from = match what {
                Weighs::Part(character, node) => self.world.part_gravity(character, node),
                Weighs::Prop(prop) => self.world.prop_gravity(prop),
            };
            let end_step = step.saturating_add(steps);
            self.timed_effects.fades.push(Fade { what, from, to: scale, begin_step: step, end_step });
        }
    }

    /// The factor on gravity that something has, or comes to, apart from what ends by itself.
    pub(crate) fn scale_without_timed(&self, what: Weighs) -> f64 {
        let fade = self.timed_effects.fades.iter().find(|fade| fade.what == what).map(|fade| fade.to);
        self.timed_effects.gravity_at_end(what).or(fade).unwrap_or_else(|| match what {
            Weighs::Part(character, node) => self.world.part_gravity(character, node),
            Weighs::Prop(prop) => self.world.prop_gravity(prop),
        })
    }

    /// What is on its way goes on by a step.
    pub(crate) fn fade_on(&mut self, step: u64) {
        if self.timed_effects.fades.is_empty() {
            return;
        }
        let mut fades = std::mem::take(&mut self.timed_effects.fades);
        for fade in &fades {
            let done = (step + 1).saturating_sub(fade.begin_step) as f64;
            let share = (done / (fade.end_step - fade.begin_step) as f64).min(1.0);
            self.set_scale(fade.what, fade.from + (fade.to - fade.from) * share);
        }
        fades.retain(|fade| step + 1 < fade.end_step);
        self.timed_effects.fades = fades;
    }

    fn set_scale(&mut self, what: Weighs, scale: f64) {
        match what {
            Weighs::Part(character, node) => self.world.set_part_gravity(character, node, scale),
            Weighs::Prop(prop) => self.world.set_prop_gravity(prop, scale),
        }
    }
}
