//! The cast: characters, props and joints of a stage, by name.

use crate::scene::{CharacterSpec, JointKind, PropJointSpec, SceneSpec};
use sinew_body::humanoid::Node;
use sinew_control::graph::{Names, Touchable};
use sinew_world::{CharacterId, Entity, PropId, PropJointId, Slots};
use std::collections::BTreeMap;

/// Names of characters, props and joints, and their ids in the world. It gives the same ids as the world does, in which the same is
/// added and removed.
#[derive(Clone, Debug, Default)]
pub struct Cast {
    characters: Slots<CharacterId, Member>,
    props: Slots<PropId, String>,
    joints: Slots<PropJointId, NamedJoint>,
}

#[derive(Clone, Debug)]
struct Member {
    name: String,
    aliases: BTreeMap<String, Node>,
}

#[derive(Clone, Debug)]
struct NamedJoint {
    name: String,
    is_hinge: bool,
    /// It is one within the rope of this name, and has no name that could be said.
    is_in_rope: bool,
}

/// Name of the ground.
pub const GROUND: &str = "ground";

impl Cast {
    /// The cast with which a stage of a scene begins, without the joints within ropes.
    pub fn of(scene: &SceneSpec) -> Cast {
        let mut cast = Cast::default();
        for name in scene.props.keys() {
            cast.add_prop(name);
        }
        for (name, spec) in &scene.characters {
            cast.add_character(name, spec);
        }
        for (name, spec) in &scene.joints {
            cast.add_joint(name, spec);
        }
        cast
    }

    /// The id that the next character has in the world too.
    pub(crate) fn add_character(&mut self, name: &str, spec: &CharacterSpec) -> CharacterId {
        self.characters.insert(Member { name: name.to_owned(), aliases: aliases(spec) })
    }

    pub(crate) fn add_prop(&mut self, name: &str) -> PropId {
        self.props.insert(name.to_owned())
    }

    pub(crate) fn add_joint(&mut self, name: &str, spec: &PropJointSpec) -> PropJointId {
        self.joints.insert(NamedJoint {
            name: name.to_owned(),
            is_hinge: spec.kind == JointKind::Hinge,
            is_in_rope: false,
        })
    }

    pub(crate) fn add_rope_joint(&mut self, rope: &str) -> PropJointId {
        self.joints.insert(NamedJoint { name: rope.to_owned(), is_hinge: false, is_in_rope: true })
    }

    /// The joints within a rope.
    pub(crate) fn rope_joints(&self, rope: &str) -> Vec<PropJointId> {
        let of_rope = self.joints.iter().filter(|(_, joint)| joint.is_in_rope && joint.name == rope);
        of_rope.map(|(id, _)| id).collect()
    }

    /// A character's aliases as a table has them.
    pub(crate) fn set_aliases(&mut self, id: CharacterId, spec: &CharacterSpec) {
        if let Some(member) = self.characters.get_mut(id) {
            member.aliases = aliases(spec);
        }
    }

    pub(crate) fn remove_character(&mut self, id: CharacterId) {
        self.characters.remove(id);
    }

    pub(crate) fn remove_prop(&mut self, id: PropId) {
        self.props.remove(id);
    }

    pub(crate) fn remove_joint(&mut self, id: PropJointId) {
        self.joints.remove(id);
    }

    /// Characters with their names, by slot.
    pub fn characters(&self) -> impl Iterator<Item = (CharacterId, &str)> {
        self.characters.iter().map(|(id, member)| (id, member.name.as_str()))
    }

    /// Props with their names, by slot.
    pub fn props(&self) -> impl Iterator<Item = (PropId, &str)> {
        self.props.iter().map(|(id, name)| (id, name.as_str()))
    }

    /// The scene's joints with their names, by slot; not those within ropes.
    pub fn joints(&self) -> impl Iterator<Item = (PropJointId, &str)> {
        self.joints.iter().filter(|(_, joint)| !joint.is_in_rope).map(|(id, joint)| (id, joint.name.as_str()))
    }

