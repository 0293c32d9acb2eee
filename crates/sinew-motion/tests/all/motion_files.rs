//! What the analysis makes of captured motion: unit and up axis, gait, floor and feet, defects, and cycles repeated.

use crate::analysis::{Body, files, name_of};
use sinew_motion::{
    Cycle, DefectKind, Part, Repeated, Side, contacts, facings, filter, find_cycle, find_defects, floor_height_m,
    moves_from, repeat, resample, stature,
};
use sinew_testkit::mocap;

/// Stride period \[s\] and length \[m\] of every walk and run, by an independent script.
const STRIDES: &[(&str, f64, f64)] = &[
    ("cmu_asfamc/02_01.amc", 1.10, 1.32),
    ("cmu_asfamc/06_01.amc", 1.19, 1.28),
    ("cmu_asfamc/07_01.amc", 1.09, 1.49),
    ("cmu_asfamc/08_01.amc", 1.01, 1.57),
    ("cmu_asfamc/16_15.amc", 1.15, 1.27),
    ("cmu_asfamc/35_01.amc", 1.12, 1.44),
    ("cmu_bvh_motionbuilder/02_01.bvh", 1.10, 1.32),
    ("cmu_bvh_motionbuilder/02_03.bvh", 0.77, 2.09),
    ("cmu_bvh_motionbuilder/06_01.bvh", 1.19, 1.28),
    ("cmu_bvh_motionbuilder/06_02.bvh", 1.02, 1.43),
    ("cmu_bvh_motionbuilder/06_06.bvh", 1.05, 1.30),
    ("cmu_bvh_motionbuilder/07_01.bvh", 1.09, 1.49),
    ("cmu_bvh_motionbuilder/08_01.bvh", 1.01, 1.57),
    ("cmu_bvh_motionbuilder/08_11.bvh", 1.47, 1.84),
    ("cmu_bvh_motionbuilder/09_01.bvh", 0.73, 2.65),
    ("cmu_bvh_motionbuilder/09_12.bvh", 1.10, 1.26),
    ("cmu_bvh_motionbuilder/12_01.bvh", 1.27, 1.17),
    ("cmu_bvh_60hz_trimmed/35_01_walk.bvh", 1.12, 1.43),
    ("cmu_bvh_60hz_trimmed/120_08_sneak.bvh", 2.47, 1.41),
    ("cmu_bvh_3dsmax/131_01.bvh", 1.17, 1.45),
    ("accad_bvh/Female1_B03_Walk1.bvh", 1.23, 1.33),
    ("accad_bvh/Female1_B05_WalkBackwards.bvh", 1.37, 1.23),
    ("accad_bvh/Female1_B20_WalkWithBox.bvh", 1.23, 1.38),
    ("accad_bvh/Female1_B22_SideStepLeft.bvh", 1.40, 1.39),
    ("accad_bvh/Female1_B24_WalkToCrouch.bvh", 1.30, 1.31),
    ("accad_bvh/Female1_C03_Run.bvh", 0.73, 3.42),
    ("accad_bvh/Female1_C07_RunBackwards.bvh", 0.60, 1.75),
    ("dialects/fair_zombie.bvh", 1.53, 0.79),
    ("dialects/bvhtoolbox_walk01.bvh", 1.04, 1.57),
    ("dialects/gpmat_Swagger.bvh", 1.05, 1.25),
];

