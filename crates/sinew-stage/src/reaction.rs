//! The scene's `[[when]]`: commands when two things touch.

use crate::cast::Cast;
use crate::event::Cause;
use crate::order::{Order, Resolver};
use crate::scene::Scene;
use crate::step::step_of;
use sinew_control::graph::Touchable;
use sinew_control::{Command, OrderError};
use sinew_snapshot::snapshot;
use sinew_world::{Entity, Frame};

#[derive(Clone)]
pub(crate) struct Reactions {
    list: Vec<Waiting>,
}

#[derive(Clone)]
struct Waiting {
    touching: [Touchable; 2],
    line: usize,
    /// The two as the scene names them.
    names: [String; 2],
    order: Order,
    command: Command,
    /// Steps until it may fire again; `None` for never.
    repeat_after: Option<u64>,
    /// The first step in which it may fire; `None` when it is done.
    ready_at: Option<u64>,
}

/// Nothing that happens; for reading one.
impl Default for Waiting {
    fn default() -> Waiting {
        Waiting {
            touching: [Touchable::One(Entity::Floor); 2],
            line: 0,
            names: Default::default(),
            order: Order::default(),
            command: Command::default(),
            repeat_after: None,
            ready_at: None,
        }
    }
}

snapshot!(Reactions { list });
snapshot!(Waiting { touching, line, names, order, command, repeat_after, ready_at }
    valid |waiting| waiting.repeat_after.is_none_or(|steps| steps <= u64::MAX / 4));

impl Reactions {
    pub fn of(scene: &Scene, cast: &Cast) -> Result<Reactions, OrderError> {
        let step_secs = scene.stage.world_settings().step_secs();
        let resolver = Resolver { scene, cast };
        let mut list = Vec::new();
        for reaction in &scene.when {
            let [one, other] = &reaction.touching;
            // The scene was checked: both are there.
            let (Some(one), Some(other)) = (cast.meaning(one, None), cast.meaning(other, None)) else { continue };
            list.push(Waiting {
                touching: [one, other],
                line: reaction.line,
                names: reaction.touching.clone(),
                order: resolver.resolve(&reaction.command)?,
                command: reaction.command.clone(),
                repeat_after: reaction.repeat_after_secs.map(|secs| step_of(secs, step_secs).max(1)),
                ready_at: Some(0),
            });
        }
        Ok(Reactions { list })
    }

    /// Those that were there before go on as they were: one that fires once does not fire again.
    #[must_use]
    pub fn continued(mut self, before: &Reactions) -> Reactions {
        for waiting in &mut self.list {
            let key = |one: &Waiting| (one.names.clone(), one.command.clone(), one.repeat_after);
            if let Some(known) = before.list.iter().find(|one| key(one) == key(waiting)) {
                waiting.ready_at = known.ready_at;
            }
        }
        self
    }

    /// Orders of those whose touch begins, with the cause.
    pub fn fired(&mut self, frame: &Frame, cast: &Cast) -> Vec<(Order, Cause)> {
        let mut fired = Vec::new();
        for waiting in &mut self.list {
            if waiting.ready_at.is_none_or(|step| step > frame.step) {
                continue;
            }
            let [one, other] = waiting.touching;
            let touch = frame.contacts.iter().find(|contact| {
                contact.begins && (one.is(contact.a) && other.is(contact.b) || one.is(contact.b) && other.is(contact.a))
            });
            if let Some(touch) = touch {
                waiting.ready_at = waiting.repeat_after.map(|steps| frame.step + steps);
                let cause = Cause::Reaction {
                    line: waiting.line,
                    touching: waiting.names.clone(),
                    touched: [touch.a, touch.b].map(|thing| cast.name_of(thing)),
                };
                fired.push((waiting.order.clone(), cause));
            }
        }
        fired
    }
}
