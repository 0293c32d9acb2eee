//! What a running stage does with commands, spans, touches and bad input.

#![allow(clippy::unwrap_used, clippy::disallowed_methods, reason = "tests")]

use glam::DVec3;
use sinew_body::humanoid::Node;
use sinew_control::{Action, Command, Layer};
use sinew_stage::{CharacterEffect, Effect, Scene, Stage};
use sinew_world::CharacterId;

fn stage(text: &str) -> Stage {
    Stage::new(Scene::from_text(&format!("format = 1\n{text}")).unwrap(), None).unwrap()
}

fn steps(stage: &mut Stage, count: usize) {
    for _ in 0..count {
        stage.step();
    }
}

fn effects(stage: &Stage) -> Vec<(u64, Effect)> {
    stage.events().list().iter().map(|event| (event.step, event.effect.clone())).collect()
}

const STANDING: &str = "[characters.one]\npose = \"stand\"\n";

#[test]
fn a_command_acts_in_the_step_that_follows_it_and_is_recorded_with_it() {
    let mut stage = stage(STANDING);
    steps(&mut stage, 7);
    stage.command(Command::to(
        "one",
        Action::Push { on: "chest".to_owned(), force_n: [0.0, 0.0, 500.0], for_secs: 0.05, facing: false, at_m: None },
    ));
    let before = stage.frame().characters[0].centre_velocity.z;
    stage.step();
    // 500 N for 1/240 s on 80 kg.
    let gained = stage.frame().characters[0].centre_velocity.z - before;
    assert!((gained - 500.0 / 240.0 / 80.0).abs() < 0.01, "{gained}");
    assert_eq!(stage.record().len(), 1);
    assert_eq!(stage.record()[0].step, 7);
    assert_eq!(effects(&stage)[0].0, 7);
}

#[test]
fn what_lasts_for_a_time_ends_at_its_step() {
    let mut stage = stage(&format!(
        "{STANDING}[[at]]\ntime_secs = 0.1\ncharacter = \"one\"\ndo = \"gravity\"\nscale = 0.0\nfor_secs = 0.2\n"
    ));
    steps(&mut stage, 240);
    let effects = effects(&stage);
    let gravity = |scale| Effect::of("one", CharacterEffect::Gravity { node: None, scale, over_secs: None });
    assert_eq!(effects, [(24, gravity(0.0)), (72, gravity(1.0))]);
}

#[test]
fn gravity_fades_and_acts_on_one_part() {
    let command = "[[at]]\ntime_secs = 0\ncharacter = \"one\"\ndo = \"gravity\"\nscale = -1.0\n";
    let mut fades = stage(&format!("{STANDING}{command}over_secs = 1.0\n"));
    steps(&mut fades, 120);
    assert!(fades.world().part_gravity(CharacterId::first_in(0), Node::Head).abs() < 1e-9, "half way from 1 to -1");
    steps(&mut fades, 240);
    assert_eq!(fades.world().part_gravity(CharacterId::first_in(0), Node::Head), -1.0);
    let mut part = stage(&format!("{STANDING}{command}part = \"leftHand\"\nfor_secs = 0.5\n"));
    steps(&mut part, 60);
    assert_eq!(part.world().part_gravity(CharacterId::first_in(0), Node::LeftHand), -1.0);
    assert_eq!(part.world().part_gravity(CharacterId::first_in(0), Node::RightHand), 1.0);
    steps(&mut part, 120);
    assert_eq!(part.world().part_gravity(CharacterId::first_in(0), Node::LeftHand), 1.0);
}

#[test]
fn a_touch_fires_once_or_again_after_its_pause() {
    let ball = "[props.ball]\nball_radius_m = 0.1\nmass_kg = 1\nbounce = 0.9\nposition_m = [0, 0.5, 0]\n";
    let when = "[[when]]\ntouching = [\"ball\", \"ground\"]\ndo = \"say\"\ntext = \"boing\"\n";
    let mut once = stage(&format!("{ball}{when}"));
    steps(&mut once, 960);
    assert_eq!(effects(&once).len(), 1);
    let mut again = stage(&format!("{ball}{when}repeat_after_secs = 0.05\n"));
    steps(&mut again, 960);
    assert!(effects(&again).len() >= 4, "{:?}", effects(&again));
}

