//! Every captured person is mapped, whatever the dialect of the joints' names; everything else is refused with a reason.

use crate::analysis::{Body, files, joint_name, name_of, read};
use sinew_motion::{Humanoid, Origin, Part};
use sinew_testkit::mocap;

/// Joint names of one dialect: midline, then the left ones from the shoulder and from the upper leg.
struct Dialect {
    files: &'static [&'static str],
    midline: [&'static str; 5],
    arm: [&'static str; 4],
    leg: [&'static str; 4],
    right: fn(&str) -> String,
    spine_chain: &'static [&'static str],
    neck_chain: &'static [&'static str],
}

fn left_to_right(name: &str) -> String {
    name.replacen("Left", "Right", 1)
}

fn l_to_r(name: &str) -> String {
    name.strip_prefix('l').map_or(String::new(), |rest| format!("r{rest}"))
}

const MOTION_BUILDER_ARM: [&str; 4] = ["LeftShoulder", "LeftArm", "LeftForeArm", "LeftHand"];
const MOTION_BUILDER_LEG: [&str; 4] = ["LeftUpLeg", "LeftLeg", "LeftFoot", "LeftToeBase"];

const DIALECTS: &[Dialect] = &[
    Dialect {
        files: &[
            "cmu_bvh_motionbuilder",
            "cmu_bvh_60hz_trimmed",
            "07_01__crlf_tabs_sci.bvh",
            "07_01__rotation_first_mixed_orders.bvh",
            "07_01__six_channels_yxz.bvh",
            "07_01__zup_metres_xyz_rootoffset.bvh",
        ],
        midline: ["Hips", "LowerBack", "Spine1", "Neck", "Head"],
        arm: MOTION_BUILDER_ARM,
        leg: MOTION_BUILDER_LEG,
        right: left_to_right,
        spine_chain: &["LowerBack", "Spine", "Spine1"],
        neck_chain: &["Neck", "Neck1", "Head"],
    },
    Dialect {
        files: &["07_01__mixamo_names_cm.bvh"],
        midline: ["mixamorig:Hips", "mixamorig:Spine", "mixamorig:Spine2", "mixamorig:Neck", "mixamorig:Head"],
        arm: ["mixamorig:LeftShoulder", "mixamorig:LeftArm", "mixamorig:LeftForeArm", "mixamorig:LeftHand"],
        leg: ["mixamorig:LeftUpLeg", "mixamorig:LeftLeg", "mixamorig:LeftFoot", "mixamorig:LeftToeBase"],
        right: left_to_right,
        spine_chain: &["mixamorig:Spine", "mixamorig:Spine1", "mixamorig:Spine2"],
        neck_chain: &["mixamorig:Neck", "mixamorig:Neck1", "mixamorig:Head"],
    },
    Dialect {
        files: &["cmu_bvh_daz"],
        midline: ["hip", "abdomen", "chest", "neck", "head"],
        arm: ["lCollar", "lShldr", "lForeArm", "lHand"],
        leg: ["lThigh", "lShin", "lFoot", ""],
        right: l_to_r,
        spine_chain: &["abdomen", "chest"],
        neck_chain: &["neck", "head"],
    },
    Dialect {
        files: &["131_01.bvh", "animateddrawings_jumping_jacks.bvh"],
        midline: ["Hips", "lowerback", "Chest2", "lowerneck", "Head"],
        arm: ["LeftCollar", "LeftShoulder", "LeftElbow", "LeftWrist"],
        leg: ["LeftHip", "LeftKnee", "LeftAnkle", "LeftToe"],
        right: left_to_right,
        spine_chain: &["lowerback", "Chest", "Chest2"],
        neck_chain: &["lowerneck", "Neck", "Head"],
    },
    Dialect {
        files: &["accad_bvh"],
        midline: ["Hips", "ToSpine", "Spine1", "Neck", "Head"],
        arm: MOTION_BUILDER_ARM,
        leg: MOTION_BUILDER_LEG,
        right: left_to_right,
        spine_chain: &["ToSpine", "Spine", "Spine1"],
        neck_chain: &["Neck", "Head"],
    },
    Dialect {
        files: &["cmu_asfamc"],
        midline: ["root", "lowerback", "thorax", "lowerneck", "head"],
        arm: ["lclavicle", "lhumerus", "lradius", "lwrist"],
        leg: ["lfemur", "ltibia", "lfoot", "ltoes"],
        right: l_to_r,
        spine_chain: &["lowerback", "upperback", "thorax"],
        neck_chain: &["lowerneck", "upperneck", "head"],
    },
    Dialect {
        files: &["rokoko_jesse_dance.bvh"],
        midline: ["Hips", "Spine", "Spine2", "Neck", "Head"],
        arm: MOTION_BUILDER_ARM,
        leg: MOTION_BUILDER_LEG,
        right: left_to_right,
        spine_chain: &["Spine", "Spine1", "Spine2"],
        neck_chain: &["Neck", "Head"],
    },
    Dialect {
        files: &["fair_zombie.bvh"],
        midline: ["Hips", "Spine", "Spine3", "Neck", "Head"],
        arm: MOTION_BUILDER_ARM,
        leg: MOTION_BUILDER_LEG,
        right: left_to_right,
        spine_chain: &["Spine", "Spine1", "Spine2", "Spine3"],
        neck_chain: &["Neck", "Head"],
    },
    Dialect {
        files: &["pybvh_example.bvh"],
        midline: ["Hips", "Spine", "Spine3", "Neck", "Head"],
        arm: MOTION_BUILDER_ARM,
        leg: MOTION_BUILDER_LEG,
        right: left_to_right,
        spine_chain: &["Spine", "Spine1", "Spine2", "Spine3"],
        neck_chain: &["Neck", "Neck1", "Head"],
    },
    Dialect {
        files: &["bvhtoolbox_walk01.bvh"],
        midline: ["Hips", "Spine", "Spine1", "Neck", "Head"],
        arm: MOTION_BUILDER_ARM,
        leg: ["LeftUpLeg", "LeftLeg", "LeftFoot", ""],
        right: left_to_right,
        spine_chain: &["Spine", "Spine1"],
        neck_chain: &["Neck", "Head"],
    },
    Dialect {
        files: &["walk01_template.fbx"],
        midline: ["Hips", "Spine", "Spine1", "Neck", "Head"],
        arm: MOTION_BUILDER_ARM,
        leg: MOTION_BUILDER_LEG,
        right: left_to_right,
        spine_chain: &["Spine", "Spine1"],
        neck_chain: &["Neck", "Head"],
    },
    // The arms of this 3ds Max biped hang from its neck, and its legs from the lowest joint of the spine.
    Dialect {
        files: &["ozz_walk.fbx"],
        midline: ["Pelvis", "Spine", "Spine3", "Neck", "Head"],
        arm: ["LeftShoulder", "LeftArm", "LeftForeArm", "Lefthand"],
        leg: ["LeftUpLeg", "LeftLeg", "LeftFoot", ""],
        right: |name| if name == "Lefthand" { "RightHand".to_owned() } else { left_to_right(name) },
        spine_chain: &["Spine", "Spine1", "Spine2", "Spine3"],
        neck_chain: &["Neck", "Head"],
    },
    // The shoulders hang beside the thorax, from the upper back.
    Dialect {
        files: &["gpmat_Swagger.bvh"],
        midline: ["root", "lowerback", "upperback", "neck", "head"],
        arm: ["lshoulderjoint", "lhumerus", "lradius", "lhand"],
        leg: ["lfemur", "ltibia", "lfoot", "ltoes"],
        right: l_to_r,
        spine_chain: &["lowerback", "upperback"],
        neck_chain: &["thorax", "neck", "head"],
    },
];

