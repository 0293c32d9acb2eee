//! Out of the middle of a walk.

use crate::common::hand;
use crate::common::motion::{apart_deg, frames, roughness};
use glam::DVec3;
use sinew_body::humanoid::{Person, Pose, Reduction};
use sinew_motion::formats::{MotionFile, ReadOptions};
use sinew_motion::resample;
use sinew_reach::{Goal, Reacher, Start, Style};
use std::path::Path;

#[test]
fn whoever_walks_goes_on_from_there_comes_to_stand_and_reaches() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../samples/walk.bvh");
    let file = MotionFile::read(&path, &ReadOptions::default()).expect("the sample walk");
    let parts = file.body_parts().expect("a body");
    let reduction = Reduction::new(&file.clip, parts, file.stature_m, Person::default()).expect("a body");
    let clip = resample(&file.clip, 60.0);
    let body = reduction.body();
    for frame in (60..126).step_by(6) {
        let poses: Vec<Pose> = [frame - 1, frame].map(|at| reduction.pose(&clip.world(at))).to_vec();
        let start = Start { pose: poses[1], before: Some((poses[0], 1.0 / 60.0)) };
        let mut reacher = Reacher::new(body, &Style::default(), &start).expect("a style in range");
        let (first, next) = (reacher.pose_at(0.0), reacher.pose_at(1.0 / 240.0));
        let velocity = (next.hips_position - first.hips_position) * 240.0;
        let walked = (poses[1].hips_position - poses[0].hips_position) * 60.0;
        let off = (first.hips_position - poses[1].hips_position).length();
        let target = poses[1].hips_position + DVec3::new(-0.3, 0.4, 0.9);
        reacher.reach(&Goal { right: Some(target), ..Goal::default() });
        let end = reacher.done_secs();
        let mut seen: Vec<Pose> = (frame - 3..frame).map(|at| reduction.pose(&clip.world(at))).collect();
        seen.extend(frames(&reacher, 0.0));
        assert!(apart_deg(&poses[1], &seen[3]) < 0.5, "frame {frame}: {}", apart_deg(&poses[1], &seen[3]));
        let worst = roughness(&seen);
        // Most phases stop below 6 m/s²; a foot that is just about to lift off behind has to come along.
        assert!(worst.hips_m_s2 < 13.0, "frame {frame}: {worst:?}");
        assert!(worst.head_deg_s < 400.0, "frame {frame}: {worst:?}");
        // The walk's own knees turn by 5.9 degrees in a frame.
        assert!(worst.knee_deg < 7.7, "frame {frame}: {worst:?}");
        let lowest = (0..240)
            .map(|at| reacher.pose_at(end * f64::from(at) / 240.0).hips_position.y)
            .fold(f64::INFINITY, f64::min);
        assert!(off < 1e-3, "frame {frame}: {off}");
        let along = DVec3::new(velocity.x - walked.x, 0.0, velocity.z - walked.z).length();
        assert!(along < 0.05, "frame {frame}: {velocity} after {walked}");
        // Caught in a long step, the hips sink, by a quarter of a metre at most.
        assert!(lowest > poses[1].hips_position.y - 0.25, "frame {frame}: {lowest}");
        assert!((hand(body, &reacher.pose_at(end), true) - target).length() < 1e-3);
    }
}
