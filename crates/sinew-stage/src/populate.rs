//! From tables of a scene to bodies, joints and actors: at the start of a stage, and when its scene is edited.

use crate::actor::Actor;
use crate::build::{StageError, StageErrorKind as Kind};
use crate::cast::Cast;
use crate::scene::{CharacterSpec, PropJointSpec, RopeSpec, Scene};
use crate::source_context::{Context, cut};
use glam::DVec3;
use sinew_body::humanoid::{Body, Node, Pose, exp};
use sinew_control::graph::{Graph, Touchable};
use sinew_control::perform::LiveSource;
use sinew_control::pose::{KeyPose, STAND, resolve_poses};
use sinew_control::source::{Performer, PoseBook};
use sinew_control::tracker::{Gains, JointGain};
use sinew_control::{PoseSpec, Root, Wanted};
use sinew_world::{
    BodyState, CharacterId, Entity, PropJointKind, Surface, World, hips_over_soles_m, outboard_inertias,
};
use std::collections::BTreeMap;
use std::sync::Arc;

/// Names of what comes onto a stage, and where props come that have been there before.
#[derive(Debug, Default)]
pub(crate) struct Newcomers<'a> {
    pub props: Vec<&'a str>,
    pub characters: Vec<&'a str>,
    pub joints: Vec<&'a str>,
    pub ropes: Vec<&'a str>,
    /// Where a prop was and how it moved before it became another.
    pub places: BTreeMap<&'a str, BodyState>,
}

