//! "The character can hit the ball object and affect its motion."

use super::stage::{centre, lower_ankle_m, prop, prop_centre, shipped, until};
use glam::DVec3;
use sinew_body::humanoid::Node;
use sinew_world::Entity;

#[test]
fn the_performer_hits_the_ball_again_and_again_and_it_flies_round_its_pole() {
    let mut stage = shipped("tetherball", &[]);
    let ball = prop(&stage, "ball");
    let top = DVec3::new(0.0, 2.85, 0.0);
    let length = (prop_centre(&stage, "ball") - top).length();
    let (mut hits, mut last_hit) = (0, f64::NEG_INFINITY);
    let (mut fastest, mut farthest, mut longest, mut highest_ankle): (f64, f64, f64, f64) = (0.0, 0.0, 0.0, 0.0);
    let mut rest = None;
    until(&mut stage, 8.0, |stage| {
        let state = &stage.frame().props[ball.slot()];
        let touched = stage.frame().touching(Entity::Prop(ball)).any(|contact| {
            contact.impulse.length() > 0.05
                && (matches!(contact.a, Entity::Part(..)) || matches!(contact.b, Entity::Part(..)))
        });
        // Hits within a third of a second are one.
        if touched {
            if stage.frame().time_secs - last_hit > 0.33 {
                hits += 1;
            }
            last_hit = stage.frame().time_secs;
        }
        if hits == 0 {
            rest = Some(state.velocity.length());
        } else {
            fastest = fastest.max(state.velocity.length());
            farthest = farthest.max(DVec3::new(state.centre.x, 0.0, state.centre.z).length());
        }
        longest = longest.max((state.centre - top).length() - length);
        highest_ankle = highest_ankle.max(lower_ankle_m(stage, "player"));
    });
    // Before it is hit it hangs at its pole; then it is struck away, comes back, and is struck again.
    assert!(rest.unwrap() < 0.5, "{rest:?}");
    assert!(hits >= 2, "{hits}");
    assert!(fastest > 2.0, "{fastest} m/s");
    assert!(farthest > 0.6, "{farthest} m from the pole");
    // The rope is 1.45 m long and the ball pulls with some times its 6 N: it gives by less than a hand's breadth.
    assert!(longest < 0.08, "{longest} m longer");
    assert!(highest_ankle < 0.13, "{highest_ankle}");
    let head = centre(&stage, "player", Node::Head);
    assert!(head.y > 1.4, "{head}");
}
