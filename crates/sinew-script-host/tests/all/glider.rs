//! "When the actor changes the level of his feet, the glider pitches correspondingly. The glider's force pushes the character in the
//! appropriate direction. The actor can also shift his facing direction to rotate the glider [...] to navigate a slalom course."

use crate::stage::{character, prop, shipped, until, when};
use glam::DVec3;
use sinew::body::humanoid::Node;
use sinew::stage::Effect;

#[test]
fn the_pilot_steers_through_every_gate_in_its_order_and_stays_on_the_glider() {
    let mut stage = shipped("glider", &[]);
    let glider = prop(&stage, "glider");
    let (mut lowest, mut off): (f64, f64) = (f64::MAX, 0.0);
    until(&mut stage, 20.5, |stage| {
        let deck = &stage.frame().props[glider.slot()];
        lowest = lowest.min(deck.centre.y);
        let hips = character(stage, "pilot").part(Node::Hips).position;
        let own = deck.rotation.conjugate() * (hips - deck.position);
        off = off.max(DVec3::new(own.x, 0.0, own.z).length());
    });
    let times = [1, 2, 3, 4].map(|gate| when(&stage, &Effect::Said { text: format!("gate {gate} is passed") }));
    assert!(times.is_sorted(), "{times:?}");
    assert!(lowest > 1.2, "{lowest}");
    assert!(off < 0.4, "{off} m from the middle of the deck");
}

#[test]
fn the_level_of_the_feet_pitches_the_glider_and_its_force_drives_it_that_way() {
    let run = |pose: &str| {
        // Without the controller the pilot keeps the pose that it is told.
        let mut stage = shipped("glider", &[]);
        stage.command(sinew::control::Command::to("pilot", sinew::control::Action::Controller { name: String::new() }));
        stage.command(sinew::control::Command::to("pilot", sinew::control::Action::Pose { name: pose.to_owned() }));
        until(&mut stage, 3.0, |_| ());
        let deck = stage.frame().props[prop(&stage, "glider").slot()];
        ((deck.rotation * DVec3::Z).y, deck.velocity.z)
    };
    let (ahead, level, back) = (run("fly_ahead"), run("fly"), run("fly_brake"));
    assert!(ahead.0 < -0.05 && ahead.1 > 0.2, "nose {} up, {} m/s", ahead.0, ahead.1);
    assert!(level.0.abs() < 0.03 && level.1.abs() < 0.3, "nose {} up, {} m/s", level.0, level.1);
    assert!(back.0 > 0.05 && back.1 < -0.5, "nose {} up, {} m/s", back.0, back.1);
}
