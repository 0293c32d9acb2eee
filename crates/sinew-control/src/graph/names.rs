//! Resolves the names in a graph's conditions.

use crate::pose::PartName;
use sinew_body::humanoid::Node;
use sinew_world::{CharacterId, Contact, Entity, Frame};
use std::collections::BTreeMap;

/// The object of a name of the scene.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Touchable {
    /// One thing.
    One(Entity),
    /// Any part of a character.
    Character(CharacterId),
}

sinew_snapshot::snapshot!(enum Touchable { 0: One(thing), 1: Character(id) });

/// The scene's names: characters, objects, and aliases of parts. Own parts and `ground` need not be among them.
pub trait Names {
    /// The object of a name.
    fn find(&self, name: &str) -> Option<Touchable>;

    /// All names, for messages.
    fn known(&self) -> Vec<&str>;
}

impl Names for BTreeMap<String, Touchable> {
    fn find(&self, name: &str) -> Option<Touchable> {
        self.get(name).copied()
    }

    fn known(&self) -> Vec<&str> {
        self.keys().map(String::as_str).collect()
    }
}

/// A name in a graph, which any character may play.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Thing {
    /// An own part.
    Own(Node),
    /// Any own part, or the own centre of mass.
    Whole,
    /// Something else.
    Other(Touchable),
}

impl Thing {
    /// Own parts first, then the scene's names, then another character's part as `name.part`.
    pub(super) fn find(name: &str, names: &dyn Names) -> Option<Thing> {
        if let Ok(PartName(node)) = name.parse() {
            return Some(Thing::Own(node));
        }
        match name {
            "self" | "centre" => return Some(Thing::Whole),
            "ground" => return Some(Thing::Other(Touchable::One(Entity::Floor))),
            _ => {}
        }
        if let Some(found) = names.find(name) {
            return Some(Thing::Other(found));
        }
        let (whose, part) = name.rsplit_once('.')?;
        let PartName(node) = part.parse().ok()?;
        match names.find(whose)? {
            Touchable::Character(index) => Some(Thing::Other(Touchable::One(Entity::Part(index, node)))),
            Touchable::One(_) => None,
        }
    }

    /// As the scene of a character sees it.
    pub(super) fn seen_by(self, own: CharacterId) -> Touchable {
        match self {
            Thing::Own(node) => Touchable::One(Entity::Part(own, node)),
            Thing::Whole => Touchable::Character(own),
            Thing::Other(other) => other,
        }
    }
}

impl Touchable {
    /// Whether the entity is this object or a part of it.
    pub fn is(self, entity: Entity) -> bool {
        match self {
            Touchable::One(one) => one == entity,
            Touchable::Character(index) => matches!(entity, Entity::Part(whose, _) if whose == index),
        }
    }
}

/// The first contact between two things.
pub fn contact_between(frame: &Frame, one: Touchable, other: Touchable) -> Option<&Contact> {
    frame
        .contacts
        .iter()
        .find(|contact| (one.is(contact.a) && other.is(contact.b)) || (one.is(contact.b) && other.is(contact.a)))
}
