//! From a scene to what runs: bodies into the world, poses and graphs resolved, layers and controllers begun.

use crate::Stage;
use crate::actor::Actor;
use crate::cast::Cast;
use crate::event::{Cause, Effect};
use crate::heading::heading;
use crate::scene::{CharacterSpec, RopeSpec, Scene};
use crate::source_context::{Context, cut};
use glam::DVec3;
use sinew_body::humanoid::{Body, Node, Pose, exp};
use sinew_control::graph::{Graph, Touchable};
use sinew_control::perform::LiveSource;
use sinew_control::pose::{KeyPose, STAND, resolve_poses};
use sinew_control::source::{Performer, PoseBook};
use sinew_control::tracker::{Gains, JointGain, TrackerKind};
use sinew_control::{Layer, PoseSpec, Root, Wanted};
use sinew_world::{Entity, PropJointKind, PropJointSpec, Surface, World, hips_over_soles_m, outboard_inertias};
use std::collections::BTreeMap;
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

pub(crate) fn populate(scene: &Scene, cast: &Cast, world: &mut World) -> Result<Vec<Actor>, StageError> {
    let wrong = |kind, place: String, problem: String| {
        let file = scene.file_name().to_owned();
        StageError { kind, file, place, problem }
    };
    for (name, prop) in &scene.props {
        let place = || format!("props.{name}");
        let spec = prop.in_world().ok_or_else(|| wrong(Kind::Body, place(), "it has no shape".to_owned()))?;
        world.add_prop(spec).map_err(|error| wrong(Kind::Body, place(), error.to_string()))?;
    }
    let mut actors = Vec::new();
    for (name, spec) in &scene.characters {
        let place = || format!("characters.{name}");
        let cut = cut(scene, spec).map_err(|problem| wrong(Kind::Clip, place(), problem))?;
        let specs: &BTreeMap<String, PoseSpec> = &scene.poses;
        let poses = resolve_poses(specs, &cut.body)
            .map_err(|error| wrong(Kind::Pose, "poses".to_owned(), format!("on the body of {name}: {error}")))?;
        let mut graphs = BTreeMap::new();
        for (graph, spec) in &scene.graphs {
            let resolved = Graph::new(spec, &poses, cast);
            let resolved = resolved.map_err(|error| wrong(Kind::Pose, format!("graphs.{graph}"), error.to_string()))?;
            graphs.insert(graph.clone(), resolved);
        }
        let outboard = outboard_inertias(&cut.body);
        let springs = Gains::of(&cut.body, &outboard, &joint_gains(spec), world.settings().gravity_m_s2);
        let pose = first_pose(spec, &poses);
        let book = Arc::new(PoseBook { poses, graphs });
        let step_secs = world.settings().step_secs();
        let context = Context {
            scene,
            spec,
            tracker: spec.tracker,
            book: &book,
            first: pose,
            step_secs,
            clips: &cut.clips,
            running: None,
        };
        let own = spec.source.as_ref().map(|source| source.build(&context)).transpose();
        let own = own.map_err(|error| wrong(Kind::Clip, place(), error.to_string()))?.flatten();
        let start = match own.as_ref().filter(|own| own.root() == Root::Placed) {
            Some(own) => {
                let mut wanted = Wanted::STANDING;
                own.wanted(0.0, &mut wanted);
                wanted.pose
            }
            None => placed(spec, &cut.body, book.poses.get(pose).unwrap_or(&KeyPose::STAND)),
        };
        let surface = Surface { friction: spec.friction.unwrap_or(Surface::BODY.friction), ..Surface::BODY };
        let in_world = sinew_world::CharacterSpec {
            body: cut.body.clone(),
            pose: start,
            velocity: spec.velocity_m_s.into(),
            surface,
        };
        let id = world.add_character(in_world).map_err(|error| wrong(Kind::Body, place(), error.to_string()))?;
        if spec.spin_rad_s != [0.0; 3] {
            world.spin_character(id, spec.spin_rad_s.into());
        }
        let mut actor = Actor::new(id, &cut.body, Arc::clone(&book), pose, &start, springs, step_secs);
        if let Some(own) = own {
            actor.sources.follow(own);
        }
        if let Some(source) = &spec.source
            && let Some(live) = &source.live
        {
            let has_understudy = source.has_understudy();
            let source = LiveSource::new(
                actor.body(),
                spec.position_m.into(),
                spec.facing_deg.to_radians(),
                &start,
                live.settings(),
            );
            actor.sources.set_performer(Performer::new(source, has_understudy));
        }
        actors.push(actor);
    }
    fasten(scene, cast, world)?;
    Ok(actors)
}

