//! `docs/scenes.md` shows one scene, and the scene runs.

#![allow(clippy::unwrap_used, clippy::disallowed_methods, reason = "tests")]

use sinew_control::Action;
use sinew_stage::scene::{CameraSpec, CharacterSpec, DiskFiles, FileError, Files, StageSpec};
use sinew_stage::{Scene, Stage};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

fn page() -> String {
    std::fs::read_to_string(root().join("docs/scenes.md")).unwrap()
}

/// All TOML of the page, one after the other.
fn example(page: &str) -> String {
    page.split("```toml\n").skip(1).filter_map(|piece| piece.split("```").next()).collect()
}

/// The page's own files, and those of the shipped scenes.
#[derive(Debug)]
struct PageFiles(BTreeMap<String, Vec<u8>>, DiskFiles);

impl Files for PageFiles {
    fn read(&self, path: &str, most_bytes: u64) -> Result<Vec<u8>, FileError> {
        if self.0.contains_key(path) { self.0.read(path, most_bytes) } else { self.1.read(path, most_bytes) }
    }

    fn on_disk(&self, path: &str) -> Option<PathBuf> {
        self.1.on_disk(path)
    }
}

fn scene(text: String) -> Scene {
    let kicker = "class Kicker:\n    def step(self): pass\n";
    let files = [("page.toml", text), ("controllers/kicker.py", kicker.to_owned())];
    let files = files.map(|(name, text)| (name.to_owned(), text.into_bytes())).into();
    let files = PageFiles(files, DiskFiles { folder: root().join("scenes") });
    Scene::load("page.toml", Arc::new(files), &[]).unwrap()
}

#[test]
fn the_pages_example_is_a_scene_that_steps() {
    // Without the controller: Python is another crate's matter.
    let text = example(&page()).replace("controller = \"Kicker\"", "");
    let mut stage = Stage::new(scene(text), None).unwrap();
    for _ in 0..60 {
        stage.step();
    }
    assert!(stage.frame().characters[0].centre_of_mass.is_finite());
}

#[test]
fn the_defaults_that_the_page_shows_are_those_of_the_code() {
    let scene = scene(example(&page()));
    let (stage, usual) = (&scene.stage, StageSpec::default());
    assert_eq!(StageSpec { floor: usual.floor, pose_files: Vec::new(), ..stage.clone() }, usual);
    assert_eq!(stage.world_settings(), usual.world_settings(), "the floor is written out");
    // The page shows a direction; left out, what happens decides.
    assert_eq!((scene.camera.from_deg, CameraSpec::default().from_deg), (Some(60.0), None));
    let (left, usual) = (&scene.characters["left"], CharacterSpec::default());
    assert_eq!(
        CharacterSpec {
            // Those that the page says to be another, or none, when left out.
            height_m: None,
            clip: None,
            pose: None,
            source: None,
            joints: BTreeMap::new(),
            controller: None,
            reflexes: Vec::new(),
            aliases: BTreeMap::new(),
            friction: None,
            colour: None,
            kd: usual.kd.clone(),
            response: usual.response.clone(),
            ..left.clone()
        },
        usual
    );
    assert_eq!(left.response.compliance, usual.response.compliance);
    let ball = scene.props["ball"].in_world().unwrap();
    let plain = sinew_world::PropSpec::new(ball.solid.clone(), ball.motion, ball.position);
    assert_eq!((ball.surface, ball.gravity_scale, ball.is_sensor), (plain.surface, 1.0, false));
}

#[test]
fn the_page_lists_every_command() {
    // Commands that only programs give.
    let inner = ["script_killed"];
    let schema = schemars::schema_for!(Action);
    let variants = schema.get("oneOf").and_then(|variants| variants.as_array()).unwrap();
    let words: Vec<&str> =
        variants.iter().map(|variant| variant["properties"]["do"]["const"].as_str().unwrap()).collect();
    assert!(words.len() > 20);
    let page = page();
    let (_, table) = page.split_once("| `do` |").unwrap();
    for word in words.iter().filter(|word| !inner.contains(word)) {
        assert!(table.contains(&format!("`{word}`")), "{word}");
    }
}
