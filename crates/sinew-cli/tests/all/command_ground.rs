//! `sinew ground` as its user runs it.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use crate::command::{json, sinew};
use glam::DVec3;
use sinew::motion::formats::{MotionFile, ReadOptions};
use sinew_testkit::repository;
use std::path::Path;

/// The sample walk, drifting by 2 cm/s, first 3 cm above its floor and at the end 3 cm in it.
fn made(folder: &Path) {
    let file = MotionFile::read(&repository("samples/walk.bvh"), &ReadOptions::default()).unwrap();
    let mut clip = file.clip.clone();
    let root = clip.moving()[0];
    for frame in 0..clip.frames() {
        let secs = frame as f64 * clip.frame_time_secs();
        let at = clip.translation(frame, root);
        clip.set_translation(frame, root, at + DVec3::new(0.02 * secs, 0.03 * (1.0 - secs / 4.4), 0.0));
    }
    let rows: Vec<usize> = (0..clip.frames()).collect();
    file.write(&folder.join("made.bvh"), &clip, &rows, &[]).unwrap();
}

#[test]
fn a_drifting_floating_walk_comes_back_on_its_floor_and_the_report_says_what_was_wrong() {
    let folder = tempfile::tempdir().unwrap();
    made(folder.path());
    let files = ["out.bvh", "out.glb", "r.json", "p.png", "v.gif"];
    let once = || {
        let words = "ground made.bvh -o out.bvh -o out.glb --report r.json --picture p.png --video v.gif";
        sinew(folder.path(), words.split(' ')).done();
        files.map(|name| std::fs::read(folder.path().join(name)).unwrap())
    };
    assert!(once() == once(), "the same command twice writes the same bytes");
    let report = json(&folder.path().join("r.json"));
    let number = |value: &serde_json::Value| value.as_f64().unwrap();
    // 8.8 s at 2 cm/s, and 8 mm that the walk slides by itself.
    assert!((number(&report["drift_m"]) - 0.176).abs() < 0.02, "{report}");
    assert!(number(&report["before"]["slide_mean_m_s"]) > 0.015 && number(&report["after"]["slide_mean_m_s"]) < 0.002);
    assert!(number(&report["before"]["height_rms_m"]) > 0.015 && number(&report["after"]["height_rms_m"]) < 0.001);
    // Read back as a user would, the feet are where the walk has them.
    let read = |path: &Path| MotionFile::read(path, &ReadOptions::default()).unwrap().clip;
    let (out, walk) = (read(&folder.path().join("out.bvh")), read(&repository("samples/walk.bvh")));
    let last = out.frames() - 1;
    let gap = out.world(last)[0].translation.distance(walk.world(last)[0].translation);
    assert!(gap < 0.02, "{gap} m");
}

#[test]
fn what_cannot_be_grounded_is_said() {
    let folder = tempfile::tempdir().unwrap();
    made(folder.path());
    sinew(folder.path(), ["ground", "made.bvh", "--floor", "-200"])
        .refused(&["--floor -200 is out of range", "give -100 to 100"]);
    let onto = sinew(folder.path(), ["ground", "made.bvh", "-o", "made.bvh"]);
    assert!(onto.code != 0 && onto.err.contains("made.bvh"), "{}", onto.err);
}
