//! FBX files of the world, read as motion.

use sinew_motion::Limits;
use sinew_motion::formats::{Parsed, fbx};
use sinew_testkit::capture;

fn read(file: &str) -> Option<Parsed> {
    let bytes = std::fs::read(capture(file)?).expect("it can be read");
    Some(fbx::read(&bytes, &Limits::default()).expect("the file is fine"))
}

#[test]
fn the_walk_has_the_duration_of_its_bvh_and_its_hips_at_hip_height() {
    let Some(walk) = read("fbx/walk01_template.fbx") else { return };
    assert_eq!((walk.clip.frames(), walk.clip.fps()), (251, 60.0));
    // bvhtoolbox_walk01.bvh: 101 frames at 24 Hz.
    assert!((walk.clip.duration_secs() - 100.0 / 24.0).abs() < 1e-9);
    assert_eq!(walk.unit_m, Some(1.0));
    let hips = walk.clip.skeleton().find("Hips").expect("hips");
    assert_eq!(walk.clip.moving(), [hips]);
    assert_eq!(walk.clip.skeleton().len(), 24);
    for frame in 0..walk.clip.frames() {
        let world = walk.clip.world(frame);
        let height = world[hips].translation.y;
        assert!((0.9..1.1).contains(&height), "frame {frame}: {height} m");
        let head = world[walk.clip.skeleton().find("Head").unwrap()].translation.y;
        assert!((1.5..1.8).contains(&head), "frame {frame}: {head} m");
    }
}

#[test]
fn the_walk_of_the_fbx_is_the_walk_of_the_bvh() {
    let (Some(walk), Some(bvh)) = (read("fbx/walk01_template.fbx"), capture("dialects/bvhtoolbox_walk01.bvh")) else {
        return;
    };
    // The root's position in centimetres opens each line of the motion.
    let text = std::fs::read_to_string(bvh).unwrap();
    let (_, motion) = text.split_once("Frame Time").unwrap();
    let rows: Vec<Vec<f64>> = motion
        .lines()
        .skip(1)
        .filter(|line| !line.trim().is_empty())
        .map(|line| line.split_whitespace().take(3).map(|word| word.parse().unwrap()).collect())
        .collect();
    assert_eq!(rows.len(), 101);
    // Every second frame of 24 Hz is every fifth of 60 Hz.
    for (at, row) in rows.iter().enumerate().step_by(2) {
        let hips = walk.clip.translation(at / 2 * 5, 0) * 100.0;
        for (ours, theirs) in hips.to_array().iter().zip(row) {
            // The FBX was resampled with splines from another rate: half a centimetre.
            assert!((ours - theirs).abs() < 0.5, "frame {at}: {hips} and {row:?}");
        }
    }
}

#[test]
fn the_ozz_walk_is_read_in_metres_with_all_its_limbs() {
    let Some(walk) = read("fbx/ozz_walk.fbx") else { return };
    assert_eq!(walk.clip.skeleton().len(), 67);
    assert!((walk.clip.duration_secs() - 4.0 / 3.0).abs() < 1e-6, "{}", walk.clip.duration_secs());
    let heights: Vec<f64> = walk.clip.world(0).iter().map(|joint| joint.translation.y).collect();
    let top = heights.iter().copied().fold(f64::MIN, f64::max);
    assert!((1.6..1.9).contains(&top), "{top} m");
    assert_eq!(walk.clip.first_non_finite(), None);
}

#[test]
fn limits_hold_for_fbx() {
    let Some(path) = capture("fbx/ozz_walk.fbx") else { return };
    let bytes = std::fs::read(path).unwrap();
    let fine = Limits::default();
    for (limits, word) in [
        (Limits { file_bytes: 1000, ..fine }, "bytes"),
        (Limits { joints: 66, ..fine }, "67 joints"),
        (Limits { frames: 40, ..fine }, "frames"),
        (Limits { values: 1000, ..fine }, "frames"),
        (Limits { name_bytes: 4, ..fine }, "name"),
        (Limits { depth: 3, ..fine }, "epth"),
    ] {
        let error = fbx::read(&bytes, &limits).expect_err(word);
        assert!(error.to_string().contains(word) && !error.remedy().is_empty(), "{word}: {error}");
    }
}
