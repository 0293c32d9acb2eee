//! A bad network costs a performer smoothness, never a jump, and every sample is accounted for.

use super::rehearsal::{Farthest, Rehearsal, WALK, player};
use sinew_body::humanoid::{Body, Node};
use sinew_control::perform::Presence;
use sinew_live::{Corruption, Impairment};

fn bad(seed: u64) -> Impairment {
    Impairment { delay_secs: 0.02, jitter_secs: 0.03, loss: 0.05, duplicate: 0.05, reorder: 0.05, corrupt: 0.05, seed }
}

/// Half a minute: forwards and backwards twice.
const FRAMES: u64 = 1800;

#[test]
fn no_part_of_a_walk_moves_by_more_than_two_centimetres_in_a_step_on_a_bad_network() {
    let Some(player) = player(WALK, 60.0) else { return };
    for seed in 1..=3 {
        let mut rehearsal = Rehearsal::new(&player, bad(seed));
        let mut farthest = Farthest::default();
        rehearsal.until_sent(FRAMES, |now| {
            farthest.look(now.places());
        });
        // The contract; the walk's own toes swing by 17 mm in a step.
        assert!(farthest.m < 0.02, "seed {seed}: {:.1} mm", farthest.m * 1e3);
        assert!(farthest.m > 0.008, "it walks: {:.1} mm", farthest.m * 1e3);
    }
}

#[test]
fn on_any_walk_a_bad_network_adds_at_most_six_millimetres_to_a_step() {
    // Walks whose own toes flick by up to 32 mm in a step.
    let clips = [
        "cmu_bvh_60hz_trimmed/35_01_walk.bvh",
        "cmu_bvh_motionbuilder/07_01.bvh",
        "cmu_bvh_motionbuilder/08_01.bvh",
        "cmu_bvh_motionbuilder/12_01.bvh",
        "cmu_bvh_60hz_trimmed/120_08_sneak.bvh",
    ];
    for clip in clips {
        let Some(player) = player(clip, 60.0) else { return };
        let farthest = [Impairment::default(), bad(1), bad(2), bad(3)].map(|impairment| {
            let mut rehearsal = Rehearsal::new(&player, impairment);
            let mut farthest = Farthest::default();
            rehearsal.until_sent(FRAMES / 2, |now| {
                farthest.look(now.places());
            });
            farthest.m
        });
        eprintln!("{clip}: {:.1?} mm", farthest.map(|m| m * 1e3));
        // A tenth for the playhead that hurries, and the speed of a blend, 0.8 m/s, is 3.3 mm in a step.
        assert!(farthest.iter().all(|m| *m < farthest[0] * 1.1 + 0.006), "{clip}: {farthest:?}");
    }
}

#[test]
fn a_walk_on_a_bad_network_is_the_walk_a_tenth_of_a_second_later() {
    let Some(player) = player(WALK, 60.0) else { return };
    let (mut good, mut spoilt) = (Rehearsal::new(&player, Impairment::default()), Rehearsal::new(&player, bad(4)));
    let mut track = Vec::new();
    let (mut sum, mut count) = (0.0, 0);
    for step in 0..4800 {
        good.step();
        spoilt.step();
        track.push(good.places());
        if step > 960 {
            let places = spoilt.places();
            let apart = |then: &Vec<glam::DVec3>| {
                then.iter().zip(&places).map(|(a, b)| a.distance_squared(*b)).sum::<f64>() / places.len() as f64
            };
            // Somewhere in the last fifth of a second.
            sum += track.iter().rev().take(48).map(apart).fold(f64::INFINITY, f64::min);
            count += 1;
        }
    }
    let rms = (sum / f64::from(count)).sqrt();
    // Three samples in four are there, and a gap of one is bridged to millimetres; 2 cm are what is allowed.
    assert!(rms < 0.02, "{:.1} mm", rms * 1e3);
}

