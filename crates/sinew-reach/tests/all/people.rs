//! Against people: captured reaches to the floor and high up, and the method's for the same target in the same time.

use crate::captured::{self, CASES, compare};
use sinew_testkit::mocap;

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
