//! Commands are understood once: names, ranges, the way back to text, and undo.

#![allow(clippy::unwrap_used, clippy::disallowed_methods, reason = "tests")]

use sinew_body::humanoid::Node;
use sinew_control::tracker::KdPreset;
use sinew_control::{Action, Command, Layer, OrderErrorKind as Kind, ReachOrder};
use sinew_stage::{CharacterEffect, Effect, Scene, Stage};
use sinew_world::Entity;

const SCENE: &str = r#"format = 1
[characters.one]
aliases = { RightArm = "rightHand" }
[characters.two]
position_m = [2, 0, 0]
tracker = "kd"
[props.ball]
ball_radius_m = 0.1
mass_kg = 1
position_m = [0, 0.1, 1]
[props.lift]
box_m = [1, 0.1, 1]
position_m = [5, 0, 5]
moving = true
[props.door]
box_m = [1, 2, 0.1]
mass_kg = 5
position_m = [9, 1, 0]
[joints.hinge]
kind = "hinge"
between = ["door", "ground"]
anchor_m = [8.5, 1, 0]
axis = [0, 1, 0]
motor = { strength_n_m = 100, speed_rad_s = 0 }
[shapes.skis]
box_m = [0.12, 0.04, 1.2]
[controllers.Idle]
text = "class Idle:\n    def step(self): pass\n"
[poses.guard]
joints.leftLowerArm = [-60, 0, 0]
[graphs.sway]
start = "a"
[graphs.sway.states.a]
pose = "guard"
"#;

fn stage() -> Stage {
    Stage::new(Scene::from_text(SCENE).unwrap(), None).unwrap()
}

fn text(name: &str) -> String {
    name.to_owned()
}

fn one(action: Action) -> Command {
    Command::to("one", action)
}

fn push(force_n: [f64; 3]) -> Action {
    Action::Push { on: text("chest"), force_n, for_secs: 0.1, facing: true, at_m: Some([0.0, 0.1, 0.0]) }
}

fn gravity(scale: f64, part: Option<&str>, for_secs: Option<f64>) -> Action {
    Action::Gravity { scale, on: None, part: part.map(text), over_secs: None, for_secs }
}

/// A command of every kind that says something about this scene.
fn commands() -> Vec<Command> {
    let motor = |angle_deg, speed_rad_s| Action::Motor {
        joint: text("hinge"),
        speed_rad_s,
        angle_deg,
        speed_m_s: None,
        shift_m: None,
    };
    let of_one = [
        Action::Pose { name: text("guard") },
        Action::Graph { name: text("sway"), state: Some(text("a")) },
        Action::Signal { name: text("go") },
        Action::Ik { link: Some(text("rightHand")), target_m: [0.3, 1.0, 0.3] },
        Action::IkRelease { link: None },
        Action::Attach { link: text("leftHand"), object: text("ball"), soft: true, break_n: Some(300.0) },
        Action::Attach { link: text("leftHand"), object: text("two.rightHand"), soft: false, break_n: None },
        Action::Detach { link: text("leftHand"), object: String::new() },
        push([1.0, -2.0, 3.0]),
        Action::Gain { factor: 0.5, part: Some(text("leftFoot")) },
        Action::ForcesOff { parts: vec![text("hips")], for_secs: Some(0.5) },
        Action::ForcesOn { parts: vec![text("hips"), text("chest")] },
        Action::Plane { facing_deg: Some(90.0), for_secs: Some(1.0) },
        Action::PlaneOff {},
        gravity(0.0, Some("leftHand"), Some(1.0)),
        Action::Shape { part: text("leftFoot"), shape: text("skis"), for_secs: None },
        Action::Shape { part: text("leftFoot"), shape: text("none"), for_secs: Some(1.0) },
        Action::AddShape { part: text("hips"), shape: text("skis"), for_secs: None },
        Action::RemoveShape { part: text("hips"), shape: text("skis") },
        Action::Layer { layer: Layer::Poses, on: false },
        Action::Reflex { name: text("balance"), on: true },
        Action::Controller { name: text("Idle") },
        Action::Controller { name: String::new() },
        Action::Tracker { name: text("kinematic") },
        Action::Reach(ReachOrder { object: Some(text("ball")), ..ReachOrder::default() }),
        Action::ReachEnd {},
        Action::Say { text: text("hm") },
    ];
    let fade_secs = Some(0.25);
    let of_two = [
        Action::Weights { parts: vec![text("chest")], pin: Some(0.5), joint: None, fade_secs, for_secs: Some(1.0) },
        Action::Kd {
            preset: Some(KdPreset::Default),
            k_p: Some(100.0),
            d_p: None,
            k_q: None,
            d_q: None,
            damping: None,
            feed_forward: Some(false),
            fade_secs,
            for_secs: None,
        },
        Action::Pins { on: false, fade_secs, for_secs: Some(0.5) },
    ];
    let of_stage = [
        Action::Place { object: text("ball"), position_m: Some([0.0, 2.0, 0.0]), velocity_m_s: None },
        Action::Accelerate { object: text("lift"), acceleration_m_s2: [0.0, 1.0, 0.0], for_secs: 1.0 },
        Action::Push { on: text("ball"), force_n: [1.0; 3], for_secs: 0.1, facing: false, at_m: None },
        Action::Gravity { scale: 0.5, on: Some(text("ball")), part: None, over_secs: Some(1.0), for_secs: None },
        motor(None, Some(2.0)),
        motor(None, None),
        Action::Cut { joint: text("hinge") },
        Action::Reload { name: text("Idle"), text: Some(text("class Idle: pass")) },
        Action::ScriptKilled { name: text("Idle"), reason: text("late") },
        Action::Say { text: text("hm") },
    ];
    let commands = of_one.into_iter().map(one).chain(of_two.into_iter().map(|action| Command::to("two", action)));
    commands.chain(of_stage.into_iter().map(Command::stage)).collect()
}

