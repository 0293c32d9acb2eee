//! Broken and evil text files: an error with a remedy or a motion, never a panic, a hang or a flood of memory.
#![allow(clippy::unwrap_used, reason = "a test may fail")]

#[path = "../../../../fuzz/src/text.rs"]
mod fuzz;
use crate::text::{complaint, parse};
use proptest::prelude::*;
use sinew_motion::formats::{amc, bvh};
use sinew_motion::{Error, Limits};

const BVH: &str = "HIERARCHY\r\nROOT hips\n{\n OFFSET 0 9.5 0\n CHANNELS 6 Xposition Yposition Zposition Zrotation \
                   Xrotation Yrotation\n JOINT leg\n {\n  OFFSET 1 -2 .5\n  CHANNELS 2 Yrotation Xposition\n  End Site\n  \
                   {\n   OFFSET 0 -1e0 0\n  }\n }\n}\nMOTION\nFrames: 3\nFrame Time:\t.0083333\n1 2 3 40 50 60 7 \
                   8\n-1.5e-014 2 3 400 90 -60 7 8 \r\n1 2 3 40 50 60 7 8";

const AMC: &str = "#!OML\n:FULLY-SPECIFIED\n:DEGREES\n7\nroot 1 2 3 10 20 30\na 5 6.5\nb 1 2 -3e-015\n8\nroot 1 2 3 10 20 \
                   30\na 5 6.5\nb 1 2 3\n9\nroot 1 2 3 10 20 30\na 5 6\nb 1 2 3\n";

fn asf_text() -> String {
    String::from_utf8(fuzz::SKELETON.to_vec()).unwrap()
}

fn amc_complaint(motion: &str, skeleton: &str) -> String {
    amc::read(motion.as_bytes(), skeleton.as_bytes(), &Limits::default()).map(|_| ()).expect_err(motion).to_string()
}

/// Replaces a piece that must be there.
fn with(text: &str, piece: &str, other: &str) -> String {
    assert!(text.contains(piece), "{piece:?}");
    text.replacen(piece, other, 1)
}

#[test]
fn the_small_files_are_sound() {
    assert_eq!(parse(BVH).clip.frames(), 3);
    assert_eq!(parse(BVH).notes, []);
    let read = amc::read(AMC.as_bytes(), fuzz::SKELETON, &fuzz::LIMITS).unwrap();
    assert_eq!((read.clip.frames(), read.clip.skeleton().len(), read.notes.len()), (3, 3, 1), "{:?}", read.notes);
}

#[test]
fn broken_bvh_files_say_line_and_remedy() {
    let table = [
        ("HIERARCHY", "HIERARCHI", "line 1: a BVH file starts with HIERARCHY", "check that the file is a BVH"),
        ("{\n OFFSET", "\n OFFSET", "line 4: an opening brace should follow", "add the missing `{`"),
        ("}\n}\nMOTION", "}\nMOTION", "line 15: MOTION begins inside joint hips", "add 1 closing brace(s)"),
        ("}\nMOTION", "}}\nMOTION", "line 15: a closing brace has no opening one", "remove it"),
        ("OFFSET 0 9.5", "OFFSET 0 9,5", "line 4: OFFSET Y of hips is \"9,5\", with a comma", "decimal point"),
        ("OFFSET 0 9.5 0", "OFFSET 0 9.5", "line 5: OFFSET Z of hips is \"CHANNELS\"", "repair the value"),
        (" OFFSET 0 9.5 0\n", "", "line 2: joint hips has no OFFSET", "add a line OFFSET"),
        ("CHANNELS 6", "CHANNELS 4000000000", "line 5: joint hips has \"4000000000\" channels", "after CHANNELS"),
        ("CHANNELS 6", "CHANNELS 7", "line 5: joint hips has \"7\" channels", "after CHANNELS"),
        ("CHANNELS 6", "CHANNELS 5", "line 5: joint hips names more channels", "correct the number after CHANNELS"),
        ("CHANNELS 2", "CHANNELS 3", "line 10: CHANNELS of leg names \"End\"", "correct the names or their count"),
        ("Zrotation", "Xposition", "line 5: joint hips has the channel Xposition twice", "once"),
        ("CHANNELS 2", "OFFSET 1 1 1\nCHANNELS 2", "line 9: joint leg has a second OFFSET", "remove one"),
        ("OFFSET 0 -1e0 0", "", "line 13: the End Site of leg has no OFFSET", "add a line OFFSET"),
        (" JOINT leg", " ROOT leg", "line 6: ROOT begins inside joint hips", "close the joints"),
        (" JOINT leg", " JIONT leg", "line 6: \"JIONT\" does not belong in joint hips", "a joint holds OFFSET"),
        ("Frames: 3", "Frames: three", "line 17: Frames: is \"three\"", "write the number of rows"),
        ("Frames: 3\n", "", "line 18: Frames: should stand here", "add a line `Frames: n`"),
        (".0083333", "0", "line 18: Frame Time: is \"0\"", "write the seconds from frame to frame"),
        (".0083333", "-0.01", "line 18: Frame Time: is \"-0.01\"", "write the seconds from frame to frame"),
        (".0083333", "inf", "line 18: Frame Time: is \"inf\", which is not a finite number", "repair the value"),
        (".0083333", "0,0083333", "line 18: Frame Time: is \"0,0083333\", with a comma", "decimal point"),
        (
            "400 90",
            "nan 90",
            "line 20: frame 1, joint hips, Zrotation is \"nan\"",
            "repair the value or cut the frames",
        ),
        ("400 90", "1e999 90", "line 20: frame 1, joint hips, Zrotation is \"1e999\"", "repair the value"),
        ("400 90", "1e13 90", "too large", "no value may exceed"),
        ("400 90", "-1.#IND 90", "line 20: frame 1, joint hips, Zrotation is \"-1.#IND\"", "export the file again"),
        (
            "400 90",
            "90",
            "line 20: frame 1 has 7 values, the channels ask for 8: from joint leg, Xposition on",
            "CHANNELS",
        ),
        ("400 90", "400 90 1", "line 20: frame 1 has 9 values, the channels ask for 8", "repair or remove the row"),
    ];
    for (piece, other, problem, remedy) in table {
        let said = complaint(&with(BVH, piece, other));
        assert!(said.contains(problem) && said.contains(remedy), "{piece:?} to {other:?}: {said}");
    }
    assert!(complaint("\u{feff}").contains("ends before HIERARCHY"));
    assert!(complaint("").contains("empty"));
    assert!(complaint("HIERARCHY\nMOTION\nFrames: 0\nFrame Time: 1\n").contains("no joints"));
    let utf16: Vec<u8> = BVH.encode_utf16().flat_map(u16::to_le_bytes).collect();
    let utf16 = [&[0xff, 0xfe][..], &utf16].concat();
    let error = bvh::read(&utf16, &Limits::default()).unwrap_err().to_string();
    assert!(error.contains("UTF-16") && error.contains("UTF-8"), "{error}");
}

