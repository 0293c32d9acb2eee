//! `sinew respond` as its user runs it.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use crate::command::{Ran, json, sinew};
use serde_json::Value;
use sinew::motion::formats::{MotionFile, ReadOptions};
use sinew_testkit::mocap;
use std::path::{Path, PathBuf};

const PUSH: &str = "part=leftHand,force=0:0:-100,at=2.0,for=0.1";

/// A folder to write in, and a walk that needs no neighbours.
fn place() -> Option<(tempfile::TempDir, PathBuf)> {
    let mocap = mocap()?;
    Some((tempfile::tempdir().unwrap(), mocap.join("cmu_bvh_60hz_trimmed/35_01_walk.bvh")))
}

/// Reads a motion file as a user would.
fn read(path: &Path) -> MotionFile {
    MotionFile::read(path, &ReadOptions::default()).unwrap()
}

/// `sinew respond CLIP`, then words separated by blanks.
fn respond(at: &Path, clip: &Path, words: &str) -> Ran {
    let mut arguments = vec!["respond".to_owned(), clip.display().to_string()];
    arguments.extend(words.split_whitespace().map(str::to_owned));
    sinew(at, arguments)
}

#[test]
fn the_same_command_twice_writes_the_same_bytes() {
    let Some((folder, clip)) = place() else { return };
    let files = ["out.bvh", "out.glb", "report.json", "out.png"];
    let once = || {
        respond(
            folder.path(),
            &clip,
            &format!("--repeat 8 --push {PUSH} --push part=head,force=80:0:0,at=4 -o out.bvh -o out.glb --report report.json --picture out.png"),
        )
        .done();
        files.map(|name| std::fs::read(folder.path().join(name)).unwrap())
    };
    let (first, second) = (once(), once());
    for (name, (first, second)) in files.iter().zip(first.iter().zip(&second)) {
        assert!(first == second, "{name} differs");
        assert!(!first.is_empty(), "{name} is empty");
    }
}

#[test]
fn a_clip_without_a_disturbance_passes_through_byte_for_byte() {
    let Some((folder, clip)) = place() else { return };
    let ran = respond(folder.path(), &clip, "-o same.bvh").done();
    assert!(ran.out.contains("passes through unchanged"), "{}", ran.out);
    assert!(std::fs::read(folder.path().join("same.bvh")).unwrap() == std::fs::read(&clip).unwrap());
}

#[test]
fn the_report_has_the_promised_keys_and_tells_each_push_apart() {
    let Some((folder, clip)) = place() else { return };
    respond(
        folder.path(),
        &clip,
        &format!("--repeat 10 --push {PUSH} --push part=chest,force=0:0:120,at=5,for=0.2,frame=world --report r.json"),
    )
    .done();
    let report = json(&folder.path().join("r.json"));
    assert_eq!(report["preset"], "robust");
    assert_eq!(report["k"], 10);
    assert_eq!(report["compliance"], 1.0);
    assert_eq!(report["finite"], true);
    assert!(report["cycle"].as_array().is_some_and(|ends| ends.len() == 2));
    assert!(report["stance_deviation_max_m"].as_f64().unwrap() < 1e-3);
    let pushes = report["pushes"].as_array().unwrap();
    assert_eq!(pushes.len(), 2);
    for push in pushes {
        let peaks = push["peak_deflection_deg"].as_object().unwrap();
        assert!(peaks.values().all(|peak| peak.as_f64().is_some_and(f64::is_finite)));
        assert!(peaks.contains_key("leftHand") && peaks.contains_key("chest"), "{peaks:?}");
    }
    assert!(pushes[0]["recovered_after_s"].as_f64().unwrap() < 3.0);
    assert!(pushes[1]["recovered_after_s"].as_f64().unwrap() < 6.0);
    assert_eq!((&pushes[0]["part"], &pushes[1]["part"]), (&Value::from("leftHand"), &Value::from("chest")));
    let arm = |push: &Value| push["peak_deflection_deg"]["leftUpperArm"].as_f64().unwrap();
    assert!(arm(&pushes[0]) > 5.0 && arm(&pushes[0]) > arm(&pushes[1]));
}

#[test]
fn a_push_that_the_clip_does_not_outlast_is_reported_as_not_recovered() {
    let Some((folder, clip)) = place() else { return };
    respond(folder.path(), &clip, "--push part=leftHand,force=0:0:-100,at=1.8 --report r.json").done();
    assert!(json(&folder.path().join("r.json"))["pushes"][0]["recovered_after_s"].is_null());
    let late = respond(folder.path(), &clip, "--push part=leftHand,force=0:0:-100,at=60 --report r.json").done();
    assert!(late.err.contains("after the clip's end"), "{}", late.err);
}

