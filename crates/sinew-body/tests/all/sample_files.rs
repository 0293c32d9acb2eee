//! The sample files that the repository ships.

#[path = "../../examples/make_samples.rs"]
mod make_samples;

use sinew_motion::formats::{Parsed, bvh, gltf};
use sinew_motion::{Clip, Humanoid, Limits, Origin, Part, find_cycle, find_defects, guess_space};

fn shipped(name: &str) -> Vec<u8> {
    let path = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../../samples").join(name);
    std::fs::read(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

#[test]
fn the_shipped_files_are_what_the_generator_makes_byte_for_byte() {
    for (name, bytes) in make_samples::files().unwrap() {
        let shipped = shipped(name);
        let at = bytes.iter().zip(&shipped).position(|(a, b)| a != b);
        assert!(
            bytes == shipped,
            "samples/{name} differs from what `cargo run -p sinew-body --example make_samples` writes ({} bytes against {}, \
             first at {at:?}): run it and look at the walk",
            shipped.len(),
            bytes.len()
        );
        // A newcomer downloads them, and the repository carries them for ever.
        assert!(bytes.len() < 1_000_000, "{name} has {} bytes", bytes.len());
    }
}

fn in_metres(parsed: &Parsed) -> (Clip, Humanoid, f64) {
    let humanoid = Humanoid::of(&parsed.clip, &[]).expect("the sample is a body");
    let guess = guess_space(&parsed.clip, &humanoid, parsed.unit_m, parsed.world_from_source);
    let clip = guess.space.clip_to_world(&parsed.clip);
    (clip, humanoid, guess.stature_m)
}

#[test]
fn both_files_are_understood_without_a_hint() {
    let limits = Limits::default();
    let bvh = bvh::read(&shipped("walk.bvh"), &limits).unwrap();
    let glb = gltf::read_slice(&shipped("walk.glb"), None, &limits).unwrap();
    for parsed in [bvh, glb] {
        let (clip, humanoid, stature_m) = in_metres(&parsed);
        // The BVH states no unit: centimetres must be found. The stature is measured along a slightly curved spine.
        assert!((stature_m - 1.70).abs() < 0.01, "{stature_m}");
        for &part in Part::ALL.iter().filter(|&&part| part != Part::UpperChest) {
            assert_eq!(humanoid.origin(part), Some(Origin::Name), "{part}");
        }
        let cycle = find_cycle(&clip, &humanoid).expect("a walk has a cycle");
        assert_eq!(cycle.last - cycle.first, 66);
        // Files round: single precision in the one, a millionth of a degree in the other.
        assert!(cycle.pose_gap_deg < 1e-3, "{cycle:?}");
        assert_eq!(find_defects(&clip, &humanoid), vec![]);
        // A push after one or two seconds has time to pass.
        assert!(clip.duration_secs() >= 8.0);
    }
}

#[test]
fn both_files_hold_the_same_motion() {
    let limits = Limits::default();
    let (bvh, of_bvh, _) = in_metres(&bvh::read(&shipped("walk.bvh"), &limits).unwrap());
    let (glb, of_glb, _) = in_metres(&gltf::read_slice(&shipped("walk.glb"), None, &limits).unwrap());
    assert_eq!(bvh.frames(), glb.frames());
    for frame in 0..bvh.frames() {
        let (a, b) = (bvh.world(frame), glb.world(frame));
        for (part, joint) in of_bvh.parts() {
            let other = of_glb.joint(part).unwrap();
            // Single precision: 1e-6 m over ten metres, 1e-7 rad in every joint of a chain.
            assert!((a[joint].translation - b[other].translation).length() < 5e-6, "{part} in frame {frame}");
        }
    }
}
