//! A body that the tracker `kd` holds follows captured people.

use crate::performer;

use crate::performer::{Act, BASKETBALL, BOXING, Following, Performer, RUNS, WALKS};
use sinew_control::tracker::{KdDamping, KdPreset, KdSettings};
use sinew_testkit::mocap;
use sinew_world::CharacterId;

fn fed(performer: &Performer, feed_forward: bool) -> Following {
    Following::of(performer, KdSettings { feed_forward, ..KdSettings::default() })
}

/// Root mean square of body centres, which the performers' own shapes hardly disturb: what is left is mostly feet that the floor
/// keeps from dipping, which captures do by centimetres.
fn follows(clips: &[&str], most_m: f64) {
    let Some(folder) = mocap() else { return };
    for &clip in clips {
        let performer = Performer::read(&folder.join(clip));
        let (with, without) = (fed(&performer, true), fed(&performer, false));
        assert!(with.centres_m < most_m, "{clip}: {with:?}");
        assert!(!with.fell() && !without.fell(), "{clip}: fell");
        assert!(with.centres_m < without.centres_m, "{clip}: fed forward {with:?}, else {without:?}");
        // A frame is 17 ms.
        assert!(with.lag_secs.abs() < 0.003, "{clip}: {with:?}");
        // The floor holds soles that the performer's own roll; a performer's feet slide by up to 15 cm/s where they stand.
        assert!(with.skate_m_s[0] < with.skate_m_s[1] + 0.08, "{clip}: {with:?}");
    }
}

#[test]
fn walks_are_followed_within_two_centimetres() {
    follows(&WALKS, 0.02);
}

#[test]
fn runs_are_followed_within_five_centimetres() {
    follows(&RUNS, 0.05);
}

#[test]
fn boxing_is_followed_within_five_centimetres() {
    follows(&BOXING, 0.05);
}

#[test]
fn basketball_is_followed_within_five_centimetres() {
    follows(&BASKETBALL, 0.05);
}

#[test]
fn every_preset_that_holds_a_body_follows_a_walk_and_a_run() {
    let Some(folder) = mocap() else { return };
    for clip in [WALKS[5], RUNS[0]] {
        let performer = Performer::read(&folder.join(clip));
        for preset in KdPreset::ALL.into_iter().filter(|preset| preset.gains().k_p > 0.0) {
            let found = Following::of(&performer, KdSettings::of(preset));
            assert!(found.centres_m < 0.02 && !found.fell(), "{clip}, {}: {found:?}", preset.name());
        }
    }
}

#[test]
fn damped_as_printed_a_walk_lags_by_more_than_a_hand_s_breadth() {
    let Some(folder) = mocap() else { return };
    let performer = Performer::read(&folder.join(WALKS[5]));
    let printed = KdSettings { feed_forward: false, damping: KdDamping::Absolute, ..KdSettings::default() };
    let found = Following::of(&performer, printed);
    // The walk goes at 1.28 m/s; d_p / k_p is 0.16 s for the upper body, 14 ms for the feet, whose pins hold all back less.
    assert!(found.centres_m > 0.08 && found.lag_secs > 0.05, "{found:?}");
}

#[test]
fn a_body_that_is_half_as_tall_follows_too() {
    let Some(folder) = mocap() else { return };
    let performer = Performer::scaled(&folder.join(WALKS[5]), 20.0, Some(0.85));
    let found = Following::of(&performer, KdSettings::default());
    assert!(found.centres_m < 0.02 && !found.fell(), "{found:?}");
}

#[test]
fn a_motion_that_jumps_is_met_without_a_jump_of_the_body() {
    let performer = performer::standing(5.0);
    let mut act = Act::new(&performer, KdSettings::default());
    let mut fastest: f64 = 0.0;
    for frame in 0..360 {
        let mut wanted = *performer.pose(0);
        // Two metres aside and turned about, from one frame to the next.
        if frame >= 60 {
            let turn = glam::DQuat::from_rotation_y(2.0);
            wanted.hips_position.x += 2.0;
            wanted.world = wanted.world.map(|rotation| turn * rotation);
        }
        for _ in 0..4 {
            if act.tracker.wants_pose() {
                act.tracker.wanted(&wanted);
            }
            act.tracker.physics_step(&mut act.world, CharacterId::first_in(0));
            act.world.step();
            let parts = &act.world.frame().characters[0].parts;
            fastest = parts.iter().map(|part| part.velocity.length()).fold(fastest, f64::max);
        }
    }
    // The way is slid over at 2 m/s at most, and hands are on the outside of the turn.
    assert!(fastest < 4.0, "{fastest} m/s");
    let off = act.world.frame().characters[0].parts[0].position - performer.pose(0).hips_position;
    assert!((off - glam::DVec3::X * 2.0).length() < 0.01, "{off}");
}