#[test]
fn every_captured_person_is_mapped_completely_by_name() {
    let Some(mocap) = mocap() else { return };
    let mut paths = files(&mocap, &[]);
    paths.extend(files(&mocap, &["fbx"]));
    for path in paths {
        let (file, folder) = (name_of(&path), name_of(path.parent().unwrap()));
        let dialect =
            DIALECTS.iter().find(|dialect| dialect.files.iter().any(|known| *known == file || *known == folder));
        let dialect = dialect.unwrap_or_else(|| panic!("no dialect is known for {file}"));
        let parsed = read(&path);
        let humanoid = Humanoid::of(&parsed.clip, &[]).unwrap_or_else(|error| panic!("{file}: {error}"));
        let mut expected: Vec<(Part, String)> = [Part::Hips, Part::Spine, Part::Chest, Part::Neck, Part::Head]
            .into_iter()
            .zip(dialect.midline.map(str::to_owned))
            .collect();
        let left = [
            [Part::LeftShoulder, Part::LeftUpperArm, Part::LeftLowerArm, Part::LeftHand],
            [Part::LeftUpperLeg, Part::LeftLowerLeg, Part::LeftFoot, Part::LeftToes],
        ];
        for (part, name) in left.concat().into_iter().zip([dialect.arm, dialect.leg].concat()) {
            expected.push((part, name.to_owned()));
            expected.push((part.mirrored(), (dialect.right)(name)));
        }
        for (part, name) in expected {
            assert_eq!(joint_name(&parsed.clip, humanoid.joint(part)), name, "{file}: {part}");
            assert_ne!(humanoid.origin(part), Some(Origin::Shape), "{file}: {part}");
        }
        let names = |chain: &[usize]| -> Vec<String> {
            chain.iter().map(|&joint| joint_name(&parsed.clip, Some(joint))).collect()
        };
        assert_eq!(names(humanoid.spine_chain()), dialect.spine_chain, "{file}");
        assert_eq!(names(humanoid.neck_chain()), dialect.neck_chain, "{file}");
        assert_eq!(humanoid.unmapped().len() + humanoid.parts().count(), parsed.clip.skeleton().len(), "{file}");
        assert!(humanoid.notes().is_empty(), "{file}: {:?}", humanoid.notes());
    }
}

