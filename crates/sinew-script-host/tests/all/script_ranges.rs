//! Scripts pass the door that scenes and commands pass.

use crate::stage::of;
use sinew::control::OrderErrorKind;
use sinew::stage::{Cause, Effect, Scene};
use std::collections::BTreeMap;

const SCENE: &str = "format = 1\n[characters.one]\ncontroller = \"Limp\"\n[controllers.Limp]\nfile = \"limp.py\"\n";

const LIMP: &str = "class Limp:\n    def step(self):\n        skeleton.setGain(1e30)\n";

#[test]
fn a_script_that_states_an_absurd_gain_is_refused_and_the_joints_hold() {
    let files = [("scene.toml", SCENE), ("limp.py", LIMP)];
    let files: BTreeMap<String, Vec<u8>> =
        files.into_iter().map(|(name, text)| (name.to_owned(), text.as_bytes().to_vec())).collect();
    let mut stage = of(Scene::from_files("scene.toml", files).unwrap_or_else(|error| panic!("{error}")));
    stage.step();
    let event = &stage.events().list()[0];
    assert_eq!(event.cause, Cause::Script { controller: "Limp".to_owned() });
    let Effect::Refused(error) = &event.effect else { panic!("it is refused: {}", event.effect) };
    assert_eq!(error.kind(), OrderErrorKind::OutOfRange);
    let one = stage.cast().character("one").unwrap();
    assert_eq!(stage.state_of(one).unwrap().gain(None), 1.0);
}
