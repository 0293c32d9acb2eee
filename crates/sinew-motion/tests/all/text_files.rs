//! Every text motion file of the shared folder: what is read, and that writing it again changes nothing.
#![allow(clippy::unwrap_used, reason = "a test may fail")]

use crate::text::*;
use glam::DVec3;
use sinew_motion::SourceSpace;
use sinew_motion::formats::{amc, bvh};
use sinew_testkit::mocap;
use std::collections::BTreeMap;

/// Frames and rates as the folder's README lists them.
fn listed(folder: &std::path::Path) -> BTreeMap<String, (usize, f64)> {
    let readme = std::fs::read_to_string(folder.join("README.md")).unwrap();
    let row = |line: &str| {
        let cells: Vec<&str> = line.split('|').map(str::trim).collect();
        let name = (*cells.get(1)?).to_owned();
        Some((name, (cells.get(3)?.parse().ok()?, cells.get(4)?.parse().ok()?)))
    };
    readme.lines().filter_map(row).filter(|(name, _)| name.ends_with(".bvh") || name.ends_with(".amc")).collect()
}

/// Joints and tips by folder, or by file where files of a folder differ.
const JOINTS: &[(&str, usize, usize)] = &[
    ("cmu_bvh_motionbuilder/", 31, 7),
    ("cmu_bvh_60hz_trimmed/", 31, 7),
    ("cmu_bvh_daz/", 43, 14),
    ("accad_bvh/", 22, 5),
    ("rokoko_jesse_dance", 60, 0),
    ("fair_zombie", 27, 0),
    ("bvhtoolbox_walk01", 19, 0),
    ("dialects_generated/", 31, 7),
    ("cmu_asfamc/", 31, 0),
];

#[test]
fn every_file_reads_as_its_table_says_and_writes_back_to_the_same_bytes() {
    let Some(folder) = mocap() else { return };
    let listed = listed(&folder);
    let (bvh_files, amc_files) = (files(&folder, "bvh"), files(&folder, "amc"));
    assert_eq!((bvh_files.len(), amc_files.len(), listed.len()), (47, 7, 54), "files here and in the README");
    for path in bvh_files.iter().chain(&amc_files) {
        let name = path.file_name().unwrap().to_str().unwrap();
        let is_amc = name.ends_with(".amc");
        let parsed = if is_amc { read_amc(path) } else { read_bvh(path) };
        let (frames, fps) = listed[name];
        assert_eq!(parsed.clip.frames(), frames, "{name}");
        // The table prints at most three decimals, `Frame Time:` at least five.
        assert!((parsed.clip.fps() - fps).abs() < 0.01, "{name}: {}", parsed.clip.fps());
        assert_eq!(parsed.clip.first_non_finite(), None, "{name}");
        let whole = path.to_str().unwrap();
        if let Some(&(_, joints, tips)) = JOINTS.iter().find(|(part, ..)| whole.contains(part)) {
            assert_eq!(parsed.clip.skeleton().len(), joints, "{name}");
            let found = parsed.clip.skeleton().joints().iter().filter(|joint| joint.tip.is_some()).count();
            assert!(tips == 0 || found == tips, "{name}: {found} tips");
        }
        assert_eq!(parsed.clip.skeleton().joints()[0].rest.rotation, glam::DQuat::IDENTITY);
        if !is_amc {
            assert_eq!(parsed.notes, [], "{name}");
        }
        let write: Writer = if is_amc { amc::write } else { bvh::write };
        let loaded = Loaded::new(parsed, awkward_space());
        let written = loaded.write(write, &loaded.clip, &loaded.rows()).unwrap();
        assert!(written == std::fs::read(path).unwrap(), "{name} has changed");
    }
}

#[test]
fn the_generated_dialects_are_the_same_motion() {
    let Some(folder) = mocap() else { return };
    let original = read_bvh(&folder.join("cmu_bvh_motionbuilder/07_01.bvh")).clip;
    type Turn = fn(DVec3) -> DVec3;
    let same: Turn = |point| point;
    let dialects: [(&str, Turn); 5] = [
        ("six_channels_yxz", same),
        ("crlf_tabs_sci", same),
        ("rotation_first_mixed_orders", same),
        ("mixamo_names_cm", |point| point / (CMU_UNIT_M * 100.0)),
        ("zup_metres_xyz_rootoffset", |point| DVec3::new(point.x, point.z, -point.y) / CMU_UNIT_M),
    ];
    for (name, to_original) in dialects {
        let copy = read_bvh(&folder.join(format!("dialects_generated/07_01__{name}.bvh"))).clip;
        let mut gap: f64 = 0.0;
        for frame in 0..original.frames() {
            let moved: Vec<DVec3> = points(&copy, frame).into_iter().map(to_original).collect();
            gap = gap.max(largest_gap(&moved, &points(&original, frame)));
        }
        // As the README states: 0.1 mm.
        assert!(gap < 0.002, "{name}: {gap}");
    }
}

