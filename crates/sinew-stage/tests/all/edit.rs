//! A scene is edited while it runs.

#![allow(clippy::unwrap_used, clippy::disallowed_methods, reason = "tests")]

use sinew_body::humanoid::Node;
use sinew_control::Layer;
use sinew_control::tracker::TrackerKind;
use sinew_stage::scene::SceneDocument;
use sinew_stage::{EditOutcome, RestartReason, Scene, Stage};

const TEXT: &str = "format = 1

# A boxer, and what it hits.
[characters.one]   # she
mass_kg = 60
pose_gain = 1.0    # as people are
reflexes = []
source = { pose = \"guard\" }

[props.ball]
ball_radius_m = 0.1
mass_kg = 1
position_m = [0, 0.1, 2]

[poses.guard]
joints.leftLowerArm = [-60, 0, 0]
[poses.up]
joints.leftUpperArm = [0, 0, 150]

[[keys]]
key = \"g\"
character = \"one\"
do = \"pose\"
name = \"up\"
";

fn stage() -> Stage {
    Stage::new(Scene::from_text(TEXT).unwrap(), None).unwrap()
}

fn edited(sets: &[(&str, &str)]) -> String {
    let mut document = SceneDocument::parse(TEXT).unwrap();
    for (path, value) in sets {
        document.set(path, value).unwrap();
    }
    document.to_string()
}

#[test]
fn comments_order_and_spacing_stay_as_they_were() {
    let text = edited(&[("characters.one.pose_gain", "0.5"), ("props.ball.position_m", "[0, 1, 2]")]);
    let expected = TEXT.replace("pose_gain = 1.0 ", "pose_gain = 0.5 ").replace("[0, 0.1, 2]", "[0, 1, 2]");
    assert_eq!(text, expected);
    // A text that nothing was set in is that text.
    assert_eq!(edited(&[]), TEXT);
}

#[test]
fn the_running_stage_follows_what_it_can_and_names_what_needs_a_restart() {
    let mut stage = stage();
    (0..10).for_each(|_| stage.step());
    let text = edited(&[
        ("characters.one.pose_gain", "0.5"),
        ("characters.one.reflexes", "[\"balance\"]"),
        ("characters.one.layers", "[\"poses\", \"reflexes\"]"),
        ("characters.one.gravity_scale", "0.25"),
        ("characters.one.source.pose", "up"),
        ("characters.one.tracker", "kd"),
        ("characters.one.colour", "#ff0000"),
        ("characters.one.mass_kg", "70"),
        ("props.ball.position_m", "[0, 1, 2]"),
        ("props.ball.mass_kg", "2"),
        ("stage.gravity_m_s2", "1.62"),
        ("stage.motion_hz", "120"),
        ("props.box.box_m", "[1, 1, 1]"),
        ("props.box.fixed", "true"),
        ("keys.0.name", "guard"),
    ]);
    let answers = stage.edit(&text).unwrap();
    let is_applied = |one: &&sinew_stage::Edited| one.outcome == EditOutcome::Applied;
    let applied: Vec<&str> = answers.iter().filter(is_applied).map(|one| one.path.as_str()).collect();
    assert_eq!(
        applied,
        [
            "characters.one.colour",
            "characters.one.gravity_scale",
            "characters.one.layers",
            "characters.one.pose_gain",
            "characters.one.reflexes",
            "characters.one.source.pose",
            "characters.one.tracker",
            "keys",
            "props.ball.mass_kg",
            "props.ball.position_m",
            "props.box",
            "stage.gravity_m_s2",
        ]
    );
    let later: Vec<(&str, EditOutcome)> =
        answers.iter().filter(|one| !is_applied(one)).map(|one| (one.path.as_str(), one.outcome)).collect();
    assert_eq!(
        later,
        [
            ("characters.one.mass_kg", EditOutcome::NeedsRestart(RestartReason::Body)),
            ("stage.motion_hz", EditOutcome::NeedsRestart(RestartReason::Rates)),
        ]
    );
    stage.step();
    let (one, ball) = (stage.cast().character("one").unwrap(), stage.cast().prop("ball").unwrap());
    let actor = stage.state_of(one).unwrap();
    assert_eq!((actor.gain(None), actor.has_reflex("balance"), actor.has_layer(Layer::Scripts)), (0.5, true, false));
    assert_eq!((actor.pose(), actor.tracker().kind()), (Some("up"), TrackerKind::Kd));
    assert_eq!(stage.world().part_gravity(one, Node::Head), 0.25);
    // It fell for one step.
    assert!((stage.frame().prop(ball).unwrap().position.y - 1.0).abs() < 1e-3);
    // The key does something else by now.
    assert!(stage.press("g"));
    stage.step();
    assert_eq!(stage.state_of(one).unwrap().pose(), Some("guard"));
    // What runs already is not said again; what waits for a restart is.
    let again = stage.edit(&text).unwrap();
    assert!(again.iter().all(|one| one.outcome != EditOutcome::Applied), "{again:?}");
    assert_eq!(again.len(), 2);
}

#[test]
fn a_text_that_is_no_sound_scene_changes_nothing() {
    let (mut stage, mut other) = (stage(), stage());
    let error = stage.edit(&edited(&[("characters.one.pose_gain", "1e30")])).unwrap_err();
    assert!(error.to_string().contains("characters.one.pose_gain: 1000000"), "{error}");
    assert!(stage.edit("format = ").is_err());
    for _ in 0..60 {
        stage.step();
        other.step();
    }
    assert_eq!(stage.hash(), other.hash());
}

#[test]
fn an_edited_run_replays_to_the_same_bits_from_the_first_text() {
    let mut stage = stage();
    for step in 0..240 {
        if step == 60 {
            stage
                .edit(&edited(&[("characters.one.pose_gain", "0.2"), ("props.ball.position_m", "[0, 2, 0]")]))
                .unwrap();
        }
        stage.step();
    }
    let mut again = self::stage();
    again.prescribe(stage.record().to_vec());
    (0..240).for_each(|_| again.step());
    assert_eq!(again.hash(), stage.hash());
}

#[test]
fn an_edit_can_be_undone() {
    let mut stage = stage();
    stage.edit(&edited(&[("characters.one.pose_gain", "0.2")])).unwrap();
    stage.step();
    assert!(stage.undo());
    stage.step();
    assert_eq!(stage.state_of(stage.cast().character("one").unwrap()).unwrap().gain(None), 1.0);
}

#[test]
fn paths_that_lead_nowhere_are_errors() {
    let mut document = SceneDocument::parse(TEXT).unwrap();
    for path in ["", "a..b", "characters.one.mass_kg.x", "keys.7.name"] {
        assert!(document.set(path, "1").is_err(), "{path}");
    }
    assert!(!document.remove("characters.two").unwrap());
    assert!(document.remove("characters.one.pose_gain").unwrap());
    assert!(SceneDocument::parse("a = [").is_err());
    assert_eq!(document.to_string(), TEXT.replace("pose_gain = 1.0    # as people are\n", ""));
}
