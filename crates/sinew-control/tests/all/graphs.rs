//! Pose graphs: what fires when and why, and what a state changes in its pose.

#![allow(clippy::unwrap_used, reason = "a test that fails may panic")]

use glam::{DQuat, DVec3};
use sinew_body::humanoid::{Body, Node, Pose, exp, log};
use sinew_control::Wanted;
use sinew_control::graph::{Cause, Graph, GraphError, GraphPlayer, Touchable};
use sinew_control::pose::{read_poses, resolve_poses, rotation_of};
use sinew_world::{BodyState, CharacterFrame, CharacterId, Contact, Entity, Frame, PropId};
use std::collections::BTreeMap;

const STEP_SECS: f64 = 1.0 / 240.0;
const NO_SIGNALS: [&str; 0] = [];

fn names() -> BTreeMap<String, Touchable> {
    BTreeMap::from([
        ("ball".to_owned(), Touchable::One(Entity::Prop(PropId::first_in(0)))),
        ("rival".to_owned(), Touchable::Character(CharacterId::first_in(1))),
        ("RightArm".to_owned(), Touchable::One(Entity::Part(CharacterId::first_in(0), Node::RightHand))),
    ])
}

fn graph(states: &str) -> Result<Graph, GraphError> {
    let text = format!(
        "[poses.bent]\njoints.rightUpperLeg = [-30, 0, 0]\njoints.leftUpperLeg = [10, 0, 0]\n[graphs.g]\nstart = 'a'\n{states}"
    );
    let file = read_poses(&text, "graph.toml").unwrap_or_else(|error| panic!("{error}"));
    let poses = resolve_poses(&file.poses, &Body::standard(80.0, 1.7)).unwrap();
    Graph::new(&file.graphs["g"], &poses, &names())
}

fn character(hips: DVec3, facing_rad: f64) -> CharacterFrame {
    let body = Body::standard(80.0, 1.7);
    let mut locals = [DQuat::IDENTITY; Node::COUNT];
    locals[0] = exp(DVec3::Y * facing_rad);
    let pose = Pose::from_locals(hips, &locals);
    let positions = pose.positions(&body);
    let parts = Node::ALL.map(|node| BodyState {
        position: positions[node.index()],
        rotation: pose.world[node.index()],
        centre: positions[node.index()] + pose.world[node.index()] * body.link(node).centre,
        ..BodyState::REST
    });
    CharacterFrame {
        parts,
        centre_of_mass: body.centre_of_mass(&pose),
        centre_velocity: DVec3::ZERO,
        facing: locals[0] * DVec3::Z,
        support: Vec::new(),
        external: CharacterFrame::EMPTY.external,
        was_reset: false,
    }
}

/// Two characters and a ball.
fn frame() -> Frame {
    let characters = vec![character(DVec3::Y, 0.0), character(DVec3::new(0.0, 1.0, 2.0), 0.0)];
    Frame::of(characters, vec![BodyState { centre: DVec3::new(0.0, 1.0, 1.0), ..BodyState::REST }])
}

fn touch(a: Entity, b: Entity) -> Contact {
    Contact { a, b, point: DVec3::ZERO, impulse: DVec3::Y, begins: true }
}

#[test]
fn a_timer_fires_at_its_step_and_does_not_drift() {
    let graph = graph(
        "[graphs.g.states.a]\npose = 'stand'\nto = [{ state = 'b', after_secs = 0.3 }]\n\
         [graphs.g.states.b]\npose = 'bent'\nto = [{ state = 'a', after_secs = 0.1 }]",
    )
    .unwrap();
    let mut player = GraphPlayer::new(&graph, STEP_SECS);
    let mut fired = Vec::new();
    for step in 1..=960_000u64 {
        if let Some(transition) = player.step(&graph, &frame_once(), CharacterId::first_in(0), &NO_SIGNALS) {
            assert_eq!(transition.cause, Cause::Timer);
            fired.push(step);
        }
    }
    // 72 and 24 steps of 1/240 s, ten thousand times over.
    assert_eq!((fired[0], fired[1], fired.len()), (72, 96, 20_000));
    assert_eq!(fired[19_999], 960_000);
}

