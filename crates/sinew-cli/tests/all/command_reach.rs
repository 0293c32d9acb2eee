//! `sinew reach` as its user runs it.

use crate::command::{Ran, json, sinew};
use serde_json::Value;
use std::path::Path;

const WALK: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../samples/walk.bvh");

/// `sinew reach`, then words separated by blanks; `WALK` is the sample walk.
fn reach(at: &Path, words: &str) -> Ran {
    let words = words.split_whitespace().map(|word| word.replace("WALK", WALK));
    sinew(at, std::iter::once("reach".to_owned()).chain(words))
}

/// What a report says that was written for such words.
fn report(at: &Path, words: &str) -> Value {
    reach(at, &format!("{words} --report r.json")).done();
    json(&at.join("r.json"))
}

#[test]
fn every_option_does_what_it_says() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    let hands = |report: &Value| {
        report["hands"].as_array().unwrap().iter().map(|hand| hand.as_str().unwrap().to_owned()).collect::<Vec<_>>()
    };
    let number = |report: &Value, key: &str| report[key].as_f64().unwrap();
    type Claim<'a> = &'a dyn Fn(&Value) -> bool;
    let cases: [(&str, Claim<'_>); 20] = [
        ("--target 0.3:1.3:0.4", &|report| hands(report) == ["left"]),
        ("--target -0.3:1.3:0.4", &|report| hands(report) == ["right"]),
        ("--target 0.3:1.3:0.4 --hand right", &|report| hands(report) == ["right"]),
        ("--target -0.3:1.3:0.4 --hand left", &|report| hands(report) == ["left"]),
        ("--target-left 0.3:1.2:0.4 --target-right -0.3:1.2:0.4", &|report| {
            hands(report) == ["left", "right"] && number(report, "hand_error_m") < 1e-3
        }),
        // A child of 1.1 m cannot reach what stands at 1.7 m of height, somebody of 1.9 m can.
        ("--target -0.2:1.7:0.4 --height 1.9", &|report| report["reached"] == true),
        ("--target -0.2:1.9:0.3 --height 1.1", &|report| report["reason"].as_str().unwrap().contains("too high")),
        ("--target -0.2:0.3:0.4 --flexibility 0.5", &|report| number(report, "squat_m") < 0.1),
        ("--target -0.2:0.3:0.4 --flexibility 2", &|report| number(report, "squat_m") > 0.3),
        // The hand goes round the shoulder, so that its fastest may differ from that of its way against the body.
        ("--target -0.2:1.3:0.45 --speed 0.5", &|report| number(report, "hand_speed_max_m_s") < 0.75),
        ("--target -0.2:1.3:0.45 --speed 2", &|report| number(report, "hand_speed_max_m_s") > 1.2),
        ("--target -0.2:1.3:0.45 --time 1.5", &|report| (number(report, "duration_s") - 1.5).abs() < 1e-6),
        ("--target -0.2:1.3:0.4 --moving -0.5:1.0:0.4@1 --moving -0.1:1.5:0.4@3", &|report| report["reached"] == true),
        ("--moving 0.2:1.2:0.6@2 --moving -0.2:1.4:0.5@4", &|report| report["reached"] == true),
        // 2.9 m in half a second: nobody can, and it says so.
        ("--target 1.5:1.0:2.5 --time 0.5", &|report| {
            report["late"] == true && (1.5..3.0).contains(&number(report, "duration_s"))
        }),
        ("--target -0.2:1.1:0.45 --avoid -0.28:1.05:0.25:0.05", &|report| report["reached"] == true),
        ("--target -0.2:1.3:0.45 --seed 9", &|report| report["seed"] == 9),
        ("--target -0.3:1.3:0.9 --from WALK@1.5", &|report| report["reached"] == true),
        ("--target -0.3:1.3:0.9 --from WALK@1.5 --back", &|report| report["reached"] == true),
        // EQ4: 2 d / (v_s (r_s + 1)) at 0.2 m/s; people take a fifth of that.
        ("--target -0.2:1.3:0.45 --print", &|report| number(report, "duration_s") > 2.0),
    ];
    for (words, claim) in cases {
        let report = report(at, words);
        assert!(claim(&report), "{words}: {report}");
        // Whatever it was told: nobody glides on planted feet.
        assert!(report["planted_slip_m"].as_f64().unwrap() < 1e-3, "{words}: {report}");
    }
}

