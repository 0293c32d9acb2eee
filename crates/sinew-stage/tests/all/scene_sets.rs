//! Values that are changed from outside, as `--set PATH=VALUE` does.

#![allow(clippy::unwrap_used, clippy::disallowed_methods, reason = "tests")]

use sinew_control::tracker::TrackerKind;
use sinew_stage::Scene;

const SCENE: &str = "format = 1\n[stage]\npose_files = [\"a.toml\"]\n[characters.left]\nmass_kg = 80\n[characters.right]\n[[at]]\ntime_secs = 1\n\
                     do = \"say\"\ntext = \"now\"\n[[at]]\ntime_secs = 2\ndo = \"say\"\ntext = \"then\"\n";

fn scene() -> Scene {
    let files = [("scene.toml", SCENE), ("a.toml", "[poses.up]\ngain = 2\n"), ("b.toml", "[poses.down]\n")];
    let files = files.map(|(name, text)| (name.to_owned(), text.as_bytes().to_vec()));
    Scene::from_files("scene.toml", files.into()).unwrap()
}

#[test]
fn a_value_is_changed_added_or_replaced_by_its_path() {
    let mut scene = scene();
    scene.set("characters.left.mass_kg", "70.5").unwrap();
    scene.set("characters.left.joints.leftFoot.frequency_hz", "4").unwrap();
    scene.set("characters.left.position_m", "[1, 2, 3]").unwrap();
    scene.set("camera.from_deg", "10").unwrap();
    scene.set("at.1.time_secs", "3").unwrap();
    // A word needs no quotes, as a shell takes them away.
    scene.set("characters.right.tracker", "kinematic").unwrap();
    scene.set("characters.left.pose", "\"up\"").unwrap();
    let left = &scene.characters["left"];
    assert_eq!((left.mass_kg, left.position_m), (70.5, [1.0, 2.0, 3.0]));
    assert_eq!(left.joints["leftFoot"].frequency_hz, Some(4.0));
    assert_eq!((scene.characters["right"].tracker, left.pose.as_deref()), (TrackerKind::Kinematic, Some("up")));
    assert_eq!((scene.camera.from_deg, scene.at[1].at_secs), (Some(10.0), 3.0));
    assert_eq!(scene.sets().len(), 7);
}

#[test]
fn what_a_pose_file_states_can_be_changed_and_so_can_the_list_of_pose_files() {
    let mut scene = scene();
    scene.set("poses.up.gain", "5").unwrap();
    assert_eq!(scene.poses["up"].gain, Some(5.0));
    scene.set("stage.pose_files", "[\"a.toml\", \"b.toml\"]").unwrap();
    assert!(scene.poses.contains_key("down"));
    assert_eq!(scene.poses["up"].gain, Some(5.0), "an earlier change stays");
}

#[test]
fn a_wrong_change_is_refused_and_leaves_the_scene_as_it_was() {
    let table = [
        ("characters.lft.mass_kg", "70", "there is no `lft` in characters", "did you mean `left`?"),
        ("characters.lft", "{}", "there is no `lft` in characters", "did you mean `left`?"),
        ("character.left.mass_kg", "70", "unknown key", "did you mean `characters`?"),
        ("characters.left.mas_kg", "70", "characters.left.mas_kg: unknown key", "did you mean `mass_kg`?"),
        ("characters.left.mass_kg", "7000", "7000 is out of range", "it was set to 7000 from outside"),
        ("characters.left.mass_kg", "heavy", "this is string \"heavy\", expected a number", "it was set to heavy"),
        ("characters.left.mass_kg", "nan", "no finite number", "it was set to nan"),
        ("characters.left.mass_kg.x", "1", "characters.left.mass_kg: this is no table", "set it as a whole"),
        ("at.2.time_secs", "1", "at: `2` is none of its 2 entries", "counted from 0"),
        ("at.x", "1", "at: `x` is none of its 2 entries", "counted from 0"),
        ("poses.up.gain", "-1", "a.toml: poses.up.gain", "it was set to -1"),
        ("characters..left", "1", "write a path such as", "characters.left.pose_gain"),
        ("", "1", "write a path such as", "characters.left.pose_gain"),
        ("format", "7", "format 7 is newer", "it was set to 7"),
        ("characters.left.clip", "c.bvh", "characters.left.clip: `c.bvh`: there is no such file", "add the file"),
    ];
    for (path, value, problem, remedy) in table {
        let mut scene = scene();
        let before = format!("{scene:?}");
        let said = scene.set(path, value).expect_err(path).to_string();
        assert!(said.contains(problem) && said.contains(remedy), "{path}={value}: {said}");
        assert_eq!(format!("{scene:?}"), before);
    }
    let deep = vec!["a"; 1000].join(".");
    assert!(scene().set(&deep, "1").is_err());
}
