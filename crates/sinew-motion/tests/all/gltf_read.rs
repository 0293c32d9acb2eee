//! glTF files of the world, and small ones made here, read as motion.

use crate::binary_support::{floats, glb};
use glam::{DQuat, DVec3};
use sinew_motion::formats::{Document, Parsed, gltf};
use sinew_motion::{Error, Limits};
use sinew_testkit::capture;

fn read(file: &str) -> Option<Parsed> {
    Some(gltf::read(&capture(file)?, &Limits::default()).expect("the file is fine"))
}

fn joint(parsed: &Parsed, name: &str) -> usize {
    parsed.clip.skeleton().find(name).unwrap_or_else(|| panic!("a joint {name}"))
}

/// A GLB with one skin of two joints, `hips` and `spine`, whose channels are given as JSON, over this buffer.
fn two_joints(hips: &str, animation: &str, views: &str, bin: &[u8]) -> Vec<u8> {
    let json = format!(
        r#"{{"asset":{{"version":"2.0"}},"scene":0,"scenes":[{{"nodes":[0]}}],"skins":[{{"joints":[0,1]}}],
        "nodes":[{{"name":"hips"{hips},"children":[1]}},{{"name":"spine","translation":[0,0.5,0]}}],
        "buffers":[{{"byteLength":{}}}],{views},"animations":[{animation}]}}"#,
        bin.len()
    );
    glb(&json, bin)
}

fn parse(bytes: &[u8]) -> Result<Parsed, Error> {
    gltf::read_slice(bytes, None, &Limits::default())
}

#[test]
fn cesium_man_is_read_with_its_joints_rate_and_height() {
    let Some(man) = read("gltf/CesiumMan.glb") else { return };
    assert_eq!(man.clip.skeleton().len(), 19);
    assert_eq!((man.clip.frames(), man.clip.fps()), (49, 24.0));
    assert!((man.clip.duration_secs() - 2.0).abs() < 1e-12);
    assert_eq!((man.unit_m, man.world_from_source), (Some(1.0), Some(DQuat::IDENTITY)));
    assert_eq!(man.clip.moving(), [0], "only the root moves in its parent");
    assert!(matches!(man.document, Document::Gltf(_)));
    let heights: Vec<f64> = man.clip.world(0).iter().map(|world| world.translation.y).collect();
    // The mesh is 1.51 m high; its topmost joint is the neck's, its lowest the toes' in mid-swing or on the floor.
    let top = heights.iter().copied().fold(f64::MIN, f64::max);
    let bottom = heights.iter().copied().fold(f64::MAX, f64::min);
    assert!((1.1..1.51).contains(&top) && (-0.02..0.05).contains(&bottom), "{bottom} to {top}");
}

#[test]
fn the_same_man_with_z_up_and_without_names_stands_at_the_same_places() {
    let (Some(glb), Some(text)) = (read("gltf/CesiumMan.glb"), read("gltf/cesium_man.gltf")) else { return };
    assert_eq!(text.clip.skeleton().len(), 20, "the Z-up root node is a joint too");
    assert_eq!(text.clip.skeleton().joints()[1].name, "node_2");
    assert_eq!(text.clip.frames(), glb.clip.frames());
    // The re-export turned him to face +Z and repeats his second pose in its first frame.
    for frame in 1..49 {
        let text: Vec<DVec3> = text.clip.world(frame).iter().map(|joint| joint.translation).collect();
        for joint in glb.clip.world(frame) {
            let turned = text[1..].iter().map(|at| DVec3::new(-at.z, at.y, at.x));
            let gap = turned.map(|at| (at - joint.translation).length()).fold(f64::MAX, f64::min);
            // Two exporters rounded to single precision along chains of nine joints: 1e-6 m seen.
            assert!(gap < 1e-5, "frame {frame}: {gap} m");
        }
    }
}

