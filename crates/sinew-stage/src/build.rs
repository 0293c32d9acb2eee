//! What begins on a stage with its first step, or with the step in which something comes onto it.

use crate::Stage;
use crate::event::{Cause, Effect};
use crate::heading::heading;
use crate::order::Resolver;
use crate::populate::at;
use crate::scene::{CharacterSpec, Scene};
use crate::source_context::cut;
use sinew_body::humanoid::Body;
use sinew_control::tracker::TrackerKind;
use sinew_control::{Layer, OrderError};
use sinew_world::CharacterId;
use std::sync::Arc;

/// What kind of trouble a [`StageError`] is, for a program to match on.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum StageErrorKind {
    /// A clip cannot be read, or holds no body.
    Clip,
    /// A pose or a graph does not suit a body.
    Pose,
    /// A body, prop or joint that physics cannot have.
    Body,
    /// What the scene begins with is refused: a tracker, a reflex, a reach, a command.
    Refused,
    /// A Python controller does not start.
    Script,
}

/// Why a scene cannot be built.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{file}: {place}: {problem}")]
pub struct StageError {
    /// What kind of trouble it is.
    pub kind: StageErrorKind,
    /// The scene file.
    pub file: String,
    /// Which of its tables.
    pub place: String,
    /// What is wrong, and what to do.
    pub problem: String,
}

use StageErrorKind as Kind;

/// What begins with the next step for these characters and props: gravity, planes, layers, reflexes, reaches, controllers.
pub(crate) fn begin(stage: &mut Stage, characters: &[&str], props: &[&str]) -> Result<(), StageError> {
    let scene = Arc::clone(&stage.scene);
    for &name in characters {
        let (Some(spec), Some(id)) = (scene.characters.get(name), stage.cast.character(name)) else { continue };
        let place = || format!("characters.{name}");
        begin_character(stage, spec, id).map_err(|error| at(&scene, Kind::Refused, place(), error))?;
        if let Some(controller) = &spec.controller {
            stage.start_controller(id, Some(controller)).map_err(|error| at(&scene, Kind::Script, place(), error))?;
        }
    }
    for &name in props {
        let controller = scene.props.get(name).and_then(|spec| spec.controller.as_ref());
        let (Some(controller), Some(prop)) = (controller, stage.cast.prop(name)) else { continue };
        stage
            .start_prop_controller(prop, controller)
            .map_err(|error| at(&scene, Kind::Script, format!("props.{name}"), error))?;
    }
    Ok(())
}

fn begin_character(stage: &mut Stage, spec: &CharacterSpec, id: CharacterId) -> Result<(), OrderError> {
    if spec.gravity_scale != 1.0 {
        stage.world.set_gravity(id, spec.gravity_scale);
    }
    if let Some(degrees) = spec.plane_facing_deg() {
        stage.world.hold_to_plane(id, heading(degrees));
    }
    let actor = stage.actor_mut(id)?;
    actor.set_gain(None, spec.pose_gain);
    for reflex in &spec.reflexes {
        actor.set_reflex(reflex, true)?;
    }
    for layer in [Layer::Poses, Layer::Scripts, Layer::Reflexes] {
        actor.set_layer(layer, spec.layers.contains(&layer));
    }
    if spec.tracker != TrackerKind::Pd {
        stage.set_tracker(id, spec.tracker)?;
    }
    if let Some(order) = spec.source.as_ref().and_then(|source| source.reach.as_ref()) {
        let order = Resolver { scene: &stage.scene, cast: &stage.cast }.reach(order)?;
        if let Some(effect) = stage.begin_reach(id, &order)? {
            let name = stage.cast.character_name(id).to_owned();
            stage.note(Cause::SceneStart, Effect::of(name, effect));
        }
    }
    Ok(())
}

/// The bodies of a scene's characters.
pub(crate) fn bodies(scene: &Scene) -> Result<Vec<Body>, StageError> {
    let body = |(name, spec): (&String, &CharacterSpec)| {
        cut(scene, spec)
            .map(|cut| cut.body)
            .map_err(|problem| at(scene, Kind::Clip, format!("characters.{name}"), problem))
    };
    scene.characters.iter().map(body).collect()
}
