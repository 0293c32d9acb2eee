//! A stream that falls silent: hold, relax, return.

use super::rehearsal::{Farthest, Rehearsal, WALK, player};
use sinew_body::humanoid::{Node, log};
use sinew_control::perform::Presence;
use sinew_live::Impairment;

/// Frames of four seconds of silence.
const SILENCE: std::ops::Range<u64> = 120..360;

#[test]
fn a_lost_performer_is_held_then_stands_at_ease_and_comes_back_without_a_pop() {
    let Some(player) = player(WALK, 60.0) else { return };
    let mut rehearsal = Rehearsal::new(&player, Impairment::default());
    rehearsal.is_silent = Box::new(|number| SILENCE.contains(&number));
    let mut farthest = Farthest::default();
    let mut seen = vec![Presence::Waiting];
    let mut gains = Vec::new();
    while rehearsal.now_secs() < 10.0 {
        rehearsal.step();
        farthest.look(rehearsal.places());
        if *seen.last().unwrap() != rehearsal.source.presence() {
            seen.push(rehearsal.source.presence());
        }
        gains.push(rehearsal.source.gain());
        if rehearsal.source.presence() == Presence::Relaxed && rehearsal.now_secs() > 5.9 {
            let pose = rehearsal.source.pose();
            let worst = Node::ALL.map(|node| log(pose.local(node)).length() * f64::from(node != Node::Hips));
            assert!(worst.iter().all(|turn| *turn < 0.02), "at ease all joints are straight: {worst:?}");
        }
    }
    use Presence::{Holding, Performing, Relaxed, Waiting};
    assert_eq!(seen, [Waiting, Performing, Holding, Relaxed, Performing]);
    // What is allowed on a bad network is allowed here.
    assert!(farthest.m < 0.02, "{:.1} mm", farthest.m * 1e3);
    let least = gains.iter().copied().fold(f64::INFINITY, f64::min);
    assert!((least - 0.5).abs() < 1e-9, "relaxed, the body is half as firm");
    let change = gains.windows(2).map(|two| (two[1] - two[0]).abs()).fold(0.0, f64::max);
    // From 1 to 0.5 in not less than a second.
    assert!(change < 0.5 / 200.0);
    assert_eq!(*gains.last().unwrap(), 1.0);
}

#[test]
fn what_is_held_stands_still() {
    let Some(player) = player(WALK, 60.0) else { return };
    let mut rehearsal = Rehearsal::new(&player, Impairment::default());
    rehearsal.is_silent = Box::new(|number| number > 120);
    let mut farthest = Farthest::default();
    while rehearsal.now_secs() < 3.0 {
        rehearsal.step();
        let way = farthest.look(rehearsal.places());
        if rehearsal.source.presence() == Presence::Holding {
            // A millimetre a step is a quarter of a metre a second: what ran on has come to rest.
            assert!(way < 1e-3, "{:.2} mm", way * 1e3);
        }
    }
    assert_eq!(rehearsal.source.presence(), Presence::Holding);
}

#[test]
fn a_sender_that_is_started_again_is_believed_within_a_fifth_of_a_second() {
    let Some(player) = player(WALK, 60.0) else { return };
    let mut rehearsal = Rehearsal::new(&player, Impairment::default());
    for _ in 0..960 {
        rehearsal.step();
    }
    let used = rehearsal.source.counters().used;
    let mut farthest = Farthest::default();
    farthest.look(rehearsal.places());
    // Its clock and its numbers begin at nought, and it stands elsewhere.
    for step in 0..480u64 {
        let now = (960 + step) as f64 / 240.0;
        if step % 4 == 0 {
            rehearsal.source.receive(&player.sample(step / 4), now);
        }
        rehearsal.source.advance(now, 1.0 / 240.0);
        farthest.look(rehearsal.places());
    }
    let counters = rehearsal.source.counters();
    assert!(counters.used - used > 120 - 15, "{}", counters.used - used);
    assert!(counters.stale <= 12, "{}", counters.stale);
    assert_eq!(counters.lost, 0, "nothing was lost");
    assert!(farthest.m < 0.02, "{:.1} mm", farthest.m * 1e3);
}