/// An empty frame: timers need none, and making a full one a million times takes its time.
fn frame_once() -> Frame {
    Frame::default()
}

#[test]
fn a_touch_fires_only_for_the_pair_that_is_named_and_tells_the_contact() {
    for (pair, contact, fires) in [
        ("'rightFoot', 'ground'", touch(Entity::Floor, Entity::Part(CharacterId::first_in(0), Node::RightFoot)), true),
        ("'ground', 'rightFoot'", touch(Entity::Floor, Entity::Part(CharacterId::first_in(0), Node::RightFoot)), true),
        ("'rightFoot', 'ground'", touch(Entity::Floor, Entity::Part(CharacterId::first_in(0), Node::LeftFoot)), false),
        ("'rightFoot', 'ground'", touch(Entity::Floor, Entity::Part(CharacterId::first_in(1), Node::RightFoot)), false),
        (
            "'self', 'ball'",
            touch(Entity::Prop(PropId::first_in(0)), Entity::Part(CharacterId::first_in(0), Node::Head)),
            true,
        ),
        (
            "'self', 'ball'",
            touch(Entity::Prop(PropId::first_in(1)), Entity::Part(CharacterId::first_in(0), Node::Head)),
            false,
        ),
        (
            "'RightArm', 'rival'",
            touch(
                Entity::Part(CharacterId::first_in(0), Node::RightHand),
                Entity::Part(CharacterId::first_in(1), Node::Chest),
            ),
            true,
        ),
        (
            "'rightHand', 'rival.head'",
            touch(
                Entity::Part(CharacterId::first_in(0), Node::RightHand),
                Entity::Part(CharacterId::first_in(1), Node::Head),
            ),
            true,
        ),
        (
            "'rightHand', 'rival.head'",
            touch(
                Entity::Part(CharacterId::first_in(0), Node::RightHand),
                Entity::Part(CharacterId::first_in(1), Node::Neck),
            ),
            false,
        ),
    ] {
        let graph = graph(&format!(
            "[graphs.g.states.a]\npose = 'stand'\nto = [{{ state = 'b', touching = [{pair}] }}]\n\
             [graphs.g.states.b]\npose = 'bent'"
        ))
        .unwrap();
        let mut player = GraphPlayer::new(&graph, STEP_SECS);
        let frame = Frame { contacts: vec![contact], ..frame() };
        let transition = player.step(&graph, &frame, CharacterId::first_in(0), &NO_SIGNALS);
        assert_eq!(transition.map(|t| t.cause), fires.then_some(Cause::Touch(contact)), "{pair}");
        assert_eq!(player.state_name(&graph), if fires { "b" } else { "a" });
    }
}

