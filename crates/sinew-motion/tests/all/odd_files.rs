//! Files that are valid and not what a reader expects, each made here as small as it goes.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use glam::{DQuat, DVec3};
use sinew_motion::formats::{MotionFile, ReadOptions, Source, WriteJob, amc, bvh, fbx};
use sinew_motion::{Clip, Joint, Limits, Skeleton, Transform};
use std::path::Path;

/// Arms, legs, trunk: enough of a body for a stature, in metres, as it stands.
const BODY: [(&str, Option<usize>, [f64; 3]); 17] = [
    ("hips", None, [0.0, 0.95, 0.0]),
    ("spine", Some(0), [0.0, 0.12, 0.0]),
    ("chest", Some(1), [0.0, 0.15, 0.0]),
    ("neck", Some(2), [0.0, 0.25, 0.0]),
    ("head", Some(3), [0.0, 0.08, 0.0]),
    ("leftUpperArm", Some(2), [0.18, 0.2, 0.0]),
    ("leftLowerArm", Some(5), [0.28, 0.0, 0.0]),
    ("leftHand", Some(6), [0.25, 0.0, 0.0]),
    ("rightUpperArm", Some(2), [-0.18, 0.2, 0.0]),
    ("rightLowerArm", Some(8), [-0.28, 0.0, 0.0]),
    ("rightHand", Some(9), [-0.25, 0.0, 0.0]),
    ("leftUpperLeg", Some(0), [0.09, -0.05, 0.0]),
    ("leftLowerLeg", Some(11), [0.0, -0.42, 0.0]),
    ("leftFoot", Some(12), [0.0, -0.4, 0.0]),
    ("rightUpperLeg", Some(0), [-0.09, -0.05, 0.0]),
    ("rightLowerLeg", Some(14), [0.0, -0.42, 0.0]),
    ("rightFoot", Some(15), [0.0, -0.4, 0.0]),
];

/// What stands beyond the last joints.
const ENDS: [(usize, [f64; 3]); 5] = [
    (4, [0.0, 0.2, 0.0]),
    (7, [0.18, 0.0, 0.0]),
    (10, [-0.18, 0.0, 0.0]),
    (13, [0.0, -0.07, 0.16]),
    (16, [0.0, -0.07, 0.16]),
];

fn skeleton(tips: bool) -> Skeleton {
    let mut skeleton = Skeleton::new();
    for (index, (name, parent, offset)) in BODY.into_iter().enumerate() {
        let tip = ENDS.iter().find(|(joint, _)| tips && *joint == index).map(|(_, tip)| DVec3::from(*tip));
        let rest = Transform::new(DQuat::IDENTITY, offset.into());
        skeleton.push(Joint { name: name.to_owned(), parent, rest, tip });
    }
    skeleton
}

/// A body that sways for twelve frames.
fn swaying(skeleton: Skeleton) -> Clip {
    let hips = skeleton.joints().iter().position(|joint| joint.name == "hips").unwrap();
    let rest: Vec<Transform> = skeleton.joints().iter().map(|joint| joint.rest).collect();
    let mut clip = Clip::new(skeleton, 1.0 / 60.0, vec![hips]);
    for frame in 0..12 {
        let mut locals = rest.clone();
        locals[hips].translation += DVec3::new(0.01, 0.002, 0.02) * f64::from(frame);
        clip.push(&locals);
    }
    clip
}