#[test]
fn overlaps_move_what_begins_after_what() {
    let folder = tempfile::tempdir().unwrap();
    let secs = |words: &str| report(folder.path(), words)["duration_s"].as_f64().unwrap();
    // Whoever begins the arm only when the steps are done arrives later; the same with the swing after the twist.
    let steps = "--target -0.2:1.1:1.1 --hand right --overlap-step";
    assert!(secs(&format!("{steps} 1")) > secs(&format!("{steps} 0")) + 0.1);
    let twists = "--target 0.7:0.5:0.1 --hand left --overlap-twist";
    assert!(secs(&format!("{twists} 1")) > secs(&format!("{twists} 0")) + 0.05);
}

#[test]
fn twenty_ways_are_twenty_files_one_list_and_one_sheet() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    let ran =
        reach(at, "--target -0.2:1.1:0.8 --variations 20 --seed 3 -o way.csv --report r.json --picture p.png").done();
    assert!(ran.out.contains("wrote way_seed3.csv to way_seed22.csv (20 files), r.json, p.png"), "{}", ran.out);
    let reports = json(&at.join("r.json"));
    let reports = reports.as_array().unwrap();
    assert_eq!(reports.len(), 20);
    assert_eq!(reports[19]["seed"], 22);
    for seed in [3, 22] {
        assert!(at.join(format!("way_seed{seed}.csv")).is_file());
    }
    assert!(!at.join("way.csv").exists() && at.join("p.png").is_file());
    // Choices differ: with 20 seeds at even odds two kinds of steps are all but certain.
    let kinds: std::collections::BTreeSet<String> =
        reports.iter().map(|one| one["steps"][0]["kind"].to_string()).collect();
    assert!(kinds.len() > 1, "{kinds:?}");
}

#[test]
fn motion_is_written_in_every_format_and_again_the_same() {
    let folder = tempfile::tempdir().unwrap();
    let files = ["m.glb", "m.gltf", "m.bvh", "m.csv", "p.png", "r.json"];
    let once = || {
        reach(
            folder.path(),
            "--target 0.4:1.6:0.4 --seed 7 -o m.glb -o m.gltf -o m.bvh -o m.csv --picture p.png --report r.json",
        )
        .done();
        files.map(|name| std::fs::read(folder.path().join(name)).unwrap())
    };
    assert!(once() == once());
}

#[test]
fn what_is_wrong_names_the_flag_and_what_to_do() {
    let folder = tempfile::tempdir().unwrap();
    for (words, says) in [
        ("", &["nothing to reach", "--target"][..]),
        ("--target 0.4:1.2", &["--target", "write X:Y:Z"]),
        ("--target 0.4:1.2:nan", &["--target", "write X:Y:Z"]),
        ("--target 0.4:1.2:2e4", &["--target", "write X:Y:Z"]),
        ("--target 0:1:0.4 --target-left 0:1:0.4", &["--target", "cannot be used with"]),
        ("--target 0:1:0.4 --hand both", &["--hand", "left, right, auto"]),
        ("--target 0:1:0.4 --flexibility 9", &["--flexibility", "0.25 to 4"]),
        ("--target 0:1:0.4 --speed 0", &["--speed", "0.05 to 10"]),
        ("--target 0:1:0.4 --time 0.1", &["--time", "0.2 to 600"]),
        ("--target 0:1:0.4 --time 1 --speed 1", &["--time", "--speed", "cannot be used with"]),
        ("--target 0:1:0.4 --overlap-step 1.5", &["--overlap-step", "0 to 1"]),
        ("--target 0:1:0.4 --overlap-twist x", &["--overlap-twist", "0 to 1"]),
        ("--target 0:1:0.4 --moving 0:1:0.4", &["--moving", "X:Y:Z@T"]),
        ("--target 0:1:0.4 --moving 0:1:0.4@2 --moving 0:1:0.5@1", &["moving", "grow"]),
        ("--target 0:1:0.4 --avoid 0:1:0.4", &["--avoid", "X:Y:Z:R"]),
        ("--target 0:1:0.4 --variations 0", &["--variations", "1..=200"]),
        ("--target 0:1:0.4 --from WALK", &["--from", "CLIP@T"]),
        ("--target 0:1:0.4 --from WALK@99", &["clip ends at", "99"]),
        ("--target 0:1:0.4 --height 0", &["--height", "0.2 to 10"]),
        ("--target 0:1:0.4 --mass 0", &["--mass", "1 to 1000"]),
        ("--target 0:1:0.4 --seed x", &["--seed"]),
    ] {
        reach(folder.path(), words).refused(says);
    }
    reach(folder.path(), "--target 0:1:0.4 --from nowhere.bvh@1").failed(&["nowhere.bvh"]);
    reach(folder.path(), "--target 0:1:0.4 -o motion.fbx").failed(&["motion.fbx", ".glb"]);
    reach(folder.path(), "--target 0:1:0.4 --report r --picture r").failed(&["two results"]);
}
