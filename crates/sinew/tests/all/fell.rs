//! Who falls is told, when, and who does not is not said to fall.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use super::ran::play;
use sinew::jobs::run::{RunJob, run};
use sinew::stage::Scene;

#[test]
fn of_two_who_are_hit_the_one_who_goes_down_fell() {
    let ran = play("block", &[]);
    let report = &ran.report.characters;
    let fell = report["left"].fell_at_s.unwrap();
    // Its picture shows the chest on the ground at 1.10 s.
    assert!((1.0..1.2).contains(&fell), "{fell} s");
    assert!(report["left"].ending().starts_with("fell at 1."), "{}", report["left"].ending());
    assert_eq!(report["right"].fell_at_s, None);
}

#[test]
fn who_sits_squats_or_reaches_low_does_not_fall() {
    for name in ["sit_on_box", "reach_f_squat", "pick_up"] {
        for (who, character) in &play(name, &[]).report.characters {
            assert_eq!(character.fell_at_s, None, "{name}: {who}");
        }
    }
}

#[test]
fn a_body_that_is_shown_without_physics_is_not_in_the_air() {
    let text = "format = 1\n[characters.one]\npose = \"stand\"\ntracker = \"kinematic\"\n";
    let job = RunJob { for_secs: Some(0.1), ..RunJob::default() };
    let ran = run(Scene::from_text(text).unwrap(), &job, &mut []).unwrap();
    assert!(!ran.report.characters["one"].ending().contains("in the air"), "{}", ran.report.characters["one"].ending());
}
