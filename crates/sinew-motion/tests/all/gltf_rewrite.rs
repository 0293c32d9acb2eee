//! A glTF file with another motion in it stays that file.

use crate::binary_support::world_gap;
use glam::{DQuat, DVec3};
use serde_json::Value;
use sinew_motion::formats::{Document, Format, Parsed, Source, WriteJob, gltf as ours};
use sinew_motion::{Clip, Limits, SourceSpace};
use sinew_testkit::capture;

fn read(file: &str) -> Option<Parsed> {
    Some(ours::read(&capture(file)?, &Limits::default()).expect("the file is fine"))
}

fn write_rows(parsed: &Parsed, clip: &Clip, rows: &[usize], format: Format) -> Vec<u8> {
    let source = Source { document: &parsed.document, clip: &parsed.clip, space: SourceSpace::SINEW, rows };
    let mut file = Vec::new();
    ours::write(&mut file, &WriteJob { clip, source: Some(source) }, format, &[]).expect("it can be written");
    file
}

fn write(parsed: &Parsed, clip: &Clip, format: Format) -> Vec<u8> {
    write_rows(parsed, clip, &(0..clip.frames()).collect::<Vec<_>>(), format)
}

fn original(parsed: &Parsed) -> &[u8] {
    let Document::Gltf(document) = &parsed.document else { panic!("a glTF document") };
    document.bytes()
}

fn reread(file: &[u8]) -> Parsed {
    gltf::Gltf::from_slice(file).expect("the gltf crate finds no fault");
    ours::read_slice(file, None, &Limits::default()).expect("we can read it")
}

/// The JSON and the binary chunk.
fn parts(file: &[u8]) -> (Value, Vec<u8>) {
    if !file.starts_with(b"glTF") {
        return (serde_json::from_slice(file).expect("JSON"), Vec::new());
    }
    let glb = gltf::Glb::from_slice(file).expect("a GLB");
    (serde_json::from_slice(&glb.json).expect("JSON"), glb.bin.map(|bin| bin.into_owned()).unwrap_or_default())
}

/// The clip with one joint nodding.
fn nodding(clip: &Clip, joint: usize) -> Clip {
    let mut clip = clip.clone();
    for frame in 0..clip.frames() {
        let nod = DQuat::from_rotation_x(libm::sin(frame as f64 * 0.3) * 0.4);
        clip.set_rotation(frame, joint, clip.rotation(frame, joint) * nod);
    }
    clip
}

const FILES: [(&str, Format); 4] = [
    ("gltf/CesiumMan.glb", Format::Glb),
    ("gltf/cesium_man.gltf", Format::Gltf),
    ("gltf/Fox.glb", Format::Glb),
    ("gltf/RiggedSimple.glb", Format::Glb),
];

#[test]
fn an_unchanged_clip_gives_the_same_bytes() {
    for (file, format) in FILES {
        let Some(parsed) = read(file) else { return };
        assert!(write(&parsed, &parsed.clip, format) == original(&parsed), "{file}");
    }
}

#[test]
fn a_changed_joint_changes_its_own_channel_and_nothing_else() {
    for (file, format) in FILES {
        let Some(parsed) = read(file) else { return };
        let clip = nodding(&parsed.clip, 3);
        let written = write(&parsed, &clip, format);
        let again = reread(&written);
        let size = parsed.clip.world(0).iter().map(|joint| joint.translation.length()).fold(1.0, f64::max);
        let (distance, angle) = world_gap(&clip, &again.clip);
        // Single precision, relative to the size of the fox.
        assert!(distance < 1e-6 * size && angle < 1e-5, "{file}: {distance}, {angle} rad");
        let ((mut old, old_bin), (mut new, new_bin)) = (parts(original(&parsed)), parts(&written));
        assert!(new_bin.starts_with(&old_bin), "{file}: old data stays where it was");
        for key in ["accessors", "bufferViews"] {
            let (old, new) = (old[key].as_array().unwrap(), new[key].as_array().unwrap());
            assert_eq!(new[..old.len()], old[..], "{file}: {key} are only added to");
            assert_eq!(new.len(), old.len() + 2, "{file}: times and rotations");
        }
        let (old_first, new_first) = (old["animations"][0].take(), new["animations"][0].take());
        for key in ["accessors", "bufferViews", "buffers"] {
            (old[key], new[key]) = (Value::Null, Value::Null);
        }
        assert_eq!(serde_json::to_string(&old).unwrap(), serde_json::to_string(&new).unwrap(), "{file}");
        let (old, new) = (&old_first["channels"], &new_first["channels"]);
        let differing = old.as_array().unwrap().iter().zip(new.as_array().unwrap()).filter(|(old, new)| old != new);
        assert!(differing.count() <= 1, "{file}: only the joint's own channel may get another sampler");
    }
}

#[test]
fn a_moved_root_and_a_translation_that_was_still_are_written() {
    let Some(parsed) = read("gltf/CesiumMan.glb") else { return };
    let mut clip = parsed.clip.clone();
    for frame in 0..clip.frames() {
        clip.set_translation(frame, 0, clip.translation(frame, 0) + DVec3::Z * frame as f64 * 0.05);
    }
    let again = reread(&write(&parsed, &clip, Format::Glb));
    let (distance, angle) = world_gap(&clip, &again.clip);
    assert!(distance < 1e-5 && angle < 1e-5, "{distance} m, {angle} rad");
    // A limb made longer: its constant translation has a channel in this file, which must say so too.
    let mut clip = parsed.clip.clone();
    clip.skeleton_mut().edit(|joint, _, rest, _| {
        if joint == 2 {
            rest.translation *= 1.5
        }
    });
    let again = reread(&write(&parsed, &clip, Format::Glb));
    assert!(world_gap(&clip, &again.clip).0 < 1e-5);
}