#[test]
fn sensors_measure_what_they_say() {
    let mut frame = frame();
    let own = &mut frame.characters[0];
    own.parts[0].velocity = DVec3::new(3.0, 7.0, 4.0);
    own.parts[0].rotation = rotation_of([30.0, 0.0, 0.0]);
    own.centre_of_mass = DVec3::new(0.0, 1.0, 0.0);
    own.centre_velocity = DVec3::new(0.2, -0.4, 0.7);
    own.facing = DVec3::X;
    own.support = [(-0.1, -0.1), (-0.1, 0.2), (0.1, 0.2), (0.1, -0.1)].map(|(x, z)| DVec3::new(x, 0.0, z)).to_vec();
    let mut pushing = touch(Entity::Floor, Entity::Part(CharacterId::first_in(0), Node::LeftFoot));
    pushing.impulse = DVec3::Y * 2.0;
    frame.contacts = vec![pushing, pushing];
    let head = frame.characters[0].part(Node::Head).centre.y;
    for (sensor, value) in [
        ("of = 'head', is = 'height_m'", head),
        ("is = 'height_m'", 1.0),
        ("of = 'hips', is = 'speed_m_s'", 5.0),
        ("is = 'forward_m_s'", 0.2),
        ("is = 'up_m_s'", -0.4),
        ("of = 'hips', is = 'tilt_deg'", 30.0),
        // Two contacts of 2 N s in a step of 1/240 s.
        ("of = 'leftFoot', is = 'load_n'", 960.0),
        ("of = 'rightFoot', is = 'load_n'", 0.0),
        ("of = 'ball', is = 'distance_m', to = 'centre'", 1.0),
        ("is = 'com_margin_m'", 0.1),
    ] {
        let fires = |threshold: String| {
            let graph = graph(&format!(
                "[graphs.g.states.a]\npose = 'stand'\nto = [{{ state = 'a', sensor = {{ {sensor}, {threshold} }} }}]"
            ))
            .unwrap_or_else(|error| panic!("{sensor}: {error}"));
            GraphPlayer::new(&graph, STEP_SECS)
                .step(&graph, &frame, CharacterId::first_in(0), &NO_SIGNALS)
                .map(|transition| transition.cause)
        };
        let Some(Cause::Sensor(read)) = fires(format!("below = {:?}", value + 1e-6)) else { panic!("{sensor}") };
        assert!((read - value).abs() < 1e-9, "{sensor}: {read}");
        assert_eq!(fires(format!("above = {:?}", value + 1e-6)), None, "{sensor}");
        assert!(fires(format!("above = {:?}, below = {:?}", value - 1e-6, value + 1e-6)).is_some(), "{sensor}");
    }
}

#[test]
fn all_conditions_must_hold_the_first_way_wins_and_one_transition_fires_a_step() {
    let graph = graph(
        "[graphs.g.states.a]\npose = 'stand'\nto = [\
         { state = 'b', touching = ['rightFoot', 'ground'], after_secs = 0.1 },\
         { state = 'c', signal = 'go' },\
         { state = 'b', after_secs = 0.5 }]\n\
         [graphs.g.states.b]\npose = 'bent'\nto = [{ state = 'a', after_secs = 0 }]\n\
         [graphs.g.states.c]\npose = 'bent'",
    )
    .unwrap();
    let contact = touch(Entity::Floor, Entity::Part(CharacterId::first_in(0), Node::RightFoot));
    let on_ground = Frame { contacts: vec![contact], ..frame() };
    let mut player = GraphPlayer::new(&graph, STEP_SECS);
    for step in 1..=24 {
        let transition = player.step(&graph, &on_ground, CharacterId::first_in(0), &NO_SIGNALS);
        assert_eq!(transition.is_some(), step == 24, "{step}");
        if let Some(transition) = transition {
            assert_eq!(transition.names(&graph), ("a", "b"));
            assert_eq!(
                transition.text(&graph),
                "a to b after 0.100 s (after 0.1 s, rightFoot touches ground): \
                 the ground touched rightFoot of character 0 with 1.00 N s"
            );
        }
    }
    // A state with an open way lasts one step.
    assert_eq!(
        player.step(&graph, &on_ground, CharacterId::first_in(0), &NO_SIGNALS).unwrap().names(&graph),
        ("b", "a")
    );
    assert_eq!(player.step(&graph, &on_ground, CharacterId::first_in(0), &["stop"]), None);
    assert_eq!(
        player.step(&graph, &on_ground, CharacterId::first_in(0), &["stop", "go"]).unwrap().cause,
        Cause::Signal
    );
    assert_eq!(player.state_name(&graph), "c");
    assert!(player.jump(&graph, "a") && !player.jump(&graph, "nowhere"));
    assert_eq!((player.state_name(&graph), player.lasted_secs()), ("a", 0.0));
}