#[test]
fn unit_and_up_axis_of_every_file_are_found() {
    let Some(mocap) = mocap() else { return };
    for path in files(&mocap, &[]) {
        let (file, folder) = (name_of(&path), name_of(path.parent().unwrap()));
        let cmu = 0.0254 / 0.45;
        let unit_m = match (folder.as_str(), file.as_str()) {
            ("accad_bvh" | "cmu_bvh_daz", _) => 0.01,
            ("dialects", "rokoko_jesse_dance.bvh" | "bvhtoolbox_walk01.bvh" | "gpmat_Swagger.bvh") => 0.01,
            ("dialects", "fair_zombie.bvh" | "pybvh_example.bvh") => 0.0254,
            ("dialects_generated", "07_01__mixamo_names_cm.bvh") => 0.01,
            ("dialects_generated", "07_01__zup_metres_xyz_rootoffset.bvh") => 1.0,
            _ => cmu,
        };
        let body = Body::load(&path);
        // Readers may state a unit rounded in its sixth digit.
        assert!((body.guess.space.unit_m / unit_m - 1.0).abs() < 1e-5, "{file}: {:?}", body.guess);
        let z_up =
            ["fair_zombie.bvh", "pybvh_example.bvh", "07_01__zup_metres_xyz_rootoffset.bvh"].contains(&file.as_str());
        let up_in_source = body.guess.space.world_from_source.conjugate() * glam::DVec3::Y;
        let expected = if z_up { glam::DVec3::Z } else { glam::DVec3::Y };
        assert!(up_in_source.distance(expected) < 1e-12, "{file}: {up_in_source}");
        // The zombie is 1.12 m to the head by its joints, the tallest captured man 1.9 m.
        assert!((1.1..2.0).contains(&body.guess.stature_m), "{file}: {}", body.guess.stature_m);
        assert!((stature(&body.clip, &body.humanoid) - body.guess.stature_m).abs() < 1e-9);
        assert_eq!(body.guess.notes.is_empty(), body.guess.unit_is_stated && !z_up, "{file}: {:?}", body.guess.notes);
    }
}

#[test]
fn stature_hardly_depends_on_what_a_person_does() {
    let Some(mocap) = mocap() else { return };
    let of = |file: &str| Body::load(&mocap.join(file)).guess.stature_m;
    let woman: Vec<f64> = ["B03_Walk1", "A05_PickUpBox", "B24_WalkToCrouch", "B22_SideStepLeft", "A03_Swing"]
        .map(|clip| of(&format!("accad_bvh/Female1_{clip}.bvh")))
        .to_vec();
    let (least, most) = woman.iter().fold((f64::MAX, 0.0_f64), |(least, most), &one| (least.min(one), most.max(one)));
    // The sole is measured from how the foot is held: 2 cm.
    assert!(most - least < 0.02, "{woman:?}");
    // The BVH conversion drops the 12 cm bone of the thorax.
    let difference = of("cmu_asfamc/02_01.amc") - of("cmu_bvh_motionbuilder/02_01.bvh");
    assert!((difference - 0.12).abs() < 0.02, "{difference}");
}

#[test]
fn the_stride_of_every_walk_and_run_is_found() {
    let Some(mocap) = mocap() else { return };
    for &(file, period_secs, stride_m) in STRIDES {
        let body = Body::load(&mocap.join(file));
        let cycle = find_cycle(&body.clip, &body.humanoid).unwrap_or_else(|| panic!("no cycle in {file}"));
        assert!((cycle.period_secs / period_secs - 1.0).abs() < 0.05, "{file}: {cycle:?}, not {period_secs} s");
        // A frame more or less at 4.7 m/s and 30 fps is 16 cm.
        assert!((cycle.stride_m / stride_m - 1.0).abs() < 0.06, "{file}: {cycle:?}, not {stride_m} m");
        assert!(cycle.first >= moves_from(&body.clip, &body.humanoid), "{file}: {cycle:?}");
    }
}

#[test]
fn motion_that_is_no_gait_has_no_cycle() {
    let Some(mocap) = mocap() else { return };
    let gaits: Vec<String> = STRIDES.iter().map(|(file, ..)| name_of(file.as_ref())).collect();
    let mut others = 0;
    for path in files(&mocap, &[]) {
        if gaits.contains(&name_of(&path)) || path.parent().unwrap().ends_with("dialects_generated") {
            continue;
        }
        let body = Body::load(&path);
        assert_eq!(find_cycle(&body.clip, &body.humanoid), None, "{}", path.display());
        others += 1;
    }
    assert!(others >= 15, "{others}");
}

