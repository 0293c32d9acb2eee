//! Ways of writing text motion files that no file of the shared folder shows.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

use crate::text::{Loaded, complaint, parse};
use glam::{DQuat, DVec3};
use sinew_motion::formats::{amc, bvh};
use sinew_motion::{Limits, SourceSpace};

const PLAIN: &str = "HIERARCHY\nROOT hips\n{\n\tOFFSET 0 90 0\n\tCHANNELS 6 Xposition Yposition Zposition Zrotation \
                     Xrotation Yrotation\n\tJOINT leg\n\t{\n\t\tOFFSET 1 -2 3\n\t\tCHANNELS 3 Zrotation Xrotation \
                     Yrotation\n\t\tEnd Site\n\t\t{\n\t\t\tOFFSET 0 -40 0\n\t\t}\n\t}\n}\nMOTION\nFrames: 2\nFrame Time: \
                     0.02\n1 2 3 10 20 30 4 5 6\n7 8 9 40 50 60 1 2 3\n";

/// The file still writes back to itself.
fn unchanged(text: &str) {
    let loaded = Loaded::new(parse(text), SourceSpace::SINEW);
    assert!(loaded.write(bvh::write, &loaded.clip, &loaded.rows()).unwrap() == text.as_bytes(), "{text:?}");
}

#[test]
fn layout_does_not_change_the_motion() {
    let plain = parse(PLAIN);
    let (head, rows) = PLAIN.split_once("MOTION").unwrap();
    for text in [
        PLAIN.replace('\n', "\r\n"),
        PLAIN.replace('\n', "\r"),
        head.replace('\n', "\r\n") + "MOTION" + rows,
        format!("\u{feff}{PLAIN}"),
        PLAIN.trim_end().to_owned(),
        format!("{PLAIN}\n \n\t\n\n"),
        PLAIN.replace("0.02\n", "0.02\n\n\n").replace("\n7 8", "\n\n7 8"),
        head.to_lowercase() + "motion" + &rows.to_lowercase(),
        PLAIN.replace("hips\n{", "hips {").replace("leg\n\t{", "leg{").replace("Site\n\t\t{", "Site {"),
        PLAIN.replace("Frames: ", "Frames:\t").replace("Time: ", "Time:\t"),
        PLAIN.replace("Frames: 2\nFrame Time: 0.02", "Frame Time: 0.02\nFrames: 2"),
        PLAIN.replace("Frames:", "FRAMES :").replace("Frame Time:", "FrameTime:"),
        head.replace('\n', " ").replace("hips ", "hips\n").replace("leg ", "leg\n") + "MOTION" + rows,
        PLAIN.replace("1 2 3 10", "\t1  2\t3 +10.").replace("5 6\n", "5 6 \t\n"),
        PLAIN.replace("0.02", ".02").replace("90 0\n", "9e+001 0\n"),
    ] {
        let read = parse(&text);
        assert_eq!(read.clip, plain.clip, "{text:?}");
        assert_eq!(read.notes, [], "{text:?}");
        unchanged(&text);
    }
}

#[test]
fn wrapped_rows_are_read_when_they_add_up() {
    let text = PLAIN.replace("10 20 30 4", "\n10 20 30\n4").replace("40 50", "40\n 50");
    let read = parse(&text);
    assert_eq!(read.clip, parse(PLAIN).clip);
    assert!(read.notes.len() == 1 && read.notes[0].text.contains("wrapped"), "{:?}", read.notes);
    unchanged(&text);
    assert!(complaint(&text.replace("Frames: 2", "Frames: 3")).contains("frame 0 has 3 values"));
}

#[test]
fn root_positions_replace_the_offset_axis_by_axis() {
    let clip = parse(PLAIN).clip;
    assert_eq!(clip.translation(0, 0), DVec3::new(1.0, 2.0, 3.0));
    assert_eq!(clip.skeleton().joints()[0].rest.translation, DVec3::new(0.0, 90.0, 0.0));
    let text = PLAIN.replace("6 Xposition Yposition Zposition", "4 Zposition").replace("1 2 3 10", "3 10");
    let clip = parse(&text.replace("7 8 9 ", "9 ")).clip;
    assert_eq!(clip.translation(0, 0), DVec3::new(0.0, 90.0, 3.0));
    assert_eq!(clip.moving(), [0]);
}

