//! The numbers of the sample walk are those that its measuring program measures.

#[path = "../examples/measure_walk.rs"]
mod measure_walk;

use std::path::{Path, PathBuf};

fn mocap() -> Option<PathBuf> {
    let shared = std::env::var_os("SINEW_SHARED")
        .map_or_else(|| Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared"), PathBuf::from);
    let mocap = shared.join("mocap");
    if mocap.is_dir() {
        return Some(mocap);
    }
    assert!(std::env::var_os("SINEW_REQUIRE_SHARED").is_none(), "no {}", mocap.display());
    eprintln!("SKIPPED: needs the shared folder, set SINEW_SHARED");
    None
}

fn rows(text: &str) -> Vec<Vec<f64>> {
    text.lines()
        .filter_map(|line| line.trim().strip_prefix('[')?.strip_suffix("],"))
        .map(|numbers| numbers.split(", ").map(|number| number.parse().expect("a number")).collect())
        .collect()
}

#[test]
fn the_table_holds_what_the_program_measures() {
    let Some(mocap) = mocap() else { return };
    let measured = rows(&measure_walk::table(&mocap).unwrap());
    let kept = rows(include_str!("../src/sample/walk_table.rs"));
    assert_eq!((measured.len(), kept.len()), (33, 33));
    for (index, (measured, kept)) in measured.iter().zip(&kept).enumerate() {
        // A tenth of a degree: how poses are calibrated may be improved in the last digits without a new walk.
        let same = measured.len() == kept.len() && measured.iter().zip(kept).all(|(a, b)| (a - b).abs() < 0.1);
        assert!(same, "row {index}: measured {measured:?}, kept {kept:?}; measure again and look at the walk");
    }
}