#[test]
fn every_format_that_is_written_reads_again_and_holds_the_same_motion() {
    let Some((folder, clip)) = place() else { return };
    let names = ["out.bvh", "out.glb", "out.gltf"];
    respond(folder.path(), &clip, &format!("--repeat 6 --push {PUSH} -o out.bvh -o out.glb -o out.gltf")).done();
    let files = names.map(|name| read(&folder.path().join(name)));
    let [bvh, ..] = &files;
    for (name, file) in names.iter().zip(&files) {
        assert_eq!(file.clip.frames(), bvh.clip.frames(), "{name}");
        let (ours, theirs) = (file.body_parts().unwrap(), bvh.body_parts().unwrap());
        for frame in (0..bvh.clip.frames()).step_by(37) {
            let (here, there) = (file.clip.world(frame), bvh.clip.world(frame));
            for (part, joint) in ours.parts() {
                let Some(other) = theirs.joint(part) else { continue };
                let gap = (here[joint].translation - there[other].translation).length();
                // Six decimals of a degree in the one, single precision in the other.
                assert!(gap < 1e-4, "{name}: {part} in frame {frame} by {gap} m");
            }
        }
    }
}

#[test]
fn a_smaller_person_is_weighed_and_measured_as_told() {
    let Some((folder, clip)) = place() else { return };
    let at = folder.path();
    respond(at, &clip, &format!("--repeat 6 --mass 40 --height 1.5 --push {PUSH} --report child.json")).done();
    respond(at, &clip, &format!("--repeat 6 --mass 80 --height 1.7 --push {PUSH} --report adult.json")).done();
    let (child, adult) = (json(&at.join("child.json")), json(&at.join("adult.json")));
    assert_eq!((child["mass_kg"].as_f64(), child["height_m"].as_f64()), (Some(40.0), Some(1.5)));
    let hand = |report: &Value| report["pushes"][0]["peak_deflection_deg"]["leftUpperArm"].as_f64().unwrap();
    assert!(hand(&child) > 1.2 * hand(&adult), "the same force moves half the mass further");
}

#[test]
fn another_clips_coordinates_change_the_answer_and_it_still_recovers() {
    let Some((folder, clip)) = place() else { return };
    let at = folder.path();
    let sneak = clip.with_file_name("120_08_sneak.bvh");
    respond(at, &clip, &format!("--repeat 8 --push {PUSH} -o own.bvh --report own.json")).done();
    respond(at, &clip, &format!("--repeat 8 --push {PUSH} --basis {} -o lent.bvh --report lent.json", sneak.display()))
        .done();
    assert!(std::fs::read(at.join("own.bvh")).unwrap() != std::fs::read(at.join("lent.bvh")).unwrap());
    assert!(json(&at.join("lent.json"))["pushes"][0]["recovered_after_s"].as_f64().unwrap() < 6.0);
}

#[test]
fn a_platform_carries_the_walk_and_its_feet_stay_on_it() {
    let Some((folder, clip)) = place() else { return };
    respond(folder.path(), &clip, "--repeat 8 --platform accel=4:0:0,at=2.0,for=0.2 --report r.json -o out.bvh").done();
    let report = json(&folder.path().join("r.json"));
    assert!(report["stance_deviation_max_m"].as_f64().unwrap() < 1e-3, "{report}");
    assert!(report["peak_deflection_deg"]["chest"].as_f64().unwrap() > 0.5, "{report}");
    assert!(report["recovered_after_s"].as_f64().unwrap() < 6.0, "{report}");
}

#[test]
fn the_cycle_can_be_stated_and_repeated() {
    let Some((folder, clip)) = place() else { return };
    let at = folder.path();
    respond(at, &clip, "--cycle 8..75 --repeat 3 --report r.json -o out.bvh").done();
    let report = json(&at.join("r.json"));
    assert_eq!(report["cycle"], serde_json::json!([8, 75]));
    // Three rounds of 67 frames and the closing one.
    assert_eq!(read(&at.join("out.bvh")).clip.frames(), 3 * 67 + 1);
    respond(at, &clip, "--cycle 8..500").failed(&["8..500", "0..119"]);
    respond(at, &clip, "--cycle 75..8").refused(&["FIRST..LAST"]);
    respond(at, &clip, "--cycle 8-75").refused(&["FIRST..LAST"]);
    let standing = clip.with_file_name("143_23_punch.bvh");
    respond(at, &standing, "--repeat 3").failed(&["--cycle"]);
}

