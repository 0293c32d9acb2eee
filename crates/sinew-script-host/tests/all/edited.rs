//! A script on a stage whose scene is edited knows who came and who went.

use crate::stage::of;
use sinew::stage::{Effect, Scene};
use std::collections::BTreeMap;

const SCENE: &str = "format = 1
[characters.one]
controller = \"Watch\"
[controllers.Watch]
file = \"watch.py\"
";

const WATCH: &str = "class Watch:
    def step(self):
        try:
            print(round(getPosition('crate').x))
        except ValueError:
            print('none')
";

const CRATE: &str = "[props.crate]
box_m = [1, 1, 1]
fixed = true
position_m = [5, 0.5, 0]
";

#[test]
fn a_script_hears_of_what_comes_and_goes() {
    let files = [("scene.toml", SCENE), ("watch.py", WATCH)];
    let files: BTreeMap<String, Vec<u8>> =
        files.into_iter().map(|(name, text)| (name.to_owned(), text.as_bytes().to_vec())).collect();
    let mut stage = of(Scene::from_files("scene.toml", files).unwrap_or_else(|error| panic!("{error}")));
    stage.step();
    stage.edit(&format!("{SCENE}{CRATE}")).unwrap();
    stage.step();
    stage.edit(SCENE).unwrap();
    stage.step();
    let printed = |event: &sinew::stage::Event| match &event.effect {
        Effect::Printed { line } => Some(line.clone()),
        _ => None,
    };
    let lines: Vec<String> = stage.events().list().iter().filter_map(printed).collect();
    assert_eq!(lines, ["none", "5", "none"]);
}
