//! Writing a changed motion over its file: what changes, and what does not.
#![allow(clippy::unwrap_used, reason = "a test may fail")]

use crate::text::*;
use glam::{DQuat, DVec3};
use sinew_motion::formats::{Document, WriteJob, amc, bvh};
use sinew_motion::{Clip, Joint, Limits, Skeleton, SourceSpace, Transform};
use sinew_testkit::mocap;

/// Words of a text with the lines they stand in.
fn words(bytes: &[u8]) -> Vec<(usize, String)> {
    let text = String::from_utf8(bytes.to_vec()).unwrap();
    let lines = text.split('\n').enumerate();
    lines.flat_map(|(line, text)| text.split_whitespace().map(move |word| (line, word.to_owned()))).collect()
}

/// The words of the second text that differ from the first's, by index.
fn changed(before: &[u8], after: &[u8]) -> Vec<usize> {
    let (before, after) = (words(before), words(after));
    assert_eq!(before.len(), after.len());
    (0..before.len()).filter(|&index| before[index] != after[index]).collect()
}

#[test]
fn one_edited_rotation_changes_only_its_own_words() {
    let Some(folder) = mocap() else { return };
    for path in files(&folder, "bvh") {
        let before = std::fs::read(&path).unwrap();
        let loaded = Loaded::new(read_bvh(&path), awkward_space());
        for (frame, joint) in [(3, 0), (7, loaded.clip.skeleton().len() - 2)] {
            let mut clip = loaded.clip.clone();
            let turned = clip.rotation(frame, joint) * DQuat::from_euler(glam::EulerRot::XYZ, 0.1, -0.2, 0.15);
            clip.set_rotation(frame, joint, turned);
            let after = loaded.write(bvh::write, &clip, &loaded.rows()).unwrap();
            let differ = changed(&before, &after);
            let rows_from = words(&before).iter().position(|(_, word)| word.eq_ignore_ascii_case("time:")).unwrap() + 2;
            let (width, lines) = ((words(&before).len() - rows_from) / clip.frames(), words(&before));
            assert!((1..=3).contains(&differ.len()), "{}: {differ:?}", path.display());
            for &word in &differ {
                assert_eq!((word - rows_from) / width, frame, "{}", path.display());
                assert_eq!(lines[word].0, lines[differ[0]].0);
            }
            assert!(differ[differ.len() - 1] - differ[0] < 3, "{}: {differ:?}", path.display());
            let again = awkward_space().clip_to_world(&bvh::read(&after, &Limits::default()).unwrap().clip);
            let apart = again.rotation(frame, joint).conjugate() * turned;
            let apart = 2.0 * libm::asin(apart.xyz().length());
            // Half of the last of two decimals (gpmat_Swagger) of three degrees at most.
            assert!(apart < 3.0 * 0.005f64.to_radians(), "{}: {apart}", path.display());
            assert_eq!(again.rotations(frame + 1), loaded.clip.rotations(frame + 1));
        }
    }
}

#[test]
fn a_rotation_written_anew_keeps_the_branch_and_digits_of_the_file() {
    let text = small(6, "Zrotation Yrotation Xrotation", &["1 2 3 370.25 -190.5 12.125", "1 2 3 0 0 0"]);
    let loaded = Loaded::new(parse(&text), SourceSpace::SINEW);
    let mut clip = loaded.clip.clone();
    // Twice the length: another quaternion for the same rotation.
    clip.set_rotation(0, 0, -clip.rotation(0, 0));
    assert_eq!(loaded.write(bvh::write, &clip, &[0, 1]).unwrap(), text.as_bytes());
    clip.set_rotation(0, 0, clip.rotation(0, 0) * DQuat::from_rotation_x(1f64.to_radians()));
    let written = String::from_utf8(loaded.write(bvh::write, &clip, &[0, 1]).unwrap()).unwrap();
    assert!(written.contains("\n1 2 3 370.25 -190.5 13.125\n"), "{written}");
}

#[test]
fn gimbal_lock_keeps_the_angles_of_the_file() {
    let text = small(6, "Zrotation Xrotation Yrotation", &["0 0 0 30.0000 90.0000 50.0000"]);
    let loaded = Loaded::new(parse(&text), SourceSpace::SINEW);
    let mut clip = loaded.clip.clone();
    clip.set_rotation(0, 0, clip.rotation(0, 0) * DQuat::from_rotation_y(10f64.to_radians()));
    let written = String::from_utf8(loaded.write(bvh::write, &clip, &[0]).unwrap()).unwrap();
    assert!(written.contains("0 0 0 30.0000 90.0000 60.0000"), "{written}");
}

