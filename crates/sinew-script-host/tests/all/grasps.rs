//! Hands take hold of things and of each other: "first as a soft grasp [...] and also as a hard grasp", begun by the operator, a key or
//! a script (Nguyen et al. 2010, section 5).

use crate::stage::{centre, character, of, prop_centre, until, when};
use glam::DVec3;
use sinew_body::humanoid::Node;
use sinew_control::{Action, Command};
use sinew_stage::{Cause, CharacterEffect, Effect, Scene, Stage};
use std::collections::BTreeMap;

/// Somebody who stands, and two balls at the right hand: the nearer one weighs 2 kg.
const TWO_BALLS: &str = r#"format = 1
[characters.one]
pose = "stand"
source = { pose = "stand" }
tracker = "kd"
controller = "CONTROLLER"
[props.near]
ball_radius_m = 0.05
mass_kg = 2
position_m = NEAR
[props.far]
ball_radius_m = 0.05
mass_kg = 2
position_m = FAR
[controllers.Grips]
file = "grips.py"
[controllers.Idle]
file = "idle.py"
# The balls wait where they are.
[[at]]
time_secs = 0
do = "gravity"
on = "near"
scale = 0
for_secs = 0.3
[[at]]
time_secs = 0
do = "gravity"
on = "far"
scale = 0
for_secs = 0.3
[[keys]]
key = "g"
label = "grasp"
character = "one"
do = "attach"
link = "rightHand"
[[keys]]
key = "l"
label = "let go"
character = "one"
do = "detach"
link = "rightHand"
"#;

const GRIPS: &str = r#"
class Grips:
    def step(self):
        if getStep() == 24:
            skeleton.attachLink("rightHand")
"#;

const IDLE: &str = r#"
class Idle:
    def step(self):
        pass
"#;

fn scene(text: &str) -> Stage {
    let files = [("scene.toml", text), ("grips.py", GRIPS), ("idle.py", IDLE)];
    let files: BTreeMap<String, Vec<u8>> =
        files.into_iter().map(|(name, text)| (name.to_owned(), text.as_bytes().to_vec())).collect();
    of(Scene::from_files("scene.toml", files).unwrap_or_else(|error| panic!("{error}")))
}

fn two_balls(controller: &str) -> Stage {
    let with = |near: DVec3, far: DVec3| {
        let place = |at: DVec3| format!("[{}, {}, {}]", at.x, at.y, at.z);
        let text = TWO_BALLS.replace("CONTROLLER", controller);
        scene(&text.replace("NEAR", &place(near)).replace("FAR", &place(far)))
    };
    let hand = centre(&with(DVec3::X * 5.0, DVec3::X * 6.0), "one", Node::RightHand);
    // Both within reach, beside and in front.
    with(hand + DVec3::X * -0.12, hand + DVec3::Z * 0.15)
}

fn grasp(soft: bool, break_n: Option<f64>) -> Command {
    Command::to("one", Action::Attach { link: "rightHand".to_owned(), object: String::new(), soft, break_n })
}

#[test]
fn a_script_a_key_and_a_command_each_take_the_nearest_thing() {
    let grasped = |begin: &dyn Fn(&mut Stage), controller: &str| {
        let mut stage = two_balls(controller);
        begin(&mut stage);
        until(&mut stage, 0.5, |_| ());
        let held: Vec<String> = stage
            .world()
            .held()
            .map(|held| format!("{} {}", held.node.part(), stage.cast().name_of(held.object)))
            .collect();
        let holds = CharacterEffect::Holds { node: Node::RightHand, object: "near".to_owned() };
        let at = when(&stage, &Effect::of("one", holds));
        (held, at)
    };
    let by_command = grasped(&|stage| stage.command(grasp(false, None)), "Idle");
    let by_key = grasped(&|stage| assert!(stage.press("g")), "Idle");
    let by_script = grasped(&|_| (), "Grips");
    let held = vec!["rightHand near".to_owned()];
    assert_eq!(by_command, (held.clone(), 0.0));
    assert_eq!(by_key, (held.clone(), 0.0));
    // What a script says at a step happens in that step.
    assert_eq!(by_script, (held, 0.1));
}

/// Where the ball is in the hand's frame.
fn in_hand(stage: &Stage) -> DVec3 {
    let hand = character(stage, "one").part(Node::RightHand);
    hand.rotation.conjugate() * (prop_centre(stage, "near") - hand.position)
}