#[test]
fn broken_acclaim_files_say_line_and_remedy() {
    let asf = asf_text();
    let motions = [
        ("a 5 6.5", "a 5", "line 6: frame 7 has 1 values for bone a, its dof are 2", "(.asf) belongs to this motion"),
        ("a 5 6.5", "c 5 6.5", "line 6: frame 7 names \"c\"", "ReadOptions::skeleton"),
        ("a 5 6.5", "a 5 nan", "line 6: frame 7, bone a is \"nan\"", "repair the value"),
        ("a 5 6.5", "b 1 2 3", "line 7: frame 7 has a second line for bone b", "remove one"),
        ("7\nroot", "root", "line 4: \"root\" stands before the first frame's number", "check that the file is an AMC"),
        ("8\nroot 1 2 3 10 20 30\n", "8\n", "line 8: frame 8 has no line for bone root", "same bones"),
        ("b 1 2 3\n9", ":x\n9", "line 11: \":x\" stands between frames", "remove it"),
    ];
    for (piece, other, problem, remedy) in motions {
        let said = amc_complaint(&with(AMC, piece, other), &asf);
        assert!(said.contains(problem) && said.contains(remedy), "{piece:?} to {other:?}: {said}");
    }
    assert!(amc_complaint(":DEGREES\n", &asf).contains("no frames"));
    let skeletons = [
        ("length 0.45", "length 0", "line 2: the unit of length is 0", "0.45"),
        ("angle deg", "angle gon", "line 3: the unit of angles is \"gon\"", "deg"),
        ("order TX", "order QX", "line 5: \"QX\" is not a degree of freedom", "write some of"),
        ("dof rx rz", "dof rx rx", "line 15: \"rx\" is there twice", "once"),
        ("name b", "name a", "line 23: a second bone is called a", "its own name"),
        ("direction 1 0 0\n", "\n", "bone b has no direction", "add its `direction`"),
        ("direction 1 0 0", "direction 1 inf 0", "line 19: the bone's direction is \"inf\"", "repair"),
        ("20 XYZ", "20 XYX", "line 14: \"XYX\" is not an order of axes", "XYZ"),
        ("root a\n", "root a b\n", "bone b hangs from two places", "once"),
        ("a b\n", "b b\n", "bone b does not hang from the root", ":hierarchy"),
        ("a b\n", "b root\n", "bone root hangs from two places", "never the root"),
        ("root a\n", "root q\n", "the hierarchy names \"q\"", ":bonedata"),
        (" end\n begin\n name b", "\n begin\n name b", "a bone begins inside another", "missing `end`"),
        (" end\n:hier", "\n:hier", "a bone's block is not closed", "missing `end`"),
    ];
    for (piece, other, problem, remedy) in skeletons {
        let said = amc_complaint(AMC, &with(&asf, piece, other));
        assert!(said.contains("skeleton (.asf)") && said.contains(problem), "{piece:?} to {other:?}: {said}");
        assert!(said.contains(remedy), "{piece:?} to {other:?}: {said}");
    }
}

