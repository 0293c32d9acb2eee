//! A response that is restored goes on to the same bits.

#![allow(clippy::unwrap_used, reason = "a test that fails may panic")]

use glam::DVec3;
use sinew_body::humanoid::{Body, Node, Pose, exp};
use sinew_response::{Basis, Live, PointForce, Response, Settings};
use sinew_snapshot::FrameKind;

const KIND: FrameKind = FrameKind { magic: *b"TEST", version: 1 };

/// Every joint swings at a stride a second, some beyond their limits, so that these are widened on the way.
fn walk(frame: u32) -> Pose {
    let phase = f64::from(frame) / 60.0 * std::f64::consts::TAU;
    let locals = Node::ALL.map(|node| {
        let lag = node.index() as f64;
        let (a, b) = (libm::sin(phase + lag), libm::sin(phase + 2.0 * lag));
        exp(DVec3::new(0.5 * a, 0.05 * b, 0.2 * a) * (1.0 + f64::from(frame) / 100.0))
    });
    Pose::from_locals(DVec3::new(0.0, 0.9, f64::from(frame) / 60.0), &locals)
}

fn push(frame: u32) -> Vec<PointForce> {
    let hand = PointForce::at_centre(Node::LeftHand, DVec3::new(0.0, 0.0, -100.0));
    let chest = PointForce::at_centre(Node::Chest, DVec3::new(60.0, 0.0, 0.0));
    match frame {
        20..26 => vec![hand],
        50..60 | 95..110 => vec![hand, chest],
        _ => Vec::new(),
    }
}

fn made() -> (Body, Basis, Settings) {
    let (body, settings) = (Body::standard(80.0, 1.7), Settings::default());
    let poses: Vec<Pose> = (0..60).map(walk).collect();
    let basis = Basis::of_motion(&body, &poses, &settings).unwrap();
    (body, basis, settings)
}

fn bits(pose: &Pose) -> Vec<u64> {
    let turns = pose.world.iter().flat_map(|turn| turn.to_array());
    pose.hips_position.to_array().into_iter().chain(turns).map(f64::to_bits).collect()
}

#[test]
fn a_response_that_is_restored_goes_on_to_the_same_bits() {
    let (body, basis, settings) = made();
    let fresh = || Response::new(body.clone(), basis.clone(), settings, &walk(0));
    // At rest, in a push, with the reflex pending, on the way back, and after limits were widened.
    for kept in [1, 22, 24, 30, 55, 100] {
        let mut response = fresh();
        for frame in 1..kept {
            response.step_on_moving_ground(&walk(frame), &push(frame), DVec3::X * f64::from(frame % 7));
        }
        let bytes = KIND.save(&response);
        let on = |response: &mut Response| -> Vec<Vec<u64>> {
            let step =
                |frame| response.step_on_moving_ground(&walk(frame), &push(frame), DVec3::X * f64::from(frame % 7));
            (kept..140).map(step).map(|pose| bits(&pose)).collect()
        };
        let first = on(&mut response);
        let deviation = response.deviation();
        KIND.restore(&mut response, &bytes).unwrap();
        assert_eq!(KIND.save(&response), bytes);
        assert!(on(&mut response) == first, "kept at {kept}, restored in place");
        let mut other = fresh();
        KIND.restore(&mut other, &bytes).unwrap();
        assert!(on(&mut other) == first, "kept at {kept}, restored into another");
        assert_eq!((other.deviation(), other.report()), (deviation, response.report()));
    }
}

#[test]
fn a_live_response_that_is_restored_goes_on_to_the_same_bits() {
    let (body, basis, settings) = made();
    let mut live = Live::new(body.clone(), basis.clone(), settings, &walk(0));
    for frame in 1..54 {
        live.advance(&walk(frame), &push(frame));
    }
    let bytes = KIND.save(&live);
    let on = |live: &mut Live| -> Vec<Vec<u64>> {
        (54..140).map(|frame| bits(&live.advance(&walk(frame), &push(frame)))).collect()
    };
    let first = on(&mut live);
    let mut other = Live::new(body, basis, settings, &Pose::STANDING);
    KIND.restore(&mut other, &bytes).unwrap();
    assert!(on(&mut other) == first);
}
