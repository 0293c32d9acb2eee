//! Commands that a scene gives by itself or by a key: at a time, when something touches, when a key is pressed.

use schemars::JsonSchema;
use serde::de::{Deserialize, Deserializer, Error};
use sinew_control::{Action, Command};

/// A command at a time: `[[at]]`.
#[derive(Clone, Debug, PartialEq, JsonSchema)]
#[schemars(deny_unknown_fields)]
pub struct Timed {
    /// When \[s\].
    #[schemars(rename = "time_secs")]
    pub at_secs: f64,
    /// Its line in the scene file, for the list of events; 0 when unknown.
    #[schemars(skip)]
    pub line: usize,
    /// What happens then.
    #[schemars(flatten)]
    pub command: Command,
}

/// A command when two things touch: `[[when]]`.
#[derive(Clone, Debug, PartialEq, JsonSchema)]
#[schemars(deny_unknown_fields)]
pub struct Reaction {
    /// Which two: props, characters, parts as `character.part`, or `ground`.
    pub touching: [String; 2],
    /// Happens again at a touch that begins at least so much later \[s\]; only once when left out.
    #[schemars(with = "Option<f64>")]
    pub repeat_after_secs: Option<f64>,
    /// Its line in the scene file, for the list of events; 0 when unknown.
    #[schemars(skip)]
    pub line: usize,
    /// What happens then.
    #[schemars(flatten)]
    pub command: Command,
}

/// A command when a key is pressed: `[[keys]]`.
#[derive(Clone, Debug, Default, PartialEq, JsonSchema)]
#[schemars(deny_unknown_fields)]
pub struct KeyBinding {
    /// The key: a letter, a digit, or a name such as `Space` or `ArrowUp`. Several commands may share a key.
    pub key: String,
    /// What it does, in words for the user.
    #[schemars(with = "Option<String>")]
    pub label: Option<String>,
    /// What happens then.
    #[schemars(flatten)]
    pub command: Command,
}

sinew_snapshot::snapshot!(KeyBinding { key, label, command });

/// A table whose own keys are taken out; what remains is a command. Serde's `flatten` would accept unknown keys.
struct Entry {
    table: toml::Table,
}

impl Entry {
    fn read<'de, D: Deserializer<'de>>(from: D) -> Result<Entry, D::Error> {
        Ok(Entry { table: toml::Table::deserialize(from)? })
    }

    fn required<T: serde::de::DeserializeOwned, E: Error>(&mut self, key: &'static str) -> Result<T, E> {
        self.optional(key)?.ok_or_else(|| E::missing_field(key))
    }

    fn optional<T: serde::de::DeserializeOwned, E: Error>(&mut self, key: &str) -> Result<Option<T>, E> {
        let Some(value) = self.table.remove(key) else { return Ok(None) };
        value
            .try_into()
            .map(Some)
            .map_err(|error: toml::de::Error| E::custom(format!("{} for `{key}`", error.message())))
    }

    fn command<E: Error>(mut self) -> Result<Command, E> {
        let character = self.optional("character")?;
        if !self.table.contains_key("do") {
            return Err(E::missing_field("do"));
        }
        let action = Action::deserialize(toml::Value::Table(self.table));
        Ok(Command { character, action: action.map_err(|error| E::custom(error.message()))? })
    }
}

impl<'de> Deserialize<'de> for Timed {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Timed, D::Error> {
        let mut entry = Entry::read(from)?;
        Ok(Timed { at_secs: entry.required("time_secs")?, line: 0, command: entry.command()? })
    }
}

impl<'de> Deserialize<'de> for Reaction {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Reaction, D::Error> {
        let mut entry = Entry::read(from)?;
        Ok(Reaction {
            touching: entry.required("touching")?,
            repeat_after_secs: entry.optional("repeat_after_secs")?,
            line: 0,
            command: entry.command()?,
        })
    }
}

impl<'de> Deserialize<'de> for KeyBinding {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<KeyBinding, D::Error> {
        let mut entry = Entry::read(from)?;
        Ok(KeyBinding { key: entry.required("key")?, label: entry.optional("label")?, command: entry.command()? })
    }
}