#[test]
fn a_cut_clip_keeps_the_file_and_loses_the_frames() {
    let Some(parsed) = read("gltf/CesiumMan.glb") else { return };
    let mut clip =
        Clip::new(parsed.clip.skeleton().clone(), parsed.clip.frame_time_secs(), parsed.clip.moving().to_vec());
    let rows: Vec<usize> = (10..30).collect();
    for &row in &rows {
        let locals: Vec<_> = (0..clip.skeleton().len()).map(|joint| parsed.clip.local(row, joint)).collect();
        clip.push(&locals);
    }
    let written = write_rows(&parsed, &clip, &rows, Format::Glb);
    assert_eq!(parts(&written).0["meshes"], parts(original(&parsed)).0["meshes"]);
    let again = reread(&written);
    assert_eq!(again.clip.frames(), 20, "no channel, scales included, stays as long as it was");
    for (frame, row) in rows.iter().enumerate() {
        for (a, b) in again.clip.world(frame).iter().zip(parsed.clip.world(*row)) {
            assert!((a.translation - b.translation).length() < 1e-5);
        }
    }
}

#[test]
fn one_format_becomes_the_other_with_everything_inside() {
    for (file, from) in FILES {
        let Some(parsed) = read(file) else { return };
        let to = if from == Format::Glb { Format::Gltf } else { Format::Glb };
        for clip in [parsed.clip.clone(), nodding(&parsed.clip, 2)] {
            let written = write(&parsed, &clip, to);
            let again = reread(&written);
            let size = parsed.clip.world(0).iter().map(|joint| joint.translation.length()).fold(1.0, f64::max);
            let (distance, angle) = world_gap(&clip, &again.clip);
            assert!(distance < 1e-6 * size && angle < 1e-5, "{file}: {distance}, {angle} rad");
            let (old, new) = (parts(original(&parsed)).0, parts(&written).0);
            assert_eq!((&old["meshes"], &old["materials"]), (&new["meshes"], &new["materials"]));
            if to == Format::Glb {
                assert!(new["buffers"][0].get("uri").is_none(), "all data is in the binary chunk");
            }
        }
    }
}

#[test]
fn units_and_scales_are_undone_and_what_is_not_understood_stays() {
    let file = br#"{"asset":{"version":"2.0","extras":{"who":"me"}},"nodes":[
        {"name":"Armature","scale":[0.01,0.01,0.01],"children":[1],"extras":[1,2.50,{"deep":null}]},
        {"name":"hips","matrix":[0,0,-1,0,0,1,0,0,1,0,0,0,0,100,0,1],"children":[2]},
        {"name":"spine","translation":[0,10,0]}],
        "skins":[{"joints":[1,2]}],"extensionsUsed":["ACME_x"],"extensions":{"ACME_x":{"big":9007199254740993,"pi":3.141592653589793238}}}"#;
    let parsed = ours::read_slice(file, None, &Limits::default()).unwrap();
    assert_eq!(parsed.clip.frames(), 1);
    // The user says that the file's unit is 2 m.
    let space = SourceSpace { unit_m: 2.0, ..SourceSpace::SINEW };
    let in_metres = space.clip_to_world(&parsed.clip);
    let mut clip = Clip::new(in_metres.skeleton().clone(), 0.1, vec![0]);
    for frame in 0..5 {
        let mut locals: Vec<_> = (0..2).map(|joint| in_metres.local(0, joint)).collect();
        locals[0].translation.z += f64::from(frame);
        locals[1].rotation = DQuat::from_rotation_y(0.1 * f64::from(frame));
        clip.push(&locals);
    }
    let source = Source { document: &parsed.document, clip: &in_metres, space, rows: &[0, 0, 0, 0, 0] };
    for format in [Format::Gltf, Format::Glb] {
        let mut written = Vec::new();
        ours::write(&mut written, &WriteJob { clip: &clip, source: Some(source) }, format, &[]).unwrap();
        let again = space.clip_to_world(&reread(&written).clip);
        let (distance, angle) = world_gap(&clip, &again);
        assert!(distance < 1e-5 && angle < 1e-5, "{distance} m, {angle} rad");
        let json = parts(&written).0;
        assert!(json["nodes"][1].get("matrix").is_none(), "an animated node must not have a matrix");
        let text = serde_json::to_string(&json).unwrap();
        for kept in [
            r#""big":9007199254740993"#,
            r#""pi":3.141592653589793"#,
            r#""extras":[1,2.5,{"deep":null}]"#,
            r#""who":"me""#,
        ] {
            assert!(text.contains(kept), "{kept} in {text}");
        }
        assert!(text.find("asset") < text.find("nodes") && text.find("nodes") < text.find("skins"), "order stays");
    }
}

#[test]
fn another_skeleton_becomes_a_file_of_its_own() {
    let (Some(man), Some(fox)) = (read("gltf/CesiumMan.glb"), read("gltf/Fox.glb")) else { return };
    let source = Source { document: &man.document, clip: &man.clip, space: SourceSpace::SINEW, rows: &[] };
    let mut written = Vec::new();
    ours::write(&mut written, &WriteJob { clip: &fox.clip, source: Some(source) }, Format::Glb, &[]).unwrap();
    assert_eq!(parts(&written).0["asset"]["generator"], "sinew");
    assert_eq!(reread(&written).clip.skeleton().len(), 24);
}
