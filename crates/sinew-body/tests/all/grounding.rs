//! Grounding: made errors on clips, against the clips without them.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use glam::DVec3;
use sinew_body::grounding::{GroundSettings, Grounding, ground};
use sinew_body::humanoid::{Body, Person, Pose, Reduction};
use sinew_motion::formats::{MotionFile, ReadOptions};
use sinew_motion::{Clip, moves_from};
use sinew_testkit::{WALKS, capture, repository};
use std::path::Path;

/// Nearly normal noise of variance 1: sums of twelve hashes.
fn noise(frame: usize, axis: usize) -> f64 {
    let hash = |seed: u64| {
        let mut x = seed.wrapping_mul(0x9e37_79b9_7f4a_7c15);
        x = (x ^ (x >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        x = (x ^ (x >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((x ^ (x >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
    };
    (0..12).map(|part| hash((frame * 64 + axis * 16 + part) as u64)).sum::<f64>() - 6.0
}

/// 2 cm/s over the ground.
fn drift(_: usize, secs: f64) -> DVec3 {
    DVec3::new(0.016, 0.0, -0.012) * secs
}

/// 3 cm up and down.
fn float(_: usize, secs: f64) -> DVec3 {
    DVec3::Y * 0.03 * libm::sin(1.5 * secs)
}

/// 5 mm, each frame by itself.
fn jitter(frame: usize, _: f64) -> DVec3 {
    DVec3::new(noise(frame, 0), noise(frame, 1), noise(frame, 2)) * 0.005
}

/// A clip, how it is seen as a body, and its first real frame.
struct Case {
    clip: Clip,
    reduction: Reduction,
    first: usize,
}

impl Case {
    fn read(path: &Path) -> Case {
        let file = MotionFile::read(path, &ReadOptions::default()).unwrap();
        let humanoid = file.body_parts().unwrap();
        let reduction = Reduction::new(&file.clip, humanoid, file.stature_m, Person::default()).unwrap();
        Case { first: moves_from(&file.clip, humanoid), reduction, clip: file.clip }
    }

    fn grounding(&self, clip: &Clip, settings: &GroundSettings) -> Grounding {
        Grounding::of_clip(clip, &self.reduction, self.first, settings)
    }

    fn grounded(&self, clip: &Clip, settings: &GroundSettings) -> Clip {
        self.grounding(clip, settings).applied(clip, &self.reduction, self.first)
    }

    fn with(&self, error: impl Fn(usize, f64) -> DVec3) -> Clip {
        let mut made = self.clip.clone();
        let root = made.moving()[0];
        for frame in self.first..made.frames() {
            let secs = (frame - self.first) as f64 * made.frame_time_secs();
            let at = made.translation(frame, root);
            made.set_translation(frame, root, at + error(frame, secs));
        }
        made
    }
}

/// Root mean square distance between the joints of two clips \[m\].
fn apart_m(a: &Clip, b: &Clip) -> f64 {
    let (mut sum, mut count) = (0.0, 0.0);
    for frame in 0..a.frames() {
        for (a, b) in a.world(frame).iter().zip(b.world(frame)) {
            sum += a.translation.distance_squared(b.translation);
            count += 1.0;
        }
    }
    (sum / count).sqrt()
}

/// Largest angle between the rotations of two clips \[deg\].
fn turned_deg(a: &Clip, b: &Clip) -> f64 {
    let frames = 0..a.frames();
    let turn =
        |frame: usize, joint: usize| a.rotation(frame, joint).angle_between(b.rotation(frame, joint)).to_degrees();
    frames.flat_map(|frame| (0..a.skeleton().len()).map(move |joint| turn(frame, joint))).fold(0.0, f64::max)
}

#[test]
fn of_errors_made_on_a_walk_that_stands_well_at_most_a_fifth_is_left() {
    let walk = Case::read(&repository("samples/walk.bvh"));
    let settings = GroundSettings::default();
    // What the walk itself slides (0.9 mm/s) is no made error.
    let clean = walk.grounded(&walk.clip, &settings);
    assert!(apart_m(&clean, &walk.clip) < 0.006, "{} m", apart_m(&clean, &walk.clip));
    for (name, made) in [("drift", walk.with(drift)), ("float", walk.with(float))] {
        let out = walk.grounded(&made, &settings);
        let (before, after) = (apart_m(&made, &walk.clip), apart_m(&out, &clean));
        assert!(after < 0.2 * before, "{name}: {after} m of {before} m");
        assert!(turned_deg(&out, &walk.clip) < 2.0, "{name}: {} deg", turned_deg(&out, &walk.clip));
    }
    // Jitter hides a slow drift: what is left of it and of both together depends on the noise.
    let shaken = walk.with(jitter);
    let left = apart_m(&walk.grounded(&shaken, &settings), &clean) / apart_m(&shaken, &walk.clip);
    assert!(left < 0.7, "{left}");
    let all = walk.with(|frame, secs| drift(frame, secs) + float(frame, secs) + jitter(frame, secs));
    let left = apart_m(&walk.grounded(&all, &settings), &clean) / apart_m(&all, &walk.clip);
    assert!(left < 0.3, "{left}");
}

#[test]
fn a_shaken_body_moves_as_smoothly_as_before_it_was_shaken() {
    let walk = Case::read(&repository("samples/walk.bvh"));
    let rough = |clip: &Clip| {
        let hips = walk.reduction.joint(sinew_body::humanoid::Node::Hips).unwrap();
        let at = |frame: usize| clip.world(frame)[hips].translation - walk.clip.world(frame)[hips].translation;
        let bend = |frame: usize| (at(frame + 1) - 2.0 * at(frame) + at(frame - 1)).length_squared();
        (1..clip.frames() - 1).map(bend).sum::<f64>().sqrt()
    };
    let shaken = walk.with(jitter);
    let out = walk.grounded(&shaken, &GroundSettings::default());
    assert!(rough(&out) < 0.1 * rough(&shaken), "{} of {}", rough(&out), rough(&shaken));
}

#[test]
fn made_errors_on_captured_walks_are_taken_out_to_a_fifth() {
    for name in WALKS {
        let Some(path) = capture(name) else { return };
        // On a treadmill, and with a walk of one step, no drift can be told.
        if name.starts_with("gltf") || name.starts_with("fbx") {
            continue;
        }
        let walk = Case::read(&path);
        // Captured people slide and float themselves: errors are measured against the grounded clip, on its floor.
        let own = walk.grounding(&walk.clip, &GroundSettings::default());
        let floor_m = own.floor_m;
        let settings = GroundSettings { floor_m: Some(floor_m) };
        let clean = walk.grounded(&walk.clip, &settings);
        // Walks whose soles hardly ever lie flat keep up to two thirds of the float; the command says so.
        let floats = own.stands_share() > Grounding::SURE_SHARE;
        let errors = [("drift", walk.with(drift)), ("float", walk.with(float))];
        for (error, made) in errors.into_iter().filter(|(error, _)| floats || *error == "drift") {
            let out = walk.grounded(&made, &settings);
            let (before, after) = (apart_m(&made, &walk.clip), apart_m(&out, &clean));
            assert!(after < 0.2 * before, "{name}, {error}: {after} m of {before} m");
        }
    }
}

#[test]
fn standing_feet_rest_on_the_floor_and_the_residual_force_falls() {
    let walk = Case::read(&repository("samples/walk.bvh"));
    let made = walk.with(|frame, secs| drift(frame, secs) + float(frame, secs));
    let grounding = walk.grounding(&made, &GroundSettings::default());
    let out = grounding.applied(&made, &walk.reduction, walk.first);
    let quality = |clip: &Clip| grounding.quality(clip, &walk.reduction, walk.first);
    let (before, after) = (quality(&made), quality(&out));
    assert!(after.slide_mean_m_s < 0.002 && before.slide_mean_m_s > 0.015, "{before:?} {after:?}");
    assert!(after.height_rms_m < 0.001 && before.height_rms_m > 0.015, "{before:?} {after:?}");
    // 4 mm are left to heels that strike.
    assert!(after.penetration_m < 0.005 && before.penetration_m > 0.02, "{before:?} {after:?}");
    assert!(after.residual_force <= before.residual_force + 1e-3, "{before:?} {after:?}");
}

#[test]
fn a_hop_stays_a_fall_under_gravity() {
    let body = Body::standard(80.0, 1.7);
    let (fps, g) = (60.0, 9.81);
    // Stands, flies for 0.4 s, stands; all the while it floats more and more, to 3 cm.
    let height = |secs: f64| {
        let air = secs - 1.0;
        if (0.0..0.4).contains(&air) { 0.5 * g * air * (0.4 - air) } else { 0.0 }
    };
    let pose = |frame: usize| {
        let secs = frame as f64 / fps;
        let up = height(secs) + 0.03 * secs / 2.4;
        Pose { hips_position: Pose::STANDING.hips_position + DVec3::Y * up, ..Pose::STANDING }
    };
    let poses: Vec<Pose> = (0..144).map(pose).collect();
    let grounding = ground(&body, &poses, fps, &GroundSettings::default());
    let at = |frame: usize| poses[frame].hips_position.y + grounding.body_shifts[frame].y;
    for frame in 66..80 {
        let acceleration = (at(frame + 1) - 2.0 * at(frame) + at(frame - 1)) * fps * fps;
        assert!((acceleration + g).abs() < 0.3, "frame {frame}: {acceleration} m/s²");
    }
    let (before, after) = (at(30), at(120));
    assert!((before - after).abs() < 0.003, "{before} m and {after} m");
}

#[test]
fn clips_of_few_frames_stay_as_they_are() {
    let body = Body::standard(80.0, 1.7);
    for frames in 0..4 {
        let grounding = ground(&body, &vec![Pose::STANDING; frames], 60.0, &GroundSettings::default());
        assert_eq!(grounding.body_shifts, vec![DVec3::ZERO; frames]);
    }
}
