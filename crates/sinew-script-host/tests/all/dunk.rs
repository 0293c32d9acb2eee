//! Shapiro et al. 2007, appendix A: the listing runs as it is printed.

use crate::scene::{self, BALL, RIGHT_HAND, RIM};
use sinew_control::{Action, Command};
use sinew_script::{Contact, Script, Snapshot, StartInfo, Thing};

const LISTING: &str = r#"class DunkController:
    def start(self):
        skeleton.setTargetPose("PrepareDunk")
        skeleton.attachLink("RightArm", "Ball")

    def step(self):
        # As long as we have the ball,
        # continue to attempt the basket.
        if skeleton.isLinkAttached("RightArm", "Ball") :
            rimPos = getPosition("Rim")
            skeleton.setIKTarget(rimPos)

        # When the ball or the arm touches the rim,
        # the dunk attempt is finished,
        # so release ball and try to land.
        if isColliding("Ball", "Rim") \
            or isColliding(skeleton, "Rim") :
            skeleton.detachLink("RightArm", "Ball")
            skeleton.setTargetPose("Landing")
"#;

fn dunk() -> Script {
    let info = StartInfo { class: "DunkController".to_owned(), ..scene::info(LISTING) };
    Script::start(scene::host(), &info).unwrap()
}

fn with_ball() -> Snapshot {
    let mut snapshot = scene::snapshot();
    snapshot.characters[0].attached.push((RIGHT_HAND, Thing::Object(BALL)));
    snapshot
}

fn touching(mut snapshot: Snapshot, a: Thing, b: Thing) -> Snapshot {
    snapshot.contacts.push(Contact { a, b, point: [0.0; 3], impulse: [0.0; 3] });
    snapshot
}

fn own(action: Action) -> Command {
    Command::to("left", action)
}

fn pose(name: &str) -> Command {
    own(Action::Pose { name: name.to_owned() })
}

fn landing() -> [Command; 2] {
    let detach = Action::Detach { link: "rightHand".to_owned(), object: "Ball".to_owned() };
    [own(detach), pose("Landing")]
}

#[test]
fn first_step_takes_the_ball_and_then_reaches_for_the_rim_while_it_has_it() {
    let mut script = dunk();
    let outcome = script.step(&scene::snapshot());
    assert_eq!((outcome.error, outcome.killed), (None, None));
    let hand = "rightHand".to_owned();
    let attach = Action::Attach { link: hand, object: "Ball".to_owned(), soft: false, break_n: None };
    assert_eq!(outcome.commands, [pose("PrepareDunk"), own(attach)]);
    let outcome = script.step(&with_ball());
    assert_eq!(outcome.commands, [own(Action::Ik { link: None, target_m: [0.0, 3.05, 1.0] })]);
    assert_eq!(script.step(&scene::snapshot()).commands, []);
}

#[test]
fn ball_at_the_rim_lets_go_and_lands() {
    let mut script = dunk();
    script.step(&scene::snapshot());
    let snapshot = touching(with_ball(), Thing::Object(BALL), Thing::Object(RIM));
    assert_eq!(script.step(&snapshot).commands[1..], landing());
}

#[test]
fn arm_at_the_rim_lets_go_and_lands_too() {
    let mut script = dunk();
    script.step(&scene::snapshot());
    let snapshot = touching(with_ball(), Thing::Object(RIM), Thing::Part(0, RIGHT_HAND));
    assert_eq!(script.step(&snapshot).commands[1..], landing());
}

#[test]
fn somebody_elses_arm_at_the_rim_changes_nothing() {
    let mut script = dunk();
    script.step(&scene::snapshot());
    let snapshot = touching(with_ball(), Thing::Object(RIM), Thing::Part(1, RIGHT_HAND));
    assert_eq!(script.step(&snapshot).commands.len(), 1);
}
