//! What a tracker does not honour is refused, never swallowed.

#![allow(clippy::unwrap_used, clippy::disallowed_methods, reason = "tests")]

use sinew_control::tracker::{Asked, TrackerKind};
use sinew_control::{Action, Command, Layer};
use sinew_stage::{Effect, Scene, Stage};

const TRACKERS: [TrackerKind; 5] = TrackerKind::ALL;

fn scene(tracker: &str, more: &str) -> Result<Scene, String> {
    let text = format!("format = 1\n[characters.one]\npose = \"stand\"\ntracker = \"{tracker}\"\n{more}");
    Scene::from_text(&text).map_err(|error| error.to_string())
}

#[test]
fn a_command_that_the_tracker_does_not_honour_is_refused_and_changes_no_bit() {
    let asked = [
        (Asked::Gains, Action::Gain { factor: 0.3, part: None }),
        (Asked::Gains, Action::Layer { layer: Layer::Poses, on: false }),
        (Asked::Torques, Action::Reflex { name: "balance".to_owned(), on: true }),
    ];
    for kind in TRACKERS {
        for (what, action) in &asked {
            let [mut told, mut untold] = [0, 1].map(|_| Stage::new(scene(kind.name(), "").unwrap(), None).unwrap());
            told.command(Command::to("one", action.clone()));
            for _ in 0..30 {
                told.step();
                untold.step();
            }
            let is_honoured = kind.check(*what).is_ok();
            let refused = matches!(told.events().list()[0].effect, Effect::Refused(_));
            assert_eq!(refused, !is_honoured, "{} {action:?}", kind.name());
            assert_eq!(told.hash() == untold.hash(), !is_honoured, "{} {action:?}", kind.name());
        }
    }
}

#[test]
fn a_scene_that_states_what_its_tracker_does_not_honour_is_refused_at_the_key() {
    for (tracker, stated, place, hint) in [
        ("kinematic", "pose_gain = 2", "characters.one.pose_gain", "pd or kd"),
        ("response", "layers = [\"scripts\"]", "characters.one.layers", "pd or kd"),
        ("none", "reflexes = [\"balance\"]", "characters.one.reflexes", "pd or kd"),
        ("kd", "joints.leftHand = { frequency_hz = 5 }", "characters.one.joints", "follow by pd"),
        ("pd", "kd = { preset = \"giant\" }", "characters.one.kd", "tracker = \"kd\""),
        ("pd", "response = { keep_upright = \"leftHand\" }", "characters.one.response", "tracker = \"response\""),
        ("kinematic", "[[at]]\ntime_secs = 1\ncharacter = \"one\"\ndo = \"gain\"\nfactor = 2", "at", "pd or kd"),
        ("pd", "[[at]]\ntime_secs = 1\ncharacter = \"one\"\ndo = \"pins\"\non = false", "at", "tracker = \"kd\""),
    ] {
        let problem = scene(tracker, stated).unwrap_err();
        assert!(problem.contains(place) && problem.contains(hint), "{problem}");
    }
}

#[test]
fn a_scene_whose_commands_bring_the_tracker_later_may_state_what_that_one_honours() {
    let later = "[[at]]\ntime_secs = 1\ncharacter = \"one\"\ndo = \"tracker\"\nname = \"kd\"";
    assert!(scene("pd", &format!("kd = {{ preset = \"giant\" }}\n{later}")).is_ok());
    assert!(scene("kinematic", &format!("pose_gain = 2\n{later}")).is_ok());
}

#[test]
fn a_controller_excuses_its_own_character_and_only_if_it_switches_trackers() {
    let controller = |words: &str| {
        let class = format!("class C:\\n    def step(self):\\n        {words}\\n");
        let other = "[characters.other]\ntracker = \"kinematic\"";
        format!("controller = \"c\"\n{other}\n[controllers.c]\nclass = \"C\"\ntext = \"{class}\"\n")
    };
    let (calm, switching) = (controller("pass"), controller("skeleton.useTracker('pd')"));
    let problem = scene("kinematic", &format!("pose_gain = 2\n{calm}")).unwrap_err();
    assert!(problem.contains("characters.one.pose_gain"), "{problem}");
    assert!(scene("kinematic", &format!("pose_gain = 2\n{switching}")).is_ok());
    let problem = scene("kinematic", &switching.replace("[controllers", "pose_gain = 2\n[controllers")).unwrap_err();
    assert!(problem.contains("characters.other.pose_gain"), "{problem}");
}