fn fresh_bvh(clip: &Clip) -> Vec<u8> {
    let mut bytes = Vec::new();
    bvh::write(&mut bytes, &WriteJob { clip, source: None::<Source<'_>> }).unwrap();
    bytes
}

fn read_bvh(bytes: &[u8]) -> MotionFile {
    MotionFile::from_bvh(bytes, &ReadOptions::default()).unwrap()
}

#[test]
fn leaves_that_only_mark_ends_are_ends_under_all_their_names() {
    let whole = read_bvh(&fresh_bvh(&swaying(skeleton(true))));
    for name in ["_end", "_End", "Nub", "_nub", "_tip", "_End_01", "End", " Nub"] {
        let mut marked = skeleton(false);
        for (joint, offset) in ENDS {
            let rest = Transform::new(DQuat::IDENTITY, offset.into());
            let name = format!("{}{name}", BODY[joint].0);
            marked.push(Joint { name, parent: Some(joint), rest, tip: None });
        }
        let marked = read_bvh(&fresh_bvh(&swaying(marked)));
        assert!((marked.stature_m - whole.stature_m).abs() < 1e-6, "{name}: {} m", marked.stature_m);
    }
    // A joint that is called so by chance is none.
    let mut bent = skeleton(false);
    bent.push(Joint {
        name: "bend".into(),
        parent: Some(4),
        rest: Transform::new(DQuat::IDENTITY, DVec3::Y),
        tip: None,
    });
    assert_eq!(bent.end(4), None);
}

#[test]
fn positions_of_0_beside_offsets_are_added_to_them_and_a_note_says_so() {
    let body = read_bvh(&fresh_bvh(&swaying(skeleton(true))));
    let mut collapsed = swaying(skeleton(true));
    // Every joint with positions, all 0.
    let every: Vec<usize> = (0..collapsed.skeleton().len()).collect();
    let mut positions = Clip::new(collapsed.skeleton().clone(), collapsed.frame_time_secs(), every);
    for frame in 0..collapsed.frames() {
        let mut locals: Vec<Transform> =
            (0..collapsed.skeleton().len()).map(|joint| collapsed.local(frame, joint)).collect();
        locals.iter_mut().skip(1).for_each(|local| local.translation = DVec3::ZERO);
        positions.push(&locals);
    }
    collapsed = positions;
    let read = read_bvh(&fresh_bvh(&collapsed));
    assert!((read.stature_m - body.stature_m).abs() < 1e-6, "{} m", read.stature_m);
    assert!(read.notes.iter().any(|note| note.to_string().contains("the OFFSET is added")), "{:?}", read.notes);
    for frame in 0..read.clip.frames() {
        for (a, b) in read.clip.world(frame).iter().zip(body.clip.world(frame)) {
            assert!(a.translation.distance(b.translation) < 1e-7);
        }
    }
}

/// The body under an armature that is turned and never moves, under a group.
fn under_armature() -> Clip {
    let turn = DQuat::from_rotation_x(-std::f64::consts::FRAC_PI_2);
    let mut carried = Skeleton::new();
    let group = Transform::new(DQuat::IDENTITY, DVec3::new(0.3, 0.0, 0.0));
    carried.push(Joint { name: "Group".into(), parent: None, rest: group, tip: None });
    carried.push(Joint {
        name: "Armature".into(),
        parent: Some(0),
        rest: Transform::new(turn, DVec3::ZERO),
        tip: None,
    });
    for joint in skeleton(true).joints() {
        let parent = joint.parent.map_or(1, |parent| parent + 2);
        let rest = if joint.parent.is_none() {
            Transform::new(turn.conjugate(), turn.conjugate() * joint.rest.translation)
        } else {
            joint.rest
        };
        carried.push(Joint { name: joint.name.clone(), parent: Some(parent), rest, tip: joint.tip });
    }
    swaying(carried)
}

#[test]
fn a_helper_above_the_hips_is_no_root_of_a_written_file() {
    let clip = under_armature();
    let text = String::from_utf8(fresh_bvh(&clip)).unwrap();
    assert!(text.starts_with("HIERARCHY\nROOT hips\n"), "{}", &text[..80]);
    assert_eq!(text.matches("Xposition").count(), 1, "the root alone travels");
    let again = bvh::read(text.as_bytes(), &Limits::default()).unwrap().clip;
    let (mut asf, mut motion) = (Vec::new(), Vec::new());
    amc::write_skeleton(&mut asf, &clip).unwrap();
    amc::write(&mut motion, &WriteJob { clip: &clip, source: None }).unwrap();
    let amc = amc::read(&motion, &asf, &Limits::default()).unwrap();
    let unit_m = amc.unit_m.unwrap();
    for frame in 0..clip.frames() {
        let world = clip.world(frame);
        for (joint, at) in world.iter().enumerate().skip(2) {
            let name = &clip.skeleton().joints()[joint].name;
            let bvh_at = again.world(frame)[again.skeleton().find(name).unwrap()].translation * 0.01;
            // Six decimals of centimetres.
            assert!(bvh_at.distance(at.translation) < 1e-7, "{name}: {bvh_at} {}", at.translation);
        }
        // An ASF names its root `root`.
        let hips = amc.clip.world(frame)[0].translation * unit_m;
        assert!(hips.distance(world[2].translation) < 1e-6, "{hips} {}", world[2].translation);
    }
}

#[test]
fn a_written_skeleton_has_a_limit_for_each_degree_of_freedom() {
    let mut asf = Vec::new();
    amc::write_skeleton(&mut asf, &swaying(skeleton(true))).unwrap();
    let text = String::from_utf8(asf).unwrap();
    let dof: usize = text
        .lines()
        .filter(|line| line.trim().starts_with("dof"))
        .map(|line| line.split_whitespace().count() - 1)
        .sum();
    assert_eq!(text.matches("360)").count(), dof);
    assert_eq!(text.matches("limits").count(), text.matches("dof").count());
}

#[test]
fn a_skeleton_alone_is_its_rest_pose() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("body.asf");
    let mut asf = Vec::new();
    amc::write_skeleton(&mut asf, &swaying(skeleton(true))).unwrap();
    std::fs::write(&path, asf).unwrap();
    let file = MotionFile::read(&path, &ReadOptions::default()).unwrap();
    assert_eq!(file.clip.frames(), 1);
    assert!(file.notes.iter().any(|note| note.to_string().contains("a skeleton without a motion")));
    let error = MotionFile::read(Path::new("nowhere.asf"), &ReadOptions::default()).unwrap_err();
    assert!(!error.to_string().contains("AMC"), "{error}");
}

/// Hips, arm and hand as FBX text: the arm stands up in the nodes; in the bind pose, if there is one, it lies along X.
fn fbx_text(bound: &[(u32, [f64; 3])]) -> String {
    let axes = [("UpAxis", 1), ("FrontAxis", 2), ("CoordAxis", 0)];
    let axes = axes.map(|(name, axis)| {
        format!("P: \"{name}\", \"int\", \"Integer\", \"\",{axis}\nP: \"{name}Sign\", \"int\", \"Integer\", \"\",1\n")
    });
    let bones =
        [(1, "hips", [0.0, 1.0, 0.0], 0.0), (2, "arm", [0.5, 0.0, 0.0], 90.0), (3, "hand", [0.3, 0.0, 0.0], 0.0)];
    let objects = bones.map(|(id, name, [x, y, z], degrees)| {
        format!(
            "NodeAttribute: 1{id}, \"NodeAttribute::{name}\", \"LimbNode\" {{\nTypeFlags: \"Skeleton\"\n}}\n\
             Model: {id}, \"Model::{name}\", \"LimbNode\" {{\nVersion: 232\nProperties70:  {{\n\
             P: \"Lcl Translation\", \"Lcl Translation\", \"\", \"A\",{x},{y},{z}\n\
             P: \"Lcl Rotation\", \"Lcl Rotation\", \"\", \"A\",0,0,{degrees}\n}}\n}}\n"
        )
    });
    let nodes: Vec<String> = bound
        .iter()
        .map(|(id, [x, y, z])| {
            format!("PoseNode:  {{\nNode: {id}\nMatrix: *16 {{\na: 1,0,0,0,0,1,0,0,0,0,1,0,{x},{y},{z},1\n}}\n}}\n")
        })
        .collect();
    let pose = format!(
        "Pose: 9, \"Pose::bind\", \"BindPose\" {{\nType: \"BindPose\"\nVersion: 100\nNbPoseNodes: {}\n{}}}\n",
        nodes.len(),
        nodes.concat()
    );
    let links =
        [(1, 0), (2, 1), (3, 2), (11, 1), (12, 2), (13, 3)].map(|(one, other)| format!("C: \"OO\",{one},{other}\n"));
    format!(
        "; FBX 7.4.0 project file\nFBXHeaderExtension:  {{\nFBXHeaderVersion: 1003\nFBXVersion: 7400\n}}\nGlobalSettings:  {{\nVersion: \
         1000\nProperties70:  {{\n{}P: \"UnitScaleFactor\", \"double\", \"Number\", \"\",100\n}}\n}}\nObjects:  \
         {{\n{}{}}}\nConnections:  {{\n{}}}\n",
        axes.concat(),
        objects.concat(),
        if bound.is_empty() { String::new() } else { pose },
        links.concat()
    )
}

#[test]
fn the_bind_pose_of_an_fbx_is_its_rest_pose_and_its_nodes_are_its_frame() {
    let hand = |text: &str| {
        let clip = fbx::read(text.as_bytes(), &Limits::default()).unwrap().clip;
        [clip.skeleton().rest_world()[2].translation, clip.world(0)[2].translation]
    };
    let (up, along) = (DVec3::new(0.5, 1.3, 0.0), DVec3::new(0.8, 1.0, 0.0));
    let whole = [(1, [0.0, 1.0, 0.0]), (2, [0.5, 1.0, 0.0]), (3, [0.8, 1.0, 0.0])];
    for (bound, rest) in [(&whole[..], along), (&[], up), (&whole[..2], along), (&whole[1..], up)] {
        let [rests, stands] = hand(&fbx_text(bound));
        // A bone above bound ones that is in no pose leaves the nodes'.
        assert!(rests.distance(rest) < 1e-9, "{} bound: {rests}", bound.len());
        assert!(stands.distance(up) < 1e-9, "{} bound: {stands}", bound.len());
    }
}
