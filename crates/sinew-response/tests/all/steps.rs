//! A step allocates nothing: a counting allocator says so.

use glam::DVec3;
use sinew_body::humanoid::{Body, Node, Pose, exp};
use sinew_response::{Basis, PointForce, Preset, Response, Settings};
use sinew_testkit::allocations;

/// Every joint swings at a stride a second.
fn walk() -> Vec<Pose> {
    (0..60)
        .map(|frame| {
            let phase = f64::from(frame) / 60.0 * std::f64::consts::TAU;
            let locals = Node::ALL.map(|node| {
                let lag = node.index() as f64;
                let (a, b) = (libm::sin(phase + lag), libm::sin(phase + 2.0 * lag));
                exp(DVec3::new(0.25 * a, 0.03 * b, 0.05 * a))
            });
            Pose::from_locals(DVec3::new(0.0, 0.9, 0.0), &locals)
        })
        .collect()
}

#[test]
fn no_step_allocates_whatever_pushes() {
    let walk = walk();
    let body = Body::standard(80.0, 1.7);
    for preset in [Preset::Robust, Preset::Paper, Preset::Literal] {
        let settings = Settings { preset, ..Settings::default() };
        let basis = Basis::of_motion(&body, &walk, &settings).expect("a basis");
        let mut response = Response::new(body.clone(), basis, settings, &walk[0]);
        let forces: Vec<PointForce> = (0..100)
            .map(|index| PointForce {
                node: Node::ALL[index % Node::COUNT],
                point: (index % 3 == 0).then_some(DVec3::new(0.0, -0.1, 0.02)),
                force_n: DVec3::new(index as f64, 50.0, -80.0),
            })
            .collect();
        let mut finite = true;
        let ((), count) = allocations(|| {
            for frame in 1..=100 {
                // None, one, a few, many; and for a while forces that no body bears.
                let acting = [0, 1, 5, 100][frame / 7 % 4];
                let ground = DVec3::new(if frame > 80 { 3.0 } else { 0.0 }, 0.0, 0.0);
                let pose = response.step_on_moving_ground(&walk[frame % 60], &forces[..acting], ground);
                finite &= pose.is_finite();
            }
        });
        assert_eq!(count, 0, "allocations, {preset:?}");
        assert!(finite);
    }
}

#[test]
fn a_walk_without_a_push_comes_out_bit_for_bit() {
    let walk = walk();
    let body = Body::standard(80.0, 1.7);
    let settings = Settings::default();
    let basis = Basis::of_motion(&body, &walk, &settings).expect("a basis");
    let mut response = Response::new(body, basis, settings, &walk[0]);
    response.restart(&walk[0], &walk[1]);
    for frame in 2..200 {
        let wanted = &walk[frame % 60];
        assert_eq!(response.step(wanted, &[]), *wanted, "frame {frame}");
    }
}
