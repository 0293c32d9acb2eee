//! The cast: characters, props and joints of a stage, by name.

use crate::scene::{JointKind, SceneSpec};
use sinew_body::humanoid::Node;
use sinew_control::graph::{Names, Touchable};
use sinew_world::{CharacterId, Entity, PropId, PropJointId};
use std::collections::BTreeMap;

/// Names of characters and props, and what they are in the world: a slot of the world, in alphabetical order.
#[derive(Clone, Debug, Default)]
pub struct Cast {
    characters: Vec<String>,
    props: Vec<String>,
    joints: Vec<String>,
    /// By joint.
    hinges: Vec<bool>,
    /// By character: alias, part.
    aliases: Vec<BTreeMap<String, Node>>,
}

/// Name of the ground.
pub const GROUND: &str = "ground";

impl Cast {
    /// The cast of a scene.
    pub fn of(scene: &SceneSpec) -> Cast {
        let aliases = |character: &crate::scene::CharacterSpec| {
            character.aliases.keys().filter_map(|alias| Some((alias.clone(), character.node(alias)?))).collect()
        };
        Cast {
            characters: scene.characters.keys().cloned().collect(),
            props: scene.props.keys().cloned().collect(),
            joints: scene.joints.keys().cloned().collect(),
            hinges: scene.joints.values().map(|joint| joint.kind == JointKind::Hinge).collect(),
            aliases: scene.characters.values().map(aliases).collect(),
        }
    }

    /// Names of characters, in the order of the frame.
    pub fn characters(&self) -> &[String] {
        &self.characters
    }

    /// Names of props, in the order of the frame.
    pub fn props(&self) -> &[String] {
        &self.props
    }

    /// Names of the scene's joints, in the order of the world's.
    pub fn joints(&self) -> &[String] {
        &self.joints
    }

    /// Aliases of a character's parts.
    pub fn aliases(&self, character: CharacterId) -> impl Iterator<Item = (&String, Node)> {
        self.aliases.get(character.slot()).into_iter().flatten().map(|(alias, node)| (alias, *node))
    }

    /// The character of this name.
    pub fn character(&self, name: &str) -> Option<CharacterId> {
        self.characters.iter().position(|known| known == name).map(CharacterId::first_in)
    }

    /// The prop of this name.
    pub fn prop(&self, name: &str) -> Option<PropId> {
        self.props.iter().position(|known| known == name).map(PropId::first_in)
    }

    /// The joint of this name.
    pub fn joint(&self, name: &str) -> Option<PropJointId> {
        self.joints.iter().position(|known| known == name).map(PropJointId::first_in)
    }

    /// The name of a joint; empty for one that is not there.
    pub fn joint_name(&self, joint: PropJointId) -> &str {
        self.joints.get(joint.slot()).map_or("", String::as_str)
    }

    /// Whether a joint is a hinge, and not a slider or another joint.
    pub fn is_hinge(&self, joint: PropJointId) -> bool {
        self.hinges.get(joint.slot()).is_some_and(|is_hinge| *is_hinge)
    }

    /// A part of a character, by its VRM name or an alias.
    pub fn part(&self, character: CharacterId, name: &str) -> Option<Node> {
        if let Some(node) = self.aliases.get(character.slot())?.get(name) {
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

    /// The name of an entity: `ball`, `left.rightHand`, `ground`.
    pub fn name_of(&self, entity: Entity) -> String {
        match entity {
            Entity::Floor => GROUND.to_owned(),
            Entity::Prop(prop) => self.props.get(prop.slot()).cloned().unwrap_or_default(),
            Entity::Part(character, node) => {
                let owner = self.characters.get(character.slot()).map_or("", String::as_str);
                format!("{owner}.{}", node.part().name())
            }
        }
    }
}

impl Names for Cast {
    fn find(&self, name: &str) -> Option<Touchable> {
        self.meaning(name, None)
    }

    fn known(&self) -> Vec<&str> {
        self.characters.iter().chain(&self.props).map(String::as_str).collect()
    }
}