#[test]
fn switching_layers_off_and_on_does_not_jump() {
    let mut stage = stage("[stage]\nmotion_hz = 60\n[characters.one]\npose = \"stand\"\nplane = true\n");
    steps(&mut stage, 60);
    let mut fastest = 0.0_f64;
    for at in 0..240 {
        if at % 40 == 0 {
            let on = (at / 40) % 2 == 1;
            stage.command(Command::to("one", Action::Layer { layer: Layer::Poses, on }));
        }
        let before = stage.frame().characters[0].pose();
        stage.step();
        let after = stage.frame().characters[0].pose();
        for (one, other) in before.world.iter().zip(&after.world) {
            fastest = fastest.max(one.angle_between(*other));
        }
    }
    // A joint that jumped would turn by tens of degrees in a step; a fall turns limbs by at most some 15 rad/s.
    assert!(fastest < 15.0 / 240.0, "{fastest}");
}

#[test]
fn a_command_that_makes_no_sense_is_refused_in_words_and_the_stage_goes_on() {
    let mut stage = stage(STANDING);
    for action in [
        Action::Pose { name: "nonsense".to_owned() },
        Action::Push { on: "tail".to_owned(), force_n: [0.0; 3], for_secs: 1.0, facing: false, at_m: None },
        Action::Push { on: "chest".to_owned(), force_n: [f64::NAN; 3], for_secs: 1.0, facing: false, at_m: None },
        Action::Push {
            on: "chest".to_owned(),
            force_n: [1e300; 3],
            for_secs: f64::INFINITY,
            facing: false,
            at_m: None,
        },
        Action::Gravity { scale: f64::NAN, on: None, part: None, over_secs: None, for_secs: None },
        Action::Shape { part: "leftFoot".to_owned(), shape: "skis".to_owned(), for_secs: None },
        Action::Attach { link: "leftHand".to_owned(), object: "moon".to_owned(), soft: false, break_n: None },
        Action::Tracker { name: "magic".to_owned() },
        Action::Graph { name: "walk".to_owned(), state: None },
        Action::Controller { name: "Ghost".to_owned() },
        Action::Reload { name: "Ghost".to_owned(), text: Some("x".to_owned()) },
        Action::Ik { link: Some("head".to_owned()), target_m: [0.0; 3] },
    ] {
        let refused = stage.events().list().len();
        stage.command(Command::to("one", action.clone()));
        stage.step();
        let event = &stage.events().list()[refused];
        assert!(event.effect.is_refused(), "{action:?}: {}", event.effect);
    }
    stage.command(Command::to("nobody", Action::Say { text: "hm".to_owned() }));
    stage.step();
    let Effect::Refused(error) = &stage.events().list().last().unwrap().effect else { panic!("it is refused") };
    assert!(error.problem().contains("no character `nobody`; known: one"), "{error}");
    assert!(stage.frame().characters[0].pose().is_finite());
    // A take can hold no NaN; the commands that made no sense are not in it.
    assert!(stage.record().is_empty());
}

#[test]
fn equal_scenes_and_commands_give_equal_bits_at_every_step() {
    let text = format!(
        "{STANDING}[props.ball]\nball_radius_m = 0.1\nmass_kg = 3\nposition_m = [0, 1.3, 1]\nvelocity_m_s = [0, 0, -6]\n"
    );
    let run = || {
        let mut stage = stage(&text);
        let mut hashes = Vec::new();
        for step in 0..300 {
            if step == 100 {
                stage.command(Command::to("one", Action::Gain { factor: 0.5, part: None }));
            }
            stage.step();
            hashes.push(stage.hash());
        }
        hashes
    };
    assert_eq!(run(), run());
}

