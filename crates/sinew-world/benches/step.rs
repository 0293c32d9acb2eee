//! Time of one step of physics at 1/240 s: a limp fall, a standing body, many of them, a pile, and a body at rest.
//!
//! The worlds run on while they are timed, each in a state that lasts: falls begin again, piles are stirred.
//! Build for the machine to compare with the peers: `RUSTFLAGS="-C target-cpu=native" cargo bench -p sinew-world`.

#[path = "../tests/all/common/mod.rs"]
mod common;

use common::{adult, hold, lifted, odd_pose, spec, standing};
use criterion::{BatchSize, Criterion, criterion_group, criterion_main};
use glam::DVec3;
use sinew_world::{CharacterId, CharacterSpec, World, WorldSettings};
use std::time::{Duration, Instant};

/// Steps of one timed stretch: the fall from standing to lying, 7 to 26 contacts most of the time.
const FALL_STEPS: u32 = 360;

/// Mean time of a step over the stretches that `make` begins.
fn stretches(criterion: &mut Criterion, name: &str, steps: u32, make: impl Fn() -> World) {
    criterion.bench_function(name, |bencher| {
        bencher.iter_custom(|times| {
            let mut spent = Duration::ZERO;
            let mut left = times;
            while left > 0 {
                let mut world = make();
                let now = left.min(u64::from(steps));
                let start = Instant::now();
                for _ in 0..now {
                    world.step();
                }
                spent += start.elapsed();
                left -= now;
            }
            spent
        });
    });
}

fn crowd(count: usize) -> World {
    let body = adult();
    let mut world = World::new(WorldSettings::default());
    for index in 0..count {
        let mut pose = standing(&body);
        pose.hips_position += DVec3::new((index % 10) as f64, 0.0, (index / 10) as f64) * 1.5;
        world.add_character(spec(&body, pose)).expect("a body");
        hold(&mut world, CharacterId::first_in(index), 3.0);
    }
    for _ in 0..120 {
        world.step();
    }
    world
}

fn pile() -> World {
    let body = adult();
    let mut world = World::new(WorldSettings::default());
    for one in 0..20u32 {
        let mut pose = lifted(&body, odd_pose(&body, 100 + u64::from(one), 0.7), 0.3);
        pose.hips_position +=
            DVec3::new(f64::from(one % 2) * 0.5, f64::from(one / 4) * 1.1, f64::from(one / 2 % 2) * 0.5);
        world.add_character(spec(&body, pose)).expect("a body");
    }
    for _ in 0..240 {
        world.step();
    }
    world
}

fn steps(criterion: &mut Criterion) {
    let body = adult();
    stretches(criterion, "fall", FALL_STEPS, || {
        let mut world = World::new(WorldSettings::default());
        let start = CharacterSpec { velocity: DVec3::Z * 1.4, ..spec(&body, standing(&body)) };
        world.add_character(start).expect("a body");
        world
    });
    for count in [1, 10, 100] {
        stretches(criterion, &format!("stand/{count}"), 240, || crowd(count));
    }
    stretches(criterion, "pile/20", 240, pile);
    if pile().set_threads(2) == 2 {
        stretches(criterion, "pile/20, two threads", 240, || {
            let mut world = pile();
            world.set_threads(2);
            world
        });
    }
    // A world kept in memory, to be put back later.
    criterion.bench_function("clone/1", |bencher| {
        let world = crowd(1);
        bencher.iter(|| world.clone());
    });
    criterion.bench_function("asleep", |bencher| {
        let mut world = World::new(WorldSettings::default());
        world.add_character(spec(&body, lifted(&body, common::supine(), 0.02))).expect("a body");
        common::steps(&mut world, 5.0);
        assert!(world.is_asleep(CharacterId::first_in(0)));
        bencher.iter_batched(|| (), |()| world.step(), BatchSize::SmallInput);
    });
}

criterion_group! {
    name = benches;
    config = Criterion::default().sample_size(10).warm_up_time(Duration::from_millis(500)).measurement_time(Duration::from_secs(3));
    targets = steps
}
criterion_main!(benches);