#[test]
fn the_same_walk_in_other_dialects_has_the_same_cycle() {
    let Some(mocap) = mocap() else { return };
    let of = |file: &str| {
        let body = Body::load(&mocap.join(file));
        find_cycle(&body.clip, &body.humanoid).map(|cycle| (cycle.first, cycle.last, cycle.foot))
    };
    let original = of("cmu_bvh_motionbuilder/07_01.bvh").unwrap();
    for path in files(&mocap, &["dialects_generated"]) {
        assert_eq!(of(path.to_str().unwrap()), Some(original), "{}", path.display());
    }
}

#[test]
fn a_looping_walk_is_a_cycle_as_a_whole() {
    let Some(mocap) = mocap() else { return };
    for file in ["gltf/CesiumMan.glb", "fbx/ozz_walk.fbx"] {
        let body = Body::load(&mocap.join(file));
        let cycle = find_cycle(&body.clip, &body.humanoid);
        assert!(cycle.is_some_and(|cycle| (0.8..2.1).contains(&cycle.period_secs)), "{file}: {cycle:?}");
    }
}

#[test]
fn a_walker_faces_where_she_goes_and_backward_the_other_way() {
    let Some(mocap) = mocap() else { return };
    for (file, sign) in [("Female1_B03_Walk1", 1.0), ("Female1_B05_WalkBackwards", -1.0)] {
        let body = Body::load(&mocap.join(format!("accad_bvh/{file}.bvh")));
        let cycle = find_cycle(&body.clip, &body.humanoid).unwrap();
        let hips = |frame: usize| body.clip.world(frame)[body.humanoid.hips()].translation;
        let travel = (hips(cycle.last) - hips(cycle.first)).with_y(0.0).normalize();
        let facing = facings(&body.clip, &body.humanoid)[cycle.first];
        // Pelvis and shoulders swing by some 10° each way; 30° off is still the same way.
        assert!(travel.dot(facing) * sign > 0.86, "{file}: {travel} {facing}");
        assert!(facing.is_normalized() && facing.y == 0.0);
    }
}

#[test]
fn walking_feet_take_turns_and_one_always_stands() {
    let Some(mocap) = mocap() else { return };
    for file in ["cmu_bvh_motionbuilder/07_01.bvh", "accad_bvh/Female1_B03_Walk1.bvh", "cmu_asfamc/35_01.amc"] {
        let body = Body::load(&mocap.join(file));
        let cycle = find_cycle(&body.clip, &body.humanoid).unwrap();
        let contacts = contacts(&body.clip, &body.humanoid);
        for side in [Side::Left, Side::Right] {
            let stands = contacts.side(side)[cycle.first..cycle.last].iter().filter(|&&stands| stands).count();
            let share = stands as f64 / (cycle.last - cycle.first) as f64;
            // Textbook stance is 60 % of the stride; positions alone miss its rolling ends.
            assert!((0.42..0.7).contains(&share), "{file} {side:?}: {share}");
        }
        let air = (cycle.first..cycle.last).filter(|&frame| !contacts.left[frame] && !contacts.right[frame]).count();
        assert!((air as f64) < 0.06 * (cycle.last - cycle.first) as f64, "{file}: {air} frames");
    }
}

#[test]
fn floors_are_where_the_files_have_them() {
    let Some(mocap) = mocap() else { return };
    // From the notes on the files: the lowest standing points of each subject.
    for (file, from, to) in [
        ("accad_bvh/Female1_B03_Walk1.bvh", 0.014, 0.07),
        ("accad_bvh/Male2_Form_1.bvh", -0.02, 0.01),
        ("cmu_bvh_daz/13_09.bvh", 0.02, 0.045),
        ("cmu_bvh_motionbuilder/06_02.bvh", -0.06, 0.05),
        ("cmu_bvh_motionbuilder/07_01.bvh", -0.06, 0.05),
    ] {
        let body = Body::load(&mocap.join(file));
        let floor = floor_height_m(&body.clip, &body.humanoid);
        assert!((from..to).contains(&floor), "{file}: {floor}");
    }
}