#[test]
fn every_truncation_is_refused_or_read_in_part() {
    for end in 0..BVH.len() {
        fuzz::bvh(&BVH.as_bytes()[..end]);
    }
    for end in 0..AMC.len() {
        fuzz::amc(&AMC.as_bytes()[..end]);
    }
    for end in 0..fuzz::SKELETON.len() {
        fuzz::asf(&fuzz::SKELETON[..end]);
    }
    let cut = parse(&BVH[..BVH.len() - 1]);
    assert_eq!(cut.clip.frames(), 2);
    assert!(cut.notes.iter().any(|note| note.text.contains("last row has 7 of 8 values")), "{:?}", cut.notes);
    assert!(cut.notes.iter().any(|note| note.text.contains("Frames: says 3, the file has 2")), "{:?}", cut.notes);
    for cut in [2, 5, 9, 12, 20] {
        let read = amc::read(&AMC.as_bytes()[..AMC.len() - cut], fuzz::SKELETON, &fuzz::LIMITS).unwrap();
        assert!(read.notes.iter().any(|note| note.text.contains("left out")), "{cut}: {:?}", read.notes);
        assert_eq!(read.clip.frames(), 2);
    }
}

#[test]
fn every_flipped_byte_is_survived() {
    for flip in [0x01, 0x10, 0x20, 0x80, 0xff] {
        for at in 0..BVH.len() {
            let mut bytes = BVH.as_bytes().to_vec();
            bytes[at] ^= flip;
            fuzz::bvh(&bytes);
        }
        for at in 0..AMC.len() {
            let mut bytes = AMC.as_bytes().to_vec();
            bytes[at] ^= flip;
            fuzz::amc(&bytes);
        }
        for at in 0..fuzz::SKELETON.len() {
            let mut bytes = fuzz::SKELETON.to_vec();
            bytes[at] ^= flip;
            fuzz::asf(&bytes);
        }
    }
}

#[test]
fn every_doubled_or_missing_line_is_survived() {
    let mutate = |text: &str, run: fn(&[u8])| {
        let lines: Vec<&str> = text.split_inclusive('\n').collect();
        for index in 0..lines.len() {
            let mut doubled = lines.clone();
            doubled.insert(index, lines[index]);
            run(doubled.concat().as_bytes());
            let mut missing = lines.clone();
            missing.remove(index);
            run(missing.concat().as_bytes());
        }
    };
    mutate(BVH, fuzz::bvh);
    mutate(AMC, fuzz::amc);
    mutate(&asf_text(), fuzz::asf);
}

#[test]
fn a_huge_stated_count_costs_nothing() {
    let parsed = parse(&with(BVH, "Frames: 3", "Frames: 4000000000"));
    assert_eq!(parsed.clip.frames(), 3);
    assert!(parsed.notes[0].text.contains("4000000000") && parsed.notes[0].text.contains("3 complete"));
    assert_eq!(parsed.notes[0].line, Some(17));
    assert!(complaint(&with(BVH, "Frames: 3", "Frames: 40000000000000000000")).contains("not a count"));
    let still = "HIERARCHY\nROOT a\n{\nOFFSET 0 0 0\n}\nMOTION\nFrames: 4000000000\nFrame Time: 0.1\n";
    assert_eq!(parse(still).clip.frames(), 0);
    assert!(complaint(&format!("{still}0\n")).contains("no joint has channels"));
}

#[test]
fn deep_nesting_is_refused_without_recursion() {
    let joints = |count: usize| "JOINT a\n{\nOFFSET 0 0 0\nCHANNELS 0\n".repeat(count);
    let text = format!("HIERARCHY\nROOT r\n{{\nOFFSET 0 0 0\n{}{}", joints(100_000), "}".repeat(100_001));
    let said = complaint(&text);
    assert!(said.contains("nested more than 128 deep") && said.contains("limit `depth`"), "{said}");
    // As deep as the limits let it be: read, dropped and written without recursion too.
    let limits = Limits { joints: usize::MAX, depth: usize::MAX, ..Limits::default() };
    let text = format!("{text}\nMOTION\nFrames: 0\nFrame Time: 1\n");
    let read = bvh::read(text.as_bytes(), &limits).unwrap();
    assert_eq!(read.clip.skeleton().len(), 100_001);

    let bone = |name: usize| format!("begin\nname b{name}\ndirection 0 1 0\nlength 1\nend\n");
    let bones: String = (0..1500).map(bone).collect();
    let chain: String = (1..1500).map(|name| format!("b{} b{name}\n", name - 1)).collect();
    let text = format!(":bonedata\n{bones}:hierarchy\nbegin\nroot b0\n{chain}end\n");
    let error = amc::read_skeleton(text.as_bytes(), &Limits::default()).unwrap_err().to_string();
    assert!(error.contains("nested more than 128 deep"), "{error}");
}