#[test]
fn what_a_graph_names_must_be_there() {
    let a = "[graphs.g.states.a]\npose = 'stand'\n";
    for (states, words) in [
        ("[graphs.g.states.b]\npose = 'stand'".to_owned(), "the states are b"),
        ("[graphs.g.states.a]\npose = 'sit'".to_owned(), "there are: bent, stand"),
        (format!("{a}to = [{{ state = 'x', after_secs = 1 }}]"), "the states are a"),
        (format!("{a}to = [{{ state = 'a' }}]"), "give after_secs"),
        (format!("{a}to = [{{ state = 'a', touching = ['rightFoot', 'wall'] }}]"), "RightArm, ball, rival"),
        (
            format!("{a}to = [{{ state = 'a', touching = ['rightFoot', 'ball.head'] }}]"),
            "nothing is called \"ball.head\"",
        ),
        (format!("{a}to = [{{ state = 'a', sensor = {{ is = 'height_m' }} }}]"), "give below or above"),
        (format!("{a}to = [{{ state = 'a', sensor = {{ is = 'distance_m', below = 1 }} }}]"), "give `to`"),
        (format!("{a}to = [{{ state = 'a', sensor = {{ of = 'ground', is = 'height_m', below = 1 }} }}]"), "ground"),
        (format!("{a}world_hips = true"), "give stance"),
        (format!("{a}hips_lean_deg = 5"), "world_hips"),
        (format!("{a}heading_deg = 5"), "world_hips"),
        (format!("{a}upright = ['hips']"), "hips"),
    ] {
        let error = graph(&states).expect_err(&states).to_string();
        assert!(error.contains(words), "{error}");
    }
    let many: String = (0..501).map(|n| format!("[graphs.g.states.s{n}]\npose = 'stand'\n")).collect();
    assert!(matches!(graph(&format!("{a}{many}")), Err(GraphError::TooMany { .. })));
    assert!(read_poses("[graphs.g]\nstart = 'a'\n[graphs.g.states.a]\npose = 'a'\nupright = ['x']", "f").is_err());
}

#[test]
fn feedback_turns_the_joint_in_proportion_to_the_centre_of_mass() {
    let graph = graph(
        "[graphs.g.states.a]\npose = 'stand'\nfeedback = [\
         { joint = 'rightUpperLeg', axis = 'x', from = 'leftFoot', rad_per_m = -0.5, rad_per_m_s = -0.2 },\
         { joint = 'leftUpperLeg', axis = 'z', from = 'leftFoot', rad_per_m = 2.0 }]",
    )
    .unwrap();
    // Facing +X, so that the left is -Z.
    let mut own = character(DVec3::Y, std::f64::consts::FRAC_PI_2);
    let foot = own.part(Node::LeftFoot).position;
    own.centre_of_mass = foot + DVec3::new(0.3, 0.9, 0.1);
    own.centre_velocity = DVec3::new(0.5, 0.0, 0.0);
    let frame = Frame::of(vec![own], Vec::new());
    let mut target = Wanted::STANDING;
    GraphPlayer::new(&graph, STEP_SECS).steering(&graph).apply(&frame, CharacterId::first_in(0), &mut target);
    let turn = |node| log(target.joint(node).rotation);
    assert!((turn(Node::RightUpperLeg) - DVec3::X * (-0.5 * 0.3 - 0.2 * 0.5)).length() < 1e-12);
    assert!((turn(Node::LeftUpperLeg) - DVec3::Z * (2.0 * -0.1)).length() < 1e-12);
}