#[test]
fn the_number_of_threads_changes_no_bit_of_a_scene() {
    let text = "[characters.one]\nreflexes = [\"balance\"]\n[characters.two]\ntracker = \"none\"\nposition_m = [0.1, 2, 0]\n\
                [characters.three]\ntracker = \"none\"\nposition_m = [-0.1, 4, 0.1]\n";
    let run = |threads: usize| {
        let mut stage = stage(text);
        let got = stage.set_threads(threads);
        assert!(got == threads || !cfg!(feature = "threads"), "{got} threads");
        let step = |_| {
            stage.step();
            stage.hash()
        };
        (0..480).map(step).collect::<Vec<u64>>()
    };
    assert_eq!(run(1), run(2));
}

#[test]
fn absurd_gains_and_forces_never_leave_a_frame_that_is_not_finite() {
    let mut stage = stage("[characters.one]\npose_gain = 1000\n[characters.one.joints.leftHand]\nfrequency_hz = 100\n");
    for round in 0..40 {
        let most = sinew_world::MAX_FORCE_N;
        let force_n = [if round % 2 == 0 { most } else { -most }, most, 0.0];
        stage.command(Command::to(
            "one",
            Action::Push { on: "leftHand".to_owned(), force_n, for_secs: 0.01, facing: false, at_m: None },
        ));
        stage.command(Command::to("one", Action::Gain { factor: 1000.0, part: None }));
        for _ in 0..12 {
            stage.step();
            let character = &stage.frame().characters[0];
            assert!(character.pose().is_finite());
            assert!(character.parts.iter().all(|part| part.position.abs().max_element() < 1e4));
        }
    }
}

#[test]
fn a_held_ball_stays_in_the_hand_until_it_is_let_go() {
    let mut stage = stage(&format!(
        "{STANDING}[props.ball]\nball_radius_m = 0.05\nmass_kg = 0.5\nposition_m = [-0.2, 0.75, 0.1]\n"
    ));
    stage.command(Command::to(
        "one",
        Action::Attach { link: "rightHand".to_owned(), object: "ball".to_owned(), soft: false, break_n: None },
    ));
    stage.step();
    let hand = |stage: &Stage| stage.frame().characters[0].part(sinew_body::humanoid::Node::RightHand).centre;
    let apart = |stage: &Stage| (hand(stage) - stage.frame().props[0].position).length();
    let before = apart(&stage);
    steps(&mut stage, 120);
    // Rigid but for the solver's error.
    assert!((apart(&stage) - before).abs() < 2e-3, "{} {before}", apart(&stage));
    stage.command(Command::to("one", Action::Detach { link: "rightHand".to_owned(), object: "ball".to_owned() }));
    steps(&mut stage, 200);
    assert!(stage.frame().props[0].position.y < 0.1);
    assert!(stage.frame().props[0].position.distance(DVec3::ZERO) < 3.0);
}

#[test]
fn an_added_shape_touches_until_its_time_is_over() {
    use sinew_body::humanoid::Node;
    use sinew_world::Entity;
    let pole_touches = |for_secs: f64| {
        let mut stage = stage(&format!(
            "[shapes.pole]\nbox_m = [0.1, 1.0, 0.1]\ncentre_m = [0, -1.2, 0]\n[characters.one]\nposition_m = [0, 3, 0]\n\
             [[at]]\ntime_secs = 0\ncharacter = \"one\"\ndo = \"add_shape\"\npart = \"hips\"\nshape = \"pole\"\n\
             for_secs = {for_secs}\n"
        ));
        let mut touches = false;
        // 3 m of fall take 0.78 s; the pole reaches 0.7 m lower than the soles, and touches after 0.69 s.
        for _ in 0..180 {
            stage.step();
            touches |= stage.frame().are_touching(Entity::Floor, Entity::Part(CharacterId::first_in(0), Node::Hips));
        }
        touches
    };
    assert!(pole_touches(2.0));
    assert!(!pole_touches(0.6));
}
