//! Takes come back as they were written, or say what is wrong with them.

#![allow(clippy::unwrap_used, clippy::disallowed_methods, reason = "tests")]

use sinew_control::{Action, Command};
use sinew_stage::take::{HashTrace, TakeErrorKind};
use sinew_stage::{Scene, Take, TakeError};
use std::collections::BTreeMap;
use std::path::Path;

const SCENE: &str = "format = 1\n[stage]\npose_files = [\"a.toml\"]\n[characters.left]\nclip = \"../clips/w.glb\"\n\
                     controller = \"Boxer\"\n[controllers.Boxer]\nfile = \"boxer.py\"\n";

fn files() -> BTreeMap<String, Vec<u8>> {
    let files = [
        ("scene.toml", SCENE.as_bytes()),
        ("a.toml", b"[poses.up]\r\n# \xc3\xa4 \\ \"\n".as_slice()),
        ("boxer.py", b"class Boxer:\n\tdef step(self): pass\n"),
        ("../clips/w.glb", &[0x67, 0x6c, 0, 0xff, 0xfe]),
    ];
    files.map(|(name, bytes)| (name.to_owned(), bytes.to_vec())).into()
}

fn scene() -> Scene {
    Scene::from_files("scene.toml", files()).unwrap()
}

fn take() -> Take {
    let mut scene = scene();
    scene.set("characters.left.pose_gain", "2").unwrap();
    let mut take = Take::of(&scene);
    let force_n = [0.1, -1e-300, 1.0 / 3.0];
    take.push(0, Command::to("left", Action::PlaneOff {}));
    take.push(
        7,
        Command::to("left", Action::Push { on: "head".to_owned(), force_n, for_secs: 0.1, facing: true, at_m: None }),
    );
    take.push(7, Command::stage(Action::Say { text: "line\nbreak \u{2028} \"\\".to_owned() }));
    take.steps = 480;
    take.hash = 0xfedc_ba98_7654_3210;
    take.trace = Some(HashTrace { every_steps: 240, hashes: vec![1, u64::MAX] });
    take
}

fn text() -> String {
    String::from_utf8(take().to_bytes().unwrap()).unwrap()
}

fn complaint(text: &str) -> String {
    Take::read(text.as_bytes()).map(drop).expect_err("the take is wrong").to_string()
}

#[test]
fn a_take_comes_back_with_every_bit_and_so_does_its_scene() {
    let take = take();
    let again = Take::read(&take.to_bytes().unwrap()).unwrap();
    assert_eq!(again, take);
    let scene = again.to_scene(None).unwrap();
    assert_eq!(scene.characters["left"].pose_gain, 2.0);
    let held: BTreeMap<String, Vec<u8>> =
        scene.files().iter().map(|(path, file)| (path.clone(), file.bytes.to_vec())).collect();
    assert_eq!(held, files());
}

#[test]
fn a_take_is_a_line_for_each_thing() {
    // Header, four files, three commands, end.
    assert_eq!(text().lines().count(), 1 + 4 + 3 + 1);
}

#[test]
fn a_value_can_be_changed_before_a_replay() {
    let mut scene = take().to_scene(None).unwrap();
    scene.set("characters.left.pose_gain", "3").unwrap();
    assert_eq!(scene.characters["left"].pose_gain, 3.0);
    let said = scene.set("controllers.Boxer.file", "other.py").unwrap_err().to_string();
    assert!(said.contains("the take was recorded without this file"), "{said}");
}

#[test]
fn wrong_takes_say_line_and_remedy() {
    let header_end = text().find('\n').unwrap();
    let table = [
        ("\"sinew\":\"take\"", "\"sinew\":\"tape\"", "line 1 of the take: this is no take", "Take::write"),
        ("\"format\":1", "\"format\":2", "format 2 (written by Sinew", "update Sinew"),
        ("\"format\":1", "\"format\":0", "format 0 (written by Sinew", "record it again"),
        ("\"seed\":1", "\"seed\":-1", "line 1", "record it again"),
        ("\"seed\":1", "\"seed\":1,\"x\":1", "line 1 of the take: unknown field `x`", "record it again"),
        ("\"scene\":\"scene.toml\"", "\"scene\":\"s.toml\"", "the scene \"s.toml\" is none of", "files"),
        ("pose_files", "pose_flies", "\"scene.toml\" is not the file that was recorded", "record it again"),
        ("../clips/w.glb\",\"hash\":\"", "../clips/w.glb\",\"hash\":\"g", "not 16 hexadecimal digits", "record"),
        ("\"file\":\"a.toml\"", "\"file\":\"/a.toml\"", "absolute path", "relative"),
        ("\"file\":\"a.toml\"", "\"file\":\"../clips/w.glb\"", "this file stands here twice", "remove one"),
        ("\"base64\":\"", "\"base64\":\"*", "base64 is broken", "record it again"),
        ("\"step\":0", "\"step\":9", "step 7 stands after a later one", "in order"),
        ("\"step\":0", "\"step\":-1", "line 6", "record it again"),
        (
            "\"do\":\"plane_off\"",
            "\"do\":\"plane_of\"",
            "line 6 of the take: unknown variant `plane_of`",
            "record it again",
        ),
        ("\"do\":\"plane_off\"", "\"do\":\"plane_off\",\"x\":1", "line 6 of the take: unknown field `x`", "record"),
        ("\"steps\":480", "\"steps\":479", "more hashes than steps", "record it again"),
        ("\"every_steps\":240,", "", "hashes have no every_steps", "record it again"),
        ("\"every_steps\":240", "\"every_steps\":0", "every_steps is 0", "at least 1"),
        ("\"hash\":\"fedc", "\"hash\":\"FEDC", "not 16 hexadecimal digits", "record it again"),
    ];
    let text = text();
    for (piece, other, problem, remedy) in table {
        assert!(text.contains(piece), "{piece}");
        let said = complaint(&text.replacen(piece, other, 1));
        assert!(said.contains(problem) && said.contains(remedy), "{piece} to {other}: {said}");
    }
    assert!(complaint(&text[header_end + 1..]).contains("line 1 of the take: this is no take"));
    assert!(complaint("").contains("cut off"));
    assert!(complaint("{}\n").contains("this is no take"));
    assert!(complaint(&format!("{text}{{\"step\":480}}\n")).contains("nothing may follow the end"));
    let deep = format!("{}{}{}\n", &text[..=header_end], "[".repeat(100_000), "]".repeat(100_000));
    assert!(complaint(&deep).starts_with("line 2 of the take"));
}

