//! Orders to the tracker `kd`: how firmly a performer's motion holds a body.

use super::{Outcome, to_character};
use crate::Stage;
use crate::event::CharacterEffect as E;
use crate::order::{CharacterOrder as O, FADE_SECS, KdChange, Undo};
use sinew_control::tracker::{KdGains, KdTracker};
use sinew_control::{OrderError, OrderErrorKind};
use sinew_world::CharacterId;

impl Stage {
    pub(super) fn apply_kd(&mut self, id: CharacterId, order: &O) -> Outcome {
        match order {
            O::Weights { nodes, pin, joint, fade_secs, for_secs } => {
                let kd = self.kd(id)?;
                let mut undo = Vec::new();
                for &node in nodes {
                    let before = kd.weight(node);
                    undo.push(to_character(
                        id,
                        O::Weights {
                            nodes: vec![node],
                            pin: Some(before.pin),
                            joint: Some(before.joint),
                            fade_secs: FADE_SECS,
                            for_secs: None,
                        },
                    ));
                    kd.set_weight(node, *pin, *joint, *fade_secs);
                }
                self.end_with(*for_secs, &undo);
                Ok(Some((E::Weights { nodes: nodes.clone(), pin: *pin, joint: *joint }, Undo::Orders(undo))))
            }
            O::Kd { change, fade_secs, for_secs } => {
                let kd = self.kd(id)?;
                let before = kd.settings();
                let restored = KdChange {
                    preset: None,
                    k_p: Some(before.gains.k_p),
                    d_p: Some(before.gains.d_p),
                    k_q: Some(before.gains.k_q),
                    d_q: Some(before.gains.d_q),
                    damping: Some(before.damping),
                    feed_forward: Some(before.feed_forward),
                };
                let base = change.preset.map_or(before.gains, |preset| preset.gains());
                let gains = KdGains {
                    k_p: change.k_p.unwrap_or(base.k_p),
                    d_p: change.d_p.unwrap_or(base.d_p),
                    k_q: change.k_q.unwrap_or(base.k_q),
                    d_q: change.d_q.unwrap_or(base.d_q),
                };
                kd.set_gains(gains, *fade_secs);
                if let Some(damping) = change.damping {
                    kd.set_damping(damping);
                }
                if let Some(on) = change.feed_forward {
                    kd.set_feed_forward(on);
                }
                let undo = [to_character(id, O::Kd { change: restored, fade_secs: FADE_SECS, for_secs: None })];
                self.end_with(*for_secs, &undo);
                Ok(Some((E::KdGains(gains), Undo::Orders(undo.to_vec()))))
            }
            O::Pins { on, fade_secs, for_secs } => {
                let kd = self.kd(id)?;
                let changes = kd.has_pins() != *on;
                kd.set_pins(*on, *fade_secs);
                // A source without root motion has the hips stand where they are now.
                let frame = self.world.frame().character(id).filter(|_| *on && changes);
                if let (Some(frame), Some(actor)) = (frame, self.actors.get_mut(&id)) {
                    actor.sources.stand_where_it_is(frame);
                }
                let other = [to_character(id, O::Pins { on: !*on, fade_secs: FADE_SECS, for_secs: None })];
                self.end_with(*for_secs, &other);
                let undo = if changes { Undo::Orders(other.to_vec()) } else { Undo::Nothing };
                Ok(Some((E::Pins { on: *on }, undo)))
            }
            _ => Ok(None),
        }
    }

    fn kd(&mut self, id: CharacterId) -> Result<&mut KdTracker, OrderError> {
        self.actor_mut(id)?.tracker_as::<KdTracker>().ok_or_else(|| {
            let problem = "it does not follow by kd; give it tracker = \"kd\"";
            OrderError::new(OrderErrorKind::NotHonoured, problem)
        })
    }
}
