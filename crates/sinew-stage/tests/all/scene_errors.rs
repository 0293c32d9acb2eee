//! Scenes that are wrong say where, what and what to do.

#![allow(clippy::unwrap_used, clippy::disallowed_methods, reason = "tests")]

use sinew_stage::{Scene, SceneErrorKind};
use std::collections::BTreeMap;

/// Line by line, so that the tests can name lines.
const SOUND: &str = r##"format = 1
name = "sound"

[stage]
physics_hz = 240
floor = { friction = 0.9, bounce = 0.1 }

[characters.left]
mass_kg = 80
height_m = 1.7
position_m = [-1, 0, 0]
pose = "guard"
source = { graph = "walk", state = "a" }
controller = "Boxer"
joints.leftFoot = { frequency_hz = 3, damping_ratio = 1, carries = true }
aliases = { RightArm = "rightHand" }
colour = "#4f7cac"

[props.ball]
ball_radius_m = 0.12
mass_kg = 0.6
bounce = 0.6

[props.floorboard]
box_m = [1, 0.1, 1]
moving = true

[shapes.skis]
box_m = [0.12, 0.04, 1.2]

[controllers.Boxer]
text = """
class Boxer:
    def step(self): pass
"""

[poses.guard]
joints.leftLowerArm = [-60, 0, 0]

[graphs.walk]
start = "a"
[graphs.walk.states.a]
pose = "guard"
to = [{ state = "b", after_secs = 0.5 }]
[graphs.walk.states.b]
pose = "stand"
to = [{ state = "a", touching = ["leftFoot", "ground"] }]

[[at]]
time_secs = 1.0
character = "left"
do = "forces_off"
for_secs = 0.4

[[at]]
time_secs = 2
character = "left"
do = "attach"
link = "RightArm"
object = "ball"

[[when]]
touching = ["ball", "left.rightHand"]
character = "left"
do = "pose"
name = "stand"

[[keys]]
key = "s"
character = "left"
do = "shape"
part = "leftFoot"
shape = "skis"
"##;

fn complaint(text: &str) -> String {
    Scene::from_text(text).map(drop).expect_err("the scene is wrong").to_string()
}

/// The sound scene with a piece replaced.
fn with(piece: &str, other: &str) -> String {
    assert!(SOUND.contains(piece), "{piece:?}");
    SOUND.replacen(piece, other, 1)
}

#[test]
fn the_sound_scene_is_read_as_it_is_written() {
    let scene = Scene::from_text(SOUND).unwrap();
    assert_eq!((scene.at[0].at_secs, scene.at[0].line), (1.0, 49));
    assert_eq!((scene.at[1].at_secs, scene.at[1].line), (2.0, 55));
    assert_eq!(scene.when[0].line, 62);
    assert_eq!(scene.characters["left"].rgb(), Some([0x4f, 0x7c, 0xac]));
    assert_eq!(scene.controller_text("Boxer").unwrap().lines().count(), 2);
    assert_eq!(scene.stage.steps_per_frame(), 4);
    assert!(scene.props["ball"].in_world().is_some());
}