/// Without names the shape must give the same body; only which joint of the neck is the lowest is open.
#[test]
fn nameless_joints_are_mapped_by_shape_to_the_same_parts() {
    let Some(mocap) = mocap() else { return };
    for path in files(&mocap, &[]) {
        let parsed = read(&path);
        let named = Humanoid::of(&parsed.clip, &[]).unwrap();
        let mut clip = parsed.clip.clone();
        clip.skeleton_mut().edit(|joint, name, _, _| *name = format!("node_{joint}"));
        let shaped = Humanoid::of(&clip, &[]).unwrap_or_else(|error| panic!("{}: {error}", name_of(&path)));
        for &part in Part::ALL.iter().filter(|&&part| part != Part::Neck) {
            // The wrist bone of the ASF has length: its hand is not told by shape.
            let same_limb = part.name().ends_with("Hand") && name_of(&path).ends_with("amc");
            assert!(named.joint(part) == shaped.joint(part) || same_limb, "{}: {part}", name_of(&path));
        }
        assert_eq!(named.spine_chain(), shaped.spine_chain(), "{}", name_of(&path));
        assert!(!shaped.notes().is_empty());
    }
}

#[test]
fn numbered_and_nameless_game_rigs_are_mapped() {
    let Some(mocap) = mocap() else { return };
    let body = Body::load(&mocap.join("gltf/CesiumMan.glb"));
    for (part, name) in [
        (Part::Hips, "Skeleton_torso_joint_1"),
        (Part::Chest, "torso_joint_3"),
        (Part::Head, "Skeleton_neck_joint_2"),
        (Part::LeftUpperArm, "Skeleton_arm_joint_L__4_"),
        (Part::LeftLowerArm, "Skeleton_arm_joint_L__3_"),
        (Part::LeftHand, "Skeleton_arm_joint_L__2_"),
        (Part::RightUpperArm, "Skeleton_arm_joint_R"),
        (Part::RightLowerArm, "Skeleton_arm_joint_R__2_"),
        (Part::LeftUpperLeg, "leg_joint_L_1"),
        (Part::LeftLowerLeg, "leg_joint_L_2"),
        (Part::LeftFoot, "leg_joint_L_3"),
        (Part::RightToes, "leg_joint_R_5"),
    ] {
        assert_eq!(body.joint_name(part), name, "{part}");
    }
    // The same man without names, by another exporter: the same bones, so the same lengths.
    let nameless = Body::load(&mocap.join("gltf/cesium_man.gltf"));
    for (part, joint) in body.humanoid.parts().filter(|(part, _)| *part != Part::Hips) {
        let other = nameless.humanoid.joint(part).unwrap_or_else(|| panic!("{part}"));
        let (here, there) = (body.clip.translation(0, joint).length(), nameless.clip.translation(0, other).length());
        // One exporter has bones change their length by millimetres as they move.
        assert!((here - there).abs() < 0.005, "{part}: {here} {there}");
    }
}

#[test]
fn a_fox_and_a_cylinder_are_refused_with_the_reason() {
    let Some(mocap) = mocap() else { return };
    let refused = |file: &str| Humanoid::of(&read(&mocap.join(file)).clip, &[]).unwrap_err().to_string();
    let fox = refused("gltf/Fox.glb");
    assert!(fox.contains("four-legged") && fox.contains("b_Tail01_012"), "{fox}");
    let cylinder = refused("gltf/RiggedSimple.glb");
    assert!(cylinder.contains("no pair of equal limbs"), "{cylinder}");
}

#[test]
fn an_override_wins_over_the_name() {
    let Some(mocap) = mocap() else { return };
    let clip = read(&mocap.join("cmu_bvh_motionbuilder/07_01.bvh")).clip;
    let humanoid =
        Humanoid::of(&clip, &[(Part::Chest, "Spine".to_owned()), (Part::LeftHand, "LeftFingerBase".to_owned())])
            .unwrap();
    assert_eq!(joint_name(&clip, humanoid.joint(Part::LeftHand)), "LeftFingerBase");
    assert_eq!(joint_name(&clip, Some(humanoid.chest())), "Spine");
    assert_eq!(humanoid.origin(Part::Chest), Some(Origin::Override));
    let error = Humanoid::of(&clip, &[(Part::Chest, "Thorax".to_owned())]).unwrap_err().to_string();
    assert!(error.contains("\"Thorax\"") && error.contains("\"Spine1\""), "{error}");
}

#[test]
fn a_leg_that_hangs_from_an_arm_is_refused() {
    let Some(mocap) = mocap() else { return };
    let clip = read(&mocap.join("cmu_bvh_motionbuilder/07_01.bvh")).clip;
    let error = Humanoid::of(&clip, &[(Part::LeftFoot, "LeftHand".to_owned())]).unwrap_err().to_string();
    assert!(error.contains("leftFoot"), "{error}");
}
