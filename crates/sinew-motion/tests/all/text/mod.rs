//! What the tests of the text formats share.
#![allow(dead_code, clippy::unwrap_used, reason = "each test file uses a part; a test that cannot go on fails")]

use sinew_motion::formats::{Parsed, Source, WriteJob, amc, bvh};
use sinew_motion::{Clip, Limits, SourceSpace};
use std::path::{Path, PathBuf};

/// Length of a unit of the CMU files \[m\].
pub const CMU_UNIT_M: f64 = 0.0254 / 0.45;

/// Every file with this extension, sorted.
pub fn files(folder: &Path, extension: &str) -> Vec<PathBuf> {
    let mut found = Vec::new();
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            found.extend(files(&path, extension));
        } else if path.extension().is_some_and(|own| own == extension) {
            found.push(path);
        }
    }
    found.sort();
    found
}

/// Reads a BVH of the folder.
pub fn read_bvh(path: &Path) -> Parsed {
    let bytes = std::fs::read(path).unwrap();
    bvh::read(&bytes, &Limits::default()).unwrap_or_else(|error| panic!("{}", error.in_file(path)))
}

/// Reads an AMC of the folder with its skeleton.
pub fn read_amc(path: &Path) -> Parsed {
    let skeleton = std::fs::read(amc::find_skeleton(path, None).unwrap()).unwrap();
    let bytes = std::fs::read(path).unwrap();
    amc::read(&bytes, &skeleton, &Limits::default()).unwrap_or_else(|error| panic!("{}", error.in_file(path)))
}

/// Reads text as BVH.
pub fn parse(text: &str) -> Parsed {
    bvh::read(text.as_bytes(), &Limits::default()).unwrap_or_else(|error| panic!("{error}\n{text}"))
}

/// What is wrong with a BVH.
pub fn complaint(text: &str) -> String {
    bvh::read(text.as_bytes(), &Limits::default()).map(|_| ()).expect_err(text).to_string()
}

/// Which writer a test calls.
pub type Writer = fn(&mut dyn std::io::Write, &WriteJob) -> Result<(), sinew_motion::Error>;

/// A file that was read, and its clip in metres and Y up.
pub struct Loaded {
    pub parsed: Parsed,
    pub space: SourceSpace,
    pub clip: Clip,
}

impl Loaded {
    pub fn new(parsed: Parsed, space: SourceSpace) -> Loaded {
        let clip = space.clip_to_world(&parsed.clip);
        Loaded { parsed, space, clip }
    }

    /// Writes another clip over this file.
    pub fn write(&self, write: Writer, clip: &Clip, rows: &[usize]) -> Result<Vec<u8>, sinew_motion::Error> {
        let source = Source { document: &self.parsed.document, clip: &self.clip, space: self.space, rows };
        let mut out = Vec::new();
        write(&mut out, &WriteJob { clip, source: Some(source) })?;
        Ok(out)
    }

    /// All rows in order.
    pub fn rows(&self) -> Vec<usize> {
        (0..self.clip.frames()).collect()
    }
}

/// A space that is no identity in anything: CMU units, Z up.
pub fn awkward_space() -> SourceSpace {
    SourceSpace { unit_m: CMU_UNIT_M, world_from_source: glam::DQuat::from_rotation_x(-std::f64::consts::FRAC_PI_2) }
}

/// World positions of joints and tips of one frame.
pub fn points(clip: &Clip, frame: usize) -> Vec<glam::DVec3> {
    let world = clip.world(frame);
    let tips = clip.skeleton().joints().iter().zip(&world);
    let tips: Vec<glam::DVec3> = tips.filter_map(|(joint, world)| joint.tip.map(|tip| world.point(tip))).collect();
    world.iter().map(|world| world.translation).chain(tips).collect()
}

/// The largest distance between points.
pub fn largest_gap(a: &[glam::DVec3], b: &[glam::DVec3]) -> f64 {
    assert_eq!(a.len(), b.len());
    a.iter().zip(b).map(|(a, b)| a.distance(*b)).fold(0.0, f64::max)
}