#[test]
fn every_fault_names_its_line_and_a_remedy() {
    let table = [
        // What is no TOML.
        ("mass_kg = 80", "mass_kg = ", "scene.toml, line 9: this is no TOML", "correct the line"),
        ("[props.ball]", "[props.ball", "line 19: this is no TOML", "correct the line"),
        // Keys.
        ("mass_kg = 80", "mass_lb = 80", "line 9: characters.left.mass_lb: unknown key", "did you mean `mass_kg`?"),
        ("[props.ball]", "[prop.ball]", "line 19: prop: unknown key", "did you mean `props`?"),
        (
            "frequency_hz = 3",
            "frequency = 3",
            "line 15: characters.left.joints.leftFoot.frequency: unknown",
            "frequency_hz",
        ),
        ("for_secs = 0.4", "for_sec = 0.4", "line 53: at.0.for_sec: unknown key", "did you mean `for_secs`?"),
        ("key = \"s\"\n", "", "line 68: keys.0: the key `key` is missing", "add it"),
        ("time_secs = 2\n", "", "line 55: at.1: the key `time_secs` is missing", "add it"),
        ("do = \"attach\"\n", "", "line 55: at.1: the key `do` is missing", "add it"),
        ("format = 1\n", "", "scene.toml: the key `format` is missing", "add it"),
        // Words.
        ("do = \"attach\"", "do = \"atach\"", "line 55: at.1: `atach` is not known here", "did you mean `attach`?"),
        // Types.
        (
            "mass_kg = 80",
            "mass_kg = \"80 kg\"",
            "line 9: characters.left.mass_kg: this is string \"80 kg\"",
            "a number",
        ),
        ("[-1, 0, 0]", "[-1, 0]", "line 11: characters.left.position_m", "3"),
        ("time_secs = 2\n", "time_secs = \"2\"\n", "line 55: at.1", "for `time_secs`"),
        ("{ friction = 0.9, bounce = 0.1 }", "\"no\"", "line 6: stage.floor: expected `false`", "bounce = 0.0"),
        // Numbers.
        (
            "height_m = 1.7",
            "height_m = 170",
            "line 10: characters.left.height_m: 170 is out of range 0.2 to 10",
            "not centimetres",
        ),
        ("height_m = 1.7", "height_m = nan", "line 10: characters.left.height_m: NaN is no finite number", "write one"),
        (
            "position_m = [-1, 0, 0]",
            "position_m = [-1, inf, 0]",
            "line 11: characters.left.position_m: inf is",
            "write one",
        ),
        ("mass_kg = 0.6", "mass_kg = 0", "line 21: props.ball.mass_kg: 0 is out of range", "kilograms"),
        (
            "physics_hz = 240",
            "physics_hz = 250",
            "line 5: stage.physics_hz: 250 is no multiple of motion_hz = 60",
            "240",
        ),
        ("physics_hz = 240", "physics_hz = -1", "line 5: stage.physics_hz", "whole number"),
        ("time_secs = 1.0", "time_secs = -1", "line 50: at.0.time_secs: -1 is out of range", "seconds"),
        ("for_secs = 0.4", "for_secs = 1e9", "line 49: at.0: do = \"forces_off\": for_secs = 1000000000", "0 to 3600"),
        ("bounce = 0.6", "bounce = 6", "line 22: props.ball.bounce: 6 is out of range 0 to 1", "loses nothing"),
        ("ball_radius_m = 0.12", "ball_radius_m = 12000", "line 20: props.ball.ball_radius_m", "metres"),
        ("#4f7cac", "blue", "line 17: characters.left.colour: `blue` is no colour", "#rrggbb"),
        ("format = 1", "format = 2", "line 1: format: format 2 is newer", "update Sinew"),
        ("[-60, 0, 0]", "[-60, 0, 1e4]", "line 38: poses.guard.joints.leftLowerArm", "-360 to 360"),
        // Shapes and motions that contradict themselves.
        ("mass_kg = 0.6\n", "", "line 19: props.ball: nothing says how it moves", "fixed = true"),
        (
            "moving = true",
            "moving = true\nfixed = true",
            "line 26: props.floorboard.moving: it is fixed already",
            "keep one",
        ),
        ("ball_radius_m = 0.12", "", "line 19: props.ball: it has no shape", "ball_radius_m"),
        (
            "bounce = 0.6",
            "box_m = [1, 1, 1]",
            "line 20: props.ball.ball_radius_m: `box_m` is stated already",
            "keep one",
        ),
        (
            "graph = \"walk\", state = \"a\"",
            "state = \"a\"",
            "line 13: characters.left.source: it states no source",
            "write one of pose, graph",
        ),
        (
            "graph = \"walk\", state = \"a\"",
            "pose = \"guard\", graph = \"walk\"",
            "line 13: characters.left.source: pose and graph are stated",
            "keep one",
        ),
        ("text = \"\"\"", "class = \"1x\"\ntext = \"\"\"", "line 32: controllers.Boxer.class", "class ="),
        // Names.
        (
            "pose = \"guard\"\nsource",
            "pose = \"gard\"\nsource",
            "line 12: characters.left.pose: no pose `gard`",
            "did you mean `guard`?",
        ),
        (
            "controller = \"Boxer\"",
            "controller = \"Baxer\"",
            "line 14: characters.left.controller: no controller",
            "`Boxer`?",
        ),
        ("graph = \"walk\"", "graph = \"run\"", "line 13: characters.left.source.graph: no graph `run`", "known: walk"),
        ("state = \"a\" }", "state = \"z\" }", "line 13: characters.left.source.state: no state `z`", "known: a, b"),
        ("joints.leftFoot", "joints.leftFot", "line 15: characters.left.joints.leftFot: no part", "`leftFoot`?"),
        (
            "joints.leftFoot",
            "joints.hips",
            "line 15: characters.left.joints.hips: the hips have no joint",
            "another part",
        ),
        ("\"rightHand\" }", "\"rightHnd\" }", "line 16: characters.left.aliases.RightArm: no part", "`rightHand`?"),
        ("object = \"ball\"", "object = \"bell\"", "line 55: at.1: do = \"attach\": no object", "did you mean `ball`?"),
        ("link = \"RightArm\"", "link = \"RightArn\"", "line 55: at.1: do = \"attach\": no part", "RightArm"),
        (
            "left.rightHand\"",
            "left.rihtHand\"",
            "line 63: when.0.touching: no part or alias `rihtHand`",
            "`rightHand`?",
        ),
        ("[\"ball\", \"left", "[\"bal\", \"left", "line 63: when.0.touching: no object, character", "`ball`?"),
        ("shape = \"skis\"", "shape = \"sky\"", "line 68: keys.0: do = \"shape\": no shape `sky`", "skis"),
        (
            "character = \"left\"\ndo = \"forces",
            "character = \"lft\"\ndo = \"forces",
            "line 49: at.0: do = \"forces_off\": no character `lft`",
            "`left`?",
        ),
        (
            "character = \"left\"\ndo = \"forces",
            "do = \"forces",
            "line 49: at.0: do = \"forces_off\": it is for a character",
            "character = \"left\"",
        ),
        ("start = \"a\"", "start = \"x\"", "line 41: graphs.walk.start: no state `x`", "known: a, b"),
        ("pose = \"guard\"\nto", "pose = \"gard\"\nto", "line 43: graphs.walk.states.a.pose: no pose", "`guard`?"),
        ("{ state = \"b\"", "{ state = \"c\"", "line 44: graphs.walk.states.a.to.0.state: no state `c`", "known: a, b"),
        ("[\"leftFoot\", \"gr", "[\"leftFot\", \"gr", "line 47: graphs.walk.states.b.to.0.touching: no part", "known"),
        ("[props.ball]", "[props.ground]", "line 19: props.ground: `ground` is the floor's own name", "choose another"),
        ("[props.floorboard]", "[props.left]", "line 8: characters.left: a prop has this name too", "rename"),
        ("[shapes.skis]", "[shapes.own]", "line 28: shapes.own: the command `shape`", "choose another"),
        ("[props.ball]", "[props.\"a.b\"]", "line 19: props.a.b: a name holds no `.`", "choose another"),
    ];
    let mut wrong = Vec::new();
    for (piece, other, problem, remedy) in table {
        let said = complaint(&with(piece, other));
        if !(said.contains(problem) && said.contains(remedy)) {
            wrong.push(format!("{piece:?} to {other:?}: {said}\n  lacks {problem:?} or {remedy:?}"));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn a_fault_in_a_pose_file_names_that_file() {
    let scene = "format = 1\n[stage]\npose_files = [\"poses/a.toml\"]\n[characters.one]\npose = \"up\"\n";
    let read = |poses: &str| {
        let files = [("scene.toml", scene), ("poses/a.toml", poses)];
        Scene::from_files("scene.toml", files.map(|(name, text)| (name.to_owned(), text.as_bytes().to_vec())).into())
    };
    assert!(read("[poses.up]\n").is_ok());
    let table = [
        ("[poses.up]\ngain = -1\n", "poses/a.toml, line 2: poses.up.gain: a gain", "0 to 1000"),
        (
            "[poses.up]\n[graphs.g]\nstart = \"q\"\nstates = {}\n",
            "poses/a.toml, line 3: graphs.g.start: no state `q`",
            "none",
        ),
        ("[poses.up]\n[pose.down]\n", "poses/a.toml, line 2: pose: unknown key", "did you mean `poses`?"),
        ("format = 3\n[poses.up]\n", "poses/a.toml, line 1: format: 3 is no known version", "format = 1"),
        ("[poses.up\n", "poses/a.toml, line 1: this is no TOML", "correct the line"),
        ("poses = 3\n", "poses/a.toml, line 1: poses: expected tables", "[poses.NAME]"),
        ("[poses.down]\n", "scene.toml, line 5: characters.one.pose: no pose `up`", "known: down, stand"),
    ];
    for (poses, problem, remedy) in table {
        let said = read(poses).map(drop).expect_err(poses).to_string();
        assert!(said.contains(problem) && said.contains(remedy), "{poses:?}: {said}");
    }
}

#[test]
fn a_name_that_two_files_give_is_refused() {
    let scene = "format = 1\n[stage]\npose_files = [\"a.toml\", \"b.toml\"]\n";
    let files = [("scene.toml", scene), ("a.toml", "[poses.up]\n"), ("b.toml", "\n[poses.up]\n")];
    let files = files.map(|(name, text)| (name.to_owned(), text.as_bytes().to_vec()));
    let said = Scene::from_files("scene.toml", files.into()).unwrap_err().to_string();
    assert_eq!(
        said,
        "b.toml, line 2: poses.up: another file or the scene has this name already; rename one of the two"
    );
}

#[test]
fn files_are_named_relative_to_the_scene() {
    let clip = |path: &str| complaint(&format!("format = 1\n[characters.one]\nclip = '{path}'\n"));
    for path in ["/etc/passwd", "C:\\walk.bvh", "c:walk.bvh", "a\\b.bvh", "file:///walk.bvh", ""] {
        let said = clip(path);
        assert!(said.starts_with("scene.toml, line 3: characters.one.clip"), "{said}");
        assert!(said.contains("relative to the scene's folder"), "{said}");
    }
    assert!(clip("../samples/walk.bvh").contains("there is no such file"));
}

#[test]
fn a_file_of_another_kind_is_not_taken_in() {
    // A take holds copies of a scene's files; a stranger's scene must not make it hold a key.
    let table = [
        ("[characters.one]\nclip = \"../.ssh/id_rsa\"\n", "characters.one.clip", ".bvh, .glb, .gltf, .fbx"),
        ("[characters.one]\nsource.clip = \"walk.amc\"\n", "characters.one.source.clip", "`sinew convert`"),
        ("[controllers.One]\nfile = \"notes.txt\"\n", "controllers.One.file", "ends in .py"),
        ("[stage]\npose_files = [\"poses\"]\n", "stage.pose_files", "ends in .toml"),
    ];
    for (text, path, remedy) in table {
        let said = complaint(&format!("format = 1\n{text}"));
        assert!(said.starts_with(&format!("scene.toml, line 3: {path}: ")) && said.contains(remedy), "{said}");
    }
}

#[test]
fn what_is_read_has_limits() {
    let many = |count: usize| {
        let props: String = (0..count).map(|at| format!("[props.p{at}]\nball_radius_m = 1\nfixed = true\n")).collect();
        format!("format = 1\n{props}")
    };
    assert!(Scene::from_text(&many(1000)).is_ok());
    assert!(complaint(&many(1001)).contains("props: 1001 are more than the 1000 allowed; leave some out"));
    let large = format!("format = 1\n# {}\n", "x".repeat(4 << 20));
    assert!(complaint(&large).contains("larger than the 4194304 bytes allowed"));
    let deep = format!("format = 1\na = {}{}\n", "[".repeat(100_000), "]".repeat(100_000));
    assert!(complaint(&deep).contains("no TOML"));
    let deep = format!("format = 1\n{} = 1\n", vec!["a"; 100_000].join("."));
    assert!(complaint(&deep).contains("no TOML"));
    let heavy = format!("format = 1\na = [{}]\n", "{a=1},".repeat(150_000));
    assert!(complaint(&heavy).contains("state too many values; leave some out"));
    let entry = |at: usize| format!("[characters.c{at}]\n[poses.a{at}]\n[poses.b{at}]\n[poses.c{at}]\n");
    let crowd: String = (0..200).map(entry).collect();
    assert!(complaint(&format!("format = 1\n{crowd}")).contains("200 characters with 600 poses and 0 states"));
    let long = format!("format = 1\n{} = 1\n", "a".repeat(1 << 20));
    // A name of a mebibyte does not make a message of one.
    assert!(complaint(&long).len() < 1000);
    let not_text = BTreeMap::from([("scene.toml".to_owned(), vec![0xff, 0xfe, 0x00])]);
    assert!(Scene::from_files("scene.toml", not_text).unwrap_err().to_string().contains("save it as UTF-8"));
}

#[test]
fn pose_files_together_have_a_limit() {
    let names: Vec<String> = (0..4).map(|at| format!("p{at}.toml")).collect();
    let scene = format!("format = 1\n[stage]\npose_files = {names:?}\n");
    let mut files: BTreeMap<String, Vec<u8>> =
        names.iter().map(|name| (name.clone(), format!("# {}\n", "x".repeat(3 << 20)).into_bytes())).collect();
    files.insert("scene.toml".to_owned(), scene.into_bytes());
    let said = Scene::from_files("scene.toml", files).unwrap_err().to_string();
    assert!(said.contains("line 3: stage.pose_files: `p2.toml`: the file is larger than"), "{said}");
}

#[test]
fn only_what_is_a_file_is_read() {
    let folder = tempfile::tempdir().unwrap();
    let said = Scene::read(folder.path()).unwrap_err().to_string();
    assert!(said.contains("this is no file"), "{said}");
    let said = Scene::read(&folder.path().join("none.toml")).unwrap_err().to_string();
    assert!(said.contains("there is no such file"), "{said}");
    assert!(Scene::read("..".as_ref()).unwrap_err().to_string().contains("names no file"));
    // A device never ends.
    #[cfg(unix)]
    assert!(Scene::read("/dev/zero".as_ref()).unwrap_err().to_string().contains("this is no file"));
}

#[test]
fn every_fault_has_a_kind_that_a_program_can_match() {
    use SceneErrorKind as Kind;
    let kind = |text: &str| Scene::from_text(text).map(drop).expect_err("the scene is wrong").kind;
    let table = [
        ("mass_kg = 80", "mass_kg = ", Kind::Unreadable),
        ("mass_kg = 80", "mass_lb = 80", Kind::Malformed),
        ("mass_kg = 80", "mass_kg = \"80 kg\"", Kind::Malformed),
        ("format = 1\n", "", Kind::Malformed),
        ("format = 1", "format = 2", Kind::WrongVersion),
        ("height_m = 1.7", "height_m = 170", Kind::OutOfRange),
        ("height_m = 1.7", "height_m = nan", Kind::OutOfRange),
        ("for_secs = 0.4", "for_secs = 1e9", Kind::OutOfRange),
        ("pose = \"guard\"\nsource", "pose = \"gard\"\nsource", Kind::NotFound),
        ("object = \"ball\"", "object = \"bell\"", Kind::NotFound),
        ("pose = \"guard\"\nsource", "clip = \"walk.bvh\"\nsource", Kind::NotFound),
        ("mass_kg = 0.6\n", "", Kind::Invalid),
    ];
    for (piece, other, expected) in table {
        assert_eq!(kind(&with(piece, other)), expected, "{piece:?} to {other:?}");
    }
    let many: String = (0..1001).map(|at| format!("[props.p{at}]\nball_radius_m = 1\nfixed = true\n")).collect();
    assert_eq!(kind(&format!("format = 1\n{many}")), Kind::TooLarge);
}
