//! Which clips there are.

use sinew::motion::formats::{MotionFile, ReadOptions};
use std::path::{Path, PathBuf};
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};

/// Every walk of the set, each trial in one dialect: normal, slow, brisk, backward, sneaking, swaggering, stylised, as a zombie,
/// with a box, into a crouch, sidewards, with a ball, and the two loops of games.
pub const WALKS: [&str; 23] = [
    "cmu_asfamc/02_01.amc",
    "cmu_asfamc/06_01.amc",
    "cmu_asfamc/07_01.amc",
    "cmu_asfamc/08_01.amc",
    "cmu_asfamc/16_15.amc",
    "cmu_asfamc/35_01.amc",
    "cmu_bvh_motionbuilder/06_02.bvh",
    "cmu_bvh_motionbuilder/06_06.bvh",
    "cmu_bvh_motionbuilder/08_11.bvh",
    "cmu_bvh_motionbuilder/09_12.bvh",
    "cmu_bvh_motionbuilder/12_01.bvh",
    "cmu_bvh_60hz_trimmed/120_08_sneak.bvh",
    "cmu_bvh_3dsmax/131_01.bvh",
    "accad_bvh/Female1_B03_Walk1.bvh",
    "accad_bvh/Female1_B05_WalkBackwards.bvh",
    "accad_bvh/Female1_B20_WalkWithBox.bvh",
    "accad_bvh/Female1_B22_SideStepLeft.bvh",
    "accad_bvh/Female1_B24_WalkToCrouch.bvh",
    "dialects/fair_zombie.bvh",
    "dialects/bvhtoolbox_walk01.bvh",
    "dialects/gpmat_Swagger.bvh",
    "gltf/CesiumMan.glb",
    "fbx/ozz_walk.fbx",
];

/// Every clip of a human in the set, in all its dialects.
pub const EVERY_CLIP: [&str; 58] = [
    "cmu_asfamc/02_01.amc",
    "cmu_asfamc/06_01.amc",
    "cmu_asfamc/07_01.amc",
    "cmu_asfamc/08_01.amc",
    "cmu_asfamc/16_15.amc",
    "cmu_asfamc/35_01.amc",
    "cmu_asfamc/49_18.amc",
    "cmu_bvh_motionbuilder/02_01.bvh",
    "cmu_bvh_motionbuilder/02_03.bvh",
    "cmu_bvh_motionbuilder/02_04.bvh",
    "cmu_bvh_motionbuilder/02_05.bvh",
    "cmu_bvh_motionbuilder/02_06.bvh",
    "cmu_bvh_motionbuilder/06_01.bvh",
    "cmu_bvh_motionbuilder/06_02.bvh",
    "cmu_bvh_motionbuilder/06_06.bvh",
    "cmu_bvh_motionbuilder/06_15.bvh",
    "cmu_bvh_motionbuilder/07_01.bvh",
    "cmu_bvh_motionbuilder/08_01.bvh",
    "cmu_bvh_motionbuilder/08_11.bvh",
    "cmu_bvh_motionbuilder/09_01.bvh",
    "cmu_bvh_motionbuilder/09_12.bvh",
    "cmu_bvh_motionbuilder/12_01.bvh",
    "cmu_bvh_60hz_trimmed/35_01_walk.bvh",
    "cmu_bvh_60hz_trimmed/120_08_sneak.bvh",
    "cmu_bvh_60hz_trimmed/143_23_punch.bvh",
    "cmu_bvh_60hz_trimmed/113_15_sit.bvh",
    "cmu_bvh_daz/13_09.bvh",
    "cmu_bvh_daz/13_11.bvh",
    "cmu_bvh_daz/13_18.bvh",
    "cmu_bvh_daz/14_07.bvh",
    "cmu_bvh_3dsmax/131_01.bvh",
    "accad_bvh/Female1_B03_Walk1.bvh",
    "accad_bvh/Female1_B05_WalkBackwards.bvh",
    "accad_bvh/Female1_B20_WalkWithBox.bvh",
    "accad_bvh/Female1_A05_PickUpBox.bvh",
    "accad_bvh/Female1_A06_LiftBox.bvh",
    "accad_bvh/Female1_A03_Swing.bvh",
    "accad_bvh/Female1_B22_SideStepLeft.bvh",
    "accad_bvh/Female1_B24_WalkToCrouch.bvh",
    "accad_bvh/Female1_C03_Run.bvh",
    "accad_bvh/Female1_C07_RunBackwards.bvh",
    "accad_bvh/Male2_Form_1.bvh",
    "accad_bvh/Male2_E1_JabLeft.bvh",
    "dialects/rokoko_jesse_dance.bvh",
    "dialects/fair_zombie.bvh",
    "dialects/animateddrawings_jumping_jacks.bvh",
    "dialects/bvhtoolbox_walk01.bvh",
    "dialects/gpmat_Swagger.bvh",
    "dialects/pybvh_example.bvh",
    "dialects_generated/07_01__six_channels_yxz.bvh",
    "dialects_generated/07_01__crlf_tabs_sci.bvh",
    "dialects_generated/07_01__mixamo_names_cm.bvh",
    "dialects_generated/07_01__zup_metres_xyz_rootoffset.bvh",
    "dialects_generated/07_01__rotation_first_mixed_orders.bvh",
    "gltf/CesiumMan.glb",
    "gltf/cesium_man.gltf",
    "fbx/ozz_walk.fbx",
    "fbx/walk01_template.fbx",
];

/// The folder of motion files, or `None` (said on stderr) when it is not there; a failure if it is required.
pub fn mocap() -> Option<PathBuf> {
    let beside = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared");
    let folder = std::env::var_os("SINEW_SHARED").map_or(beside, PathBuf::from).join("mocap");
    if folder.is_dir() {
        return Some(folder);
    }
    assert!(std::env::var_os("SINEW_REQUIRE_SHARED").is_none(), "{} is not there", folder.display());
    eprintln!("SKIPPED: needs the shared folder, set SINEW_SHARED");
    None
}

/// Every BVH file under the folder, sorted.
pub fn every_bvh(mocap: &Path) -> Vec<PathBuf> {
    let mut found = Vec::new();
    for folder in std::fs::read_dir(mocap).unwrap().map(|entry| entry.unwrap().path()).filter(|path| path.is_dir()) {
        let files = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
        found.extend(files.filter(|path| path.extension().is_some_and(|extension| extension == "bvh")));
    }
    found.sort();
    assert!(found.len() > 40);
    found
}

/// Reads a motion file as a user would.
pub fn read(path: &Path) -> MotionFile {
    MotionFile::read(path, &ReadOptions::default()).unwrap_or_else(|error| panic!("{error}"))
}

/// Does the work for every item on all cores; answers in the order of the items.
pub fn work<T: Sync, R: Send>(items: &[T], job: impl Fn(&T) -> R + Sync) -> Vec<R> {
    let next = AtomicUsize::new(0);
    let done: Vec<Mutex<Option<R>>> = items.iter().map(|_| Mutex::new(None)).collect();
    let threads = std::thread::available_parallelism().map_or(2, std::num::NonZero::get);
    std::thread::scope(|scope| {
        for _ in 0..threads {
            scope.spawn(|| {
                loop {
                    let at = next.fetch_add(1, Ordering::Relaxed);
                    let Some(item) = items.get(at) else { break };
                    *done[at].lock().unwrap() = Some(job(item));
                }
            });
        }
    });
    done.into_iter().map(|slot| slot.into_inner().unwrap().unwrap()).collect()
}
