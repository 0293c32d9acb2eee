//! "Initially, the character influences the motion of the balloon. As the balloon increases in buoyancy, it begins to counteract the
//! character's weight. [...] When the buoyancy reaches a certain level, the balloon floats away with the character."

use super::stage::{borne, character, lower_ankle_m, prop_centre, shipped, until};
use sinew_body::humanoid::Node;
use sinew_world::Entity;

#[test]
fn the_hand_moves_the_balloon_until_the_balloon_takes_the_weight_and_flies_off_with_the_performer() {
    let mut stage = shipped("balloon", &[]);
    let start = prop_centre(&stage, "balloon");
    let mut lowest = start.y;
    until(&mut stage, 1.9, |stage| lowest = lowest.min(prop_centre(stage, "balloon").y));
    // The hand goes down by 0.4 m and the balloon with it.
    assert!(start.y - lowest > 0.2, "{lowest} from {start}");
    assert!(lower_ankle_m(&stage, "flyer") < 0.12);

    // Mean force under the feet over half a second \[N\].
    let mut mean = |until_secs: f64| {
        let (mut impulse, begin) = (0.0, until_secs - 0.5);
        until(&mut stage, until_secs, |stage| {
            if stage.frame().time_secs > begin {
                impulse += borne(stage, "flyer", |entity| entity == Entity::Floor);
            }
        });
        impulse / 0.5
    };
    let (late, later) = (mean(4.9), mean(5.6));
    // What the feet bear becomes less and less, and less than the weight of 785 N long before they leave the ground.
    assert!(late < 700.0 && later < late, "{late}, {later}");

    until(&mut stage, 8.0, |_| ());
    let ankle = lower_ankle_m(&stage, "flyer");
    assert!(ankle > 1.0, "the feet are {ankle} m up");
    let frame = character(&stage, "flyer");
    let (hand, hips) = (frame.part(Node::RightHand).centre, frame.part(Node::Hips).centre);
    let balloon = prop_centre(&stage, "balloon");
    // It hangs: balloon over hand over body, all arms stretched.
    assert!(balloon.y > hand.y + 1.0 && hand.y > hips.y + 0.5, "{balloon} {hand} {hips}");
    assert!(frame.centre_velocity.y > 0.1, "{}", frame.centre_velocity);
}