#[test]
fn frames_may_be_left_out_and_repeated() {
    for end in ["\n", ""] {
        let text = small(3, "Zrotation Xrotation Yrotation", &["1 1 1", "2 2 2", "3 3 3"]);
        let text = text.trim_end().to_owned() + end;
        let loaded = Loaded::new(parse(&text), SourceSpace::SINEW);
        let rows = [2, 2, 0, 1, 2];
        let mut clip = Clip::new(loaded.clip.skeleton().clone(), loaded.clip.frame_time_secs(), vec![]);
        rows.iter().for_each(|&row| clip.push(&[loaded.clip.local(row, 0)]));
        let written = String::from_utf8(loaded.write(bvh::write, &clip, &rows).unwrap()).unwrap();
        let expected = text.replace("Frames: 3", "Frames: 5").replace("1 1 1", "3 3 3\n3 3 3\n1 1 1");
        assert_eq!(written, expected);
    }
}

#[test]
fn another_rate_changes_the_frame_time() {
    let text = small(3, "Zrotation Xrotation Yrotation", &["1 1 1", "2 2 2"]);
    let loaded = Loaded::new(parse(&text), SourceSpace::SINEW);
    let mut clip = Clip::new(loaded.clip.skeleton().clone(), 1.0 / 60.0, vec![]);
    clip.push(&[loaded.clip.local(0, 0)]);
    let written = loaded.write(bvh::write, &clip, &[0]).unwrap();
    let again = bvh::read(&written, &Limits::default()).unwrap();
    assert_eq!(again.clip, clip);
    assert_eq!(again.notes, []);
}

#[test]
fn what_has_no_channel_is_refused_or_noted() {
    let text = small(1, "Yrotation", &["10.00"]);
    let loaded = Loaded::new(parse(&text), SourceSpace::SINEW);
    let mut clip = loaded.clip.clone();
    clip.set_rotation(0, 0, DQuat::from_rotation_y(0.5) * DQuat::from_rotation_x(0.2));
    let error = loaded.write(bvh::write, &clip, &[0]).unwrap_err().to_string();
    for word in ["frame 0", "joint hips", "no rotation channel", "new file"] {
        assert!(error.contains(word), "{error}");
    }
    let source = sinew_motion::formats::Source {
        document: &loaded.parsed.document,
        clip: &loaded.clip,
        space: loaded.space,
        rows: &[0],
    };
    let mut out = Vec::new();
    let notes = bvh::write_nearest(&mut out, &WriteJob { clip: &clip, source: Some(source) }).unwrap();
    assert!(notes.len() == 1 && notes[0].text.contains("joint hips"), "{notes:?}");
    assert!(String::from_utf8(out).unwrap().contains("\n28.65\n"), "the nearest angle is 0.5 rad");

    let mut clip = loaded.clip.clone();
    clip.skeleton_mut().edit(|_, _, rest, _| rest.translation.x += 1e-7);
    assert_eq!(loaded.write(bvh::write, &clip, &[0]).unwrap(), text.as_bytes());
    clip.skeleton_mut().edit(|_, _, rest, _| rest.translation.x += 1e-3);
    let error = loaded.write(bvh::write, &clip, &[0]).unwrap_err().to_string();
    assert!(error.contains("no position channel") && error.contains("0.001"), "{error}");
}

#[test]
fn a_clip_that_does_not_fit_its_file_is_refused() {
    let loaded = Loaded::new(parse(&small(1, "Yrotation", &["10", "20"])), SourceSpace::SINEW);
    let refused = |clip: &Clip, rows: &[usize]| loaded.write(bvh::write, clip, rows).unwrap_err().to_string();
    assert!(refused(&loaded.clip, &[0]).contains("source rows are named for 1 frames, the motion has 2"));
    assert!(refused(&loaded.clip, &[0, 2]).contains("source row 2 is named, but the file has 2"));
    let other = Clip::new(Skeleton::new(), 1.0, vec![]);
    assert!(refused(&other, &[]).contains("the motion has 0 joints, its file has 1"));
    let mut broken = loaded.clip.clone();
    broken.set_rotation(1, 0, DQuat::from_xyzw(f64::NAN, 0.0, 0.0, 1.0));
    assert!(refused(&broken, &[0, 1]).contains("frame 1 of joint hips is not finite"));
}