#[test]
fn a_take_that_was_cut_off_is_named_so_at_every_byte() {
    let text = text();
    for end in 0..text.len() {
        let said = Take::read(&text.as_bytes()[..end]).map(drop).expect_err("cut").to_string();
        assert!(said.contains("cut off"), "{end}: {said}");
    }
}

#[test]
fn a_command_that_could_not_be_read_again_is_not_written() {
    let mut take = take();
    take.push(8, Command::to("left", Action::Gain { factor: f64::NAN, part: None }));
    let TakeError { kind: TakeErrorKind::NotFinite, line: None, problem: said } = take.to_bytes().unwrap_err() else {
        panic!("concerns the whole take")
    };
    assert!(said.contains("step 8") && said.contains("not finite"), "{said}");
}

#[test]
fn a_file_is_written_whole_or_not_at_all() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.take");
    take().write(&path).unwrap();
    assert_eq!(Take::open(&path).unwrap(), take());
    assert_eq!(std::fs::read_dir(&folder).unwrap().count(), 1, "nothing is left beside it");
    assert!(take().write(&folder.path().join("none").join("a.take")).is_err());
    assert!(Take::open(folder.path()).unwrap_err().to_string().contains("this is no file"));
}

#[test]
fn a_large_file_is_known_by_its_hash_and_read_from_its_place() {
    let folder = tempfile::tempdir().unwrap();
    let scene_file = folder.path().join("scene.toml");
    std::fs::write(&scene_file, "format = 1\n[characters.one]\nclip = \"large.bvh\"\n").unwrap();
    let clip = folder.path().join("large.bvh");
    // Above the 4 MiB that a take holds.
    std::fs::write(&clip, vec![b'x'; (4 << 20) + 1]).unwrap();
    let take = Take::of(&Scene::read(&scene_file).unwrap());
    let bytes = take.to_bytes().unwrap();
    assert!(bytes.len() < 10_000);
    let again = Take::read(&bytes).unwrap();
    let said = again.to_scene(None).unwrap_err().to_string();
    assert!(said.contains("give the scene's folder"), "{said}");
    assert_eq!(again.to_scene(Some(folder.path())).unwrap().on_disk("large.bvh").as_deref(), Some(clip.as_path()));
    std::fs::write(&clip, vec![b'y'; (4 << 20) + 1]).unwrap();
    let said = again.to_scene(Some(folder.path())).unwrap_err().to_string();
    assert!(said.contains("is not the file that the take was recorded with"), "{said}");
}

#[test]
fn every_saved_version_still_reads() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/takes");
    let newest = folder.join(format!("v{}.take", sinew_stage::take::TAKE_FORMAT));
    if std::env::var_os("SAVE_TAKE").is_some() && !newest.exists() {
        take().write(&newest).unwrap();
    }
    let mut versions = 0;
    for entry in std::fs::read_dir(folder).unwrap() {
        let take = Take::open(&entry.unwrap().path()).unwrap();
        take.to_scene(None).unwrap();
        assert!(!take.commands.is_empty() && take.steps > 0);
        versions += 1;
    }
    assert_eq!(versions, sinew_stage::take::TAKE_FORMAT, "one saved take for each version of the format");
}

#[test]
fn every_wrong_take_has_a_kind_that_a_program_can_match() {
    use TakeErrorKind as Kind;
    let text = text();
    let kind = |text: &str| Take::read(text.as_bytes()).map(drop).expect_err("the take is wrong").kind;
    let table = [
        ("\"sinew\":\"take\"", "\"sinew\":\"tape\"", Kind::NotATake),
        ("\"format\":1", "\"format\":2", Kind::WrongVersion),
        ("\"step\":0", "\"step\":9", Kind::Malformed),
    ];
    for (piece, other, expected) in table {
        assert_eq!(kind(&text.replacen(piece, other, 1)), expected, "{piece} to {other}");
    }
    assert_eq!(kind(text.trim_end()), Kind::Incomplete);
    assert_eq!(Take::open(Path::new("no_such.take")).unwrap_err().kind, Kind::Unreadable);
}
