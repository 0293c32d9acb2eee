//! From a command to an order: the one place where names are looked up and ranges are checked.

use super::Order;
use crate::Cast;
use crate::scene::{CharacterSpec, SceneSpec, Touchable, known, shortened};
use sinew_body::humanoid::Node;
use sinew_control::{Action, Command, OrderError, OrderErrorKind as Kind};
use sinew_world::{CharacterId, Entity, PropId, PropJointId};

/// Longest text in a command that is no Python \[bytes\].
pub(super) const MAX_WORDS: usize = 4096;

/// A scene and who is on its stage: what commands are understood against.
#[derive(Clone, Copy, Debug)]
pub struct Resolver<'a> {
    /// The scene.
    pub scene: &'a SceneSpec,
    /// Ids of what the scene names.
    pub cast: &'a Cast,
}

impl<'a> Resolver<'a> {
    /// Understands a command: looks up its names and checks its numbers.
    ///
    /// # Errors
    /// `NotFound` for names, `OutOfRange` and `TooLarge` for values, `WrongTarget`, `Contradiction` and `NotHonoured` for commands that
    /// make no sense; the words begin with the command.
    pub fn resolve(&self, command: &Command) -> Result<Order, OrderError> {
        self.order(command)
            .map_err(|error| error.map_problem(|problem| format!("do = \"{}\": {problem}", word(&command.action))))
    }

    fn order(&self, command: &Command) -> Result<Order, OrderError> {
        let named = command.character.as_deref().map(|name| self.character(name)).transpose()?;
        match (named, &command.action) {
            (_, action) if action.is_for_stage() => self.stage_order(action).map(Order::Stage),
            (Some(id), action) => Ok(Order::Character { id, order: self.character_order(id, action)? }),
            (None, Action::Push { .. } | Action::Gravity { on: Some(_), .. } | Action::Say { .. }) => {
                self.stage_order(&command.action).map(Order::Stage)
            }
            (None, _) => Err(OrderError::new(Kind::WrongTarget, self.needs_character())),
        }
    }

    fn needs_character(&self) -> String {
        match self.scene.characters.keys().next() {
            Some(first) => format!("it is for a character; add character = \"{first}\""),
            None => "it is for a character, and the scene has none; add [characters.NAME]".to_owned(),
        }
    }

    pub(super) fn character(&self, name: &str) -> Result<CharacterId, OrderError> {
        self.cast.character(name).ok_or_else(|| not_found("character", name, self.scene.characters.keys()))
    }

    pub(super) fn prop(&self, name: &str) -> Result<PropId, OrderError> {
        self.cast.prop(name).ok_or_else(|| not_found("prop", name, self.scene.props.keys()))
    }

    pub(super) fn joint(&self, name: &str) -> Result<PropJointId, OrderError> {
        self.cast.joint(name).ok_or_else(|| not_found("joint", name, self.scene.joints.keys()))
    }

    pub(super) fn controller(&self, name: &str) -> Result<String, OrderError> {
        one_of("controller", name, self.scene.controllers.keys().map(String::as_str))
    }

    /// The table of a character.
    pub(super) fn spec(&self, id: CharacterId) -> Result<&'a CharacterSpec, OrderError> {
        let spec = self.scene.characters.get(self.cast.character_name(id));
        spec.ok_or_else(|| OrderError::new(Kind::NotFound, format!("there is no character {id} any more")))
    }

    /// A part of a character.
    pub(super) fn node(&self, id: CharacterId, name: &str) -> Result<Node, OrderError> {
        let spec = self.spec(id)?;
        spec.node(name).ok_or_else(|| OrderError::new(Kind::NotFound, spec.no_part(name)))
    }

    pub(super) fn some_node(&self, id: CharacterId, name: Option<&str>) -> Result<Option<Node>, OrderError> {
        name.map(|name| self.node(id, name)).transpose()
    }

    /// Parts; `usual` when none is named.
    pub(super) fn nodes(&self, id: CharacterId, names: &[String], usual: &[Node]) -> Result<Vec<Node>, OrderError> {
        if names.is_empty() {
            return Ok(usual.to_vec());
        }
        if names.len() > MAX_NODES {
            let problem = format!("{} parts are listed; a character has {}", names.len(), Node::COUNT);
            return Err(OrderError::new(Kind::TooLarge, problem));
        }
        names.iter().map(|name| self.node(id, name)).collect()
    }

    /// A prop, or another character's part; `None` for an empty name.
    pub(super) fn holdable(&self, own: CharacterId, name: &str) -> Result<Option<Entity>, OrderError> {
        if name.is_empty() {
            return Ok(None);
        }
        let wrong = |problem: String| Err(OrderError::new(Kind::WrongTarget, problem));
        match self.scene.touchable(name)? {
            Touchable::Prop(prop) => Ok(Some(Entity::Prop(self.prop(&prop)?))),
            Touchable::Part(character, node) => match self.character(&character)? {
                owner if owner == own => wrong(format!("`{}` is a part of its own", shortened(name))),
                owner => Ok(Some(Entity::Part(owner, node))),
            },
            Touchable::Character(_) => {
                wrong(format!("a character is held by a part; write `{}.leftHand` or another", shortened(name)))
            }
            Touchable::Ground => wrong("the ground cannot be held; add a fixed prop".to_owned()),
        }
    }
}

/// Parts that a command may list; more than a character has, for aliases.
const MAX_NODES: usize = 100;

pub(super) fn not_found<'a>(what: &str, name: &str, names: impl Iterator<Item = &'a String>) -> OrderError {
    let problem = format!("no {what} `{}`; {}", shortened(name), known(name, names.map(String::as_str)));
    OrderError::new(Kind::NotFound, problem)
}

/// The name, if it is one of these.
pub(crate) fn one_of<'a>(
    what: &str,
    wanted: &str,
    names: impl Iterator<Item = &'a str> + Clone,
) -> Result<String, OrderError> {
    if names.clone().any(|name| name == wanted) {
        return Ok(wanted.to_owned());
    }
    let problem = format!("no {what} `{}`; {}", shortened(wanted), known(wanted, names));
    Err(OrderError::new(Kind::NotFound, problem))
}

/// The action's word in files.
fn word(action: &Action) -> String {
    let value = serde_json::to_value(action).unwrap_or_default();
    value.get("do").and_then(|word| word.as_str()).unwrap_or_default().to_owned()
}

/// A text that is not too long.
pub(super) fn words(text: &str, max_bytes: usize) -> Result<String, OrderError> {
    if text.len() <= max_bytes {
        return Ok(text.to_owned());
    }
    Err(OrderError::new(Kind::TooLarge, format!("a text is longer than {max_bytes} bytes; shorten it")))
}