#[test]
fn every_command_comes_back_from_its_order_as_it_was_said() {
    let stage = stage();
    for command in commands() {
        let order = stage.resolve(&command).unwrap_or_else(|error| panic!("{command:?}: {error}"));
        assert_eq!(order.to_command(stage.cast()), command);
    }
}

#[test]
fn what_makes_no_sense_is_refused_with_its_kind() {
    let stage = stage();
    let nan = f64::NAN;
    let place = |position_m| Action::Place { object: text("ball"), position_m: Some(position_m), velocity_m_s: None };
    let table = [
        (Command::to("nobody", Action::ReachEnd {}), Kind::NotFound),
        (one(Action::Pose { name: text("gard") }), Kind::NotFound),
        (one(Action::Gain { factor: 1.0, part: Some(text("tail")) }), Kind::NotFound),
        (one(Action::Graph { name: text("sway"), state: Some(text("z")) }), Kind::NotFound),
        (one(Action::Reflex { name: text("jump"), on: true }), Kind::NotFound),
        (one(Action::Tracker { name: text("magic") }), Kind::NotFound),
        (Command::stage(Action::Cut { joint: text("knee") }), Kind::NotFound),
        (one(Action::Gain { factor: 1e30, part: None }), Kind::OutOfRange),
        (one(Action::Gain { factor: nan, part: None }), Kind::OutOfRange),
        (one(push([nan, 0.0, 0.0])), Kind::OutOfRange),
        (one(push([1e6, 0.0, 0.0])), Kind::OutOfRange),
        (one(gravity(1e3, None, None)), Kind::OutOfRange),
        (one(gravity(1.0, None, Some(1e9))), Kind::OutOfRange),
        (Command::stage(place([0.0, f64::INFINITY, 0.0])), Kind::OutOfRange),
        (one(Action::Say { text: "x".repeat(5000) }), Kind::TooLarge),
        (one(Action::ForcesOff { parts: vec![text("hips"); 1000], for_secs: None }), Kind::TooLarge),
        (Command::stage(Action::ReachEnd {}), Kind::WrongTarget),
        (one(Action::Ik { link: Some(text("head")), target_m: [0.0; 3] }), Kind::WrongTarget),
        (
            Command::stage(Action::Accelerate { object: text("ball"), acceleration_m_s2: [0.0; 3], for_secs: 1.0 }),
            Kind::WrongTarget,
        ),
        (
            one(Action::Attach { link: text("leftHand"), object: text("one.rightHand"), soft: false, break_n: None }),
            Kind::WrongTarget,
        ),
        (
            one(Action::Attach { link: text("leftHand"), object: text("ground"), soft: false, break_n: None }),
            Kind::WrongTarget,
        ),
        (one(Action::Reach(ReachOrder::default())), Kind::Contradiction),
        (one(Action::Live { on: true }), Kind::NotHonoured),
    ];
    for (command, kind) in table {
        let error = stage.resolve(&command).expect_err(&format!("{command:?}"));
        assert_eq!(error.kind(), kind, "{command:?}: {error}");
        // It names the command.
        assert!(error.problem().starts_with("do = \""), "{error}");
    }
}