#[test]
fn an_edited_amc_changes_only_its_own_words() {
    let Some(folder) = mocap() else { return };
    for name in ["07_01", "49_18", "16_15"] {
        let path = folder.join(format!("cmu_asfamc/{name}.amc"));
        let before = std::fs::read(&path).unwrap();
        let loaded = Loaded::new(read_amc(&path), awkward_space());
        let mut clip = loaded.clip.clone();
        let bone = clip.skeleton().find("lfemur").unwrap();
        let turned = clip.rotation(5, bone) * DQuat::from_rotation_y(0.05);
        clip.set_rotation(5, bone, turned);
        clip.set_translation(6, 0, clip.translation(6, 0) + DVec3::new(0.25, 0.0, 0.0));
        let after = loaded.write(amc::write, &clip, &loaded.rows()).unwrap();
        let differ = changed(&before, &after);
        assert!((2..=4).contains(&differ.len()), "{name}: {differ:?}");
        let Document::Amc(document) = &loaded.parsed.document else { panic!("an AMC") };
        let again = amc::read(&after, document.skeleton_bytes(), &Limits::default()).unwrap();
        let again = awkward_space().clip_to_world(&again.clip);
        let apart = 2.0 * libm::asin((again.rotation(5, bone).conjugate() * turned).xyz().length());
        // Six decimals of a degree, three angles.
        assert!(apart < 3.0 * 5e-7f64.to_radians(), "{apart}");
        assert!(again.translation(6, 0).distance(clip.translation(6, 0)) < 1e-6);
        assert_eq!(again.rotations(4), loaded.clip.rotations(4));
    }
}

#[test]
fn an_amc_knee_of_one_axis_keeps_what_it_can() {
    let Some(folder) = mocap() else { return };
    let loaded = Loaded::new(read_amc(&folder.join("cmu_asfamc/07_01.amc")), awkward_space());
    let mut clip = loaded.clip.clone();
    let knee = clip.skeleton().find("ltibia").unwrap();
    clip.set_rotation(9, knee, clip.rotation(9, knee) * DQuat::from_rotation_y(0.1));
    let rows = loaded.rows();
    let error = loaded.write(amc::write, &clip, &rows).unwrap_err().to_string();
    assert!(error.contains("ltibia"), "{error}");
    let document = &loaded.parsed.document;
    let source = sinew_motion::formats::Source { document, clip: &loaded.clip, space: loaded.space, rows: &rows };
    let mut out = Vec::new();
    let notes = amc::write_nearest(&mut out, &WriteJob { clip: &clip, source: Some(source) }).unwrap();
    assert!(notes.len() == 1 && notes[0].text.contains("ltibia"), "{notes:?}");
}

#[test]
fn amc_frames_that_are_left_out_or_repeated_are_counted_on() {
    let Some(folder) = mocap() else { return };
    let path = folder.join("cmu_asfamc/16_15.amc");
    let loaded = Loaded::new(read_amc(&path), SourceSpace::SINEW);
    let pick = |rows: &[usize]| {
        let mut clip =
            Clip::new(loaded.clip.skeleton().clone(), loaded.clip.frame_time_secs(), loaded.clip.moving().to_vec());
        for &row in rows {
            let locals: Vec<Transform> =
                (0..clip.skeleton().len()).map(|joint| loaded.clip.local(row, joint)).collect();
            clip.push(&locals);
        }
        let written = loaded.write(amc::write, &clip, rows).unwrap();
        let Document::Amc(document) = &loaded.parsed.document else { panic!("an AMC") };
        let again = amc::read(&written, document.skeleton_bytes(), &Limits::default()).unwrap();
        assert_eq!(again.clip, clip);
        assert!(!again.notes.iter().any(|note| note.text.contains("frame numbers")), "{:?}", again.notes);
        let text = String::from_utf8(written).unwrap();
        text.lines().filter_map(|line| line.parse().ok()).collect::<Vec<usize>>()
    };
    // The file's first frame bears the number 10.
    assert_eq!(pick(&[5, 6, 7]), [15, 16, 17]);
    assert_eq!(pick(&[5, 5, 3]), [15, 16, 17]);
}

