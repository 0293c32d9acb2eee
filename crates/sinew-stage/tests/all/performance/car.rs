//! The operator steers the car; it carries its driver, who sways as it turns.

use super::stage::{centre, prop, shipped, until};
use glam::DVec3;
use sinew_body::humanoid::Node;

#[test]
fn the_car_drives_turns_and_brakes_and_its_driver_sways_outward() {
    let mut stage = shipped("car", &[]);
    let chassis = prop(&stage, "chassis");
    // The head in the car's frame.
    let own = |stage: &sinew_stage::Stage| {
        let car = &stage.frame().props[chassis.slot()];
        car.rotation.conjugate() * (centre(stage, "driver", Node::Head) - car.position)
    };
    until(&mut stage, 0.5, |_| ());
    let before = own(&stage);
    until(&mut stage, 2.2, |_| ());
    let car = stage.frame().props[chassis.slot()];
    assert!(car.velocity.z > 2.5 && car.centre.x.abs() < 0.2, "{} {}", car.centre, car.velocity);
    let mut sway: f64 = 0.0;
    until(&mut stage, 4.6, |stage| {
        let now = own(stage).x - before.x;
        if now.abs() > sway.abs() {
            sway = now;
        }
    });
    let heading = stage.frame().props[chassis.slot()].rotation * DVec3::Z;
    // To the left, +x: by more than 40°; the driver's head goes to the right.
    assert!(heading.x > 0.64, "{heading}");
    assert!(sway < -0.03, "{sway}");
    until(&mut stage, 7.5, |stage| {
        let car = &stage.frame().props[chassis.slot()];
        let hips = car.rotation.conjugate() * (centre(stage, "driver", Node::Hips) - car.position);
        assert!((hips - DVec3::new(0.0, 0.69, -0.25)).length() < 0.1, "{hips}");
        assert!((car.rotation * DVec3::Y).y > 0.97);
    });
    let speed = stage.frame().props[chassis.slot()].velocity.length();
    assert!(speed < 0.3, "{speed} m/s after braking");
}

#[test]
fn the_operators_keys_drive_it() {
    let mut stage = shipped("car", &[("at.0.time_secs", "0")]);
    let chassis = prop(&stage, "chassis");
    until(&mut stage, 0.2, |_| ());
    assert!(stage.press("s"));
    // Before the time line's own driving begins.
    until(&mut stage, 0.49, |_| ());
    let velocity = stage.frame().props[chassis.slot()].velocity;
    assert!(velocity.z < -0.1, "{velocity}");
}
