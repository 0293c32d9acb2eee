//! A file without a disturbance is written as it was; and what the response does not move stays as it is.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

#[path = "../../../sinew-response/tests/all/pushing/case.rs"]
mod case;

use case::{Case, PERSON};
use sinew::body::humanoid::Node;
use sinew::figure::body_shapes;
use sinew::jobs::respond::{Answer, RespondJob, respond};
use sinew::motion::formats::{MotionFile, ReadOptions};
use sinew::motion::{Clip, Part};
use sinew::response::{Disturbances, Push, PushFrame, Settings, Track};
use sinew_testkit::{EVERY_CLIP, WALKS, every_bvh, mocap, none_of, work};
use std::path::Path;

/// Reads a motion file as a user would.
fn read(path: &Path) -> MotionFile {
    MotionFile::read(path, &ReadOptions::default()).unwrap()
}

fn job(pushes: Vec<Push>) -> RespondJob {
    RespondJob { pushes, person: PERSON, ..RespondJob::default() }
}

fn hand_push(at_secs: f64) -> Push {
    Push {
        part: Part::LeftHand,
        point: None,
        force_n: glam::DVec3::new(0.0, 0.0, -100.0),
        frame: PushFrame::Facing,
        at_secs,
        for_secs: 0.1,
    }
}

fn written(folder: &Path, source: &Path, answer: &Answer) -> Vec<u8> {
    let out = folder.join(source.file_name().unwrap());
    let file = read(source);
    file.write(&out, &answer.clip, answer.rows(), &body_shapes(&answer.prepared.reduction().shapes())).unwrap();
    std::fs::read(out).unwrap()
}

#[test]
fn every_bvh_without_a_disturbance_is_written_back_byte_for_byte() {
    let Some(mocap) = mocap() else { return };
    let folder = tempfile::tempdir().unwrap();
    let files = every_bvh(&mocap);
    let failures: Vec<String> = work(&files, |path| {
        let answer = respond(&read(path), &job(Vec::new()), None).unwrap();
        let same = written(folder.path(), path, &answer) == std::fs::read(path).unwrap();
        (!same).then(|| path.display().to_string())
    })
    .into_iter()
    .flatten()
    .collect();
    none_of(files.len(), &failures);
}

/// Where a joint's local transform differs in any bit.
fn moved(before: &Clip, after: &Clip, frame: usize, joint: usize) -> bool {
    before.rotation(frame, joint) != after.rotation(frame, joint)
        || before.translation(frame, joint) != after.translation(frame, joint)
}

#[test]
fn fingers_toes_and_faces_keep_every_bit_and_so_do_all_frames_before_the_push() {
    let Some(mocap) = mocap() else { return };
    let failures: Vec<String> = work(&EVERY_CLIP, |name| {
        let file = read(&mocap.join(name));
        let at_secs = 0.5 * file.clip.duration_secs();
        let answer = respond(&file, &job(vec![hand_push(at_secs)]), None).unwrap();
        let humanoid = file.body_parts().unwrap();
        // What is beyond the bodies of the method: it may only be carried along. Above the hips there may be a joint that
        // holds the place of the whole body.
        let joints = file.clip.skeleton().joints();
        let above: Vec<usize> =
            std::iter::successors(joints[humanoid.hips()].parent, |&joint| joints[joint].parent).collect();
        let untouched: Vec<usize> = (0..joints.len())
            .filter(|joint| {
                let chain = humanoid.spine_chain().contains(joint) || humanoid.neck_chain().contains(joint);
                let node = Node::ALL.iter().any(|&node| answer.prepared.reduction().joint(node) == Some(*joint));
                !chain && !node && !above.contains(joint)
            })
            .collect();
        let mut failures = Vec::new();
        let mut any = false;
        for frame in 0..file.clip.frames() {
            let secs = frame as f64 * file.clip.frame_time_secs();
            // The force of the first pose at or after its onset shows in the pose after that.
            let before = secs < at_secs;
            for joint in 0..file.clip.skeleton().len() {
                let moved = moved(&file.clip, &answer.clip, frame, joint);
                any |= moved;
                if moved && (before || untouched.contains(&joint)) && failures.len() < 2 {
                    let joint = &file.clip.skeleton().joints()[joint].name;
                    failures.push(format!("{name}: {joint} in frame {frame}, push at {at_secs:.3} s"));
                }
            }
        }
        if !any {
            failures.push(format!("{name}: nothing moved"));
        }
        if answer.clip.frames() != file.clip.frames()
            || answer.clip.frame_time_secs().to_bits() != file.clip.frame_time_secs().to_bits()
        {
            failures.push(format!("{name}: other frames"));
        }
        failures
    })
    .into_iter()
    .flatten()
    .collect();
    none_of(EVERY_CLIP.len(), &failures);
}

/// Lines of a BVH after its `Frame Time`.
fn rows(bytes: &[u8]) -> Vec<String> {
    let text = String::from_utf8(bytes.to_vec()).unwrap();
    let at = text.find("Frame Time").unwrap();
    text[at..].lines().skip(1).map(str::to_owned).collect()
}