#[test]
fn known_defects_are_found() {
    let Some(mocap) = mocap() else { return };
    let defects = |file: &str| {
        let body = Body::load(&mocap.join(file));
        find_defects(&body.clip, &body.humanoid)
    };
    let frames = |file: &str, kind: DefectKind| -> Vec<Option<(usize, usize)>> {
        defects(file).into_iter().filter(|defect| defect.kind == kind).map(|defect| defect.frames).collect()
    };
    assert_eq!(frames("cmu_bvh_motionbuilder/07_01.bvh", DefectKind::RestPoseFirst), [Some((0, 0))]);
    assert_eq!(frames("cmu_bvh_motionbuilder/07_01.bvh", DefectKind::ZeroLengthBone).len(), 10);
    assert_eq!(frames("cmu_bvh_motionbuilder/06_02.bvh", DefectKind::Frozen), [Some((640, 721))]);
    assert!(
        frames("dialects/rokoko_jesse_dance.bvh", DefectKind::FloatingFeet)
            .iter()
            .flatten()
            .any(|&(_, last)| last > 850)
    );
    assert_eq!(frames("cmu_bvh_daz/13_09.bvh", DefectKind::FloatingFeet), [None]);
}

#[test]
fn conversions_with_a_rest_pose_first_are_told_from_those_without() {
    let Some(mocap) = mocap() else { return };
    for path in
        files(&mocap, &["cmu_bvh_motionbuilder", "cmu_bvh_daz", "cmu_bvh_60hz_trimmed", "accad_bvh", "cmu_asfamc"])
    {
        let body = Body::load(&path);
        let from = moves_from(&body.clip, &body.humanoid);
        match name_of(path.parent().unwrap()).as_str() {
            "cmu_bvh_motionbuilder" => assert_eq!(from, 1, "{}", path.display()),
            // These glide from the T-pose into the motion.
            "cmu_bvh_daz" => assert!((3..=8).contains(&from), "{}: {from}", path.display()),
            _ => assert_eq!(from, 0, "{}", path.display()),
        }
    }
}

#[test]
fn a_leap_in_one_frame_is_found() {
    let Some(mocap) = mocap() else { return };
    let mut body = Body::load(&mocap.join("accad_bvh/Female1_B03_Walk1.bvh"));
    assert!(find_defects(&body.clip, &body.humanoid).iter().all(|defect| defect.kind != DefectKind::Jump));
    let arm = body.humanoid.joint(Part::LeftUpperArm).unwrap();
    let turned = body.clip.rotation(100, arm) * glam::DQuat::from_rotation_x(0.8);
    body.clip.set_rotation(100, arm, turned);
    let jumps = find_defects(&body.clip, &body.humanoid);
    assert!(jumps.iter().any(|defect| defect.kind == DefectKind::Jump && defect.joint == Some(arm)), "{jumps:?}");
}

/// The fastest that any joint turns between two frames of a stretch \[rad\].
fn fastest(clip: &sinew_motion::Clip, frames: std::ops::Range<usize>) -> f64 {
    let joints = 0..clip.skeleton().len();
    frames
        .flat_map(|frame| joints.clone().map(move |joint| (frame, joint)))
        .map(|(frame, joint)| clip.rotation(frame, joint).angle_between(clip.rotation(frame + 1, joint)))
        .fold(0.0, f64::max)
}

