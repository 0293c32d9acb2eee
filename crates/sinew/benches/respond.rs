//! Time of the whole job of `sinew respond` on ten minutes of motion: the sample walk's cycle, repeated.
//!
//! `RUSTFLAGS="-C target-cpu=native" cargo bench -p sinew`.

use std::hint::black_box;
use std::time::Duration;

use criterion::{Criterion, criterion_group, criterion_main};
use glam::DVec3;
use sinew::jobs::respond::{RespondJob, respond};
use sinew::motion::formats::{MotionFile, ReadOptions};
use sinew::motion::{Part, find_cycle, repeat};
use sinew::response::{Push, PushFrame};

const SECS: f64 = 600.0;

/// The sample walk's cycle, repeated for ten minutes, as a file would hold it.
fn ten_minutes() -> Vec<u8> {
    let sample = sinew::stage::sample_walk_bvh().expect("the sample");
    let file = MotionFile::from_bvh(&sample, &ReadOptions::default()).expect("the sample");
    let humanoid = file.body_parts().expect("a body");
    let cycle = find_cycle(&file.clip, humanoid).expect("a walk has a cycle");
    let cycle_secs = (cycle.last - cycle.first) as f64 * file.clip.frame_time_secs();
    let times = (SECS / cycle_secs).ceil() as usize;
    let repeated = repeat(&file.clip, humanoid, (cycle.first, cycle.last), times);
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("long.bvh");
    file.write(&path, &repeated.clip, &repeated.rows, &[]).expect("written");
    std::fs::read(path).expect("read")
}

fn whole_job(criterion: &mut Criterion) {
    let bytes = ten_minutes();
    let read = || MotionFile::from_bvh(&bytes, &ReadOptions::default()).expect("a clip");
    let file = read();
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("answer.bvh");
    let push = |at_secs: f64| Push {
        part: Part::LeftHand,
        point: None,
        force_n: DVec3::new(0.0, 0.0, -100.0),
        frame: PushFrame::Facing,
        at_secs,
        for_secs: 0.1,
    };
    let calm = RespondJob::default();
    let pushed = RespondJob { pushes: vec![push(2.0)], ..RespondJob::default() };
    let often =
        RespondJob { pushes: (0..100).map(|index| push(2.0 + 5.9 * f64::from(index))).collect(), ..calm.clone() };
    let answer = respond(&file, &pushed, None).expect("an answer");
    println!(
        "{:.0} s of motion, {} frames, {:.1} MB of text",
        file.clip.duration_secs(),
        file.clip.frames(),
        bytes.len() as f64 / 1e6
    );
    let mut group = criterion.benchmark_group("ten minutes");
    group.bench_function("read BVH", |b| b.iter(|| black_box(read())));
    group.bench_function("respond, no push", |b| b.iter(|| black_box(respond(&file, &calm, None))));
    group.bench_function("respond, one push", |b| b.iter(|| black_box(respond(&file, &pushed, None))));
    group.bench_function("respond, 100 pushes", |b| b.iter(|| black_box(respond(&file, &often, None))));
    group.bench_function("write BVH", |b| {
        b.iter(|| file.write(&path, &answer.clip, answer.rows(), &[]).expect("written"));
    });
    group.finish();
}

criterion_group! {
    name = benches;
    config = Criterion::default()
        .warm_up_time(Duration::from_millis(100))
        .measurement_time(Duration::from_secs(5))
        .sample_size(10)
        .without_plots();
    targets = whole_job
}
criterion_main!(benches);
