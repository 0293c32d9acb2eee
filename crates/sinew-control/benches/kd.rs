//! Time of one step of physics at 1/240 s of a body that the tracker `kd` holds to a performer: standing, walking (the sample walk),
//! standing and hit by 20 N s in every second; and the tracker's own share of it.
//!
//! `RUSTFLAGS="-C target-cpu=native" cargo bench -p sinew-control` to compare with the peers.

#![allow(missing_docs, reason = "criterion's own items have no documentation")]

#[path = "../tests/all/performer/mod.rs"]
mod performer;

use criterion::{Criterion, criterion_group, criterion_main};
use glam::DVec3;
use performer::{Act, HIT_SECS, Performer, standing};
use sinew_body::humanoid::Node;
use sinew_control::tracker::KdSettings;
use sinew_world::CharacterId;
use std::path::Path;
use std::time::{Duration, Instant};

/// Steps of one timed stretch: two seconds.
const STEPS: u64 = 480;

/// What a step consists of.
#[derive(Clone, Copy, PartialEq)]
enum Part {
    Whole,
    Tracker,
}

fn stretches(criterion: &mut Criterion, name: &str, performer: &Performer, is_hit: bool, part: Part) {
    criterion.bench_function(name, |bencher| {
        bencher.iter_custom(|times| {
            let (mut spent, mut left) = (Duration::ZERO, times);
            while left > 0 {
                let mut act = Act::new(performer, KdSettings::default());
                // A body that was just put down has no contacts yet.
                (0..120).for_each(|_| act.step());
                let now = left.min(STEPS);
                for step in 0..now {
                    let secs = (step % 240) as f64 / 240.0;
                    if is_hit && secs < HIT_SECS {
                        act.world.push_part(CharacterId::first_in(0), Node::Chest, DVec3::Z * (20.0 / HIT_SECS), None);
                    }
                    let start = Instant::now();
                    act.track();
                    let tracked = start.elapsed();
                    act.world.step();
                    spent += if part == Part::Whole { start.elapsed() } else { tracked };
                }
                left -= now;
            }
            spent
        });
    });
}

fn steps(criterion: &mut Criterion) {
    let sample = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../samples/walk.bvh");
    let (stands, walks) = (standing(6.0), Performer::read(&sample));
    stretches(criterion, "stands", &stands, false, Part::Whole);
    stretches(criterion, "stands, the tracker alone", &stands, false, Part::Tracker);
    stretches(criterion, "walks", &walks, false, Part::Whole);
    stretches(criterion, "walks, the tracker alone", &walks, false, Part::Tracker);
    stretches(criterion, "is hit every second", &stands, true, Part::Whole);
}

criterion_group! {
    name = benches;
    config = Criterion::default().sample_size(10).warm_up_time(Duration::from_millis(500)).measurement_time(Duration::from_secs(3));
    targets = steps
}
criterion_main!(benches);
