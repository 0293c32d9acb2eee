//! Which animation, which person, which joint: files with several of each.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use crate::binary_support::{floats, glb};
use sinew_motion::formats::{Document, MotionFile, ReadOptions, gltf};
use sinew_motion::{Humanoid, Limits, Origin, Part, Side};
use std::fmt::Write;

/// Name, parent and offset \[m\] of a joint.
type Bone = (String, Option<usize>, [f64; 3]);

/// Joints of a body: name without side, parent, offset \[m\]; `@` stands for the side, which mirrors X.
const BODY: [(&str, &str, [f64; 3]); 14] = [
    ("Hips", "", [0.0, 0.9, 0.0]),
    ("Spine", "Hips", [0.0, 0.1, 0.0]),
    ("Chest", "Spine", [0.0, 0.2, 0.0]),
    ("Neck", "Chest", [0.0, 0.25, 0.0]),
    ("Head", "Neck", [0.0, 0.1, 0.0]),
    ("@UpLeg", "Hips", [0.1, 0.0, 0.0]),
    ("@Leg", "@UpLeg", [0.0, -0.42, 0.0]),
    ("@Foot", "@Leg", [0.0, -0.4, 0.0]),
    ("@Toe", "@Foot", [0.0, -0.05, 0.12]),
    ("@Shoulder", "Chest", [0.05, 0.2, 0.0]),
    ("@Arm", "@Shoulder", [0.12, 0.0, 0.0]),
    ("@ForeArm", "@Arm", [0.28, 0.0, 0.0]),
    ("@Hand", "@ForeArm", [0.25, 0.0, 0.0]),
    ("@Finger", "@Hand", [0.1, 0.0, 0.0]),
];

/// A body as joints: name, index of the parent, offset. `called` gives each its name in the file, `skips` leaves joints out.
fn body(called: impl Fn(&str, Option<Side>) -> String, skips: &[&str]) -> Vec<Bone> {
    let mut keys: Vec<String> = Vec::new();
    let mut joints = Vec::new();
    for side in [Some(Side::Left), Some(Side::Right)] {
        for (name, parent, [x, y, z]) in BODY {
            let sided = name.starts_with('@');
            let text = |name: &str| name.replace('@', if side == Some(Side::Left) { "Left" } else { "Right" });
            if (!sided && side == Some(Side::Right)) || skips.contains(&text(name).as_str()) {
                continue;
            }
            let parent = keys.iter().position(|key| *key == text(parent));
            let x = if sided && side == Some(Side::Right) { -x } else { x };
            keys.push(text(name));
            joints.push((called(name.trim_start_matches('@'), side.filter(|_| sided)), parent, [x, y, z]));
        }
    }
    joints
}

/// The same as BVH trees, one for each body; every body travels by this much along Z, in three frames.
fn bvh(bodies: &[Vec<Bone>], travel: f64) -> String {
    fn write(text: &mut String, joints: &[Bone], at: usize) {
        let (name, parent, [x, y, z]) = &joints[at];
        let (word, channels) = match parent {
            None => ("ROOT", "6 Xposition Yposition Zposition Zrotation Xrotation Yrotation"),
            Some(_) => ("JOINT", "3 Zrotation Xrotation Yrotation"),
        };
        writeln!(text, "{word} {name}\n{{\nOFFSET {x} {y} {z}\nCHANNELS {channels}").unwrap();
        let children: Vec<usize> = (0..joints.len()).filter(|&child| joints[child].1 == Some(at)).collect();
        children.iter().for_each(|&child| write(text, joints, child));
        if children.is_empty() {
            text.push_str("End Site\n{\nOFFSET 0 0.01 0\n}\n");
        }
        text.push_str("}\n");
    }
    let mut text = "HIERARCHY\n".to_owned();
    bodies.iter().for_each(|body| write(&mut text, body, 0));
    text.push_str("MOTION\nFrames: 3\nFrame Time: 0.033333\n");
    for frame in 0..3 {
        for body in bodies {
            write!(text, "0 0.9 {} ", travel * f64::from(frame)).unwrap();
            text.push_str(&"0 ".repeat(3 * body.len()));
        }
        text.push('\n');
    }
    text
}