#[test]
fn world_hips_and_upright_parts_are_measured_in_the_world() {
    let graph = graph(
        "[graphs.g.states.a]\npose = 'bent'\nstance = 'left'\nworld_hips = true\nhips_lean_deg = 5\nupright = ['chest']",
    )
    .unwrap();
    // A body that has been tipped over: hips, and with them all else, by 20 degrees forward and turned by 40.
    let yaw = exp(DVec3::Y * 40f64.to_radians());
    let tipped = yaw * exp(DVec3::X * 20f64.to_radians());
    let mut own = character(DVec3::Y, 0.0);
    for part in &mut own.parts {
        part.rotation = tipped;
    }
    own.facing = yaw * DVec3::Z;
    let frame = Frame::of(vec![own], Vec::new());
    let player = GraphPlayer::new(&graph, STEP_SECS);
    let mut target = Wanted::STANDING;
    for node in Node::ALL {
        target.joint_mut(node).rotation = player.pose(&graph).rotations[node.index()];
    }
    player.steering(&graph).apply(&frame, CharacterId::first_in(0), &mut target);
    let apart = |a: DQuat, b: DQuat| log(a.conjugate() * b).length();
    // Where the parts would be in the world, if the joints did as they are told and the hips stayed.
    let chest = tipped * target.joint(Node::Chest).rotation;
    assert!(apart(chest, yaw) < 1e-12);
    let swing = tipped * target.joint(Node::RightUpperLeg).rotation;
    assert!(apart(swing, yaw * rotation_of([-30.0, 0.0, 0.0])) < 1e-12);
    // The thigh that carries stays, the hips come to it.
    let hips = tipped * target.joint(Node::LeftUpperLeg).rotation.conjugate();
    assert!(apart(hips, yaw * rotation_of([5.0, 0.0, 0.0])) < 1e-12);
}

#[test]
fn an_upright_foot_is_level_whatever_its_leg_does_and_faces_as_its_shank_does() {
    let graph = graph("[graphs.g.states.a]\npose = 'bent'\nupright = ['rightFoot']").unwrap();
    let mut own = character(DVec3::Y, 0.0);
    let yaw = exp(DVec3::Y * 25f64.to_radians());
    let shank = yaw * rotation_of([50.0, 0.0, 0.0]) * rotation_of([0.0, 0.0, 10.0]);
    own.parts[Node::RightLowerLeg.index()].rotation = shank;
    own.parts[Node::RightLowerLeg.index()].angular_velocity = DVec3::new(3.0, 2.0, -1.0);
    let frame = Frame::of(vec![own], Vec::new());
    let mut target = Wanted::STANDING;
    GraphPlayer::new(&graph, STEP_SECS).steering(&graph).apply(&frame, CharacterId::first_in(0), &mut target);
    let joint = target.joint(Node::RightFoot);
    let foot = shank * joint.rotation;
    assert!((foot * DVec3::Y - DVec3::Y).length() < 1e-12);
    // The shank leans sideways as well, so that its turn about the vertical is not exactly the 25 degrees.
    assert!(((foot * DVec3::Z).dot(yaw * DVec3::Z)) > 0.99);
    // The foot is wanted at rest in the world, but for the shank's turn about the vertical, which goes on to the foot.
    let in_world = frame.characters[0].part(Node::RightLowerLeg).angular_velocity + foot * joint.velocity;
    assert!((in_world - DVec3::Y * 2.0).length() < 1e-12);
}

#[test]
fn a_heading_turns_the_hips_the_short_way_and_not_all_at_once() {
    for (facing_deg, heading_deg, turns_deg) in [(10.0, 0.0, -10.0), (170.0, -175.0, 15.0), (0.0, 120.0, 20.05)] {
        let state = "[graphs.g.states.a]\npose = 'stand'\nstance = 'left'\nworld_hips = true\n";
        let graph = graph(&format!("{state}heading_deg = {heading_deg:?}")).unwrap();
        let facing = exp(DVec3::Y * f64::to_radians(facing_deg));
        let mut own = character(DVec3::Y, f64::to_radians(facing_deg));
        for part in &mut own.parts {
            part.rotation = facing;
        }
        let frame = Frame::of(vec![own], Vec::new());
        let mut target = Wanted::STANDING;
        GraphPlayer::new(&graph, STEP_SECS).steering(&graph).apply(&frame, CharacterId::first_in(0), &mut target);
        // The thigh that carries stays, the hips come to their heading.
        let hips = facing * target.joint(Node::LeftUpperLeg).rotation.conjugate();
        let turned = log(facing.conjugate() * hips);
        assert!((turned - DVec3::Y * f64::to_radians(turns_deg)).length() < 1e-3, "{turned}");
    }
}