#[test]
fn a_soft_grasp_gives_and_a_hard_one_does_not_until_both_let_go() {
    for soft in [false, true] {
        let mut stage = two_balls("Idle");
        let before = in_hand(&stage);
        stage.command(grasp(soft, None));
        until(&mut stage, 3.0, |_| ());
        let sags = (in_hand(&stage) - before).length();
        // 4 Hz: a weight stretches the spring by g / (2π 4 Hz)², 1.55 cm, whatever it weighs.
        let expected = if soft { 0.0155 } else { 0.0 };
        assert!((sags - expected).abs() < 0.003, "soft {soft}: {sags} m");
        assert!(stage.press("l"));
        until(&mut stage, 4.0, |_| ());
        assert_eq!(stage.world().held().count(), 0);
        assert!(prop_centre(&stage, "near").y < 0.2, "it has fallen");
    }
}

#[test]
fn a_grasp_breaks_above_its_force_and_says_so() {
    for soft in [false, true] {
        let mut stage = two_balls("Idle");
        stage.command(grasp(soft, Some(150.0)));
        let pull = |stage: &mut Stage, force_n: f64| {
            let force_n = [0.0, -force_n, 0.0];
            let push = Action::Push { on: "near".to_owned(), force_n, for_secs: 1.0, facing: false, at_m: None };
            stage.command(Command { character: None, action: push });
        };
        until(&mut stage, 1.0, |_| ());
        // Set upon at once, an arm gives twice its pull for a moment.
        pull(&mut stage, 40.0);
        until(&mut stage, 2.0, |_| ());
        assert_eq!(stage.world().held().count(), 1, "soft {soft}: it holds 40 N and the ball's 20 N");
        pull(&mut stage, 300.0);
        until(&mut stage, 3.0, |_| ());
        assert_eq!(stage.world().held().count(), 0, "soft {soft}");
        let loses = Effect::of("one", CharacterEffect::LosesHold { node: Node::RightHand, object: "near".to_owned() });
        let event = stage.events().list().iter().find(|event| event.effect == loses).unwrap();
        assert!(event.time_secs > 2.0, "{}", event.time_secs);
        let Cause::HoldOverload { force_n, max_n } = event.cause else { panic!("{}", event.cause) };
        assert!(force_n > max_n && max_n == 150.0, "{}", event.cause);
    }
}

#[test]
fn two_characters_take_each_others_hands_and_one_draws_the_other_along() {
    let text = |place: f64| {
        let mut text = "format = 1\n".to_owned();
        for (name, x) in [("one", 0.0), ("two", place)] {
            text += &format!(
                "[characters.{name}]\nposition_m = [{x}, 0, 0]\npose = \"stand\"\nsource = {{ pose = \"stand\" }}\ntracker = \"kd\"\n"
            );
        }
        text
    };
    // With a hand's breadth between their hands.
    let hand = centre(&scene(&text(9.0)), "one", Node::RightHand);
    let drawn = |holds: bool| {
        let mut stage = scene(&text(2.0 * hand.x - 0.1));
        let attach = |who: &str, link: &str, soft: bool| {
            Command::to(who, Action::Attach { link: link.to_owned(), object: String::new(), soft, break_n: None })
        };
        if holds {
            stage.command(attach("one", "rightHand", false));
            stage.command(attach("two", "leftHand", true));
        }
        until(&mut stage, 0.5, |_| ());
        let held: Vec<(usize, String)> =
            stage.world().held().map(|held| (held.character.slot(), stage.cast().name_of(held.object))).collect();
        let own = [(0, "two.leftHand".to_owned()), (1, "one.rightHand".to_owned())];
        assert_eq!(held, if holds { own.to_vec() } else { Vec::new() });
        let before = centre(&stage, "one", Node::RightHand);
        let push = Action::Push {
            on: "leftHand".to_owned(),
            force_n: [-60.0, 0.0, 0.0],
            for_secs: 1.5,
            facing: false,
            at_m: None,
        };
        stage.command(Command::to("two", push));
        until(&mut stage, 2.0, |_| ());
        let gap = (centre(&stage, "one", Node::RightHand) - centre(&stage, "two", Node::LeftHand)).length();
        (before.x - centre(&stage, "one", Node::RightHand).x, gap)
    };
    let (along, gap) = drawn(true);
    // Drawn along by centimetres, and the hands are where they took each other.
    assert!(along > 0.02 && gap < 0.13, "{along} m along, {gap} m apart");
    // Without hands nothing draws.
    assert!(drawn(false).0.abs() < 0.005);
}
