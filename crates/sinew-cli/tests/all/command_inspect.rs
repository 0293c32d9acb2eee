//! `sinew inspect` and `sinew convert` as their user runs them.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use crate::command::sinew;
use serde_json::Value;
use sinew_testkit::{EVERY_CLIP, mocap, none_of, work};

#[test]
fn inspect_json_has_the_promised_keys_on_every_file() {
    let Some(mocap) = mocap() else { return };
    let no_body = ["gltf/Fox.glb", "gltf/RiggedSimple.glb"];
    let names: Vec<&str> = EVERY_CLIP.into_iter().chain(no_body).collect();
    let failures: Vec<String> = work(&names, |name| {
        let ran = sinew(&mocap, ["inspect", name, "--json"]);
        let mut wrong = Vec::new();
        if ran.code != 0 {
            return vec![format!("{name}: exit code {}: {}", ran.code, ran.err)];
        }
        let value: Value = serde_json::from_str(&ran.out).unwrap();
        let mut check = |what: &str, good: bool| {
            if !good {
                wrong.push(format!("{name}: {what}: {}", value[what]));
            }
        };
        let body = !no_body.contains(name);
        let positive = |what: &str| value[what].as_f64().is_some_and(|number| number > 0.0);
        check("format", ["bvh", "amc", "gltf", "glb", "fbx"].contains(&value["format"].as_str().unwrap_or("")));
        check("frames", positive("frames"));
        check("fps", positive("fps"));
        check("unit_m", positive("unit_m"));
        check("stature_m", if body { positive("stature_m") } else { value["stature_m"].is_null() });
        check("no_body", value["no_body"].is_null() == body);
        check(
            "joints",
            value["joints"].as_array().is_some_and(|joints| {
                let fine =
                    |joint: &Value| joint["name"].is_string() && (joint["part"].is_string() || joint["part"].is_null());
                let parts = joints.iter().filter(|joint| joint["part"].is_string()).count();
                !joints.is_empty() && joints.iter().all(fine) && (!body || parts >= 13)
            }),
        );
        let masses = value["mass_kg"].as_object();
        check(
            "mass_kg",
            masses.is_some_and(|masses| {
                let sum: f64 = masses.values().filter_map(Value::as_f64).sum();
                if body { (sum - 80.0).abs() < 1e-6 } else { masses.is_empty() }
            }),
        );
        let frames = value["frames"].as_u64().unwrap_or(0);
        check(
            "cycle",
            value.get("cycle").is_some_and(|cycle| {
                cycle.is_null()
                    || cycle.as_array().is_some_and(|ends| {
                        let ends: Vec<u64> = ends.iter().filter_map(Value::as_u64).collect();
                        ends.len() == 2 && ends[0] < ends[1] && ends[1] < frames
                    })
            }),
        );
        check("defects", value["defects"].is_array());
        wrong
    })
    .into_iter()
    .flatten()
    .collect();
    none_of(names.len(), &failures);
}

#[test]
fn a_skeleton_that_is_no_human_is_inspected_with_the_reason_why() {
    let Some(mocap) = mocap() else { return };
    for name in ["gltf/Fox.glb", "gltf/RiggedSimple.glb"] {
        let ran = sinew(&mocap, ["inspect", name]).done();
        assert!(ran.out.contains("no human body"), "{}", ran.out);
        assert!(ran.out.contains("joints ("), "{}", ran.out);
    }
}

#[test]
fn inspect_answers_in_words_with_the_gait_cycle_and_the_spectrum() {
    let Some(mocap) = mocap() else { return };
    let ran = sinew(&mocap, ["inspect", "cmu_asfamc/07_01.amc"]).done();
    for word in ["gait cycle", "stature", "actuation spectrum", "fps"] {
        assert!(ran.out.contains(word), "{word}: {}", ran.out);
    }
}

#[test]
fn what_cannot_be_read_fails_with_its_name_and_exit_code_1() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    std::fs::write(at.join("broken.bvh"), "HIERARCHY\nROOT Hips\n{\n").unwrap();
    std::fs::write(at.join("empty.bvh"), "").unwrap();
    std::fs::write(at.join("noise.glb"), [0xff; 64]).unwrap();
    std::fs::write(at.join("alone.amc"), ":FULLY-SPECIFIED\n:DEGREES\n1\nroot 0 0 0 0 0 0\n").unwrap();
    for name in ["broken.bvh", "empty.bvh", "noise.glb", "alone.amc", "missing.bvh", "."] {
        for command in [&["inspect"][..], &["inspect", "--json"], &["respond"], &["convert"]] {
            let mut arguments = command.to_vec();
            arguments.push(name);
            if command[0] == "convert" {
                arguments.push("out.bvh");
            }
            let ran = sinew(at, &arguments);
            assert_eq!(ran.code, 1, "{arguments:?}: {}{}", ran.out, ran.err);
            assert!(ran.err.contains(name), "{arguments:?}: {}", ran.err);
            assert!(!at.join("out.bvh").exists());
        }
    }
}

#[test]
fn wrong_usage_is_refused_with_exit_code_2() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    sinew(at, ["inspect"]).refused(&["FILE"]);
    sinew(at, ["swim"]).refused(&["swim"]);
    sinew(at, ["inspect", "a.bvh", "--loudly"]).refused(&["--loudly"]);
    sinew(at, ["convert", "a.bvh"]).refused(&["OUT"]);
    sinew(at, ["inspect", "a.bvh", "--units", "much"]).refused(&["much"]);
    assert_eq!(sinew(at, ["--help"]).done().err, "");
    assert!(sinew(at, ["--version"]).done().out.contains(env!("CARGO_PKG_VERSION")));
}

#[test]
fn a_clip_converts_into_every_format_that_is_written_and_reads_the_same() {
    let Some(mocap) = mocap() else { return };
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    let source = mocap.join("cmu_bvh_60hz_trimmed/35_01_walk.bvh");
    for name in ["walk.bvh", "walk.glb", "walk.gltf"] {
        sinew(
            at,
            [source.as_os_str(), name.as_ref()].into_iter().fold(vec!["convert".as_ref()], |mut all, next| {
                all.push(next);
                all
            }),
        )
        .done();
        let ran = sinew(at, ["inspect", name, "--json"]).done();
        let value: Value = serde_json::from_str(&ran.out).unwrap();
        assert_eq!(value["frames"], 120, "{name}");
        assert!((value["fps"].as_f64().unwrap() - 60.0).abs() < 0.1, "{name}");
        assert!(value["no_body"].is_null(), "{name}");
    }
}
