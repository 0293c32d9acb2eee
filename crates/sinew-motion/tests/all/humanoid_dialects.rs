//! Dialects of joint names of which no file is at hand, on one made-up body.

use glam::DVec3;
use sinew_motion::{Clip, Humanoid, Joint, Part, Skeleton, Transform};

/// Names in the order of [`BONES`], the left ones; `turn` makes a right name of a left one. Empty: there is no such joint.
struct Dialect {
    name: &'static str,
    names: [&'static str; 14],
    turn: fn(&str) -> String,
}

/// Part, index of the parent in this list, place in the parent \[m\]; sided ones for the left.
const BONES: [(Part, usize, [f64; 3]); 14] = [
    (Part::Hips, 0, [0.0, 0.95, 0.0]),
    (Part::Spine, 0, [0.0, 0.1, 0.0]),
    (Part::Chest, 1, [0.0, 0.15, 0.0]),
    (Part::UpperChest, 2, [0.0, 0.12, 0.0]),
    (Part::Neck, 3, [0.0, 0.16, 0.0]),
    (Part::Head, 4, [0.0, 0.09, 0.01]),
    (Part::LeftShoulder, 3, [0.03, 0.1, 0.0]),
    (Part::LeftUpperArm, 6, [0.14, 0.0, 0.0]),
    (Part::LeftLowerArm, 7, [0.28, 0.0, 0.0]),
    (Part::LeftHand, 8, [0.25, 0.0, 0.0]),
    (Part::LeftUpperLeg, 0, [0.09, -0.05, 0.0]),
    (Part::LeftLowerLeg, 10, [0.0, -0.42, 0.0]),
    (Part::LeftFoot, 11, [0.0, -0.41, 0.0]),
    (Part::LeftToes, 12, [0.0, -0.06, 0.13]),
];

fn replace(from: &'static str, to: &'static str) -> impl Fn(&str) -> String {
    move |name| name.replacen(from, to, 1)
}

const DIALECTS: &[Dialect] = &[
    Dialect {
        name: "VRoid",
        names: [
            "J_Bip_C_Hips",
            "J_Bip_C_Spine",
            "J_Bip_C_Chest",
            "J_Bip_C_UpperChest",
            "J_Bip_C_Neck",
            "J_Bip_C_Head",
            "J_Bip_L_Shoulder",
            "J_Bip_L_UpperArm",
            "J_Bip_L_LowerArm",
            "J_Bip_L_Hand",
            "J_Bip_L_UpperLeg",
            "J_Bip_L_LowerLeg",
            "J_Bip_L_Foot",
            "J_Bip_L_ToeBase",
        ],
        turn: |name| replace("_L_", "_R_")(name),
    },
    Dialect {
        name: "VRM bones",
        names: [
            "hips",
            "spine",
            "chest",
            "upperChest",
            "neck",
            "head",
            "leftShoulder",
            "leftUpperArm",
            "leftLowerArm",
            "leftHand",
            "leftUpperLeg",
            "leftLowerLeg",
            "leftFoot",
            "leftToes",
        ],
        turn: |name| replace("left", "right")(name),
    },
    Dialect {
        name: "3ds Max biped",
        names: [
            "Bip01 Pelvis",
            "Bip01 Spine",
            "Bip01 Spine1",
            "Bip01 Spine2",
            "Bip01 Neck",
            "Bip01 Head",
            "Bip01 L Clavicle",
            "Bip01 L UpperArm",
            "Bip01 L Forearm",
            "Bip01 L Hand",
            "Bip01 L Thigh",
            "Bip01 L Calf",
            "Bip01 L Foot",
            "Bip01 L Toe0",
        ],
        turn: |name| replace(" L ", " R ")(name),
    },
    Dialect {
        name: "Source engine",
        names: [
            "ValveBiped.Bip01_Pelvis",
            "ValveBiped.Bip01_Spine",
            "ValveBiped.Bip01_Spine1",
            "ValveBiped.Bip01_Spine2",
            "ValveBiped.Bip01_Neck1",
            "ValveBiped.Bip01_Head1",
            "ValveBiped.Bip01_L_Clavicle",
            "ValveBiped.Bip01_L_UpperArm",
            "ValveBiped.Bip01_L_Forearm",
            "ValveBiped.Bip01_L_Hand",
            "ValveBiped.Bip01_L_Thigh",
            "ValveBiped.Bip01_L_Calf",
            "ValveBiped.Bip01_L_Foot",
            "ValveBiped.Bip01_L_Toe0",
        ],
        turn: |name| replace("_L_", "_R_")(name),
    },
    Dialect {
        name: "Unreal",
        names: [
            "pelvis",
            "spine_01",
            "spine_02",
            "spine_03",
            "neck_01",
            "head",
            "clavicle_l",
            "upperarm_l",
            "lowerarm_l",
            "hand_l",
            "thigh_l",
            "calf_l",
            "foot_l",
            "ball_l",
        ],
        turn: |name| name.strip_suffix("_l").map_or(name.to_owned(), |stem| format!("{stem}_r")),
    },
    Dialect {
        name: "Blender Rigify",
        names: [
            "hips",
            "spine",
            "spine.001",
            "chest",
            "neck",
            "head",
            "shoulder.L",
            "upper_arm.L",
            "forearm.L",
            "hand.L",
            "thigh.L",
            "shin.L",
            "foot.L",
            "toe.L",
        ],
        turn: |name| replace(".L", ".R")(name),
    },
    Dialect {
        name: "Mixamo",
        names: [
            "mixamorig:Hips",
            "mixamorig:Spine",
            "mixamorig:Spine1",
            "mixamorig:Spine2",
            "mixamorig:Neck",
            "mixamorig:Head",
            "mixamorig:LeftShoulder",
            "mixamorig:LeftArm",
            "mixamorig:LeftForeArm",
            "mixamorig:LeftHand",
            "mixamorig:LeftUpLeg",
            "mixamorig:LeftLeg",
            "mixamorig:LeftFoot",
            "mixamorig:LeftToeBase",
        ],
        turn: |name| replace("Left", "Right")(name),
    },
    Dialect {
        name: "HumanIK with a character's name",
        names: [
            "Bob_Hips",
            "Bob_Spine",
            "Bob_Spine1",
            "Bob_Spine2",
            "Bob_Neck",
            "Bob_Head",
            "Bob_LeftShoulder",
            "Bob_LeftArm",
            "Bob_LeftForeArm",
            "Bob_LeftHand",
            "Bob_LeftUpLeg",
            "Bob_LeftLeg",
            "Bob_LeftFoot",
            "Bob_LeftToeBase",
        ],
        turn: |name| replace("Left", "Right")(name),
    },
    Dialect {
        name: "SMPL",
        names: [
            "pelvis",
            "spine1",
            "spine2",
            "spine3",
            "neck",
            "head",
            "left_collar",
            "left_shoulder",
            "left_elbow",
            "left_wrist",
            "left_hip",
            "left_knee",
            "left_ankle",
            "left_foot",
        ],
        turn: |name| replace("left", "right")(name),
    },
    Dialect {
        name: "Daz Genesis",
        names: [
            "hip",
            "abdomenLower",
            "abdomenUpper",
            "chestUpper",
            "neckLower",
            "head",
            "lCollar",
            "lShldrBend",
            "lForearmBend",
            "lHand",
            "lThighBend",
            "lShin",
            "lFoot",
            "lToe",
        ],
        turn: |name| name.strip_prefix('l').map_or(name.to_owned(), |stem| format!("r{stem}")),
    },
    Dialect {
        name: "Character Creator",
        names: [
            "CC_Base_Hip",
            "CC_Base_Waist",
            "CC_Base_Spine01",
            "CC_Base_Spine02",
            "CC_Base_NeckTwist01",
            "CC_Base_Head",
            "CC_Base_L_Clavicle",
            "CC_Base_L_Upperarm",
            "CC_Base_L_Forearm",
            "CC_Base_L_Hand",
            "CC_Base_L_Thigh",
            "CC_Base_L_Calf",
            "CC_Base_L_Foot",
            "CC_Base_L_ToeBase",
        ],
        turn: |name| replace("_L_", "_R_")(name),
    },
    Dialect {
        name: "Xsens",
        names: [
            "Pelvis",
            "L5",
            "L3",
            "T8",
            "Neck",
            "Head",
            "LeftShoulder",
            "LeftUpperArm",
            "LeftForeArm",
            "LeftHand",
            "LeftUpperLeg",
            "LeftLowerLeg",
            "LeftFoot",
            "LeftToe",
        ],
        turn: |name| replace("Left", "Right")(name),
    },
    Dialect {
        name: "legs named Leg and Knee, no collar bones",
        names: [
            "Root",
            "Waist",
            "Torso",
            "Chest",
            "Neck",
            "Head",
            "",
            "LeftShoulder",
            "LeftElbow",
            "LeftWrist",
            "LeftLeg",
            "LeftKnee",
            "LeftAnkle",
            "LeftToe",
        ],
        turn: |name| replace("Left", "Right")(name),
    },
];

/// The body with a dialect's names, and for each part the joint that it is.
fn body(dialect: &Dialect) -> (Clip, Vec<(Part, usize)>) {
    let mut skeleton = Skeleton::new();
    let mut parts = Vec::new();
    let mut joints = [[0; BONES.len()]; 2];
    for (at, (part, parent, place)) in BONES.into_iter().enumerate() {
        let sides = if part.side().is_some() { 2 } else { 1 };
        for side in 0..sides {
            let place = DVec3::new(place[0] * [1.0, -1.0][side], place[1], place[2]);
            let up = joints[if BONES[parent].0.side().is_some() { side } else { 0 }][parent];
            let name = dialect.names[at];
            if name.is_empty() {
                joints[side][at] = up;
                continue;
            }
            let name = if side == 0 { name.to_owned() } else { (dialect.turn)(name) };
            assert!(side == 0 || name != dialect.names[at], "{}: {name}", dialect.name);
            let parent = (at > 0).then_some(up);
            let rest = Transform { translation: place, ..Transform::IDENTITY };
            let joint = skeleton.push(Joint { name, parent, rest, tip: None });
            joints[side][at] = joint;
            parts.push((if side == 0 { part } else { part.mirrored() }, joint));
        }
    }
    (Clip::new(skeleton, 1.0 / 60.0, vec![0]), parts)
}

#[test]
fn every_dialect_maps_to_the_same_body() {
    for dialect in DIALECTS {
        let (clip, parts) = body(dialect);
        let humanoid = Humanoid::of(&clip, &[]).unwrap_or_else(|error| panic!("{}: {error}", dialect.name));
        let highest = parts.iter().find(|(part, _)| *part == Part::UpperChest).map(|(_, joint)| *joint);
        assert_eq!(Some(humanoid.chest()), highest, "{}", dialect.name);
        assert!(humanoid.notes().is_empty(), "{}: {:?}", dialect.name, humanoid.notes());
        for (part, joint) in parts {
            // With three joints the chest is the one with the arms unless a rig names an upper chest.
            if !matches!(part, Part::Chest | Part::UpperChest) {
                assert_eq!(humanoid.joint(part), Some(joint), "{}: {part}", dialect.name);
            }
        }
    }
    let vrm = Humanoid::of(&body(&DIALECTS[1]).0, &[]).unwrap();
    assert!(vrm.joint(Part::UpperChest).is_some() && vrm.joint(Part::Chest).is_some());
}

#[test]
fn a_body_called_by_the_wrong_side_is_remarked_upon() {
    let (mut clip, _) = body(&DIALECTS[1]);
    clip.skeleton_mut().edit(|_, name, _, _| {
        let swapped = if name.starts_with("left") {
            name.replacen("left", "right", 1)
        } else {
            name.replacen("right", "left", 1)
        };
        *name = swapped;
    });
    let humanoid = Humanoid::of(&clip, &[]).unwrap();
    assert!(humanoid.notes().iter().any(|note| note.text.contains("mirrored")), "{:?}", humanoid.notes());
}

#[test]
fn what_is_no_body_is_refused_without_panic() {
    let joint = |name: &str, parent| Joint { name: name.to_owned(), parent, rest: Transform::IDENTITY, tip: None };
    let of = |skeleton: Skeleton| Humanoid::of(&Clip::new(skeleton, 0.01, vec![]), &[]);
    assert!(of(Skeleton::new()).is_err());
    let mut one = Skeleton::new();
    one.push(joint("Hips", None));
    assert!(of(one).is_err());
    // All parts by name, every one a root.
    let mut apart = Skeleton::new();
    for part in Part::ALL {
        apart.push(joint(part.name(), None));
    }
    assert!(of(apart).is_err());
    // All parts by name in one chain, all at one place.
    let mut chain = Skeleton::new();
    for (at, part) in Part::ALL.iter().enumerate() {
        chain.push(joint(part.name(), at.checked_sub(1)));
    }
    assert!(of(chain).is_err());
    // A star and a long chain of nameless joints.
    let mut star = Skeleton::new();
    star.push(joint("a", None));
    for _ in 0..1500 {
        star.push(Joint { rest: Transform { translation: DVec3::X, ..Transform::IDENTITY }, ..joint("a", Some(0)) });
    }
    assert!(of(star).is_err());
    let mut long = Skeleton::new();
    for at in 0..1500_usize {
        long.push(Joint { tip: Some(DVec3::NAN), ..joint("", at.checked_sub(1)) });
    }
    assert!(of(long).is_err());
}
