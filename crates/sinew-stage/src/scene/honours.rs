//! Whether a character's tracker honours what the scene asks of it.

use super::error::Fault;
use super::{KdSpec, ResponseSpec, SceneSpec};
use crate::Cast;
use crate::order::{CharacterOrder, Order, Resolver};
use sinew_control::tracker::{Asked, TrackerKind};
use sinew_control::{Action, Command, Layer, OrderError, OrderErrorKind};
use std::collections::BTreeMap;

/// What a controller calls to give its character another tracker.
const USE_TRACKER: &str = "useTracker";

/// Trackers that each character may have.
type Kinds<'a> = BTreeMap<&'a str, Vec<TrackerKind>>;

impl SceneSpec {
    /// What no tracker of a character would honour is refused: the one that it begins with, and those that the scene's commands and its
    /// controllers give it. `text` is that of a controller.
    pub(super) fn check_honoured<'t>(&self, text: &impl Fn(&str) -> Option<&'t str>) -> Result<(), Fault> {
        let trackers = self.trackers(text);
        let kinds_of = |name: &str| trackers.get(name).map_or(&[][..], Vec::as_slice);
        for (name, spec) in &self.characters {
            let kinds = kinds_of(name);
            let at = |key| ["characters", name, key];
            let lacks_poses = !spec.layers.contains(&Layer::Poses);
            for (key, is_stated, asked) in [
                ("pose_gain", spec.pose_gain != 1.0, Asked::Gains),
                ("layers", lacks_poses, Asked::Gains),
                ("reflexes", !spec.reflexes.is_empty(), Asked::Torques),
                ("joints", !spec.joints.is_empty(), Asked::Springs),
            ] {
                if is_stated {
                    honoured(kinds, asked).map_err(|error| Fault::of_order(&at(key), &error))?;
                }
            }
            for (key, is_stated, kind) in [
                ("kd", spec.kd != KdSpec::default(), TrackerKind::Kd),
                ("response", spec.response != ResponseSpec::default(), TrackerKind::Response),
            ] {
                if is_stated {
                    followed_by(kinds, kind).map_err(|error| Fault::of_order(&at(key), &error))?;
                }
            }
        }
        let cast = Cast::of(self);
        let resolver = Resolver { scene: self, cast: &cast };
        for (list, index, command) in self.commands() {
            let Some(name) = &command.character else { continue };
            let fault = |error: OrderError| Fault::of_order(&[list.to_owned(), index.to_string()], &error);
            let Order::Character { order, .. } = resolver.resolve(command).map_err(fault)? else { continue };
            let is_honoured = match &order {
                CharacterOrder::Weights { .. } | CharacterOrder::Kd { .. } | CharacterOrder::Pins { .. } => {
                    followed_by(kinds_of(name), TrackerKind::Kd)
                }
                other => other.asks().map_or(Ok(()), |asked| honoured(kinds_of(name), asked)),
            };
            is_honoured.map_err(fault)?;
        }
        Ok(())
    }

    /// All commands of the scene, each with its list and its place there.
    pub(super) fn commands(&self) -> impl Iterator<Item = (&'static str, usize, &Command)> {
        let at = self.at.iter().enumerate().map(|(index, timed)| ("at", index, &timed.command));
        let when = self.when.iter().enumerate().map(|(index, reaction)| ("when", index, &reaction.command));
        let keys = self.keys.iter().enumerate().map(|(index, binding)| ("keys", index, &binding.command));
        at.chain(when).chain(keys)
    }

    fn trackers<'t>(&self, text: &impl Fn(&str) -> Option<&'t str>) -> Kinds<'_> {
        let mut trackers: Kinds<'_> =
            self.characters.iter().map(|(name, spec)| (name.as_str(), vec![spec.tracker])).collect();
        let switches = |controller: &str| text(controller).is_some_and(|text| text.contains(USE_TRACKER));
        let mut give = |name: &str, given: &[TrackerKind]| {
            let Some(kinds) = trackers.get_mut(name) else { return };
            for kind in given {
                if !kinds.contains(kind) {
                    kinds.push(*kind);
                }
            }
        };
        for (_, _, command) in self.commands() {
            let Some(name) = &command.character else { continue };
            match &command.action {
                Action::Tracker { name: kind } => give(name, TrackerKind::of(kind).as_slice()),
                Action::Controller { name: controller } if switches(controller) => give(name, &TrackerKind::ALL),
                _ => {}
            }
        }
        for (name, spec) in &self.characters {
            if spec.controller.as_deref().is_some_and(switches) {
                give(name, &TrackerKind::ALL);
            }
        }
        trackers
    }
}

fn honoured(kinds: &[TrackerKind], asked: Asked) -> Result<(), OrderError> {
    let mut results = kinds.iter().map(|kind| kind.check(asked));
    let first = results.next().unwrap_or(Ok(()));
    if results.any(|result| result.is_ok()) { Ok(()) } else { first }
}

fn followed_by(kinds: &[TrackerKind], kind: TrackerKind) -> Result<(), OrderError> {
    if kinds.contains(&kind) {
        return Ok(());
    }
    let name = kind.name();
    let problem = format!("only the tracker `{name}` does this; give the character tracker = \"{name}\", or remove it");
    Err(OrderError::new(OrderErrorKind::NotHonoured, problem))
}
