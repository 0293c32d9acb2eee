//! The numbers of the sample walk are those that its measuring program measures.

#[path = "../../examples/measure_walk.rs"]
mod measure_walk;

fn rows(text: &str) -> Vec<Vec<f64>> {
    text.lines()
        .filter_map(|line| line.trim().strip_prefix('[')?.strip_suffix("],"))
        .map(|numbers| numbers.split(", ").map(|number| number.parse().expect("a number")).collect())
        .collect()
}

#[test]
fn the_table_holds_what_the_program_measures() {
    let Some(mocap) = sinew_testkit::mocap() else { return };
    let measured = rows(&measure_walk::table(&mocap).unwrap());
    let kept = rows(include_str!("../../src/walk/walk_table.rs"));
    assert_eq!((measured.len(), kept.len()), (33, 33));
    for (index, (measured, kept)) in measured.iter().zip(&kept).enumerate() {
        // A tenth of a degree: how poses are calibrated may be improved in the last digits without a new walk.
        let same = measured.len() == kept.len() && measured.iter().zip(kept).all(|(a, b)| (a - b).abs() < 0.1);
        assert!(same, "row {index}: measured {measured:?}, kept {kept:?}; measure again and look at the walk");
    }
}