#[test]
fn amc_and_bvh_of_one_trial_agree_in_the_legs_and_lower_spine() {
    let Some(folder) = mocap() else { return };
    // The BVH begins with a T-pose that the AMC does not have. Its bones bear the names of their starts.
    let pairs = [
        ("root", "Hips"),
        ("lfemur", "LeftUpLeg"),
        ("ltibia", "LeftLeg"),
        ("lfoot", "LeftFoot"),
        ("ltoes", "LeftToeBase"),
        ("rfemur", "RightUpLeg"),
        ("rtibia", "RightLeg"),
        ("rfoot", "RightFoot"),
        ("rtoes", "RightToeBase"),
        ("lowerback", "LowerBack"),
        ("upperback", "Spine"),
        ("thorax", "Spine1"),
    ];
    for trial in ["07_01", "02_01", "06_01", "08_01"] {
        let amc = read_amc(&folder.join(format!("cmu_asfamc/{trial}.amc"))).clip;
        let bvh = read_bvh(&folder.join(format!("cmu_bvh_motionbuilder/{trial}.bvh"))).clip;
        for (bone, joint) in pairs {
            let (bone_at, joint_at) = (amc.skeleton().find(bone).unwrap(), bvh.skeleton().find(joint).unwrap());
            for frame in 0..amc.frames() {
                let (a, b) = (amc.world(frame)[bone_at].translation, bvh.world(frame + 1)[joint_at].translation);
                // As the README states: the four decimals of the BVH, over a leg of 17 units.
                assert!(a.distance(b) < 1e-4, "{trial} {bone} frame {frame}: {a} {b}");
            }
        }
    }
}

#[test]
fn amc_states_its_unit_and_axes_and_not_its_rate() {
    let Some(folder) = mocap() else { return };
    let parsed = read_amc(&folder.join("cmu_asfamc/16_15.amc"));
    assert_eq!(parsed.unit_m, Some(CMU_UNIT_M));
    assert_eq!(parsed.world_from_source, Some(glam::DQuat::IDENTITY));
    assert!(parsed.notes.iter().any(|note| note.text.contains("120 frames per second")), "{:?}", parsed.notes);
    assert_eq!(parsed.clip.moving(), [0]);
}

#[test]
fn a_new_file_of_an_amc_has_the_same_places_in_the_world() {
    let Some(folder) = mocap() else { return };
    let parsed = read_amc(&folder.join("cmu_asfamc/07_01.amc"));
    let space = SourceSpace { unit_m: CMU_UNIT_M, world_from_source: glam::DQuat::IDENTITY };
    let loaded = Loaded::new(parsed, space);
    let centimetres = SourceSpace { unit_m: 0.01, world_from_source: glam::DQuat::IDENTITY };
    let job = sinew_motion::formats::WriteJob { clip: &loaded.clip, source: None };

    let mut out = Vec::new();
    bvh::write(&mut out, &job).unwrap();
    let copy = centimetres.clip_to_world(&bvh::read(&out, &Default::default()).unwrap().clip);
    compare(&loaded.clip, &copy);
    let names = |clip: &sinew_motion::Clip| -> Vec<String> {
        clip.skeleton().joints().iter().map(|joint| joint.name.clone()).collect()
    };
    assert_eq!(names(&copy), names(&loaded.clip));

    let (mut amc_out, mut asf_out) = (Vec::new(), Vec::new());
    amc::write(&mut amc_out, &job).unwrap();
    amc::write_skeleton(&mut asf_out, &loaded.clip).unwrap();
    let parsed = amc::read(&amc_out, &asf_out, &Default::default()).unwrap();
    assert_eq!(parsed.unit_m, Some(CMU_UNIT_M));
    compare(&loaded.clip, &space.clip_to_world(&parsed.clip));
}

/// Joints of the same name stand in the same places.
fn compare(original: &sinew_motion::Clip, copy: &sinew_motion::Clip) {
    assert_eq!(original.frames(), copy.frames());
    for (index, joint) in original.skeleton().joints().iter().enumerate() {
        let other = copy.skeleton().find(&joint.name).unwrap();
        let tips = (joint.tip, copy.skeleton().joints()[other].tip);
        for frame in 0..original.frames() {
            let (a, b) = (original.world(frame)[index], copy.world(frame)[other]);
            // Six decimals of a degree or a unit over a body of two metres.
            assert!(a.translation.distance(b.translation) < 1e-6, "{} in frame {frame}", joint.name);
            if let (Some(tip), Some(other)) = tips {
                assert!(a.point(tip).distance(b.point(other)) < 1e-6, "tip of {} in frame {frame}", joint.name);
            }
        }
    }
}

#[test]
fn a_new_bvh_turns_steadily_from_frame_to_frame() {
    let Some(folder) = mocap() else { return };
    for name in ["dialects/rokoko_jesse_dance.bvh", "accad_bvh/Male2_Form_1.bvh"] {
        let clip = SourceSpace { unit_m: 0.01, world_from_source: glam::DQuat::IDENTITY }
            .clip_to_world(&read_bvh(&folder.join(name)).clip);
        let mut out = Vec::new();
        bvh::write(&mut out, &sinew_motion::formats::WriteJob { clip: &clip, source: None }).unwrap();
        let text = String::from_utf8(out).unwrap();
        let rows = text.lines().skip_while(|line| !line.starts_with("Frame Time")).skip(1);
        let rows: Vec<Vec<f64>> =
            rows.map(|line| line.split(' ').map(|word| word.parse().unwrap()).collect()).collect();
        for pair in rows.windows(2) {
            for (before, after) in pair[0].iter().zip(&pair[1]) {
                // A whole turn is never jumped; half of one is, where a joint passes gimbal lock.
                assert!((before - after).abs() < 200.0, "{name}: {before} {after}");
            }
        }
    }
}