/// Joints of the scene, in the order of [`Cast::joints`], and those within ropes.
fn fasten(scene: &Scene, cast: &Cast, world: &mut World) -> Result<(), StageError> {
    for (name, spec) in &scene.joints {
        let wrong = |problem: String| StageError {
            kind: Kind::Body,
            file: scene.file_name().to_owned(),
            place: format!("joints.{name}"),
            problem,
        };
        let thing = |name: &str| match cast.meaning(name, None) {
            Some(Touchable::One(entity)) => Ok(entity),
            _ => Err(wrong(format!("`{name}` cannot be fastened"))),
        };
        let between = [thing(&spec.between[0])?, thing(&spec.between[1])?];
        let place = |prop: &str| scene.props.get(prop).map(|prop| prop.position_m);
        let anchors =
            spec.anchors(place).ok_or_else(|| wrong("nothing says where it is; write anchor_m".to_owned()))?;
        let joint = PropJointSpec {
            between,
            anchors,
            kind: spec.in_world(anchors),
            motor: spec.motor(),
            break_force_n: spec.break_n,
            touches: spec.touches,
        };
        world.add_prop_joint(joint).map_err(|error| wrong(error.to_string()))?;
    }
    for (name, rope) in &scene.ropes {
        let wrong = |problem: String| StageError {
            kind: Kind::Body,
            file: scene.file_name().to_owned(),
            place: format!("ropes.{name}"),
            problem,
        };
        let piece = |number: usize| {
            let prop = cast.prop(&RopeSpec::piece(name, number)).ok_or_else(|| wrong("a piece is missing".to_owned()));
            prop.map(Entity::Prop)
        };
        let mut join = |from: usize, to: usize, anchors: [DVec3; 2], kind: PropJointKind| {
            let between = [piece(from)?, piece(to)?];
            let touches = !matches!(kind, PropJointKind::Ball);
            let joint = PropJointSpec { between, anchors, kind, motor: None, break_force_n: None, touches };
            world.add_prop_joint(joint).map_err(|error| wrong(error.to_string()))
        };
        for number in 1..rope.pieces {
            join(number, number + 1, [rope.joint(number + 1); 2], PropJointKind::Ball)?;
        }
        for (from, to) in rope.spans() {
            let anchors = [rope.joint(from + 1), rope.joint(to)];
            let length_m = (anchors[1] - anchors[0]).length();
            if length_m > 1e-3 {
                join(from, to, anchors, PropJointKind::Rope { length_m })?;
            }
        }
    }
    Ok(())
}

/// What begins with the first step: gravity, planes, layers, reflexes, graphs, controllers.
pub(crate) fn begin(stage: &mut Stage) -> Result<(), StageError> {
    let scene = std::sync::Arc::clone(&stage.scene);
    for (at, (name, spec)) in scene.characters.iter().enumerate() {
        let id = stage.actors[at].id;
        let wrong = |problem: String| StageError {
            kind: Kind::Refused,
            file: scene.file_name().to_owned(),
            place: format!("characters.{name}"),
            problem,
        };
        if spec.gravity_scale != 1.0 {
            stage.world.set_gravity(id, spec.gravity_scale);
        }
        if let Some(degrees) = spec.plane_facing_deg() {
            stage.world.hold_to_plane(id, heading(degrees));
        }
        let actor = &mut stage.actors[at];
        actor.set_gain(None, spec.pose_gain);
        for reflex in &spec.reflexes {
            actor.set_reflex(reflex, true).map_err(wrong)?;
        }
        for layer in [Layer::Poses, Layer::Scripts, Layer::Reflexes] {
            actor.set_layer(layer, spec.layers.contains(&layer));
        }
        if spec.tracker != TrackerKind::Pd {
            stage.set_tracker(id, spec.tracker).map_err(wrong)?;
        }
        if let Some(order) = spec.source.as_ref().and_then(|source| source.reach.as_ref())
            && let Some(effect) = stage.begin_reach(id, order).map_err(wrong)?
        {
            stage.note(Cause::SceneStart, Effect::of(name, effect));
        }
        if let Some(controller) = &spec.controller {
            stage
                .start_controller(id, Some(controller))
                .map_err(|error| StageError { kind: Kind::Script, ..wrong(error.to_string()) })?;
        }
    }
    for (name, spec) in &scene.props {
        let (Some(controller), Some(prop)) = (&spec.controller, stage.cast.prop(name)) else { continue };
        stage.start_prop_controller(prop, controller).map_err(|error| StageError {
            kind: Kind::Script,
            file: scene.file_name().to_owned(),
            place: format!("props.{name}"),
            problem: error.to_string(),
        })?;
    }
    Ok(())
}

/// The bodies of a scene's characters.
pub(crate) fn bodies(scene: &Scene) -> Result<Vec<Body>, StageError> {
    let body = |(name, spec): (&String, &CharacterSpec)| {
        cut(scene, spec).map(|cut| cut.body).map_err(|problem| StageError {
            kind: Kind::Clip,
            file: scene.file_name().to_owned(),
            place: format!("characters.{name}"),
            problem,
        })
    };
    scene.characters.iter().map(body).collect()
}

/// The pose that a character has at the start.
fn first_pose<'a>(spec: &'a CharacterSpec, poses: &BTreeMap<String, KeyPose>) -> &'a str {
    let source = spec.source.as_ref().and_then(|source| source.pose.as_ref()).map(|pose| pose.0.as_str());
    let pose = spec.pose.as_deref().or(source).unwrap_or(STAND);
    if poses.contains_key(pose) { pose } else { STAND }
}

/// A key pose with its soles on the floor below its place, lifted by the place's height.
fn placed(spec: &CharacterSpec, body: &Body, key: &KeyPose) -> Pose {
    let mut locals = key.rotations;
    locals[0] = exp(DVec3::Y * spec.facing_deg.to_radians());
    let mut pose = Pose::from_locals(DVec3::ZERO, &locals);
    pose.hips_position = DVec3::from(spec.position_m) + DVec3::Y * hips_over_soles_m(body, &pose);
    pose
}

fn joint_gains(spec: &CharacterSpec) -> [JointGain; Node::COUNT] {
    let mut joints = [JointGain::DEFAULT; Node::COUNT];
    for (name, joint) in &spec.joints {
        let Some(node) = spec.node(name) else { continue };
        let gain = &mut joints[node.index()];
        gain.frequency_hz = joint.frequency_hz.unwrap_or(gain.frequency_hz);
        gain.damping_ratio = joint.damping_ratio.unwrap_or(gain.damping_ratio);
        if let Some(carries) = joint.carries {
            gain.load = if carries { None } else { Some(0.0) };
        }
    }
    joints
}
