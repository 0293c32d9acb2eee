//! "The giant character picks up and holds onto the smaller character. [...] The giant is given increased strength to hold and
//! manipulate the other character."

use super::stage::{centre, lower_ankle_m, shipped, until};
use sinew_body::humanoid::Node;

#[test]
fn the_giant_lifts_the_person_off_the_ground_and_holds_on() {
    let mut stage = shipped("giant", &[]);
    until(&mut stage, 1.0, |_| ());
    assert!(lower_ankle_m(&stage, "person") < 0.12);
    until(&mut stage, 3.5, |_| ());
    let (mut lowest, mut farthest, mut sideways): (f64, f64, (f64, f64)) = (f64::MAX, 0.0, (0.0, 0.0));
    until(&mut stage, 8.0, |stage| {
        lowest = lowest.min(lower_ankle_m(stage, "person"));
        let chest = centre(stage, "person", Node::Chest);
        let hands = (centre(stage, "giant", Node::LeftHand) + centre(stage, "giant", Node::RightHand)) / 2.0;
        farthest = farthest.max((chest - hands).length());
        sideways = (sideways.0.min(chest.x), sideways.1.max(chest.x));
        assert!(lower_ankle_m(stage, "giant") < 0.25);
    });
    assert!(lowest > 0.4, "{lowest} m over the ground");
    assert!(farthest < 0.8, "{farthest} m from the hands");
    // And swings the catch from one side to the other.
    assert!(sideways.1 - sideways.0 > 0.4, "{sideways:?}");
    assert!(centre(&stage, "giant", Node::Head).y > 2.5);
}

#[test]
fn without_the_strength_of_a_giant_the_catch_is_held_lower() {
    let height = |preset: &str| {
        let mut stage = shipped("giant", &[("characters.giant.kd.preset", preset)]);
        let (mut sum, mut count) = (0.0, 0.0);
        until(&mut stage, 3.5, |stage| {
            if stage.frame().time_secs > 2.8 {
                sum += centre(stage, "person", Node::Chest).y;
                count += 1.0;
            }
        });
        sum / count
    };
    let (giant, usual) = (height("giant"), height("default"));
    assert!(giant > usual + 0.1, "{giant} and {usual} m");
}
