//! A controller reaches for a box, grasps it, and puts it on a shelf.

use crate::ran::{character, event, frame, holds, play, prop};
use glam::DVec3;
use sinew::body::humanoid::Node;
use sinew::stage::{Cause, CharacterEffect};

#[test]
fn a_box_is_reached_grasped_lifted_and_put_on_a_shelf() {
    let ran = play("reach_grasp", &[]);
    let held = holds(&ran, Node::RightHand, "box", |cause| *cause == Cause::ReachArrives);
    let let_go = event(
        &ran,
        |effect| *effect == CharacterEffect::LetsGo { node: Node::RightHand, objects: vec!["box".to_owned()] },
        |_| true,
    );
    let places = prop(&ran, "box");
    // Nothing pushes it before it is held.
    assert!((places[frame(&ran, held) - 1] - places[0]).length() < 0.02);
    let highest = places.iter().map(|place| place.y).fold(f64::NEG_INFINITY, f64::max);
    assert!(highest > places[0].y + 0.2, "{highest}");
    assert!(let_go > held + 2.0);
    // It stands on the shelf: its middle half of its height above it within a centimetre, and no farther from the shelf's middle
    // than springs that carry 0.8 kg are off.
    let end = *places.last().unwrap();
    let shelf = prop(&ran, "shelf")[0];
    assert!((end.y - (shelf.y + 0.015 + 0.12)).abs() < 0.01, "{end} on {shelf}");
    assert!((end - shelf).with_y(0.0).length() < 0.06, "{end} on {shelf}");
    // And the body stands upright again.
    let one = character(&ran, "keeper");
    let up = one.poses.last().unwrap().world[Node::Chest.index()] * DVec3::Y;
    assert!(up.y > 0.97, "{up}");
}