#[test]
fn every_sample_of_our_own_sender_is_counted_where_it_belongs() {
    let Some(player) = player(WALK, 60.0) else { return };
    for seed in 1..=5 {
        let impairment = bad(seed);
        let mut rehearsal = Rehearsal::new(&player, impairment);
        rehearsal.until_sent(FRAMES, |_| ());
        let counters = rehearsal.source.counters();
        // From the network's own book.
        let deliveries: Vec<_> =
            (0..FRAMES).map(|number| impairment.delivery(number, player.interval_secs())).collect();
        let copies = |wanted: &dyn Fn(Option<Corruption>) -> bool| -> u64 {
            let those = deliveries.iter().filter(|delivery| wanted(delivery.corruption));
            those.map(|delivery| delivery.arrivals_secs.iter().flatten().count() as u64).sum()
        };
        let of = |kind: Corruption| copies(&|corruption| corruption == Some(kind));
        let is_fit = |corruption| matches!(corruption, None | Some(Corruption::Jump));
        let fit_frames = deliveries
            .iter()
            .filter(|delivery| delivery.arrivals_secs[0].is_some() && is_fit(delivery.corruption))
            .count();
        assert_eq!(rehearsal.malformed, of(Corruption::Truncated), "cut off");
        assert_eq!(counters.received, copies(&|corruption| corruption != Some(Corruption::Truncated)));
        assert_eq!(counters.non_finite, of(Corruption::NonFinite));
        assert_eq!(counters.non_unit, of(Corruption::NonUnit));
        assert_eq!(counters.stale, of(Corruption::Stale));
        assert_eq!(counters.duplicates, copies(&is_fit) - fit_frames as u64);
        assert_eq!(counters.used + counters.late + counters.jumps, fit_frames as u64);
        let jumps = deliveries
            .iter()
            .filter(|delivery| delivery.corruption == Some(Corruption::Jump) && delivery.arrivals_secs[0].is_some());
        let jumps = jumps.count() as u64;
        // One that comes late is late before it is anything else.
        assert!(counters.jumps <= jumps && counters.jumps + counters.late >= jumps);
        // Gone, or cut before its number could be read; what is missing before the first and after the last nobody can know.
        let is_missing = |number: &usize| {
            let delivery = &deliveries[*number];
            delivery.arrivals_secs[0].is_none() || delivery.corruption == Some(Corruption::Truncated)
        };
        let known = (0..deliveries.len()).find(|number| !is_missing(number)).unwrap()
            ..(0..deliveries.len()).rfind(|number| !is_missing(number)).unwrap();
        assert_eq!(counters.lost, known.filter(is_missing).count() as u64);
        assert!(!counters.lost_is_estimate);
        // A held back frame is 17 to 50 ms late on top of 30 ms of jitter: few of them are in time.
        assert!(counters.late < FRAMES / 12, "{} late", counters.late);
    }
}

#[test]
fn loss_without_numbers_is_an_estimate_and_called_so() {
    let Some(player) = player(WALK, 60.0) else { return };
    let impairment = Impairment { loss: 0.05, seed: 9, ..Impairment::default() };
    let mut rehearsal = Rehearsal::new(&player, Impairment::default());
    let lost = (0..FRAMES).filter(|&number| impairment.delivery(number, 1.0).arrivals_secs[0].is_none()).count() as f64;
    for step in 0..FRAMES * 4 {
        let now = step as f64 / 240.0;
        let number = step / 4;
        if step % 4 == 0 && impairment.delivery(number, 1.0).arrivals_secs[0].is_some() {
            let sample = sinew_control::perform::PerformerSample { number: None, ..player.sample(number) };
            rehearsal.source.receive(&sample, now);
        }
        rehearsal.source.advance(now, 1.0 / 240.0);
    }
    let counters = rehearsal.source.counters();
    assert!(counters.lost_is_estimate);
    // From time stamps alone single gaps are seen as well as long ones; the last half second is not passed yet.
    assert!((counters.lost as f64 - lost).abs() <= 5.0, "{} for {lost}", counters.lost);
}

#[test]
fn a_heavier_and_taller_body_performs_the_same_walk_with_longer_steps_and_its_feet_on_the_floor() {
    let Some(player) = player(WALK, 60.0) else { return };
    let giant = Body::standard(160.0, 2.4);
    let mut own = Rehearsal::new(&player, Impairment::default());
    let mut other = Rehearsal::on(&player, Impairment::default(), giant);
    let leg = |body: &Body| body.link(Node::LeftLowerLeg).offset.length() + body.link(Node::LeftFoot).offset.length();
    let scale = leg(&other.body) / leg(&own.body);
    let mut lowest = f64::INFINITY;
    let mut ways = [0.0; 2];
    for step in 0..480 {
        own.step();
        other.step();
        if step > 60 {
            let pose = other.source.pose();
            lowest = lowest.min(pose.hips_position.y - sinew_world::hips_over_soles_m(&other.body, pose));
        }
        if step > 240 {
            ways = [&own, &other].map(|one| one.source.pose().hips_position.with_y(0.0).length());
        }
    }
    // Hip joints of another breadth move the hips by a few centimetres as they turn.
    assert!((ways[1] / ways[0] - scale).abs() < 0.1, "{ways:?}, legs {scale}");
    // Another shape of the foot and thighs that are longer against the shanks: a few centimetres of a body of 2.4 m.
    assert!(lowest.abs() < 0.08, "soles at {lowest}");
    assert_eq!(other.source.presence(), Presence::Performing);
}