#[test]
fn repeated_cycles_are_seamless() {
    let Some(mocap) = mocap() else { return };
    for &(file, ..) in STRIDES {
        let body = Body::load(&mocap.join(file));
        let cycle: Cycle = find_cycle(&body.clip, &body.humanoid).unwrap();
        let length = cycle.last - cycle.first;
        let Repeated { clip, rows } = repeat(&body.clip, &body.humanoid, (cycle.first, cycle.last), 8);
        assert_eq!((clip.frames(), rows.len()), (8 * length + 1, 8 * length + 1), "{file}");
        assert_eq!((rows[0], rows[length], rows[8 * length]), (cycle.first, cycle.first, cycle.last));
        assert_eq!(clip.first_non_finite(), None);

        let usual = fastest(&body.clip, cycle.first..cycle.last);
        let hips = |frame: usize| clip.world(frame)[body.humanoid.hips()].translation;
        let step = |frame: usize| hips(frame + 1) - hips(frame);
        let strides: Vec<f64> =
            (0..8).map(|round| (hips((round + 1) * length) - hips(round * length)).with_y(0.0).length()).collect();
        let longest = (0..length - 1).map(|frame| step(frame).length()).fold(0.0, f64::max);
        for seam in (1..8).map(|round| round * length) {
            let at_seam = fastest(&clip, seam - 2..seam + 2);
            assert!(at_seam <= 1.5 * usual, "{file}: {at_seam} rad at the seam, {usual} in the cycle");
            // The seam's own step is no longer than the others, and like its neighbours: half of a step, or 2 mm.
            assert!(step(seam - 1).length() < 1.3 * longest, "{file}");
            let change = step(seam).distance(step(seam - 1));
            assert!(change < (0.5 * longest).max(0.002), "{file}: hips change by {change} m per frame");
        }
        // Each joint for itself, too: neither its speed nor the change of its speed stands out at a seam. Half a degree is
        // below what anybody sees.
        let slack = 0.5_f64.to_radians();
        for joint in 0..clip.skeleton().len() {
            let turn = |clip: &sinew_motion::Clip, frame: usize| {
                let turn = clip.rotation(frame, joint).conjugate() * clip.rotation(frame + 1, joint);
                (if turn.w < 0.0 { -turn } else { turn }).to_scaled_axis()
            };
            let change = |clip: &sinew_motion::Clip, frame: usize| turn(clip, frame).distance(turn(clip, frame - 1));
            // What the person did about the contacts counts too: the seam is at one.
            let from = cycle.first.saturating_sub(5).max(moves_from(&body.clip, &body.humanoid)) + 1;
            let to = (cycle.last + 5).min(body.clip.frames() - 1);
            let within = |of: &dyn Fn(usize) -> f64| (from..to).map(of).fold(0.0, f64::max);
            let speed = within(&|frame| turn(&body.clip, frame).length());
            let jerk = within(&|frame| change(&body.clip, frame));
            for frame in 3 * length - 2..3 * length + 2 {
                assert!(
                    turn(&clip, frame).length() <= 1.5 * speed + slack,
                    "{file}: joint {joint}, frame {frame}: {} {speed}",
                    turn(&clip, frame).length()
                );
                assert!(
                    change(&clip, frame) <= 1.5 * jerk + slack,
                    "{file}: joint {joint}, frame {frame}: {} {jerk}",
                    change(&clip, frame)
                );
            }
        }
        for stride in &strides {
            assert!((stride - strides[0]).abs() < 1e-9, "{file}: {strides:?}");
            assert!((stride - cycle.stride_m).abs() < 0.01 + 0.02 * cycle.stride_m, "{file}: {strides:?} {cycle:?}");
        }
    }
}