#[test]
fn the_fox_keeps_its_units_and_its_other_animations_are_named() {
    let Some(fox) = read("gltf/Fox.glb") else { return };
    assert_eq!((fox.clip.skeleton().len(), fox.clip.frames()), (24, 83));
    assert_eq!(fox.unit_m, Some(1.0), "glTF is metres by definition, even where it makes a giant fox");
    assert!(fox.clip.world(0)[joint(&fox, "b_Head_05")].translation.y > 50.0);
    let names: Vec<&str> = fox.contents.animations.iter().map(|animation| animation.name.as_str()).collect();
    assert_eq!(names, ["Survey", "Walk", "Run"]);
    assert!(fox.contents.animations[0].is_read && fox.contents.animations.iter().all(|other| other.frames > 10));
}

#[test]
fn a_skinned_cylinder_is_read_too() {
    let Some(simple) = read("gltf/RiggedSimple.glb") else { return };
    assert_eq!((simple.clip.skeleton().len(), simple.clip.frames()), (4, 161));
    assert!(simple.clip.moving().is_empty());
}

const ROTATION_AND_TIME: &str =
    r#""bufferViews":[{"buffer":0,"byteLength":12},{"buffer":0,"byteOffset":12,"byteLength":144}]"#;

#[test]
fn steps_hold_lines_turn_and_splines_follow_their_tangents() {
    let (sin, cos) = (libm::sin(0.5) as f32, libm::cos(0.5) as f32); // half of 1 rad
    let mut bin = floats(&[0.0, 0.1, 0.3]);
    bin.extend(floats(&[0.0, 0.0, 0.0, 1.0, 0.0, 0.0, sin, cos, 0.0, 0.0, 0.0, 1.0]));
    bin.resize(12 + 144, 0);
    let file = |interpolation: &str| {
        let animation = format!(
            r#"{{"channels":[{{"sampler":0,"target":{{"node":1,"path":"rotation"}}}}],
            "samplers":[{{"input":0,"output":1,"interpolation":"{interpolation}"}}]}}"#
        );
        let views = format!(
            r#"{ROTATION_AND_TIME},"accessors":[{{"bufferView":0,"componentType":5126,"count":3,"type":"SCALAR"}},
            {{"bufferView":1,"componentType":5126,"count":3,"type":"VEC4"}}]"#
        );
        two_joints("", &animation, &views, &bin)
    };
    let turn = |parsed: &Parsed, frame: usize| {
        let rotation = parsed.clip.rotation(frame, 1);
        2.0 * libm::atan2(rotation.z, rotation.w)
    };
    let linear = parse(&file("LINEAR")).unwrap();
    // Keys at 0, 0.1 and 0.3 s lie on the frames of 30 Hz.
    assert_eq!((linear.clip.fps(), linear.clip.frames()), (30.0, 10));
    // Single-precision keys.
    assert!((turn(&linear, 1) - 1.0 / 3.0).abs() < 1e-6 && (turn(&linear, 3) - 1.0).abs() < 1e-6);
    let step = parse(&file("STEP")).unwrap();
    assert_eq!((turn(&step, 2), turn(&step, 9)), (0.0, 0.0));
    assert!((turn(&step, 3) - 1.0).abs() < 1e-6, "a step is taken on its frame, not one late");
}

#[test]
fn a_spline_of_translations_is_the_hermite_curve() {
    // One second from x = 0 to x = 1 with out-tangent 3 and in-tangent 0: x(t) = 3(t3 - 2t2 + t) + 3t2 - 2t3.
    let mut bin = floats(&[0.0, 1.0]);
    let knots: [[f32; 3]; 6] = [[0.0; 3], [0.0; 3], [3.0, 0.0, 0.0], [0.0; 3], [1.0, 0.0, 0.0], [0.0; 3]];
    bin.extend(floats(knots.as_flattened()));
    let animation = r#"{"channels":[{"sampler":0,"target":{"node":0,"path":"translation"}}],
        "samplers":[{"input":0,"output":1,"interpolation":"CUBICSPLINE"}]}"#;
    let views = r#""bufferViews":[{"buffer":0,"byteLength":8},{"buffer":0,"byteOffset":8,"byteLength":72}],
        "accessors":[{"bufferView":0,"componentType":5126,"count":2,"type":"SCALAR"},
        {"bufferView":1,"componentType":5126,"count":6,"type":"VEC3"}]"#;
    let parsed = parse(&two_joints("", animation, views, &bin)).unwrap();
    assert_eq!((parsed.clip.fps(), parsed.clip.frames()), (60.0, 61), "two keys say nothing of a rate");
    assert_eq!(parsed.clip.moving(), [0]);
    for frame in 0..61 {
        let t = frame as f64 / 60.0;
        let x = 3.0 * (t * t * t - 2.0 * t * t + t) + 3.0 * t * t - 2.0 * t * t * t;
        // Values that single precision holds exactly: only rounding of doubles is left.
        assert!((parsed.clip.translation(frame, 0).x - x).abs() < 1e-12, "frame {frame}");
    }
}

