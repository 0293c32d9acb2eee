//! A responding walker in a world: what it follows, what it feels, what it gives back.
#![allow(clippy::unwrap_used, clippy::disallowed_methods, reason = "tests")]

mod walker;

use glam::DVec3;
use sinew_body::humanoid::Node;
use walker::{Scene, Walk, ball};

#[test]
fn an_undisturbed_walker_is_where_the_walk_has_it() {
    let mut scene = Scene::new(&Walk::new(8, false));
    let (mut squares, mut count) = (0.0, 0);
    let mut by_part = [0.0_f64; Node::COUNT];
    for _ in 0..240 {
        scene.frame();
        if scene.frame > 30 {
            let error = scene.error_m(scene.wanted());
            squares += error * error;
            count += 1;
            let centres = scene.walk.centres(scene.wanted());
            for at in 0..Node::COUNT {
                by_part[at] += (centres[at] - scene.world.frame().characters[0].parts[at].centre).length_squared();
            }
        }
    }
    for node in Node::ALL {
        println!("{node:?} {:.1} mm", 1e3 * (by_part[node.index()] / f64::from(count)).sqrt());
    }
    let rms = (squares / f64::from(count)).sqrt();
    println!("rms {:.2} mm", 1e3 * rms);
    assert!(rms < 0.005, "{rms}");
}