fn english(name: &str, side: Option<Side>) -> String {
    format!("{}{name}", side.map_or(String::new(), |side| format!("{side:?}")))
}

fn read(text: &str, options: &ReadOptions) -> MotionFile {
    MotionFile::from_bvh(text.as_bytes(), options).unwrap()
}

fn name_of(file: &MotionFile, part: Part) -> &str {
    let joint = file.body_parts().unwrap().joint(part).unwrap();
    &file.clip.skeleton().joints()[joint].name
}

#[test]
fn of_two_people_one_is_mapped_within_their_own_tree_and_the_other_is_named() {
    // The second stands higher in its tree: names alone would mix the two.
    let one = body(|name, side| format!("A:{}", english(name, side)), &[]);
    let two = body(|name, side| format!("B:{}", english(name, side)), &["LeftShoulder", "RightShoulder", "Neck"]);
    let two = two.into_iter().enumerate().map(|(at, (name, parent, offset))| {
        // Joints whose parents were left out hang from the chest.
        (name, if at == 0 { None } else { Some(parent.unwrap_or(2)) }, offset)
    });
    let text = bvh(&[one, two.collect()], 0.0);
    for (person, prefix) in [(None, "A:"), (Some("1"), "A:"), (Some("2"), "B:"), (Some("b:hips"), "B:")] {
        let file = read(&text, &ReadOptions { person: person.map(str::to_owned), ..ReadOptions::default() });
        for (part, joint) in file.body_parts().unwrap().parts() {
            assert!(file.clip.skeleton().joints()[joint].name.starts_with(prefix), "{person:?}: {part}");
        }
        assert!(file.notes.iter().any(|note| note.text.contains("2 people") && note.text.contains("B:Hips")));
    }
    let options = ReadOptions { person: Some("C".to_owned()), ..ReadOptions::default() };
    let error = MotionFile::from_bvh(text.as_bytes(), &options).unwrap_err().to_string();
    assert!(error.contains("1 \"A:Hips\", 2 \"B:Hips\""), "{error}");
}

#[test]
fn sides_named_in_any_language_hold_whichever_way_the_body_goes() {
    let words = [
        ("左", "右"),
        ("links", "rechts"),
        ("gauche", "droite"),
        ("izq", "der"),
        ("sinistra", "destra"),
        ("왼", "오른"),
    ];
    for (left, right) in words {
        let called = |name: &str, side: Option<Side>| match side {
            // The stems say nothing: shape finds them.
            Some(side) => format!("q{}_{}", name.len(), if side == Side::Left { left } else { right }),
            None => format!("q{}", name.len()),
        };
        // Without toes travel alone would tell, and backward it would tell wrong.
        let text = bvh(&[body(called, &["LeftToe", "RightToe"])], -2.0);
        let file = read(&text, &ReadOptions::default());
        assert!(name_of(&file, Part::LeftUpperLeg).contains(left), "{left}");
        assert!(name_of(&file, Part::RightLowerArm).contains(right), "{right}");
        assert!(!file.notes.iter().any(|note| note.text.contains("left and right")), "{:?}", file.notes);
    }
}

#[test]
fn a_note_says_that_travel_or_toes_told_left_from_right() {
    let nameless = |name: &str, _: Option<Side>| format!("q{}", name.len());
    let text = bvh(&[body(nameless, &["LeftToe", "RightToe"])], 2.0);
    let notes = read(&text, &ReadOptions::default()).notes;
    assert!(notes.iter().any(|note| note.text.contains("where it travels")), "{notes:?}");
}

#[test]
fn an_arm_that_ends_at_the_elbow_lacks_its_lower_part_and_not_its_upper_one() {
    let text = bvh(&[body(english, &["RightForeArm", "RightHand", "RightFinger"])], 0.0);
    let error = read(&text, &ReadOptions::default()).humanoid.unwrap_err().to_string();
    assert!(error.contains("rightLowerArm, rightHand") && !error.contains("rightUpperArm"), "{error}");
    assert!(error.contains("ReadOptions::parts"), "{error}");
}

