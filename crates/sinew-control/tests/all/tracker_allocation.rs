//! Steps of the trackers `response` and `kd` allocate nothing: a counting allocator says so.
#![allow(clippy::unwrap_used, clippy::disallowed_methods, reason = "tests")]

use crate::performer::{Act, standing};
use crate::walker::{Scene, Walk, ball};
use glam::DVec3;
use sinew_body::humanoid::Node;
use sinew_control::tracker::{KdPreset, KdSettings};
use sinew_testkit::allocations;
use sinew_world::{CharacterId, Form, Motion, PropSpec, Solid};

#[test]
fn a_responding_trackers_step_allocates_nothing() {
    let walk = Walk::new(4, false);
    let mut scene = Scene::new(&walk);
    let target = walk.centres(walk.pose(30))[Node::Head.index()];
    let spec = ball(1.0, 0.1, 0.3, target + DVec3::Z * 3.0, DVec3::Z * -6.0);
    let prop = scene.world.add_prop(spec).unwrap();
    scene.tracker.keep_upright(Some(Node::RightHand));
    scene.tracker.avoid(&[prop]);
    let (mut count, mut felt) = (0, 0);
    for _ in 0..240 {
        if scene.tracker.wants_pose() {
            scene.frame += 1;
            scene.tracker.wanted(walk.pose(scene.frame));
        }
        count += allocations(|| scene.tracker.physics_step(&mut scene.world, CharacterId::first_in(0))).1;
        felt += scene.tracker.forces().len();
        scene.world.step();
    }
    assert!(felt > 0, "the ball hits");
    assert_eq!(count, 0);
}

#[test]
fn a_performers_trackers_step_allocates_nothing() {
    let mut act = Act::new(&standing(8.0), KdSettings::default());
    // It stands on a plank that can move, and is hit.
    let plank = Solid::new(Form::Box { size_m: DVec3::new(2.0, 0.1, 2.0) });
    let plank = PropSpec::new(plank, Motion::Dynamic { mass_kg: 100.0 }, DVec3::Y * -0.05);
    let plank = act.world.add_prop(plank).unwrap();
    act.tracker.stand_on(&act.world, Some(plank));
    let mut count = 0;
    for step in 0..1680 {
        match step {
            240 => act.tracker.set_gains(KdPreset::Giant.gains(), 0.2),
            480 => act.tracker.set_weight(Node::LeftHand, Some(0.0), Some(0.1), 0.2),
            720 => act.tracker.set_pins(false, 0.0),
            // It has fallen by now: from here it comes up again.
            960 => act.tracker.set_pins(true, 0.5),
            _ => {}
        }
        if (120..144).contains(&step) {
            act.world.push_part(CharacterId::first_in(0), Node::Chest, DVec3::Z * 200.0, None);
        }
        count += allocations(|| act.track()).1;
        act.world.step();
    }
    assert_eq!(count, 0);
}
