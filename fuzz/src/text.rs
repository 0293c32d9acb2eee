//! What the fuzz targets of the text formats do with a file. The tests of `sinew-motion` call the same functions on
//! mutated files, so that they run without a nightly compiler.

use sinew_motion::formats::{Document, Parsed, Source, WriteJob, amc, bvh};
use sinew_motion::{Clip, Error, Limits, SourceSpace};

/// A small skeleton for fuzzed motions.
pub const SKELETON: &[u8] = b":units\n length 0.45\n angle deg\n:root\n order TX TY TZ RX RY RZ\n axis XYZ\n position 0 0 0\n \
orientation 0 0 0\n:bonedata\n begin\n name a\n direction 0 1 0\n length 2\n axis 0 0 20 XYZ\n dof rx rz\n end\n begin\n name \
b\n direction 1 0 0\n length 1\n axis 90 0 0 XYZ\n dof rx ry rz\n end\n:hierarchy\n begin\n root a\n a b\n end\n";

/// Small enough that a fuzzer is fast, large enough that a file can reach them.
pub const LIMITS: Limits =
    Limits { file_bytes: 1 << 20, joints: 100, depth: 32, frames: 2_000, values: 200_000, name_bytes: 64 };

type Writer = fn(&mut dyn std::io::Write, &WriteJob) -> Result<(), Error>;

/// Reads a BVH; what is read is written over itself and anew.
///
/// # Panics
/// If a file that was read does not write back to the same bytes, or to another motion.
pub fn bvh(data: &[u8]) {
    let Ok(parsed) = bvh::read(data, &LIMITS) else { return };
    rewrite(data, &parsed, bvh::write);
    edit(&parsed, bvh::write, |bytes| bvh::read(bytes, &LIMITS));
    anew(&parsed, bvh::write);
}

/// Reads a skeleton.
pub fn asf(data: &[u8]) {
    let _ = amc::read_skeleton(data, &LIMITS);
    let _ = amc::read(b"1\nroot 0 0 0 0 0 0\n", data, &LIMITS);
}

/// Reads a motion to a fixed skeleton; what is read is written over itself and anew.
///
/// # Panics
/// As [`bvh`].
pub fn amc(data: &[u8]) {
    let Ok(parsed) = amc::read(data, SKELETON, &LIMITS) else { return };
    rewrite(data, &parsed, amc::write);
    edit(&parsed, amc::write, |bytes| amc::read(bytes, SKELETON, &LIMITS));
    anew(&parsed, amc::write);
    let clip = SourceSpace::SINEW.clip_to_world(&parsed.clip);
    amc::write_skeleton(&mut Vec::new(), &clip).expect("one root, all finite");
}

fn rewrite(data: &[u8], parsed: &Parsed, write: Writer) {
    let rows: Vec<usize> = (0..parsed.clip.frames()).collect();
    let out = over(parsed, &parsed.clip, &rows, write);
    assert!(out == data, "an unchanged motion writes back to the same bytes");
}

/// Repeats the first frame and leaves out the last: the motion that is written must be read again.
fn edit(parsed: &Parsed, write: Writer, read: impl Fn(&[u8]) -> Result<Parsed, Error>) {
    let frames = parsed.clip.frames();
    if frames < 2 || frames * 2 > LIMITS.frames {
        return;
    }
    let rows: Vec<usize> = (0..frames - 1).flat_map(|row| [row, 0]).collect();
    let mut clip =
        Clip::new(parsed.clip.skeleton().clone(), parsed.clip.frame_time_secs(), parsed.clip.moving().to_vec());
    for &row in &rows {
        let locals: Vec<_> = (0..clip.skeleton().len()).map(|joint| parsed.clip.local(row, joint)).collect();
        clip.push(&locals);
    }
    let out = over(parsed, &clip, &rows, write);
    if out.len() as u64 > LIMITS.file_bytes || frames * 2 * clip.skeleton().len() * 6 > LIMITS.values {
        return;
    }
    let again = read(&out).expect("what was written is read");
    assert_eq!(again.clip, clip, "the same motion");
}

fn over(parsed: &Parsed, clip: &Clip, rows: &[usize], write: Writer) -> Vec<u8> {
    assert!(!matches!(parsed.document, Document::None));
    let source = Source { document: &parsed.document, clip: &parsed.clip, space: SourceSpace::SINEW, rows };
    let mut out = Vec::new();
    write(&mut out, &WriteJob { clip, source: Some(source) }).expect("writing to memory");
    out
}

fn anew(parsed: &Parsed, write: Writer) {
    // Several roots and the like are refused: no panic is all that is asked for.
    let _ = write(&mut Vec::new(), &WriteJob { clip: &parsed.clip, source: None });
}