impl<'a> Newcomers<'a> {
    /// All that a scene names.
    pub fn all(scene: &'a Scene) -> Newcomers<'a> {
        Newcomers {
            props: scene.props.keys().map(String::as_str).collect(),
            characters: scene.characters.keys().map(String::as_str).collect(),
            joints: scene.joints.keys().map(String::as_str).collect(),
            ropes: scene.ropes.keys().map(String::as_str).collect(),
            places: BTreeMap::new(),
        }
    }
}

/// An error at a table of the scene.
pub(crate) fn at(scene: &Scene, kind: Kind, place: String, problem: impl ToString) -> StageError {
    StageError { kind, file: scene.file_name().to_owned(), place, problem: problem.to_string() }
}

/// Puts newcomers into the cast and the world; gives the actors of the characters among them.
pub(crate) fn populate(
    scene: &Scene,
    cast: &mut Cast,
    world: &mut World,
    new: &Newcomers,
) -> Result<BTreeMap<CharacterId, Actor>, StageError> {
    // All names first: poses and graphs refer to any of them.
    let props: Vec<_> = new.props.iter().map(|name| cast.add_prop(name)).collect();
    let characters: Vec<_> = new
        .characters
        .iter()
        .filter_map(|name| scene.characters.get(*name).map(|spec| cast.add_character(name, spec)))
        .collect();
    for (&name, &id) in new.props.iter().zip(&props) {
        let place = || format!("props.{name}");
        let spec = scene.props.get(name).and_then(crate::scene::PropSpec::in_world);
        let mut spec = spec.ok_or_else(|| at(scene, Kind::Body, place(), "it has no shape"))?;
        if let Some(before) = new.places.get(name) {
            (spec.position, spec.rotation) = (before.position, before.rotation);
            (spec.velocity, spec.spin) = (before.velocity, before.angular_velocity);
        }
        let added = world.add_prop(spec).map_err(|error| at(scene, Kind::Body, place(), error))?;
        debug_assert_eq!(added, id, "cast and world count alike");
    }
    let mut actors = BTreeMap::new();
    for (&name, &id) in new.characters.iter().zip(&characters) {
        let Some(spec) = scene.characters.get(name) else { continue };
        actors.insert(id, character(scene, cast, world, name, spec)?);
    }
    for &name in &new.joints {
        let Some(spec) = scene.joints.get(name) else { continue };
        fasten(scene, cast, world, name, spec)?;
    }
    for &name in &new.ropes {
        let Some(rope) = scene.ropes.get(name) else { continue };
        lay(scene, cast, world, name, rope)?;
    }
    Ok(actors)
}

/// The key poses and graphs of a scene on a body.
pub(crate) fn pose_book(scene: &Scene, cast: &Cast, name: &str, body: &Body) -> Result<PoseBook, StageError> {
    let specs: &BTreeMap<String, PoseSpec> = &scene.poses;
    let poses = resolve_poses(specs, body)
        .map_err(|error| at(scene, Kind::Pose, "poses".to_owned(), format!("on the body of {name}: {error}")))?;
    let mut graphs = BTreeMap::new();
    for (graph, spec) in &scene.graphs {
        let resolved = Graph::new(spec, &poses, cast);
        let resolved = resolved.map_err(|error| at(scene, Kind::Pose, format!("graphs.{graph}"), error))?;
        graphs.insert(graph.clone(), resolved);
    }
    Ok(PoseBook { poses, graphs })
}

/// The springs of a character's joints in a world.
pub(crate) fn springs(spec: &CharacterSpec, body: &Body, gravity_m_s2: f64) -> Gains {
    Gains::of(body, &outboard_inertias(body), &joint_gains(spec), gravity_m_s2)
}

fn character(
    scene: &Scene,
    cast: &Cast,
    world: &mut World,
    name: &str,
    spec: &CharacterSpec,
) -> Result<Actor, StageError> {
    let wrong = |kind, problem: String| at(scene, kind, format!("characters.{name}"), problem);
    let cut = cut(scene, spec).map_err(|problem| wrong(Kind::Clip, problem))?;
    let book = Arc::new(pose_book(scene, cast, name, &cut.body)?);
    let springs = springs(spec, &cut.body, world.settings().gravity_m_s2);
    let pose = first_pose(spec, &book.poses);
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
    let build = |context: &Context| {
        let own = spec.source.as_ref().map(|source| source.build(context)).transpose();
        own.map(Option::flatten).map_err(|error| wrong(Kind::Clip, error.to_string()))
    };
    let mut own = build(&context)?;
    let start = match own.as_ref().filter(|own| own.root() == Root::Placed) {
        Some(own) => {
            let mut wanted = Wanted::STANDING;
            own.wanted(0.0, &mut wanted);
            wanted.pose
        }
        None => placed(spec, &cut.body, book.poses.get(pose).unwrap_or(&KeyPose::STAND)),
    };
    let now_secs = world.frame().time_secs;
    if now_secs > 0.0 {
        // A character that is added later starts its clips at that time.
        own = build(&Context { running: Some((now_secs, &cut.body, start)), ..context })?;
    }
    let surface = Surface { friction: spec.friction.unwrap_or(Surface::BODY.friction), ..Surface::BODY };
    let in_world =
        sinew_world::CharacterSpec { body: cut.body.clone(), pose: start, velocity: spec.velocity_m_s.into(), surface };
    let id = world.add_character(in_world).map_err(|error| wrong(Kind::Body, error.to_string()))?;
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
    Ok(actor)
}

/// A joint of the scene. In the middle of a run its anchors are where the things have them that it fastens, and it counts from how
/// they are now.
fn fasten(
    scene: &Scene,
    cast: &mut Cast,
    world: &mut World,
    name: &str,
    spec: &PropJointSpec,
) -> Result<(), StageError> {
    let wrong = |problem: String| at(scene, Kind::Body, format!("joints.{name}"), problem);
    let thing = |name: &str| match cast.meaning(name, None) {
        Some(Touchable::One(entity)) => Ok(entity),
        _ => Err(wrong(format!("`{name}` cannot be fastened"))),
    };
    let between = [thing(&spec.between[0])?, thing(&spec.between[1])?];
    let place = |prop: &str| scene.props.get(prop).map(|prop| prop.position_m);
    let mut anchors =
        spec.anchors(place).ok_or_else(|| wrong("nothing says where it is; write anchor_m".to_owned()))?;
    let kind = spec.in_world(anchors);
    if world.frame().step > 0 {
        for (anchor, entity) in anchors.iter_mut().zip(between) {
            *anchor = moved_with(scene, cast, world, entity, *anchor);
        }
    }
    let joint = sinew_world::PropJointSpec {
        between,
        anchors,
        kind,
        motor: spec.motor(),
        break_force_n: spec.break_n,
        touches: spec.touches,
    };
    cast.add_joint(name, spec);
    world.add_prop_joint(joint).map(drop).map_err(|error| wrong(error.to_string()))
}

/// Where a point has come that belonged to a prop at the start.
fn moved_with(scene: &Scene, cast: &Cast, world: &World, entity: Entity, point: DVec3) -> DVec3 {
    let Entity::Prop(prop) = entity else { return point };
    let spec = scene.props.get(cast.prop_name(prop)).and_then(crate::scene::PropSpec::in_world);
    let (Some(spec), Some(now)) = (spec, world.frame().prop(prop)) else { return point };
    now.point(spec.rotation.conjugate() * (point - spec.position))
}

/// The joints within a rope.
fn lay(scene: &Scene, cast: &mut Cast, world: &mut World, name: &str, rope: &RopeSpec) -> Result<(), StageError> {
    let wrong = |problem: String| at(scene, Kind::Body, format!("ropes.{name}"), problem);
    let mut join = |from: usize, to: usize, anchors: [DVec3; 2], kind: PropJointKind| {
        let piece = |number: usize| {
            let prop = cast.prop(&RopeSpec::piece(name, number));
            prop.map(Entity::Prop).ok_or_else(|| wrong("a piece is missing".to_owned()))
        };
        let between = [piece(from)?, piece(to)?];
        let touches = !matches!(kind, PropJointKind::Ball);
        let joint = sinew_world::PropJointSpec { between, anchors, kind, motor: None, break_force_n: None, touches };
        cast.add_rope_joint(name);
        world.add_prop_joint(joint).map(drop).map_err(|error| wrong(error.to_string()))
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
    Ok(())
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