#[test]
fn joints_have_any_channels_in_any_order() {
    let text = PLAIN
        .replace("6 Xposition Yposition Zposition Zrotation Xrotation Yrotation", "0")
        .replace("3 Zrotation Xrotation Yrotation", "4 Yrotation Zposition Xrotation Xposition")
        .replace("1 2 3 10 20 30 4 5 6", "30 7 -20 5")
        .replace("7 8 9 40 50 60 1 2 3", "0 0 0 0");
    let clip = parse(&text).clip;
    assert_eq!(clip.moving(), [1]);
    assert_eq!(clip.translation(0, 0), DVec3::new(0.0, 90.0, 0.0));
    assert_eq!(clip.rotation(0, 0), DQuat::IDENTITY);
    assert_eq!(clip.translation(0, 1), DVec3::new(5.0, -2.0, 7.0));
    let expected = DQuat::from_rotation_y(30f64.to_radians()) * DQuat::from_rotation_x(-20f64.to_radians());
    assert!(clip.rotation(0, 1).angle_between(expected) < 1e-7);
    unchanged(&text);
}

#[test]
fn names_are_whatever_stands_on_their_line() {
    let long = "mixamorig:Left Leg_End{2}";
    let text = PLAIN.replace("JOINT leg", &format!("JOINT {long}")).replace("ROOT hips", "ROOT  End Hips\t");
    let skeleton = parse(&text).clip.skeleton().clone();
    let names: Vec<&str> = skeleton.joints().iter().map(|joint| joint.name.as_str()).collect();
    assert_eq!(names, ["End Hips", long]);
    unchanged(&text);
}

#[test]
fn several_roots_are_several_bodies() {
    let (body, rest) = PLAIN.split_once("MOTION").unwrap();
    let second = body.strip_prefix("HIERARCHY\n").unwrap().replace("hips", "hips2");
    let row = |row: &str| format!("{row} {row}");
    let rest = rest.replace("1 2 3 10 20 30 4 5 6", &row("1 2 3 10 20 30 4 5 6"));
    let text = format!("{body}{second}MOTION{}", rest.replace("7 8 9 40 50 60 1 2 3", &row("7 8 9 40 50 60 1 2 3")));
    let read = parse(&text);
    assert_eq!(read.clip.skeleton().len(), 4);
    assert_eq!(read.clip.skeleton().joints()[2].parent, None);
    assert_eq!(read.clip.world(1)[3], read.clip.world(1)[1]);
    unchanged(&text);
    let error = amc::write_skeleton(&mut Vec::new(), &read.clip).unwrap_err().to_string();
    assert!(error.contains("2 roots") && error.contains("BVH"), "{error}");
}

#[test]
fn foreign_and_missing_names_are_noted() {
    let mut bytes = PLAIN.replace("hips", "h?ps").into_bytes();
    let at = bytes.iter().position(|&byte| byte == b'?').unwrap();
    bytes[at] = 0xfc;
    let read = bvh::read(&bytes, &Limits::default()).unwrap();
    assert!(read.notes[0].text.contains("not UTF-8") && read.notes[0].line == Some(2), "{:?}", read.notes);
    let read = parse(&PLAIN.replace("JOINT leg", "JOINT"));
    assert_eq!(read.clip.skeleton().joints()[1].name, "joint1");
    assert_eq!(read.notes.len(), 1);
}

#[test]
fn a_frame_rate_in_place_of_the_frame_time_is_noted() {
    let read = parse(&PLAIN.replace("Time: 0.02", "Time: 30"));
    assert!(read.notes[0].text.contains("30 frames per second"), "{:?}", read.notes);
}

const ASF: &str = ":units\n  length 1.0\n  angle rad\n# a comment\n:documentation\n begin\n anything 1 2\n:root\n order RX RY RZ TX \
                   TY TZ\n axis ZYX\n position 0 0 0\n orientation 0 0 0\n:bonedata\n begin\n id 1\n name thigh\n direction 0 \
                   -1 0\n length 4\n axis 0 0 0.5 XYZ # its own\n dof rz rx\n limits (-1 1)\n (-1 1)\n end\n:hierarchy\n begin\n \
                   root thigh\n end\n:skin a.obj\n";

