//! Size of a snapshot, and time to take and restore it, in memory and as bytes: `cargo bench -p sinew-stage --bench snapshot`.
//!
//! Characters that stand, held by their joint springs, half a second into the run. Divide the times by the number of characters.

use criterion::{Criterion, criterion_group, criterion_main};
use sinew_snapshot::{FrameKind, Snapshot as _, Writer};
use sinew_stage::{Scene, Stage, StageSnapshot};
use std::fmt::Write as _;
use std::time::Duration;

const KIND: FrameKind = FrameKind { magic: *b"BNCH", version: 1 };

fn standing(count: usize) -> Stage {
    let mut text = "format = 1\n".to_owned();
    for index in 0..count {
        let (x, z) = (1.5 * (index % 5) as f64, 1.5 * (index / 5) as f64);
        write!(text, "[characters.c{index}]\nposition_m = [{x}, 0, {z}]\n").expect("a text grows");
    }
    let mut stage = Stage::new(Scene::from_text(&text).expect("a scene"), None).expect("a stage");
    (0..120).for_each(|_| stage.step());
    stage
}

fn snapshots(criterion: &mut Criterion) {
    for count in [1, 10] {
        let mut stage = standing(count);
        let kept = stage.snapshot();
        let bytes = kept.to_bytes(&stage).expect("bytes");
        let mut raw = Writer::new();
        stage.world().save(&mut raw);
        println!("{count}: {} bytes, of {} bytes of the world as they are", bytes.len(), raw.len());
        let mut group = criterion.benchmark_group(format!("snapshot/{count}"));
        group.bench_function("memory: take", |bencher| bencher.iter(|| stage.snapshot()));
        group.bench_function("memory: restore", |bencher| bencher.iter(|| stage.restore(&kept)));
        group.bench_function("bytes: of a snapshot", |bencher| bencher.iter(|| kept.to_bytes(&stage)));
        group.bench_function("bytes: to a snapshot", |bencher| {
            bencher.iter(|| StageSnapshot::from_bytes(&bytes, &stage));
        });
        let mut world = stage.world().clone();
        let saved = KIND.save(&world);
        let mut buffer = Vec::new();
        group.bench_function("world: bytes as they are", |bencher| {
            bencher.iter(|| buffer = KIND.save_into(&world, std::mem::take(&mut buffer)));
        });
        group.bench_function("world: restored", |bencher| bencher.iter(|| KIND.restore(&mut world, &saved)));
        group.finish();
    }
}

criterion_group! {
    name = benches;
    config = Criterion::default().sample_size(20).warm_up_time(Duration::from_millis(500)).measurement_time(Duration::from_secs(2));
    targets = snapshots
}
criterion_main!(benches);
