//! Whether a command fits a scene. Scripts, keys, takes and networks are held to this as the scene's own time line is.

use super::error::{known, shortened};
use super::kd::{MAX_GAIN, MAX_WEIGHT};
use super::stage::MAX_SECS;
use super::{REFLEXES, SceneSpec};
use sinew_body::humanoid::Limb;
use sinew_control::tracker::TrackerKind;
use sinew_control::{Action, Command};
use std::ops::RangeInclusive;

/// Longest text in a command that is no Python \[bytes\].
const MAX_WORDS: usize = 4096;

/// Largest Python text \[bytes\].
pub(super) const MAX_PYTHON_BYTES: usize = 1 << 20;

impl SceneSpec {
    /// Whether a command names things that exist and holds numbers that are sound.
    ///
    /// # Errors
    /// What is wrong with it and what to do.
    pub fn check_command(&self, command: &Command) -> Result<(), String> {
        self.check_action(command).map_err(|problem| format!("do = \"{}\": {problem}", word(&command.action)))
    }

    fn check_action(&self, command: &Command) -> Result<(), String> {
        use Action as A;
        let within = |key: &str, value: f64, range: RangeInclusive<f64>| {
            if range.contains(&value) {
                return Ok(());
            }
            Err(format!("{key} = {value} is out of range {} to {}", range.start(), range.end()))
        };
        let secs = |value: Option<f64>| within("for_secs", value.unwrap_or(0.0), 0.0..=MAX_SECS);
        let three = |key: &str, value: [f64; 3], most: f64| {
            value.into_iter().try_for_each(|value| within(key, value, -most..=most))
        };
        let part = |name: &str| self.own_part(command, name);
        let some_part = |name: &Option<String>| name.as_deref().map_or_else(|| self.owner(command).map(drop), part);
        let one_of = |what: &str, name: &str, names: &mut dyn Iterator<Item = &str>| one_of(what, name, names);
        let words = |text: &str, most: usize| {
            if text.len() <= most { Ok(()) } else { Err(format!("a text is longer than {most} bytes; shorten it")) }
        };
        if command.character.is_some() {
            self.owner(command)?;
        }
        match &command.action {
            A::Pose { name } => {
                self.owner(command)?;
                one_of("pose", name, &mut self.pose_names())
            }
            A::Graph { name, state } => {
                self.owner(command)?;
                one_of("graph", name, &mut self.graphs.keys().map(String::as_str))?;
                match (state, self.graphs.get(name)) {
                    (Some(state), Some(graph)) => one_of("state", state, &mut graph.states.keys().map(String::as_str)),
                    _ => Ok(()),
                }
            }
            A::Signal { name } => {
                self.owner(command)?;
                words(name, MAX_WORDS)
            }
            A::Ik { link, target_m } => {
                some_part(link)?;
                let node = link.as_deref().and_then(|link| self.owner(command).ok()?.node(link));
                if let Some(node) = node.filter(|node| Limb::of(*node).is_none()) {
                    return Err(format!("{} is no part of an arm or a leg; name a hand or a foot", node.part()));
                }
                three("target_m", *target_m, 1e5)
            }
            A::IkRelease { link } => some_part(link),
            A::Attach { link, object, break_n, .. } => {
                part(link)?;
                if !object.is_empty() {
                    self.holdable(object)?;
                }
                within("break_n", break_n.unwrap_or(1.0), 1e-6..=1e9)
            }
            A::Detach { link, object } => {
                part(link)?;
                if object.is_empty() { Ok(()) } else { self.holdable(object) }
            }
            A::Push { on, force_n, for_secs, facing, at_m } => {
                match command.character {
                    Some(_) => part(on)?,
                    None if *facing => return Err("only a character has a facing; name it with character".to_owned()),
                    None => self.prop(on)?,
                }
                three("force_n", *force_n, sinew_world::MAX_FORCE_N)?;
                three("at_m", at_m.unwrap_or_default(), 1e3)?;
                secs(Some(*for_secs))
            }
            A::Gain { factor, part: only } => {
                some_part(only)?;
                within("factor", *factor, 0.0..=1000.0)
            }
            A::ForcesOff { parts, for_secs } => {
                self.owner(command)?;
                parts.iter().try_for_each(|name| part(name))?;
                secs(*for_secs)
            }
            A::ForcesOn { parts } => {
                self.owner(command)?;
                parts.iter().try_for_each(|name| part(name))
            }
            A::Plane { facing_deg, for_secs } => {
                self.owner(command)?;
                within("facing_deg", facing_deg.unwrap_or(0.0), -360.0..=360.0)?;
                secs(*for_secs)
            }
            A::PlaneOff {} | A::Layer { .. } => self.owner(command).map(drop),
            A::Gravity { scale, on, part: only, over_secs, for_secs } => {
                match (&command.character, on) {
                    (Some(_), Some(_)) => return Err("`on` is for objects; remove it or `character`".to_owned()),
                    (None, Some(object)) => self.prop(object)?,
                    (_, None) => drop(self.owner(command)?),
                }
                if let Some(only) = only {
                    part(only)?;
                }
                within("scale", *scale, -100.0..=100.0)?;
                within("over_secs", over_secs.unwrap_or(0.0), 0.0..=MAX_SECS)?;
                secs(*for_secs)
            }
            A::Motor { joint, speed_rad_s, angle_deg, speed_m_s, shift_m } => {
                let stated = [
                    ("speed_rad_s", *speed_rad_s),
                    ("angle_deg", *angle_deg),
                    ("speed_m_s", *speed_m_s),
                    ("shift_m", *shift_m),
                ];
                self.check_motor(joint, stated)
            }
            A::Cut { joint } => self.joint(joint).map(drop),
            A::Shape { part: name, shape, for_secs } => {
                part(name)?;
                one_of("shape", shape, &mut self.shapes.keys().map(String::as_str).chain(["own", "none"]))?;
                secs(*for_secs)
            }
            A::AddShape { part: name, shape, for_secs } => {
                part(name)?;
                one_of("shape", shape, &mut self.shapes.keys().map(String::as_str))?;
                secs(*for_secs)
            }
            A::RemoveShape { part: name, shape } => {
                part(name)?;
                one_of("shape", shape, &mut self.shapes.keys().map(String::as_str))
            }
            A::Reflex { name, .. } => {
                self.owner(command)?;
                one_of("reflex", name, &mut REFLEXES.into_iter())
            }
            A::Controller { name } => {
                self.owner(command)?;
                if name.is_empty() { Ok(()) } else { self.controller(name) }
            }
            A::Weights { parts, pin, joint, fade_secs, for_secs } => {
                self.owner(command)?;
                parts.iter().try_for_each(|name| part(name))?;
                within("pin", pin.unwrap_or(1.0), 0.0..=MAX_WEIGHT)?;
                within("joint", joint.unwrap_or(1.0), 0.0..=MAX_WEIGHT)?;
                secs(*fade_secs)?;
                secs(*for_secs)
            }
            A::Kd { k_p, d_p, k_q, d_q, fade_secs, for_secs, .. } => {
                self.owner(command)?;
                for (key, gain) in [("k_p", k_p), ("d_p", d_p), ("k_q", k_q), ("d_q", d_q)] {
                    within(key, gain.unwrap_or(1.0), 0.0..=MAX_GAIN)?;
                }
                secs(*fade_secs)?;
                secs(*for_secs)
            }
            A::Pins { fade_secs, for_secs, .. } => {
                self.owner(command)?;
                secs(*fade_secs)?;
                secs(*for_secs)
            }
            A::Tracker { name } => {
                self.owner(command)?;
                one_of("tracker", name, &mut TrackerKind::ALL.into_iter().map(TrackerKind::name))
            }
            A::Place { object, position_m, velocity_m_s } => {
                self.prop(object)?;
                three("position_m", position_m.unwrap_or_default(), 1e5)?;
                three("velocity_m_s", velocity_m_s.unwrap_or_default(), 1e3)
            }
            A::Accelerate { object, acceleration_m_s2, for_secs } => {
                self.prop(object)?;
                if !self.props.get(object).is_some_and(|prop| prop.moving) {
                    return Err(format!("`{}` is no platform; write moving = true in [props.{0}]", shortened(object)));
                }
                three("acceleration_m_s2", *acceleration_m_s2, 1e4)?;
                secs(Some(*for_secs))
            }
            A::Reload { name, text } => {
                self.controller(name)?;
                words(text.as_deref().unwrap_or_default(), MAX_PYTHON_BYTES)
            }
            A::ScriptKilled { name, reason } => {
                self.controller(name)?;
                words(reason, MAX_WORDS)
            }
            A::Perform { .. } | A::Live { .. } => match &self.owner(command)?.source {
                Some(source) if source.live.is_some() => match &command.action {
                    A::Perform { sample } => within("time_secs", sample.time_secs, -1e9..=1e9),
                    _ => Ok(()),
                },
                _ => Err("the character has no performer; write source = { live = {} } in its table".to_owned()),
            },
            A::Reach(order) => {
                self.owner(command)?;
                order.check()?;
                order.object.iter().chain(&order.avoid).try_for_each(|name| self.prop(name))
            }
            A::ReachEnd {} => self.owner(command).map(drop),
            A::Say { text } => words(text, MAX_WORDS),
        }
    }

