//! What the tests of the analysis share: the motion files, read, mapped and brought to metres and Y up.
#![allow(clippy::unwrap_used, reason = "a test that cannot read its file fails")]
#![allow(dead_code, reason = "each test file uses a part")]

use sinew_motion::formats::{Parsed, amc, bvh, fbx, gltf};
use sinew_motion::{Clip, Humanoid, Limits, Part, SpaceGuess, guess_space};
use std::path::{Path, PathBuf};

/// Every motion file of some folders, sorted; all text formats when no folder is named.
pub fn files(mocap: &Path, folders: &[&str]) -> Vec<PathBuf> {
    const TEXT: [&str; 8] = [
        "accad_bvh",
        "cmu_asfamc",
        "cmu_bvh_3dsmax",
        "cmu_bvh_60hz_trimmed",
        "cmu_bvh_daz",
        "cmu_bvh_motionbuilder",
        "dialects",
        "dialects_generated",
    ];
    let folders = if folders.is_empty() { &TEXT } else { folders };
    let mut found: Vec<PathBuf> = folders
        .iter()
        .flat_map(|folder| std::fs::read_dir(mocap.join(folder)).unwrap())
        .map(|entry| entry.unwrap().path())
        .filter(|path| path.extension().is_some_and(|extension| extension != "asf"))
        .collect();
    found.sort();
    assert!(!found.is_empty());
    found
}

pub fn name_of(path: &Path) -> String {
    path.file_name().unwrap().to_string_lossy().into_owned()
}

pub fn read(path: &Path) -> Parsed {
    let limits = Limits::default();
    let bytes = || std::fs::read(path).unwrap();
    let parsed = match path.extension().unwrap().to_str().unwrap() {
        "bvh" => bvh::read(&bytes(), &limits),
        "amc" => amc::read(&bytes(), &std::fs::read(amc::find_skeleton(path, None).unwrap()).unwrap(), &limits),
        "fbx" => fbx::read(&bytes(), &limits),
        _ => gltf::read(path, &limits),
    };
    parsed.unwrap_or_else(|error| panic!("{}", error.in_file(path)))
}

/// A file with all that the analysis starts from.
pub struct Body {
    pub clip: Clip,
    pub humanoid: Humanoid,
    pub guess: SpaceGuess,
}

impl Body {
    pub fn load(path: &Path) -> Body {
        let parsed = read(path);
        let humanoid = Humanoid::of(&parsed.clip, &[]).unwrap_or_else(|error| panic!("{}", error.in_file(path)));
        let guess = guess_space(&parsed.clip, &humanoid, parsed.unit_m, parsed.world_from_source);
        let clip = guess.space.clip_to_world(&parsed.clip);
        Body { clip, humanoid, guess }
    }

    /// The name of a part's joint; empty where there is none.
    pub fn joint_name(&self, part: Part) -> String {
        joint_name(&self.clip, self.humanoid.joint(part))
    }
}

pub fn joint_name(clip: &Clip, joint: Option<usize>) -> String {
    joint.map_or(String::new(), |joint| clip.skeleton().joints()[joint].name.clone())
}