#[test]
fn in_a_written_bvh_rows_before_the_push_and_values_of_untouched_joints_are_the_files_own_text() {
    let Some(mocap) = mocap() else { return };
    let folder = tempfile::tempdir().unwrap();
    let files = every_bvh(&mocap);
    let failures: Vec<String> = work(&files, |path| {
        let file = read(path);
        let at_secs = 0.5 * file.clip.duration_secs();
        let answer = respond(&file, &job(vec![hand_push(at_secs)]), None).unwrap();
        let (before, after) = (std::fs::read(path).unwrap(), written(folder.path(), path, &answer));
        let (before, after) = (rows(&before), rows(&after));
        let name = path.display();
        if before.len() != after.len() {
            return Some(format!("{name}: {} rows became {}", before.len(), after.len()));
        }
        let first_moved = (0..file.clip.frames())
            .find(|&frame| (0..file.clip.skeleton().len()).any(|joint| moved(&file.clip, &answer.clip, frame, joint)));
        let first_moved = first_moved?;
        if before[..first_moved] != after[..first_moved] {
            return Some(format!("{name}: a row before the push changed"));
        }
        // Every joint's own words stay unless the joint moved: in a row of the file as many words change as may.
        let changed = before[first_moved..].iter().zip(&after[first_moved..]).zip(first_moved..).find(
            |((before, after), frame)| {
                let other =
                    before.split_ascii_whitespace().zip(after.split_ascii_whitespace()).filter(|(a, b)| a != b).count();
                let joints = 0..file.clip.skeleton().len();
                let moved = joints.filter(|&joint| moved(&file.clip, &answer.clip, *frame, joint)).count();
                // Three angles a joint, and the place of the root.
                other > 3 * moved + 3
            },
        );
        changed.map(|(_, frame)| format!("{name}: more words of frame {frame} are new than joints moved"))
    })
    .into_iter()
    .flatten()
    .collect();
    none_of(files.len(), &failures);
}

#[test]
fn the_whole_job_and_a_single_run_of_the_response_agree_bit_for_bit() {
    let Some(mocap) = mocap() else { return };
    for name in ["cmu_asfamc/07_01.amc", "dialects/gpmat_Swagger.bvh", "cmu_bvh_daz/13_09.bvh"] {
        let case = Case::load(&mocap, name, 6.0);
        let push = hand_push(2.0);
        let job = RespondJob { repeat: case.repeats, ..job(vec![push]) };
        let answer = respond(&case.file, &job, None).unwrap();
        let settings = case.stable(Settings::default());
        let happens = Disturbances { pushes: &[push], ground: &[] };
        let track = Track::run(case.body(), case.basis(), &settings, case.motion(), happens);
        assert_eq!(track.poses(), answer.pushed.poses(), "{name}");
        assert_eq!(settings, answer.prepared.motion().stable_settings(), "{name}");
    }
}

#[test]
fn on_the_files_own_skeleton_stance_ankles_stay_within_a_millimetre_too() {
    let Some(mocap) = mocap() else { return };
    let failures: Vec<String> = work(&WALKS, |name| {
        let file = read(&mocap.join(name));
        [Part::LeftHand, Part::Head, Part::Chest].map(|part| {
            let pushes =
                [(2.0, [0.0, 0.0, -1.0]), (4.3, [1.0, 0.0, 0.0]), (6.6, [0.0, 0.0, 1.0]), (8.9, [-1.0, 0.0, 0.0])];
            let pushes = pushes.map(|(at_secs, way)| Push {
                part,
                force_n: glam::DVec3::from_array(way) * 100.0,
                ..hand_push(at_secs)
            });
            let job = RespondJob { repeat: 10, ..job(pushes.to_vec()) };
            let answer = respond(&file, &job, None).unwrap();
            let millimetres = answer.report.stance_deviation_max_m * 1e3;
            (millimetres > 1.0 || !answer.report.finite).then(|| format!("{name}, {part}: {millimetres:.2} mm"))
        })
    })
    .into_iter()
    .flatten()
    .flatten()
    .collect();
    none_of(3 * WALKS.len(), &failures);
}

#[test]
fn the_ground_carries_the_body_off_and_its_upper_part_lags_and_recovers() {
    let Some(mocap) = mocap() else { return };
    for name in ["cmu_asfamc/07_01.amc", "accad_bvh/Female1_B03_Walk1.bvh", "dialects/gpmat_Swagger.bvh"] {
        let file = read(&mocap.join(name));
        let jerk = sinew::response::GroundJerk {
            acceleration: glam::DVec3::new(4.0, 0.0, 0.0),
            frame: PushFrame::World,
            at_secs: 2.0,
            for_secs: 0.2,
        };
        let job = RespondJob { ground: vec![jerk], repeat: 10, ..job(Vec::new()) };
        let answer = respond(&file, &job, None).unwrap();
        assert!(answer.report.finite, "{name}");
        assert!(answer.report.stance_deviation_max_m < 1e-3, "{name}: {}", answer.report.stance_deviation_max_m);
        assert!(answer.report.recovered_after_s.unwrap() < 6.0, "{name}");
        // From then on the ground goes on at 0.8 m/s: 4 m/s² for 0.2 s.
        let deviations = answer.pushed.deviations();
        let last = deviations.len() - 1;
        let speed = (deviations[last].ground_shift - deviations[last - 60].ground_shift).x;
        assert!((speed - 0.8).abs() < 1e-6, "{name}: {speed}");
        // While the ground jerks to +x the head stays behind, towards -x, of where the ground alone would carry it.
        let head = |track: &Track, index: usize| {
            track.poses()[index].positions(answer.prepared.reduction().body())[Node::Head.index()]
        };
        let lag = (126..150).map(|index| {
            (head(&answer.pushed, index) - head(&answer.unpushed, index) - deviations[index].ground_shift).x
        });
        let lag = lag.fold(f64::INFINITY, f64::min);
        eprintln!("{name}: the head lags {:.1} cm", -lag * 100.0);
        assert!(lag < -0.01, "{name}: {lag}");
    }
}