#[test]
fn scales_move_into_offsets_and_a_file_without_animation_is_one_frame() {
    let json = br#"{"asset":{"version":"2.0"},"skins":[{"joints":[1,2]}],"nodes":[
        {"name":"Armature","scale":[0.01,0.01,0.01],"children":[1]},
        {"name":"hips","translation":[0,100,0],"scale":[2,2,2],"children":[2]},
        {"translation":[0,10,0],"children":[3]},{"translation":[0,5,0]}]}"#;
    let parsed = parse(json).unwrap();
    let world = parsed.clip.world(0);
    assert_eq!((parsed.clip.frames(), world.len()), (1, 2), "a node that only scales is no joint");
    assert!((world[1].translation.y - 1.2).abs() < 1e-12);
    let spine = &parsed.clip.skeleton().joints()[1];
    assert_eq!(spine.name, "node_2");
    assert!((spine.tip.unwrap().y - 0.1).abs() < 1e-12, "the bare child ends the bone");
    let notes = parsed.notes.iter().map(ToString::to_string).collect::<Vec<_>>().join("; ");
    assert!(notes.contains("scales of 2 nodes") && notes.contains("one frame"), "{notes}");
}

#[test]
fn time_before_the_first_key_holds_its_value() {
    let file = |start: f32| {
        let times: Vec<f32> = (0..24_u8).map(|frame| start + f32::from(frame) / 30.0).collect();
        let places: Vec<f32> = (0..24_u8).flat_map(|frame| [f32::from(frame), 1.0, 0.0]).collect();
        let mut bin = floats(&times);
        bin.extend(floats(&places));
        let animation = r#"{"channels":[{"sampler":0,"target":{"node":0,"path":"translation"}}],
            "samplers":[{"input":0,"output":1}]}"#;
        let views = r#""bufferViews":[{"buffer":0,"byteLength":96},{"buffer":0,"byteOffset":96,"byteLength":288}],
            "accessors":[{"bufferView":0,"componentType":5126,"count":24,"type":"SCALAR"},
            {"bufferView":1,"componentType":5126,"count":24,"type":"VEC3"}]"#;
        parse(&two_joints("", animation, views, &bin)).unwrap().clip
    };
    let x = |clip: &sinew_motion::Clip, frame: usize| clip.translation(frame, 0).x;
    let late = file(1.5);
    assert_eq!((late.fps(), late.frames()), (30.0, 69), "45 frames are held, then come 24 keys");
    assert_eq!((x(&late, 0), x(&late, 45)), (0.0, 0.0));
    // Single-precision keys, 30 frames a second: 1e-5 of a frame.
    assert!((x(&late, 46) - 1.0).abs() < 1e-4 && (x(&late, 68) - 23.0).abs() < 1e-4);
    assert_eq!(file(1.0 / 30.0).frames(), 24, "frames counted from 1 are no pause");
    assert_eq!(file(0.0).frames(), 24);
}

