//! `sinew run` gives a character's motion back on its own skeleton.

use crate::command::sinew;
use sinew::motion::formats::{MotionFile, ReadOptions};
use std::path::Path;

const SAMPLES: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../samples");

fn scene(clip: &str) -> String {
    format!(
        "format = 1\n[stage]\nduration_secs = 1\n[characters.hero]\nposition_m = [3, 0, 1]\nfacing_deg = 70\n\
         tracker = \"kinematic\"\nsource = {{ clip = \"{clip}\", repeat = false }}\n[props.crate]\nbox_m = [1, 1, 1]\nfixed = true\nposition_m = [0, 0.5, 0]\n"
    )
}

fn read(path: &Path) -> MotionFile {
    MotionFile::read(path, &ReadOptions::default()).unwrap()
}

#[test]
fn a_kinematic_run_of_a_clip_is_that_clip_on_its_own_skeleton() {
    for name in ["walk.bvh", "walk.glb"] {
        let folder = tempfile::tempdir().unwrap();
        let at = folder.path();
        std::fs::copy(Path::new(SAMPLES).join(name), at.join(name)).unwrap();
        std::fs::write(at.join("s.toml"), scene(name)).unwrap();
        let ran = sinew(at, ["run", "s.toml", "--no-live", "--character", "hero", "-o", &format!("out_{name}")]).done();
        assert!(ran.err.contains(&format!("hero is on the skeleton and mesh of {name}")), "{}", ran.err);
        let (before, after) = (read(&at.join(name)), read(&at.join(format!("out_{name}"))));
        let (old, new) = (before.clip.skeleton().joints(), after.clip.skeleton().joints());
        assert_eq!(old.len(), new.len());
        assert!(old.iter().zip(new).all(|(old, new)| old.name == new.name && old.parent == new.parent));
        // The walk begins with its first frame, at the scene's own rate of 60 Hz.
        assert_eq!(after.clip.frames(), 61);
        for frame in 0..61 {
            for joint in 0..old.len() {
                if old[joint].parent.is_none() {
                    continue;
                }
                let apart = before.clip.rotation(frame, joint).angle_between(after.clip.rotation(frame, joint));
                assert!(apart.to_degrees() < 0.1, "{name}, frame {frame}, {}: {apart} rad", old[joint].name);
            }
        }
        // Moved to where the scene has the character: the hips begin over its place.
        let hips = after.clip.world(0)[after.body_parts().unwrap().joint(sinew::motion::Part::Hips).unwrap()];
        assert!((hips.translation.x - 3.0).abs() < 1e-3 && (hips.translation.z - 1.0).abs() < 1e-3, "{hips:?}");
    }
}

#[test]
fn all_of_a_scene_and_a_body_without_a_clip_are_written_as_bodies_and_a_note_says_so() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    std::fs::copy(Path::new(SAMPLES).join("walk.bvh"), at.join("walk.bvh")).unwrap();
    std::fs::write(at.join("s.toml"), scene("walk.bvh")).unwrap();
    let ran = sinew(at, ["run", "s.toml", "--no-live", "-o", "all.glb"]).done();
    assert!(ran.err.contains("--character hero writes it on the skeleton of walk.bvh"), "{}", ran.err);
    std::fs::write(at.join("t.toml"), "format = 1\n[stage]\nduration_secs = 0.5\n[characters.one]\n").unwrap();
    let ran = sinew(at, ["run", "t.toml", "--no-live", "-o", "one.bvh", "-o", "one.glb"]).done();
    assert_eq!(ran.err.matches("no clip of its own and is written as a body of 18 parts").count(), 2, "{}", ran.err);
    assert_eq!(read(&at.join("one.bvh")).clip.skeleton().len(), 18);
}

#[test]
fn a_reach_out_of_a_clip_is_written_on_the_clips_skeleton() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    let clip = format!("{SAMPLES}/walk.bvh@1.5");
    let words = ["reach", "--target", "-0.3:1.3:0.9", "--from", &clip, "--back", "-o", "r.bvh", "-o", "r.glb"];
    let ran = sinew(at, words).done();
    assert_eq!(ran.err.matches("on the skeleton and mesh of").count(), 2, "{}", ran.err);
    let (walk, reach) = (read(&Path::new(SAMPLES).join("walk.bvh")), read(&at.join("r.bvh")));
    let names =
        |file: &MotionFile| file.clip.skeleton().joints().iter().map(|joint| joint.name.clone()).collect::<Vec<_>>();
    assert_eq!(names(&walk), names(&reach));
    // It begins with the frame in which the clip was left; legs are placed anew, for the body stands on its soles.
    let is_leg = |name: &str| ["Leg", "Foot", "Toe"].iter().any(|word| name.contains(word));
    for (joint, name) in names(&walk).iter().enumerate().skip(1).filter(|(_, name)| !is_leg(name)) {
        let apart = walk.clip.rotation(90, joint).angle_between(reach.clip.rotation(0, joint));
        assert!(apart.to_degrees() < 0.5, "{name}: {apart} rad");
    }
}