/// A GLB of one nameless body with these extensions and two animations, of which the first has one key.
fn nameless_glb(extensions: &str) -> Vec<u8> {
    let joints = body(|_, _| "b".to_owned(), &["LeftToe", "RightToe"]);
    let node = |at: usize| {
        let children: Vec<String> =
            (0..joints.len()).filter(|&child| joints[child].1 == Some(at)).map(|child| child.to_string()).collect();
        let children =
            if children.is_empty() { String::new() } else { format!(r#","children":[{}]"#, children.join(",")) };
        format!(r#"{{"name":"b","translation":{:?}{children}}}"#, joints[at].2)
    };
    let nodes: Vec<String> = (0..joints.len()).map(node).collect();
    let skin: Vec<String> = (0..joints.len()).map(|at| at.to_string()).collect();
    let mut bin = floats(&[0.0, 1.0 / 30.0, 2.0 / 30.0]);
    bin.extend(floats(&[0.0, 0.9, 0.0, 0.0, 0.9, -1.0, 0.0, 0.9, -2.0]));
    let animation = |name: &str, input: usize, output: usize| {
        format!(
            r#"{{"name":"{name}","channels":[{{"sampler":0,"target":{{"node":0,"path":"translation"}}}}],"samplers":[{{"input":{input},"output":{output}}}]}}"#
        )
    };
    let json = format!(
        r#"{{"asset":{{"version":"2.0"}},"scene":0,"scenes":[{{"nodes":[0]}}],"nodes":[{}],"skins":[{{"joints":[{}]}}],
        "animations":[{},{}],"buffers":[{{"byteLength":48}}],
        "bufferViews":[{{"buffer":0,"byteLength":12}},{{"buffer":0,"byteOffset":12,"byteLength":36}}],
        "accessors":[{{"bufferView":0,"componentType":5126,"count":3,"type":"SCALAR"}},{{"bufferView":1,"componentType":5126,"count":3,"type":"VEC3"}},
        {{"bufferView":0,"componentType":5126,"count":1,"type":"SCALAR"}},{{"bufferView":1,"componentType":5126,"count":1,"type":"VEC3"}}]{extensions}}}"#,
        nodes.join(","),
        skin.join(","),
        animation("Take 001", 2, 3),
        animation("Walk", 0, 1),
    );
    glb(&json, &bin)
}

#[test]
fn the_animation_with_keys_is_read_or_the_one_that_is_told_and_all_are_listed() {
    let bytes = nameless_glb("");
    for (told, at, frames) in [(None, 1, 3), (Some("walk"), 1, 3), (Some("2"), 1, 3), (Some("Take 001"), 0, 1)] {
        let options = ReadOptions { animation: told.map(str::to_owned), ..ReadOptions::default() };
        let file = MotionFile::from_bytes("a.glb".as_ref(), &bytes, &options).unwrap();
        assert_eq!(file.clip.frames(), frames, "{told:?}");
        let read: Vec<bool> = file.animations.iter().map(|animation| animation.is_read).collect();
        assert_eq!(read, [at == 0, at == 1], "{told:?}");
        let listed: Vec<(&str, usize)> = file.animations.iter().map(|one| (one.name.as_str(), one.frames)).collect();
        assert_eq!(listed, [("Take 001", 1), ("Walk", 3)], "{told:?}");
    }
    let options = ReadOptions { animation: Some("Wlak".to_owned()), ..ReadOptions::default() };
    let error = MotionFile::from_bytes("a.glb".as_ref(), &bytes, &options).unwrap_err().to_string();
    assert!(error.contains("did you mean \"Walk\""), "{error}");
}

#[test]
fn the_bones_that_a_vrm_states_win_over_travel() {
    let joints = body(english, &["LeftToe", "RightToe"]);
    let vrm = [
        ("hips", "Hips"),
        ("spine", "Spine"),
        ("chest", "Chest"),
        ("neck", "Neck"),
        ("head", "Head"),
        ("leftUpperLeg", "LeftUpLeg"),
        ("leftLowerLeg", "LeftLeg"),
        ("leftFoot", "LeftFoot"),
        ("rightUpperLeg", "RightUpLeg"),
        ("rightLowerLeg", "RightLeg"),
        ("rightFoot", "RightFoot"),
        ("leftUpperArm", "LeftArm"),
        ("leftLowerArm", "LeftForeArm"),
        ("leftHand", "LeftHand"),
        ("rightUpperArm", "RightArm"),
        ("rightLowerArm", "RightForeArm"),
        ("rightHand", "RightHand"),
    ];
    let node = |name: &str| joints.iter().position(|(joint, ..)| joint == name).unwrap();
    let map: Vec<String> = vrm.iter().map(|(bone, name)| format!(r#""{bone}":{{"node":{}}}"#, node(name))).collect();
    let list: Vec<String> =
        vrm.iter().map(|(bone, name)| format!(r#"{{"bone":"{bone}","node":{}}}"#, node(name))).collect();
    let stated = |extension: &str, bones: String| {
        format!(r#","extensions":{{"{extension}":{{"humanoid":{{"humanBones":{bones}}}}}}}"#)
    };
    for (name, extensions, faces) in [
        ("a.vrm", stated("VRMC_vrm", format!("{{{}}}", map.join(","))), 1.0),
        ("a.vrma", stated("VRMC_vrm_animation", format!("{{{}}}", map.join(","))), 1.0),
        // VRM 0.x faces -Z: turned, what the file has at +X is at -X.
        ("a.vrm", stated("VRM", format!("[{}]", list.join(","))), -1.0),
    ] {
        // The body travels backward and has no toes: its shape alone would swap the sides.
        let file = MotionFile::from_bytes(name.as_ref(), &nameless_glb(&extensions), &ReadOptions::default()).unwrap();
        let humanoid: &Humanoid = file.body_parts().unwrap();
        let parsed = gltf::read_slice(&nameless_glb(&extensions), None, &Limits::default()).unwrap();
        let Document::Gltf(document) = parsed.document else { panic!("a glTF") };
        let joint_of = |node: usize| document.nodes().position(|at| at == node);
        for (bone, joint) in vrm {
            let part: Part = bone.parse().unwrap();
            assert_eq!(humanoid.joint(part), joint_of(node(joint)), "{name}: {bone}");
            assert_eq!(humanoid.origin(part), Some(Origin::Stated), "{name}: {bone}");
        }
        let left = file.clip.world(0)[humanoid.joint(Part::LeftUpperLeg).unwrap()].translation.x;
        // The number of the file, in single precision.
        assert!((left - faces * 0.1).abs() < 1e-6, "{name}: {left}");
    }
}

#[test]
fn one_rule_reads_names_of_parts_in_every_spelling() {
    let spellings = [
        (Part::LeftHand, ["LeftHand", "left_hand", "hand.L", "mixamorig:LeftHand", "hand_l", "LEFTHAND"]),
        (
            Part::RightUpperLeg,
            ["rightUpperLeg", "right_upper_leg", "thigh.R", "mixamorig:RightUpLeg", "thigh_r", "R Thigh"],
        ),
        (Part::Chest, ["chest", "Chest", "mixamorig:Spine1", "spine_02", "CHEST", "Spine1"]),
    ];
    for (part, names) in spellings {
        for name in names {
            assert_eq!(name.parse(), Ok(part), "{name}");
        }
    }
    for name in ["tail", "leftThumb", "left", "", "leftHandIk", "HeadTop_End", "jaw"] {
        assert!(name.parse::<Part>().is_err(), "{name}");
    }
    let error = "leftHnad".parse::<Part>().unwrap_err().to_string();
    assert!(error.contains("did you mean `leftHand`") && error.contains("rightToes"), "{error}");
}