#[test]
fn a_body_mirrored_in_all_three_axes_is_exact_and_has_no_note() {
    let file = |scale: &str| {
        let json = format!(
            r#"{{"asset":{{"version":"2.0"}},"skins":[{{"joints":[0,1,2]}}],"nodes":[
            {{"name":"hips","scale":{scale},"children":[1]}},
            {{"name":"spine","translation":[0.1,0.5,0],"rotation":[0,0,0.6,0.8],"children":[2]}},
            {{"name":"head","translation":[0,0.5,0.25]}}]}}"#
        );
        parse(json.as_bytes()).unwrap()
    };
    let noted = |parsed: &Parsed| parsed.notes.iter().any(|note| note.text.contains("may be off"));
    let (plain, reflected) = (file("[1,1,1]"), file("[-1,-1,-1]"));
    assert!(!noted(&reflected), "{:?}", reflected.notes);
    for (plain, reflected) in plain.clip.world(0).iter().zip(&reflected.clip.world(0)) {
        // Sums of a few doubles below 1.
        assert!((plain.translation + reflected.translation).length() < 1e-12);
    }
    assert!(noted(&file("[-1,1,1]")), "a mirror in one axis does not commute with rotations");
}

#[test]
fn an_animated_scale_is_left_out_and_told() {
    let mut bin = floats(&[0.0, 0.5, 1.0]);
    bin.extend(floats(&[1.0, 1.0, 1.0, 2.0, 2.0, 2.0, 1.0, 1.0, 1.0]));
    let animation = r#"{"channels":[{"sampler":0,"target":{"node":0,"path":"scale"}}],
        "samplers":[{"input":0,"output":1}]}"#;
    let views = r#""bufferViews":[{"buffer":0,"byteLength":12},{"buffer":0,"byteOffset":12,"byteLength":36}],
        "accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"SCALAR"},
        {"bufferView":1,"componentType":5126,"count":3,"type":"VEC3"}]"#;
    let parsed = parse(&two_joints("", animation, views, &bin)).unwrap();
    assert!(parsed.notes.iter().any(|note| note.text.contains("animated scale of hips")), "{:?}", parsed.notes);
    assert!(parsed.clip.moving().is_empty());
}

#[test]
fn normalised_integers_are_rotations_too() {
    let mut bin = floats(&[0.0, 0.1, 0.3]);
    for value in [[0_i16, 0, 0, 32767], [0, 0, 23170, 23170], [0, 0, 0, 32767]].as_flattened() {
        bin.extend(value.to_le_bytes());
    }
    let animation = r#"{"channels":[{"sampler":0,"target":{"node":1,"path":"rotation"}}],
        "samplers":[{"input":0,"output":1}]}"#;
    let views = r#""bufferViews":[{"buffer":0,"byteLength":12},{"buffer":0,"byteOffset":12,"byteLength":24}],
        "accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"SCALAR"},
        {"bufferView":1,"componentType":5122,"normalized":true,"count":3,"type":"VEC4"}]"#;
    let parsed = parse(&two_joints("", animation, views, &bin)).unwrap();
    let up = parsed.clip.rotation(3, 1) * DVec3::X;
    // A sixteenth-bit integer holds a quarter turn to 1 / 32767.
    assert!((up - DVec3::Y).length() < 1e-4, "{up}");
}

#[test]
fn a_sparse_accessor_replaces_single_keys() {
    let mut bin = floats(&[0.0, 0.1, 0.3]);
    bin.extend(floats(&[0.0; 9]));
    bin.extend([1, 0, 0, 0]);
    bin.extend(floats(&[0.0, 7.0, 0.0]));
    let animation = r#"{"channels":[{"sampler":0,"target":{"node":0,"path":"translation"}}],
        "samplers":[{"input":0,"output":1}]}"#;
    let views = r#""bufferViews":[{"buffer":0,"byteLength":12},{"buffer":0,"byteOffset":12,"byteLength":36},
        {"buffer":0,"byteOffset":48,"byteLength":1},{"buffer":0,"byteOffset":52,"byteLength":12}],
        "accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"SCALAR"},
        {"bufferView":1,"componentType":5126,"count":3,"type":"VEC3","sparse":{"count":1,
        "indices":{"bufferView":2,"componentType":5121},"values":{"bufferView":3}}}]"#;
    let parsed = parse(&two_joints("", animation, views, &bin)).unwrap();
    assert_eq!(parsed.clip.translation(3, 0), DVec3::new(0.0, 7.0, 0.0));
    assert_eq!(parsed.clip.translation(9, 0), DVec3::ZERO);
}