#[test]
fn what_excludes_each_other_or_is_out_of_range_is_said() {
    let Some((folder, clip)) = place() else { return };
    let at = folder.path();
    let tried = |words: &str, word: &str| {
        let ran = respond(at, &clip, &format!("{words} -o never.bvh"));
        assert!(ran.code == 1 || ran.code == 2, "{words}: {} {}{}", ran.code, ran.out, ran.err);
        assert!(ran.err.contains(word), "{words}: {}", ran.err);
        assert!(!at.join("never.bvh").exists(), "{words}");
    };
    tried("-k 25", "24");
    tried("-k -1", "-1");
    tried("--compliance 99", "compliance");
    tried("--compliance nan", "");
    tried("--compliance 2 --preset paper", "compliance");
    tried("--coordinates high", "paper");
    tried("--preset best", "best");
    tried("--mass 0", "mass");
    tried("--mass nan", "");
    tried("--mass 1e9", "mass");
    tried("--height -1", "");
    tried("--height 1e300", "height");
    tried("--units 0", "unit");
    tried("--repeat 18446744073709551615", "repeat");
    tried("--repeat 4000000", "repeat");
    tried("--basis nowhere.bvh", "nowhere.bvh");
    for push in [
        "part=tail,force=0:0:1",
        "part=head",
        "part=head,force=1:2",
        "part=head,force=nan:0:0",
        "part=head,force=0:0:1e999",
        "part=head,force=0:0:1e308",
        "part=head,force=0:0:1,at=-1",
        "part=head,force=0:0:1,for=inf",
        "part=head,force=0:0:1,frame=sideways",
        "",
    ] {
        let ran = sinew(at, ["respond".as_ref(), clip.as_os_str(), "--push".as_ref(), push.as_ref()]);
        ran.refused(&["--push"]);
    }
    sinew(at, ["respond".as_ref(), clip.as_os_str(), "--platform".as_ref(), "accel=1:2".as_ref()])
        .refused(&["--platform"]);
}

#[test]
fn forces_beyond_all_reason_give_a_finite_answer() {
    let Some((folder, clip)) = place() else { return };
    let at = folder.path();
    for push in [
        "part=head,force=1e6:1e6:-1e6,at=0,for=1000",
        "part=leftHand,force=1e6:0:0,at=1,for=0.5,point=3:0:0",
        "part=hips,force=0:1e6:0,at=0.5",
        "part=leftFoot,force=5000:0:0,at=0.5",
        "part=chest,force=0:0:0,at=1000",
        "part=chest,force=0:0:100,at=1,for=0",
    ] {
        respond(at, &clip, &format!("--push {push} --report r.json -o out.bvh")).done();
        assert_eq!(json(&at.join("r.json"))["finite"], true, "{push}");
        assert!(read(&at.join("out.bvh")).clip.first_non_finite().is_none(), "{push}");
    }
    respond(at, &clip, "--platform accel=1000:0:-1000,at=0,for=10 --report r.json -o out.bvh").done();
    assert_eq!(json(&at.join("r.json"))["finite"], true);
}

#[test]
fn what_is_no_human_body_cannot_respond_and_says_why() {
    let Some(mocap) = mocap() else { return };
    let folder = tempfile::tempdir().unwrap();
    for name in ["gltf/Fox.glb", "gltf/RiggedSimple.glb"] {
        let ran = respond(folder.path(), &mocap.join(name), &format!("--push {PUSH} -o out.glb"));
        let ran = ran.failed(&[Path::new(name).file_name().unwrap().to_str().unwrap()]);
        assert!(ran.err.trim().len() > 40, "{}", ran.err);
        assert!(!folder.path().join("out.glb").exists());
    }
}

#[test]
fn an_unknown_output_format_or_place_fails_and_leaves_no_file() {
    let Some((folder, clip)) = place() else { return };
    let at = folder.path();
    respond(at, &clip, "-o out.docx").failed(&["docx"]);
    std::fs::write(at.join("file"), "").unwrap();
    respond(at, &clip, "-o file/out.bvh").failed(&["file"]);
    let left: Vec<_> = std::fs::read_dir(at).unwrap().map(|entry| entry.unwrap().file_name()).collect();
    assert_eq!(left, ["file"]);
}

#[test]
fn without_a_clip_the_sample_walk_is_pushed_into_the_folder_out() {
    let folder = tempfile::tempdir().unwrap();
    let ran = sinew(folder.path(), ["respond"]).done();
    assert!(ran.out.contains("push:") && ran.out.contains("recovered"), "{}", ran.out);
    for name in ["pushed.bvh", "pushed.glb", "report.json", "pushed.png"] {
        assert!(folder.path().join("out").join(name).is_file(), "{name}");
    }
}