    /// Aliases of a character's parts.
    pub fn aliases(&self, character: CharacterId) -> impl Iterator<Item = (&String, Node)> {
        let aliases = self.characters.get(character).map(|member| &member.aliases);
        aliases.into_iter().flatten().map(|(alias, node)| (alias, *node))
    }

    /// The character of this name.
    pub fn character(&self, name: &str) -> Option<CharacterId> {
        self.characters().find(|(_, known)| *known == name).map(|(id, _)| id)
    }

    /// The prop of this name.
    pub fn prop(&self, name: &str) -> Option<PropId> {
        self.props().find(|(_, known)| *known == name).map(|(id, _)| id)
    }

    /// The joint of this name.
    pub fn joint(&self, name: &str) -> Option<PropJointId> {
        self.joints().find(|(_, known)| *known == name).map(|(id, _)| id)
    }

    /// The name of a character; empty for one that is not there.
    pub fn character_name(&self, character: CharacterId) -> &str {
        self.characters.get(character).map_or("", |member| member.name.as_str())
    }

    /// The name of a prop; empty for one that is not there.
    pub fn prop_name(&self, prop: PropId) -> &str {
        self.props.get(prop).map_or("", String::as_str)
    }

    /// The name of a joint; empty for one that is not there.
    pub fn joint_name(&self, joint: PropJointId) -> &str {
        self.joints.get(joint).map_or("", |joint| joint.name.as_str())
    }

    /// Whether a character is there.
    pub fn has_character(&self, character: CharacterId) -> bool {
        self.characters.get(character).is_some()
    }

    /// Whether a joint is there, whole or not.
    pub fn has_joint(&self, joint: PropJointId) -> bool {
        self.joints.get(joint).is_some()
    }

    /// Whether something is there. The ground always is.
    pub fn has(&self, entity: Entity) -> bool {
        match entity {
            Entity::Floor => true,
            Entity::Prop(prop) => self.props.get(prop).is_some(),
            Entity::Part(character, _) => self.has_character(character),
        }
    }

    /// Whether a joint is a hinge, and not a slider or another joint.
    pub fn is_hinge(&self, joint: PropJointId) -> bool {
        self.joints.get(joint).is_some_and(|joint| joint.is_hinge)
    }

    /// A part of a character, by its VRM name or an alias.
    pub fn part(&self, character: CharacterId, name: &str) -> Option<Node> {
        if let Some(node) = self.characters.get(character)?.aliases.get(name) {
            return Some(*node);
        }
        name.parse().ok().map(Node::of)
    }

    /// `ground`, a prop, a character, `character.part`, or a part of `own`.
    pub fn meaning(&self, name: &str, own: Option<CharacterId>) -> Option<Touchable> {
        if name == GROUND {
            return Some(Touchable::One(Entity::Floor));
        }
        if let Some(prop) = self.prop(name) {
            return Some(Touchable::One(Entity::Prop(prop)));
        }
        if let Some(character) = self.character(name) {
            return Some(Touchable::Character(character));
        }
        if let Some((character, part)) = name.split_once('.') {
            let character = self.character(character)?;
            return Some(Touchable::One(Entity::Part(character, self.part(character, part)?)));
        }
        let own = own?;
        if name == "self" {
            return Some(Touchable::Character(own));
        }
        Some(Touchable::One(Entity::Part(own, self.part(own, name)?)))
    }

    /// The name of an entity: `ball`, `left.rightHand`, `ground`; empty for a prop that is not there.
    pub fn name_of(&self, entity: Entity) -> String {
        match entity {
            Entity::Floor => GROUND.to_owned(),
            Entity::Prop(prop) => self.prop_name(prop).to_owned(),
            Entity::Part(character, node) => format!("{}.{}", self.character_name(character), node.part().name()),
        }
    }
}

fn aliases(spec: &CharacterSpec) -> BTreeMap<String, Node> {
    spec.aliases.keys().filter_map(|alias| Some((alias.clone(), spec.node(alias)?))).collect()
}

impl Names for Cast {
    fn find(&self, name: &str) -> Option<Touchable> {
        self.meaning(name, None)
    }

    fn known(&self) -> Vec<&str> {
        self.characters().map(|(_, name)| name).chain(self.props().map(|(_, name)| name)).collect()
    }
}