    /// The character that a command is for.
    fn owner(&self, command: &Command) -> Result<&super::CharacterSpec, String> {
        let names = || self.characters.keys().map(String::as_str);
        let Some(name) = &command.character else {
            return Err(match names().next() {
                Some(first) => format!("it is for a character; add character = \"{first}\""),
                None => "it is for a character, and the scene has none; add [characters.NAME]".to_owned(),
            });
        };
        self.characters.get(name).ok_or_else(|| format!("no character `{}`; {}", shortened(name), known(name, names())))
    }

    fn own_part(&self, command: &Command, name: &str) -> Result<(), String> {
        let character = self.owner(command)?;
        character.node(name).map(drop).ok_or_else(|| character.no_part(name))
    }

    fn prop(&self, name: &str) -> Result<(), String> {
        one_of("prop", name, &mut self.props.keys().map(String::as_str))
    }

    fn controller(&self, name: &str) -> Result<(), String> {
        one_of("controller", name, &mut self.controllers.keys().map(String::as_str))
    }

    /// A prop, or another character's part.
    fn holdable(&self, name: &str) -> Result<(), String> {
        match self.touchable(name)? {
            super::Touchable::Prop(_) | super::Touchable::Part(..) => Ok(()),
            super::Touchable::Character(_) => {
                Err(format!("a character is held by a part; write `{}.leftHand` or another", shortened(name)))
            }
            super::Touchable::Ground => Err("the ground cannot be held; add a fixed prop".to_owned()),
        }
    }
}

fn one_of(what: &str, wanted: &str, names: &mut dyn Iterator<Item = &str>) -> Result<(), String> {
    let names: Vec<&str> = names.collect();
    if names.contains(&wanted) {
        return Ok(());
    }
    Err(format!("no {what} `{}`; {}", shortened(wanted), known(wanted, names)))
}

/// The action's word in files.
fn word(action: &Action) -> String {
    let value = serde_json::to_value(action).unwrap_or_default();
    value.get("do").and_then(|word| word.as_str()).unwrap_or_default().to_owned()
}
