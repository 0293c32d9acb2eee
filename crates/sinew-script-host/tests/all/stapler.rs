//! "The actor is able to dampen the vertical motion of the stapler. The character also reacts to the stapler's motion [...]"

use crate::stage::{centre, prop, shipped, until};
use sinew::body::humanoid::Node;

/// How far the toy goes up and down, and how far the performer's trunk is moved by it \[m\].
struct Motion {
    arm: f64,
    chest: f64,
}

fn motion(is_held: bool) -> Motion {
    let far = [("at.0.time_secs", "100"), ("at.1.time_secs", "100"), ("characters.tamer.position_m", "[0, 0, -3]")];
    let mut stage = shipped("stapler", if is_held { &[] } else { &far });
    until(&mut stage, 1.0, |_| ());
    let arm = prop(&stage, "arm");
    let mut arms: Vec<f64> = Vec::new();
    let mut chests = Vec::new();
    until(&mut stage, 7.0, |stage| {
        let state = &stage.frame().props[arm.slot()];
        // Its free end.
        arms.push(state.point(glam::DVec3::new(0.0, 0.0, -0.6)).y);
        chests.push(centre(stage, "tamer", Node::Chest));
    });
    let span = |values: &mut dyn Iterator<Item = f64>| {
        let (low, high) = values.fold((f64::MAX, f64::MIN), |(low, high), value| (low.min(value), high.max(value)));
        high - low
    };
    let middle = chests.iter().sum::<glam::DVec3>() / chests.len() as f64;
    Motion {
        arm: span(&mut arms.iter().copied()),
        chest: chests.iter().map(|chest| (*chest - middle).length()).fold(0.0, f64::max),
    }
}

#[test]
fn the_performer_dampens_the_stapler_and_is_shaken_by_it() {
    let (held, free) = (motion(true), motion(false));
    assert!(held.arm < 0.7 * free.arm, "the arm moves {} m held and {} m free", held.arm, free.arm);
    // Left alone it hops on.
    assert!(free.arm > 0.5, "{}", free.arm);
    assert!(held.chest > 0.012 && free.chest < 0.005, "{} and {} m", held.chest, free.chest);
}
