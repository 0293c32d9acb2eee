//! A suit that broadcasts BVH.

use sinew_body::humanoid::{Node, Person, Reduction, log};
use sinew_control::perform::PerformerSample;
use sinew_live::raw::RawReader;
use sinew_motion::formats::{MotionFile, ReadOptions};
use sinew_testkit::capture;

fn read(reader: &mut RawReader, bytes: &[u8]) -> (Vec<PerformerSample>, usize) {
    let (mut samples, mut wrong) = (Vec::new(), 0);
    reader.bytes(bytes, 0.0, &mut |result| match result {
        Ok(sample) => samples.push(sample),
        Err(_) => wrong += 1,
    });
    (samples, wrong)
}

const WALK: &str = "cmu_bvh_60hz_trimmed/35_01_walk.bvh";

#[test]
fn a_broadcast_file_gives_its_own_poses_after_the_first_second_however_it_is_cut() {
    let Some(path) = capture(WALK) else { return };
    let bytes = std::fs::read(&path).unwrap();
    let file = MotionFile::read(&path, &ReadOptions::default()).unwrap();
    let reduction = Reduction::new(&file.clip, file.body_parts().unwrap(), file.stature_m, Person::default()).unwrap();
    let (mut whole, mut pieces) = (RawReader::new(), RawReader::new());
    let (samples, wrong) = read(&mut whole, &bytes);
    assert_eq!(wrong, 0);
    assert_eq!(samples.len(), file.clip.frames() - 60);
    let cut: Vec<PerformerSample> = bytes.chunks(37).flat_map(|piece| read(&mut pieces, piece).0).collect();
    assert_eq!(samples, cut);
    let mut sum = 0.0;
    for (at, sample) in samples.iter().enumerate() {
        let (pose, wanted) = (sample.pose(), reduction.pose(&file.clip.world(60 + at)));
        assert!((pose.hips_position - wanted.hips_position).length() < 0.02);
        for node in Node::ALL {
            sum += log(pose.world[node.index()].conjugate() * wanted.world[node.index()]).length_squared();
        }
    }
    let rms = (sum / (samples.len() * Node::COUNT) as f64).sqrt();
    // Frames of limbs are found on a second of the walk instead of all of it: a few degrees.
    assert!(rms < 0.1, "{rms}");
}

#[test]
fn bad_lines_are_told_and_passed_over_and_a_new_header_begins_anew() {
    let Some(path) = capture(WALK) else { return };
    let text = std::fs::read_to_string(&path).unwrap();
    let mut reader = RawReader::new();
    let (before, _) = read(&mut reader, text.as_bytes());
    let (none, wrong) = read(&mut reader, b"nan nan nan\n1 2 3\n\xff\xfe\n");
    assert!(none.is_empty() && wrong == 3);
    let endless = vec![b'1'; 1 << 20];
    let (none, wrong) = read(&mut reader, &endless);
    assert!(none.is_empty() && wrong == 1, "a line without an end is told once");
    let (after, wrong) = read(&mut reader, format!("\n{text}").as_bytes());
    assert_eq!((after.len(), wrong), (before.len(), 0));
}
