//! Poses a second of a full-body reach, and plans a second.
#![allow(missing_docs, reason = "criterion's own items have no documentation")]

use criterion::{Criterion, criterion_group, criterion_main};
use glam::DVec3;
use sinew_body::humanoid::Body;
use sinew_reach::{Goal, Reacher, Start, Style, standing};
use std::hint::black_box;

fn reach(bench: &mut Criterion) {
    let body = Body::standard(80.0, 1.7);
    let start = Start { pose: standing(&body, DVec3::ZERO, 0.0), before: None };
    for (name, target) in [
        ("arm", DVec3::new(-0.2, 1.2, 0.4)),
        ("step and squat", DVec3::new(-0.2, 0.2, 0.9)),
        ("too high", DVec3::new(-0.2, 2.6, 0.4)),
    ] {
        let goal = Goal { right: Some(target), ..Goal::default() };
        let fresh = Reacher::new(&body, &Style::default(), &start).expect("a style in range");
        bench.bench_function(&format!("plan: {name}"), |bencher| {
            bencher.iter(|| {
                let mut reacher = fresh.clone();
                reacher.reach(black_box(&goal)).arrives_secs
            });
        });
        let mut reacher = fresh.clone();
        reacher.reach(&goal);
        let mut frame = 0;
        bench.bench_function(&format!("pose: {name}"), |bencher| {
            bencher.iter(|| {
                frame = (frame + 1) % 90;
                reacher.pose_at(black_box(f64::from(frame) / 60.0))
            });
        });
    }
}

criterion_group!(benches, reach);
criterion_main!(benches);