/// What commands of this file change, in numbers.
fn state(stage: &Stage) -> Vec<String> {
    let (character, ball) = (stage.cast().character("one").unwrap(), stage.cast().prop("ball").unwrap());
    let actor = stage.state_of(character).unwrap();
    let world = stage.world();
    let mut state = vec![
        format!("{:?} {:?} {:?}", actor.pose(), actor.graph_state(), actor.tracker().kind()),
        format!("{:?}", [Layer::Poses, Layer::Scripts, Layer::Reflexes].map(|layer| actor.has_layer(layer))),
        format!("{:?} {}", actor.gain(None), actor.has_reflex("balance")),
        format!("{:?}", Node::ALL.map(|node| actor.gain(Some(node)))),
        format!("{:?}", Node::ALL.map(|node| world.part_gravity(character, node))),
        format!("{:?}", Node::ALL.map(|node| world.has_forces(character, node))),
        format!("{:?}", stage.shape_in_place_of_own(character, Node::LeftFoot)),
        format!("{} {}", world.is_held_to_plane(character), world.prop_gravity(ball)),
        format!("{:?}", world.prop_motor(stage.cast().joint("hinge").unwrap())),
    ];
    state.extend(world.held().map(|held| format!("{held:?}")));
    state
}

#[test]
fn undo_brings_back_what_an_order_changed() {
    let is_undone = |action: &Action| {
        !matches!(
            action,
            Action::Signal { .. }
                | Action::Push { .. }
                | Action::Say { .. }
                | Action::Cut { .. }
                | Action::Reload { .. }
                | Action::ScriptKilled { .. }
                | Action::Controller { .. }
                | Action::Reach(_)
        )
    };
    for command in commands().into_iter().filter(|command| command.character.as_deref() != Some("two")) {
        if !is_undone(&command.action) {
            continue;
        }
        let mut stage = stage();
        stage.step();
        let before = state(&stage);
        stage.command(command.clone());
        stage.step();
        let changed = state(&stage) != before;
        let is_taken_back = stage.undo();
        stage.step();
        assert_eq!(state(&stage), before, "{command:?}");
        assert!(is_taken_back || !changed, "{command:?}");
    }
}

#[test]
fn a_push_cannot_be_undone_and_undo_goes_on_to_what_can() {
    let mut stage = stage();
    stage.command(one(Action::Gain { factor: 0.5, part: None }));
    stage.command(one(push([0.0, 0.0, 10.0])));
    stage.step();
    assert!(stage.undo());
    stage.step();
    let one = stage.cast().character("one").unwrap();
    assert_eq!(stage.state_of(one).unwrap().gain(None), 1.0);
    assert!(!stage.undo(), "nothing is left");
    // What undo did is in the record, so that a take replays it.
    assert_eq!(stage.record().len(), 3);
}

#[test]
fn timed_effects_that_overlap_bring_back_what_was_before_the_first() {
    let mut stage = stage();
    let scale = |stage: &Stage| stage.world().part_gravity(stage.cast().character("one").unwrap(), Node::Hips);
    // A factor of its own, then two that last.
    stage.command(one(gravity(0.5, None, None)));
    stage.command(one(gravity(0.0, None, Some(0.2))));
    stage.step();
    assert_eq!(scale(&stage), 0.0);
    stage.command(one(gravity(2.0, None, Some(0.2))));
    stage.step();
    assert_eq!(scale(&stage), 2.0);
    (0..60).for_each(|_| stage.step());
    assert_eq!(scale(&stage), 0.5);
}

#[test]
fn what_a_tracker_does_not_honour_is_refused_with_that_kind() {
    let mut stage = stage();
    stage.command(one(Action::Pins { on: false, fade_secs: None, for_secs: None }));
    stage.step();
    let Effect::Refused(error) = &stage.events().list()[0].effect else { panic!("it is refused") };
    assert_eq!(error.kind(), Kind::NotHonoured);
}

#[test]
fn nothing_in_reach_is_a_state_and_no_name() {
    let mut stage = stage();
    let nearest = Action::Attach { link: text("leftHand"), object: String::new(), soft: false, break_n: None };
    stage.command(one(nearest));
    stage.step();
    let Effect::Refused(error) = &stage.events().list()[0].effect else { panic!("it is refused") };
    assert_eq!(error.kind(), Kind::WrongState);
    let take = Action::Attach { link: text("RightArm"), object: text("ball"), soft: false, break_n: None };
    stage.command(one(take));
    stage.step();
    let holds = CharacterEffect::Holds { node: Node::RightHand, object: text("ball") };
    assert_eq!(stage.events().list()[1].effect, Effect::of("one", holds));
    let (ball, one) = (stage.cast().prop("ball").unwrap(), stage.cast().character("one").unwrap());
    assert!(stage.world().is_attached(one, Node::RightHand, Entity::Prop(ball)));
}
