//! Captured motion, which is not part of the project because of its licences, and the project's own files.

use std::path::{Path, PathBuf};

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

/// A file or folder of the project, by its path from the repository's root.
pub fn repository(path: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..").join(path)
}

/// A file or folder of the shared folder, which lies beside the repository or where `SINEW_SHARED` points. `None`, with `SKIPPED`
/// said on stderr, when it is not there: the test that asks is to return.
///
/// # Panics
/// When it is not there although `SINEW_REQUIRE_SHARED` is set.
pub fn shared(path: &str) -> Option<PathBuf> {
    let folder = std::env::var_os("SINEW_SHARED").map_or_else(|| repository("../shared"), PathBuf::from);
    let found = folder.join(path);
    if found.exists() {
        return Some(found);
    }
    assert!(std::env::var_os("SINEW_REQUIRE_SHARED").is_none(), "{} is not there", found.display());
    eprintln!("SKIPPED: needs the shared folder, set SINEW_SHARED");
    None
}

/// The folder of captured motion, as [`shared`].
///
/// # Panics
/// As [`shared`].
pub fn mocap() -> Option<PathBuf> {
    shared("mocap")
}

/// A file of captured motion (`accad_bvh/Female1_C03_Run.bvh`), as [`shared`].
///
/// # Panics
/// As [`shared`].
pub fn capture(name: &str) -> Option<PathBuf> {
    shared(&format!("mocap/{name}"))
}

/// Every BVH file of the captured motion, sorted.
///
/// # Panics
/// When a folder cannot be read, or has fewer than the forty files that the set has.
pub fn every_bvh(mocap: &Path) -> Vec<PathBuf> {
    let files = |folder: &Path| -> Vec<PathBuf> {
        let entries = std::fs::read_dir(folder).unwrap_or_else(|error| panic!("{}: {error}", folder.display()));
        entries.filter_map(|entry| Some(entry.ok()?.path())).collect()
    };
    let mut found: Vec<PathBuf> =
        files(mocap).iter().filter(|path| path.is_dir()).flat_map(|folder| files(folder)).collect();
    found.retain(|path| path.extension().is_some_and(|extension| extension == "bvh"));
    found.sort();
    assert!(found.len() > 40, "{} BVH files in {}", found.len(), mocap.display());
    found
}
