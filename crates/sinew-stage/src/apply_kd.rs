//! Commands to the tracker `kd`: how firmly a performer's motion holds a body.

use crate::Stage;
use crate::apply_command::number;
use crate::event::{CharacterEffect, Effect};
use crate::timed_effect::Expiry;
use sinew_body::humanoid::Node;
use sinew_control::Action;
use sinew_control::tracker::{KdGains, KdTracker};
use sinew_world::CharacterId;

/// Gains and switches fade over this time when a command does not say \[s\].
const FADE_SECS: f64 = 0.5;

impl Stage {
    pub(crate) fn apply_kd(&mut self, character: CharacterId, action: &Action) -> Result<CharacterEffect, String> {
        let fade = |secs: &Option<f64>| number(secs.unwrap_or(FADE_SECS), "fade_secs").map(|secs| secs.max(0.0));
        match action {
            Action::Weights { parts, pin, joint, fade_secs, for_secs } => {
                let nodes = if parts.is_empty() { Node::ALL.to_vec() } else { self.parts(character, parts)? };
                let fade_secs = fade(fade_secs)?;
                let weight = |value: &Option<f64>, what| value.map(|value| number(value, what)).transpose();
                let (pin, joint) = (weight(pin, "pin")?, weight(joint, "joint")?);
                let until = self.until(*for_secs)?;
                let kd = self.kd(character)?;
                for &node in &nodes {
                    kd.set_weight(node, pin.map(|pin| pin.max(0.0)), joint.map(|joint| joint.max(0.0)), fade_secs);
                }
                for &node in &nodes {
                    self.timed_effects.end_at(until, Expiry::Weights(character, node));
                }
                Ok(CharacterEffect::Weights { nodes, pin, joint })
            }
            Action::Kd { preset, k_p, d_p, k_q, d_q, damping, feed_forward, fade_secs, for_secs } => {
                let fade_secs = fade(fade_secs)?;
                let until = self.until(*for_secs)?;
                let kd = self.kd(character)?;
                let base = preset.map_or(kd.gains(), |preset| preset.gains());
                let gain = |value: &Option<f64>, or: f64, what| number(value.unwrap_or(or), what);
                let gains = KdGains {
                    k_p: gain(k_p, base.k_p, "k_p")?.max(0.0),
                    d_p: gain(d_p, base.d_p, "d_p")?.max(0.0),
                    k_q: gain(k_q, base.k_q, "k_q")?.max(0.0),
                    d_q: gain(d_q, base.d_q, "d_q")?.max(0.0),
                };
                kd.set_gains(gains, fade_secs);
                if let Some(damping) = damping {
                    kd.set_damping(*damping);
                }
                if let Some(on) = feed_forward {
                    kd.set_feed_forward(*on);
                }
                self.timed_effects.end_at(until, Expiry::Kd(character));
                Ok(CharacterEffect::KdGains(gains))
            }
            Action::Pins { on, fade_secs, for_secs } => {
                let fade_secs = fade(fade_secs)?;
                let until = self.until(*for_secs)?;
                self.switch_pins(character, *on, fade_secs)?;
                self.timed_effects.end_at(until, Expiry::Pins(character));
                Ok(CharacterEffect::Pins { on: *on })
            }
            _ => Err("this is no command to the tracker kd".to_owned()),
        }
    }

    /// Undoes what has lasted for its time; what was done, unless the character follows in another way by now.
    pub(crate) fn end_kd(&mut self, ending: &Expiry) -> Option<Effect> {
        let (Expiry::Weights(character, _) | Expiry::Kd(character) | Expiry::Pins(character)) = *ending else {
            return None;
        };
        let who = self.cast.characters().get(character.slot())?.clone();
        if *ending == Expiry::Pins(character) {
            let on = !self.kd(character).ok()?.has_pins();
            self.switch_pins(character, on, FADE_SECS).ok()?;
            return Some(Effect::of(who, CharacterEffect::Pins { on }));
        }
        let scene = std::sync::Arc::clone(&self.scene);
        let spec = scene.characters.values().nth(character.slot())?;
        let settings = spec.kd.settings(|part| spec.node(part));
        let kd = self.kd(character).ok()?;
        match ending {
            Expiry::Weights(_, node) => {
                let weight = settings.weights[node.index()];
                kd.set_weight(*node, Some(weight.pin), Some(weight.joint), FADE_SECS);
                Some(Effect::of(who, CharacterEffect::WeightsRestored { node: *node }))
            }
            _ => {
                kd.set_gains(settings.gains, FADE_SECS);
                kd.set_damping(settings.damping);
                kd.set_feed_forward(settings.feed_forward);
                Some(Effect::of(who, CharacterEffect::KdGainsRestored))
            }
        }
    }

    fn switch_pins(&mut self, character: CharacterId, on: bool, fade_secs: f64) -> Result<(), String> {
        let kd = self.kd(character)?;
        let comes_on = on && !kd.has_pins();
        kd.set_pins(on, fade_secs);
        // A source that knows no place has the hips stand where they are now.
        if let Some(frame) = self.world.frame().character(character).filter(|_| comes_on) {
            self.actors[character.slot()].sources.stand_where_it_is(frame);
        }
        Ok(())
    }

    fn kd(&mut self, character: CharacterId) -> Result<&mut KdTracker, String> {
        self.actors[character.slot()]
            .tracker_as::<KdTracker>()
            .ok_or_else(|| "it does not follow by kd; give it tracker = \"kd\"".to_owned())
    }
}