#[test]
fn feet_hardly_slide_more_in_a_repeated_walk() {
    let Some(mocap) = mocap() else { return };
    for file in ["cmu_bvh_motionbuilder/07_01.bvh", "accad_bvh/Female1_B03_Walk1.bvh", "dialects/gpmat_Swagger.bvh"] {
        let body = Body::load(&mocap.join(file));
        let cycle = find_cycle(&body.clip, &body.humanoid).unwrap();
        let repeated = repeat(&body.clip, &body.humanoid, (cycle.first, cycle.last), 3);
        let stands = contacts(&body.clip, &body.humanoid);
        let step = |clip: &sinew_motion::Clip, frame: usize, joint: usize| {
            clip.world(frame + 1)[joint]
                .translation
                .with_y(0.0)
                .distance(clip.world(frame)[joint].translation.with_y(0.0))
        };
        for side in [Side::Left, Side::Right] {
            let toes = body.humanoid.toes(side).unwrap();
            for frame in cycle.first..cycle.last - 1 {
                if stands.side(side)[frame] && stands.side(side)[frame + 1] {
                    let extra = step(&repeated.clip, frame - cycle.first, toes) - step(&body.clip, frame, toes);
                    // 3 mm a frame at 30 fps, as a foot slides in captured stances.
                    assert!(extra < 0.09 * body.clip.frame_time_secs(), "{file} {side:?} frame {frame}: {extra} m");
                }
            }
        }
    }
}

#[test]
fn repeating_does_the_same_to_the_bit() {
    let Some(mocap) = mocap() else { return };
    let body = Body::load(&mocap.join("cmu_bvh_motionbuilder/02_01.bvh"));
    let cycle = find_cycle(&body.clip, &body.humanoid).unwrap();
    assert_eq!(
        repeat(&body.clip, &body.humanoid, (cycle.first, cycle.last), 4),
        repeat(&body.clip, &body.humanoid, (cycle.first, cycle.last), 4)
    );
}

#[test]
fn a_captured_walk_survives_60_hz_and_back_and_6_hz() {
    let Some(mocap) = mocap() else { return };
    let body = Body::load(&mocap.join("cmu_asfamc/07_01.amc"));
    let halved = resample(&body.clip, 60.0);
    let doubled = resample(&halved, 120.0);
    let filtered = filter(&doubled, 6.0);
    let mut worst = [0.0_f64; 2];
    for frame in 0..doubled.frames() {
        for (_, joint) in body.humanoid.parts() {
            if frame % 2 == 0 {
                assert_eq!(doubled.rotation(frame, joint), body.clip.rotation(frame, joint), "the same bits");
            }
        }
        let wrist = body.humanoid.joint(Part::LeftHand).unwrap();
        let place = |clip: &sinew_motion::Clip| clip.world(frame)[wrist].translation;
        worst = [
            worst[0].max(place(&doubled).distance(place(&body.clip))),
            worst[1].max(place(&filtered).distance(place(&body.clip))),
        ];
    }
    // Between frames of a walk at 60 Hz a cubic is right to millimetres, CMU's noise
    // in the arms included (4.4 mm); 6 Hz takes off some of each stop.
    assert!(worst[0] < 6e-3 && worst[1] < 1e-2, "{worst:?}");
}

#[test]
fn clips_of_few_frames_or_none_are_no_trouble() {
    let Some(mocap) = mocap() else { return };
    let body = Body::load(&mocap.join("cmu_bvh_motionbuilder/07_01.bvh"));
    for frames in [0, 1, 2, 3, 9, 30] {
        let mut clip = sinew_motion::Clip::new(
            body.clip.skeleton().clone(),
            body.clip.frame_time_secs(),
            body.clip.moving().to_vec(),
        );
        for frame in 0..frames {
            let locals: Vec<_> = (0..clip.skeleton().len()).map(|joint| body.clip.local(frame, joint)).collect();
            clip.push(&locals);
        }
        let humanoid = sinew_motion::Humanoid::of(&clip, &[]).unwrap();
        assert_eq!(find_cycle(&clip, &humanoid), None, "{frames} frames");
        assert!(floor_height_m(&clip, &humanoid).is_finite());
        assert_eq!(contacts(&clip, &humanoid).left.len(), frames);
        assert_eq!(facings(&clip, &humanoid).len(), frames);
        assert!(find_defects(&clip, &humanoid).len() < 20, "{frames} frames");
        assert!((1.2..1.8).contains(&stature(&clip, &humanoid)), "{frames} frames: {}", stature(&clip, &humanoid));
    }
}