#[test]
fn limits_are_kept_and_named() {
    let refused = |limits: Limits| bvh::read(BVH.as_bytes(), &limits).unwrap_err().to_string();
    let all = Limits::default();
    for (limits, name) in [
        (Limits { file_bytes: 10, ..all }, "`file_bytes`"),
        (Limits { joints: 1, ..all }, "`joints`"),
        (Limits { depth: 1, ..all }, "`depth`"),
        (Limits { frames: 2, ..all }, "`frames`"),
        (Limits { values: 23, ..all }, "`values`"),
    ] {
        assert!(refused(limits).contains(name), "{name}: {}", refused(limits));
    }
    assert!(refused(Limits { name_bytes: 2, ..all }).contains("limit is 2"));
    assert!(bvh::read(BVH.as_bytes(), &Limits { values: 24, ..all }).is_ok());
    let refused = |limits: Limits| -> Error { amc::read(AMC.as_bytes(), fuzz::SKELETON, &limits).unwrap_err() };
    for (limits, name) in [
        (Limits { joints: 2, ..all }, "`joints`"),
        (Limits { depth: 2, ..all }, "`depth`"),
        (Limits { frames: 2, ..all }, "`frames`"),
        (Limits { values: 32, ..all }, "`values`"),
    ] {
        assert!(refused(limits).to_string().contains(name), "{name}: {}", refused(limits));
    }
}

#[test]
fn binary_junk_is_refused() {
    let junk: Vec<u8> = (0..4096u32).map(|index| (index.wrapping_mul(2_654_435_761) >> 13) as u8).collect();
    assert!(bvh::read(&junk, &Limits::default()).is_err());
    assert!(amc::read(&junk, fuzz::SKELETON, &Limits::default()).is_err());
    assert!(amc::read_skeleton(&junk, &Limits::default()).is_err());
    for byte in 0..=255 {
        fuzz::bvh(&vec![byte; 300]);
        fuzz::amc(&vec![byte; 300]);
        fuzz::asf(&vec![byte; 300]);
    }
}

/// A change to a text: where (as a share of its length), how much of it, and what takes its place.
type Mutation = (f64, usize, String);

fn mutation() -> impl Strategy<Value = Mutation> {
    let pieces = prop::sample::select(vec![
        "",
        " ",
        "\n",
        "\r",
        "\r\n",
        "{",
        "}",
        "0",
        "-",
        "1e5",
        "1e-300",
        "nan",
        "999999999999",
        "1e12",
        ".",
        ",",
        "#",
        ":",
        "JOINT x\n{\n",
        "ROOT y\n{\nOFFSET 0 0 0\n",
        "End Site\n{\nOFFSET 0 0 0\n}\n",
        "CHANNELS 1 Xrotation\n",
        "MOTION\n",
        "Frames: 5\n",
        "Frame Time: 2\n",
        "10\n",
        "a 1 2\n",
        "root 1 2 3 4 5 6\n",
        "begin\n",
        "end\n",
        ":hierarchy\n",
        "\u{feff}",
        "1 2 3 40 50 60 7 8\n",
        "é\u{0}",
    ]);
    (0.0..1.0, 0usize..12, pieces.prop_map(str::to_owned))
}

fn apply(text: &str, mutations: &[Mutation]) -> Vec<u8> {
    let mut bytes = text.as_bytes().to_vec();
    for (share, length, piece) in mutations {
        let at = (share * bytes.len() as f64) as usize;
        let end = (at + length).min(bytes.len());
        bytes.splice(at..end, piece.bytes());
    }
    bytes
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 4000, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn mutated_bvh_files_write_back_to_themselves_or_are_refused(mutations in prop::collection::vec(mutation(), 1..5)) {
        fuzz::bvh(&apply(BVH, &mutations));
    }

    #[test]
    fn mutated_amc_files_write_back_to_themselves_or_are_refused(mutations in prop::collection::vec(mutation(), 1..5)) {
        fuzz::amc(&apply(AMC, &mutations));
    }

    #[test]
    fn mutated_asf_files_are_read_or_refused(mutations in prop::collection::vec(mutation(), 1..5)) {
        fuzz::asf(&apply(&asf_text(), &mutations));
    }
}