#[test]
fn a_skeleton_with_rest_rotations_keeps_its_places_in_new_files() {
    let turn = |x: f64, y: f64, z: f64| DQuat::from_euler(glam::EulerRot::XYZ, x, y, z);
    let mut skeleton = Skeleton::new();
    let mut push = |name: &str, parent, rotation, at: [f64; 3], tip: Option<[f64; 3]>| {
        let rest = Transform::new(rotation, at.into());
        skeleton.push(Joint { name: name.into(), parent, rest, tip: tip.map(DVec3::from) })
    };
    let hips = push("hips of {one}", None, turn(0.3, -1.2, 0.4), [0.1, 1.0, -0.2], None);
    let spine = push("spine", Some(hips), turn(1.5, 0.2, -0.7), [0.0, 0.2, 0.05], None);
    let leg = push("leg", Some(hips), turn(-1.0, 0.9, 2.0), [0.1, -0.05, 0.0], Some([0.0, 0.4, 0.0]));
    push("head", Some(spine), turn(0.0, 0.0, 1.0), [0.0, 0.3, 0.0], None);
    push("leg", Some(leg), turn(0.1, 0.0, 0.0), [0.0, 0.4, 0.0], Some([0.0, 0.1, 0.2]));
    push("", Some(spine), turn(0.0, 2.0, 0.0), [0.2, 0.25, 0.0], Some([0.1, 0.0, 0.0]));
    let mut clip = Clip::new(skeleton, 0.02, vec![hips, leg]);
    for frame in 0..20 {
        let swing = f64::from(frame) * 0.37;
        let locals = clip.skeleton().joints().iter().enumerate().map(|(index, joint)| {
            let bend = turn(swing * (index as f64 + 1.0), libm::sin(swing), 0.5 * swing);
            Transform::new(joint.rest.rotation * bend, joint.rest.translation + DVec3::splat(0.01 * swing))
        });
        let locals: Vec<Transform> = locals.collect();
        clip.push(&locals);
    }
    let job = WriteJob { clip: &clip, source: None };
    let mut out = Vec::new();
    bvh::write(&mut out, &job).unwrap();
    let parsed = bvh::read(&out, &Limits::default()).unwrap();
    assert_eq!(parsed.notes, []);
    let copy = SourceSpace { unit_m: 0.01, world_from_source: DQuat::IDENTITY }.clip_to_world(&parsed.clip);
    // Depth first, unlike the skeleton above; names that cannot be written are changed.
    let order = [0, 1, 3, 5, 2, 4];
    let names: Vec<&str> = copy.skeleton().joints().iter().map(|joint| joint.name.as_str()).collect();
    assert_eq!(names, ["hips of _one_", "spine", "head", "joint5", "leg", "leg"]);
    let (mut amc_out, mut asf_out) = (Vec::new(), Vec::new());
    amc::write(&mut amc_out, &job).unwrap();
    amc::write_skeleton(&mut asf_out, &clip).unwrap();
    let space = SourceSpace { unit_m: CMU_UNIT_M, world_from_source: DQuat::IDENTITY };
    let acclaim = space.clip_to_world(&amc::read(&amc_out, &asf_out, &Limits::default()).unwrap().clip);
    let bones = ["root", "spine", "leg", "head", "leg_2", "_"].map(|name| acclaim.skeleton().find(name).unwrap());
    for frame in 0..clip.frames() {
        let (world, copied, bones_at) = (clip.world(frame), copy.world(frame), acclaim.world(frame));
        for (index, &joint) in order.iter().enumerate() {
            // Six decimals of a centimetre and of a degree, in a metre.
            assert!(world[joint].translation.distance(copied[index].translation) < 1e-7, "{joint} {frame}");
            assert!(world[joint].translation.distance(bones_at[bones[joint]].translation) < 3e-7, "{joint} {frame}");
        }
        let tip = world[4].point(DVec3::new(0.0, 0.1, 0.2));
        assert!(tip.distance(copied[5].point(copy.skeleton().joints()[5].tip.unwrap())) < 1e-7);
    }
}

/// A file of one joint.
fn small(channels: usize, rotations: &str, rows: &[&str]) -> String {
    let positions = if channels == 6 { "Xposition Yposition Zposition " } else { "" };
    format!(
        "HIERARCHY\nROOT hips\n{{\n OFFSET 0 0 0\n CHANNELS {channels} {positions}{rotations}\n End Site\n {{\n  OFFSET 0 1 \
         0\n }}\n}}\nMOTION\nFrames: {}\nFrame Time: 0.008\n{}\n",
        rows.len(),
        rows.join("\n")
    )
}
