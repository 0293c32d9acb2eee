//! Broken and evil scenes, pose files and takes: an error in words or a sound scene, never a panic or a hang.

#![allow(clippy::unwrap_used, clippy::disallowed_methods, reason = "tests")]

#[path = "../../../../fuzz/src/stage.rs"]
mod fuzz;

use proptest::prelude::*;
use sinew_stage::{Scene, Take};
use std::path::Path;

/// The richest shipped texts.
fn text(path: &str) -> String {
    std::fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("../..").join(path)).unwrap()
}

/// A scene of one file, with most of what a scene can state.
fn scene() -> String {
    let page = text("docs/scenes.md");
    let example: String = page.split("```toml\n").skip(1).filter_map(|piece| piece.split("```").next()).collect();
    let example = example.replace("pose_files = [", "pose_files = [] # [").replace("clip = ", "# clip = ");
    let example = example.replace("file = \"controllers/kicker.py\"", "text = \"class Kicker: pass\"");
    format!("{example}\n[poses.guard]\n")
}

fn take() -> String {
    let scene = Scene::from_text(&scene()).unwrap();
    let mut take = Take::of(&scene);
    for (step, timed) in scene.at.iter().enumerate() {
        take.push(step as u64, timed.command.clone());
    }
    take.steps = 1000;
    String::from_utf8(take.to_bytes().unwrap()).unwrap()
}

/// What happens to a file on its way.
#[derive(Clone, Debug)]
enum Mutation {
    Cut(prop::sample::Index),
    Byte(prop::sample::Index, u8),
    Drop(prop::sample::Index, usize),
    Repeat(prop::sample::Index, usize),
    Insert(prop::sample::Index, &'static str),
}

fn mutation() -> impl Strategy<Value = Mutation> {
    let words = prop::sample::select(vec![
        "\n",
        "[",
        "]]",
        "{",
        "\"",
        "\"\"\"",
        ".",
        "=",
        "-",
        "nan",
        "inf",
        "1e999",
        "-0.0",
        "99999999999999999999",
        "0x7f",
        "1979-05-27",
        "true",
        "[]",
        "{}",
        "null",
        "\\u0000",
        "\u{feff}",
        "format = 1\n",
        "[characters.left]\n",
        "[[at]]\n",
    ]);
    prop_oneof![
        any::<prop::sample::Index>().prop_map(Mutation::Cut),
        (any::<prop::sample::Index>(), any::<u8>()).prop_map(|(at, byte)| Mutation::Byte(at, byte)),
        (any::<prop::sample::Index>(), 1..40usize).prop_map(|(at, count)| Mutation::Drop(at, count)),
        (any::<prop::sample::Index>(), 1..200usize).prop_map(|(at, count)| Mutation::Repeat(at, count)),
        (any::<prop::sample::Index>(), words).prop_map(|(at, word)| Mutation::Insert(at, word)),
    ]
}

fn apply(text: &str, mutations: &[Mutation]) -> Vec<u8> {
    let mut bytes = text.as_bytes().to_vec();
    for mutation in mutations {
        if bytes.is_empty() {
            break;
        }
        let end = |at: usize, count: usize| (at + count).min(bytes.len());
        match mutation {
            Mutation::Cut(at) => bytes.truncate(at.index(bytes.len())),
            Mutation::Byte(at, byte) => {
                let at = at.index(bytes.len());
                bytes[at] = *byte;
            }
            Mutation::Drop(at, count) => {
                let at = at.index(bytes.len());
                bytes.drain(at..end(at, *count));
            }
            Mutation::Repeat(at, count) => {
                let at = at.index(bytes.len());
                let piece = bytes[at..end(at, *count)].to_vec();
                bytes.splice(at..at, piece);
            }
            Mutation::Insert(at, word) => {
                let at = at.index(bytes.len());
                bytes.splice(at..at, word.bytes());
            }
        }
    }
    bytes
}

#[test]
fn the_unbroken_files_are_sound() {
    fuzz::scene(scene().as_bytes());
    Scene::from_text(&scene()).unwrap();
    Take::read(take().as_bytes()).unwrap();
    fuzz::take(take().as_bytes());
    fuzz::pose(text("scenes/poses/basic.toml").as_bytes());
}

#[test]
fn every_line_can_be_missing_or_the_last() {
    let scene = scene();
    let lines: Vec<&str> = scene.lines().collect();
    for at in 0..lines.len() {
        fuzz::scene(lines[..at].join("\n").as_bytes());
        fuzz::scene([&lines[..at], &lines[at + 1..]].concat().join("\n").as_bytes());
    }
}

#[test]
fn every_value_can_be_of_another_type() {
    let scene = scene();
    let lines: Vec<&str> = scene.lines().collect();
    for (at, line) in lines.iter().enumerate() {
        let Some((key, _)) = line.split_once(" = ") else { continue };
        for value in ["\"\"", "-1", "1e300", "nan", "[]", "{}", "[[]]", "true", "1979-05-27T07:32:00Z"] {
            let line = format!("{key} = {value}");
            fuzz::scene([&lines[..at], &[line.as_str()], &lines[at + 1..]].concat().join("\n").as_bytes());
        }
    }
}

proptest! {
    // Each case reads a whole scene, some twice.
    #![proptest_config(ProptestConfig { cases: 1500, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn mutated_scenes_are_sound_or_refused(mutations in prop::collection::vec(mutation(), 1..5)) {
        fuzz::scene(&apply(&scene(), &mutations));
    }

    #[test]
    fn mutated_pose_files_are_sound_or_refused(mutations in prop::collection::vec(mutation(), 1..5)) {
        fuzz::pose(&apply(&text("scenes/poses/basic.toml"), &mutations));
    }

    #[test]
    fn mutated_takes_are_sound_or_refused(mutations in prop::collection::vec(mutation(), 1..5)) {
        fuzz::take(&apply(&take(), &mutations));
    }

    #[test]
    fn random_bytes_are_refused(bytes in prop::collection::vec(any::<u8>(), 0..500)) {
        fuzz::scene(&bytes);
        fuzz::pose(&bytes);
        fuzz::take(&bytes);
    }
}
