//! The snapshot of the frame for scripts.

use crate::cast::Cast;
use crate::scene::Scene;
use sinew_body::humanoid::Node;
use sinew_script::{
    CharacterNames, CharacterState, Contact, JointName, JointState, Names, ObjectState, PartState, Snapshot, Thing,
};
use sinew_world::{Entity, Frame, World};

/// Names that scripts can use, in the slots of the frame; a vacant slot has an empty name.
pub(crate) fn names(scene: &Scene, cast: &Cast, frame: &Frame) -> Names {
    let with = |keys: Vec<String>, more: &[&str]| -> Vec<String> {
        more.iter().map(|name| (*name).to_owned()).chain(keys).collect()
    };
    let characters = frame.character_ids.iter().map(|id| {
        let Some(id) = *id else { return CharacterNames::default() };
        let alias = |(alias, node): (&String, Node)| (alias.clone(), node.part().name().to_owned());
        CharacterNames { name: cast.character_name(id).to_owned(), aliases: cast.aliases(id).map(alias).collect() }
    });
    let objects = frame.prop_ids.iter().map(|id| id.map_or("", |id| cast.prop_name(id)).to_owned());
    let joints = cast.joints().map(|(id, name)| JointName { name: name.to_owned(), turns: cast.is_hinge(id) });
    let trackers = sinew_control::tracker::TrackerKind::ALL.map(|kind| kind.name().to_owned());
    Names {
        parts: Node::ALL.map(|node| node.part().name().to_owned()).to_vec(),
        characters: characters.collect(),
        objects: objects.collect(),
        joints: joints.collect(),
        poses: with(scene.poses.keys().cloned().collect(), &["stand"]),
        graphs: scene.graphs.keys().cloned().collect(),
        shapes: with(scene.shapes.keys().cloned().collect(), &["own", "none"]),
        reflexes: sinew_control::reflex::NAMES.iter().map(|name| (*name).to_owned()).collect(),
        trackers: trackers.to_vec(),
    }
}

fn thing(entity: Entity) -> Thing {
    match entity {
        Entity::Floor => Thing::Ground,
        Entity::Prop(prop) => Thing::Object(prop.slot()),
        Entity::Part(character, node) => Thing::Part(character.slot(), node.index()),
    }
}

/// The present world, in the order of [`names`].
pub(crate) fn snapshot(world: &World, cast: &Cast) -> Snapshot {
    let frame = world.frame();
    let characters = frame.characters.iter().enumerate().map(|(index, character)| CharacterState {
        parts: character
            .parts
            .iter()
            .map(|part| PartState {
                position: part.position.into(),
                rotation: part.rotation.into(),
                velocity: part.velocity.into(),
            })
            .collect(),
        centre_of_mass: character.centre_of_mass.into(),
        centre_velocity: character.centre_velocity.into(),
        facing: character.facing.into(),
        support: character.support.iter().map(|corner| corner.to_array()).collect(),
        attached: world
            .held()
            .filter(|held| held.character.slot() == index)
            .map(|held| (held.node.index(), thing(held.object)))
            .collect(),
    });
    let objects = frame.props.iter().map(|prop| ObjectState {
        position: prop.centre.into(),
        velocity: prop.velocity.into(),
        rotation: prop.rotation.into(),
        spin: prop.angular_velocity.into(),
    });
    let joints = cast.joints().map(|(joint, _)| {
        let state = world.prop_joint(joint);
        let place = if cast.is_hinge(joint) { state.place.to_degrees() } else { state.place };
        JointState { place, speed: state.speed, is_whole: state.is_whole }
    });
    let contacts = frame.contacts.iter().map(|contact| Contact {
        a: thing(contact.a),
        b: thing(contact.b),
        point: contact.point.into(),
        impulse: contact.impulse.into(),
    });
    Snapshot {
        step: frame.step,
        time_secs: frame.time_secs,
        step_secs: world.settings().step_secs(),
        characters: characters.collect(),
        objects: objects.collect(),
        joints: joints.collect(),
        contacts: contacts.collect(),
    }
}