#[test]
fn acclaim_angles_may_be_radians_and_dof_in_another_order() {
    let motion = ":RADIANS\n1\nroot 0.1 0.2 0.3 1 2 3\nthigh 0.4 0.25\n";
    let read = amc::read(motion.as_bytes(), ASF.as_bytes(), &Limits::default()).unwrap();
    let (x, y, z) = (DQuat::from_rotation_x, DQuat::from_rotation_y, DQuat::from_rotation_z);
    let near = |joint: usize, expected: DQuat| {
        let found = read.clip.rotation(0, joint);
        assert!((found.dot(expected).abs() - 1.0).abs() < 1e-14, "{found} {expected}");
    };
    near(0, z(0.3) * y(0.2) * x(0.1));
    assert_eq!(read.clip.translation(0, 0), DVec3::new(1.0, 2.0, 3.0));
    near(1, z(0.5) * (x(0.25) * z(0.4)) * z(-0.5));
    assert_eq!(read.clip.skeleton().joints()[1].tip, Some(DVec3::new(0.0, -4.0, 0.0)));
    assert_eq!(read.unit_m, Some(0.0254));
    let told = |what: &str| read.notes.iter().any(|note| note.text.contains(what));
    assert!(told("another order") && told(":skin"), "{:?}", read.notes);
    let loaded = Loaded::new(read.clone(), SourceSpace::SINEW);
    let mut clip = loaded.clip.clone();
    clip.set_rotation(0, 1, z(0.5) * (x(-0.75) * z(0.4)) * z(-0.5));
    let written = String::from_utf8(loaded.write(amc::write, &clip, &[0]).unwrap()).unwrap();
    assert_eq!(written, motion.replace("0.25", "-0.75"));
    let degrees = motion.replace(":RADIANS", ":DEGREES");
    let read = amc::read(degrees.as_bytes(), ASF.as_bytes(), &Limits::default()).unwrap();
    assert!(read.clip.rotation(0, 0).angle_between(DQuat::IDENTITY) < 0.01);
}

#[test]
fn a_bone_that_shifts_moves_from_its_rest_along_its_axes() {
    let asf = ASF.replace("dof rz rx", "dof ty rx").replace("root thigh\n", "root thigh\n thigh shin\n").replace(
        ":hierarchy",
        " begin\n name shin\n direction 0 -1 0\n length 3\n axis 0 0 1.5707963267948966 XYZ\n dof tx rx l\n end\n:hierarchy",
    );
    let motion = ":RADIANS\n1\nroot 0 0 0 0 0 0\nthigh 0 0\nshin 0.5 0 0\n";
    let read = amc::read(motion.as_bytes(), asf.as_bytes(), &Limits::default()).unwrap();
    // The shin's x axis is the file's y axis.
    assert!(read.clip.translation(0, 2).distance(DVec3::new(0.0, -3.5, 0.0)) < 1e-12);
    let loaded = Loaded::new(read, SourceSpace::SINEW);
    let mut clip = loaded.clip.clone();
    clip.set_translation(0, 2, DVec3::new(0.0, -3.25, 0.0));
    let written = String::from_utf8(loaded.write(amc::write, &clip, &[0]).unwrap()).unwrap();
    assert_eq!(written, motion.replace("shin 0.5", "shin 0.750000"));
}

#[test]
fn bones_that_the_motion_leaves_out_stay_at_rest() {
    let motion = ":RADIANS\n4\nroot 0 0 0 0 0 0\n9\nroot 0 0 0 1 1 1\n";
    let read = amc::read(motion.as_bytes(), ASF.as_bytes(), &Limits::default()).unwrap();
    let told = |what: &str| read.notes.iter().any(|note| note.text.contains(what));
    assert!(told("stay at rest: thigh") && told("frame numbers do not go up by one at 1 place"), "{:?}", read.notes);
    let loaded = Loaded::new(read.clone(), SourceSpace::SINEW);
    let mut clip = loaded.clip.clone();
    clip.set_rotation(1, 1, DQuat::from_rotation_x(0.1));
    let error = loaded.write(amc::write, &clip, &[0, 1]).unwrap_err().to_string();
    assert!(error.contains("thigh") && error.contains("no rotation channel"), "{error}");
}
