//! A reacher that is restored goes on to the same bits.

#![allow(clippy::unwrap_used, reason = "a test that fails may panic")]

use crate::common::{bodies, goal, reacher};
use glam::{DQuat, DVec3};
use sinew_reach::{Goal, Obstacle, Reacher, Style};
use sinew_snapshot::{FrameKind, Reader, Snapshot, SnapshotError};

const KIND: FrameKind = FrameKind { magic: *b"TEST", version: 1 };

/// A reach, another in its middle that needs steps, a target that moves, another style, and back.
fn frame(reacher: &mut Reacher, frame: u32) -> [u64; 3] {
    let secs = f64::from(frame) / 60.0;
    reacher.advance(secs);
    match frame {
        0 => drop(reacher.reach(&goal(DVec3::new(-0.2, 0.5, 0.5)))),
        30 => drop(reacher.reach(&goal(DVec3::new(-0.6, 1.2, 1.6)))),
        90..140 => {
            let along = f64::from(frame - 90) * 0.01;
            reacher.follow(&Goal { right: Some(DVec3::new(-0.6 + along, 1.2, 1.6)), ..Goal::default() });
        }
        150 => {
            reacher.set_style(&Style { flexibility: 2.0, ..*reacher.style() }).unwrap();
            reacher.reach(&Goal { left: Some(DVec3::new(0.3, 0.1, 1.9)), ..Goal::default() });
        }
        230 => reacher.release(),
        _ => {}
    }
    let hands = reacher.hands_at(secs);
    let pose = reacher.pose_at(secs);
    [hands[0].x, hands[1].z, pose.hips_position.y].map(f64::to_bits)
}

#[test]
fn a_reacher_that_is_restored_goes_on_to_the_same_bits() {
    let body = &bodies()[0];
    let style = Style { seed: 7, ..Style::default() };
    let mut first = reacher(body, &style);
    first.set_obstacles(&[Obstacle::Box {
        centre: DVec3::new(-0.2, 0.6, 0.6),
        turn: DQuat::IDENTITY,
        half_m: DVec3::new(0.2, 0.02, 0.2),
    }]);
    let mut kept = Vec::new();
    let mut all = Vec::new();
    for at in 0..280 {
        if [1, 20, 31, 60, 100, 135, 151, 200, 240].contains(&at) {
            kept.push((at, KIND.save(&first)));
        }
        all.push(frame(&mut first, at));
    }
    for (at, bytes) in kept {
        // Built in another style: that is state, too.
        let mut other = reacher(body, &Style { print: true, ..Style::default() });
        KIND.restore(&mut other, &bytes).unwrap();
        assert_eq!(KIND.save(&other), bytes);
        let on: Vec<_> = (at..280).map(|at| frame(&mut other, at)).collect();
        assert!(on == all[at as usize..], "kept at frame {at}");
        assert_eq!(other.outcome(), first.outcome());
    }
}

#[test]
fn a_reacher_takes_no_foot_that_is_not_there() {
    let body = &bodies()[0];
    let mut one = reacher(body, &Style::default());
    one.reach(&goal(DVec3::new(-0.6, 1.2, 1.6)));
    assert!(!one.feet().strides().is_empty());
    let bytes = KIND.save(&one);
    // Every byte changed, and the checksum not looked at: an error or another reacher, and never a panic.
    let state = &bytes[8..bytes.len() - 8];
    let mut errors = 0;
    for place in 0..state.len() {
        let mut changed = state.to_vec();
        changed[place] ^= 0x55;
        let mut other = one.clone();
        let result: Result<(), SnapshotError> = other.restore(&mut Reader::new(&changed));
        match result {
            Ok(()) => drop(other.pose_at(0.7)),
            Err(_) => errors += 1,
        }
    }
    assert!(errors > 0);
}
