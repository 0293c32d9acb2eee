//! Against people: captured reaches to the floor and high up, and the method's for the same target in the same time.

mod captured;

use captured::{CASES, compare};
use std::path::{Path, PathBuf};

/// The captures, or `None` (said on stderr) when they are not there; a failure if they are required.
fn mocap() -> Option<PathBuf> {
    let beside = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared");
    let folder = std::env::var_os("SINEW_SHARED").map_or(beside, PathBuf::from).join("mocap");
    if folder.is_dir() {
        return Some(folder);
    }
    assert!(std::env::var_os("SINEW_REQUIRE_SHARED").is_none(), "{} is not there", folder.display());
    eprintln!("SKIPPED: needs the shared folder, set SINEW_SHARED");
    None
}

#[test]
fn the_method_arrives_where_people_do_and_bends_as_they_do() {
    let Some(folder) = mocap() else { return };
    println!("{}", captured::HEADER);
    for case in CASES {
        let compared = compare(&folder, &case).expect("a capture that can be read");
        println!("{}", compared.row());
        assert!(compared.reached, "{}", case.name);
        let (theirs, ours) = (compared.shape(&compared.theirs), compared.shape(&compared.ours));
        for side in (0..2).filter(|side| case.hands[*side]) {
            let end = captured::hands(&compared.body, &compared.ours[compared.ours.len() - 1])[side];
            assert!((end - compared.targets[side].expect("a target")).length() < 1e-3, "{}", case.name);
        }
        // People differ from each other by as much: whoever bends less at the knees bends more at the hips.
        assert!((theirs.end.trunk_deg - ours.end.trunk_deg).abs() < 45.0, "{}: {ours:?}", case.name);
        assert!((theirs.end.knee_deg - ours.end.knee_deg).abs() < 45.0, "{}: {ours:?}", case.name);
        // Both sink for the floor, neither does for a shelf.
        assert_eq!(theirs.end.hips_m - theirs.start.hips_m < -0.15, ours.end.hips_m - ours.start.hips_m < -0.15);
    }
}
