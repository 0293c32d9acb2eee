//! What controllers of props sense and do.

use crate::scene::{self, error_of, step_of};
use sinew_control::Action;
use sinew_script::{Script, StartInfo};

fn prop_step(body: &str) -> sinew_script::StepOutcome {
    let source = format!("class C:\n    def step(self):\n        {}\n", body.replace('\n', "\n        "));
    let info = StartInfo { own: "Ball".to_owned(), ..scene::info(&source) };
    Script::start(scene::host(), &info).unwrap().step(&scene::snapshot())
}

#[test]
fn a_prop_pushes_itself_for_a_step_in_its_own_directions() {
    let outcome = prop_step("push(me, 10 * toWorld(me, (0, 0, 1)), at=(0, 0.1, 0))");
    assert_eq!(outcome.error, None);
    let [command] = &outcome.commands[..] else { panic!("{outcome:?}") };
    let Action::Push { on, force_n, for_secs, at_m, .. } = &command.action else { panic!("{command:?}") };
    // The ball is turned so that its z is the world's x.
    assert!((force_n[0] - 10.0).abs() < 1e-9 && force_n[1].abs() < 1e-9 && force_n[2].abs() < 1e-9, "{force_n:?}");
    assert_eq!((on.as_str(), *for_secs, *at_m), ("Ball", scene::snapshot().step_secs, Some([0.0, 0.1, 0.0])));
    assert_eq!(command.character, None);
}

#[test]
fn motors_aim_in_the_units_of_their_joints() {
    let outcome = prop_step(
        "setMotor('wheel', speed=3)\nsetMotor('wheel', place=45)\nsetMotor('drawer', place=0.2)\nsetMotor('drawer')",
    );
    let aims: Vec<_> = outcome
        .commands
        .iter()
        .map(|command| match &command.action {
            Action::Motor { speed_rad_s, angle_deg, speed_m_s, shift_m, .. } => {
                [*speed_rad_s, *angle_deg, *speed_m_s, *shift_m]
            }
            other => panic!("{other:?}"),
        })
        .collect();
    let none = [None; 4];
    assert_eq!(
        aims,
        [[Some(3.0), None, None, None], [None, Some(45.0), None, None], [None, None, None, Some(0.2)], none]
    );
}

#[test]
fn joints_are_sensed() {
    let outcome = prop_step("print(getJointPlace('wheel'), getJointSpeed('drawer'), isJointWhole('drawer'))");
    assert_eq!(outcome.printed, ["30.0 -1.0 False"]);
}

#[test]
fn gravity_fades_and_joints_are_cut() {
    let outcome = prop_step("setGravity(me, -2, over=5)\ncut('wheel')");
    let [gravity, cut] = &outcome.commands[..] else { panic!("{outcome:?}") };
    let Action::Gravity { scale, on, over_secs, for_secs, .. } = &gravity.action else { panic!("{gravity:?}") };
    assert_eq!((*scale, on.as_deref(), *over_secs, *for_secs), (-2.0, Some("Ball"), Some(5.0), None));
    assert_eq!(cut.action, Action::Cut { joint: "wheel".to_owned() });
}

#[test]
fn a_prop_watches_characters_and_steers_none() {
    let outcome =
        prop_step("print(skeleton, getPosition('left.rightHand').y)\ngetCharacter('left').setTargetPose('Landing')");
    assert_eq!(outcome.printed, ["None 1.0"]);
    let message = outcome.error.unwrap().message;
    assert!(message.contains("this script controls 'Ball'"), "{message}");
}

#[test]
fn a_characters_script_knows_its_own_name() {
    assert_eq!(step_of("print(me)").printed, ["left"]);
}

#[test]
fn mistakes_are_told() {
    assert!(error_of("setMotor('whel', speed=1)").contains("there are: wheel, drawer"));
    assert!(error_of("setMotor('wheel', speed=1, place=2)").contains("not at both"));
    assert!(error_of("push('Bal', (1, 0, 0))").contains("there are: Ball, Rim"));
    assert!(error_of("push('Ball', (1, 0, float('nan')))").contains("finite"));
}