#[test]
fn skins_of_one_body_are_one_skeleton_and_strangers_stay_out() {
    let json = br#"{"asset":{"version":"2.0"},"skins":[{"joints":[2]},{"joints":[0,1]},{"joints":[3]}],"nodes":[
        {"name":"hips","children":[1]},{"name":"head","translation":[0,1,0],"children":[2]},
        {"name":"eye","translation":[0,0,0.1]},{"name":"stranger"}]}"#;
    let names: Vec<String> =
        parse(json).unwrap().clip.skeleton().joints().iter().map(|joint| joint.name.clone()).collect();
    assert_eq!(names, ["hips", "head", "eye"]);
}

#[test]
fn a_buffer_beside_the_file_is_read_and_one_elsewhere_refused() {
    let folder = tempfile::tempdir().unwrap();
    let inner = folder.path().join("inner");
    std::fs::create_dir(&inner).unwrap();
    let mut bin = floats(&[0.0, 0.1, 0.3]);
    bin.extend(floats(&[0.0, 1.0, 0.0, 0.0, 2.0, 0.0, 0.0, 1.0, 0.0]));
    std::fs::write(inner.join("my motion.bin"), &bin).unwrap();
    std::fs::write(folder.path().join("secret.bin"), &bin).unwrap();
    let secret = folder.path().join("secret.bin");
    let file = |uri: &str| {
        format!(
            r#"{{"asset":{{"version":"2.0"}},"nodes":[{{"name":"hips"}}],"buffers":[{{"byteLength":48,"uri":"{uri}"}}],
            "bufferViews":[{{"buffer":0,"byteLength":12}},{{"buffer":0,"byteOffset":12,"byteLength":36}}],
            "accessors":[{{"bufferView":0,"componentType":5126,"count":3,"type":"SCALAR"}},
            {{"bufferView":1,"componentType":5126,"count":3,"type":"VEC3"}}],
            "animations":[{{"channels":[{{"sampler":0,"target":{{"node":0,"path":"translation"}}}}],
            "samplers":[{{"input":0,"output":1}}]}}]}}"#
        )
    };
    let read = |uri: &str| {
        let path = inner.join("walk.gltf");
        std::fs::write(&path, file(uri)).unwrap();
        gltf::read(&path, &Limits::default())
    };
    assert_eq!(read("my%20motion.bin").unwrap().clip.translation(3, 0).y, 2.0);
    let absolute = secret.display().to_string();
    #[cfg(unix)]
    std::os::unix::fs::symlink(&secret, inner.join("link.bin")).unwrap();
    #[cfg(unix)]
    std::os::unix::fs::symlink("/dev/zero", inner.join("zero.bin")).unwrap();
    for uri in [
        "../secret.bin",
        "%2e%2e/secret.bin",
        "a/../../secret.bin",
        "/etc/hostname",
        "file:///etc/hostname",
        "..\\\\secret.bin",
        "C:\\\\secret.bin",
        &absolute,
        "link.bin",
        "zero.bin",
        "",
        ".",
        "%00",
        "%zz",
        "http://x/y",
    ] {
        let error = read(uri).expect_err(uri).to_string();
        assert!(error.contains("walk.gltf") && error.contains("buffers[0]"), "{uri}: {error}");
    }
    let error = gltf::read_slice(file("my%20motion.bin").as_bytes(), None, &Limits::default()).unwrap_err();
    assert!(error.remedy().contains("path"), "{error}");
    let small = Limits { file_bytes: 47, ..Limits::default() };
    assert!(gltf::read(&inner.join("walk.gltf"), &small).is_err(), "the limit holds for the file");
}
