//! Nanoseconds of a single tick on caches that others used meanwhile, beside a hot one.
//!
//! `cargo bench -p asperity-benches --bench cold`. A servo loop wakes once a millisecond, and what
//! ran in between has taken its cache lines. Each tick is timed by itself; `the clock` is what
//! reading the time twice costs, which is part of the other figures.

use asperity_benches::{Rig, check, evict::Others, motion::Motion, texture::texture};
use asperity_formats::Numerator;
use criterion::{
    BenchmarkGroup, Criterion, criterion_group, criterion_main, measurement::WallTime,
};
use std::{
    hint::black_box,
    time::{Duration, Instant},
};

/// Times `tick` once an iteration, with `between` before it, untimed.
fn single(
    group: &mut BenchmarkGroup<'_, WallTime>,
    name: &str,
    mut between: impl FnMut(),
    mut tick: impl FnMut(),
) {
    group.bench_function(name, |b| {
        b.iter_custom(|times| {
            let mut total = Duration::ZERO;
            for _ in 0..times {
                between();
                let start = Instant::now();
                tick();
                total += start.elapsed();
            }
            total
        });
    });
}

fn cold(c: &mut Criterion) {
    let samples: Vec<_> = (0..2000).map(|tick| Motion::Stroke.sample(tick)).collect();
    let mut others = Others::new();
    let mut group = c.benchmark_group("the clock");
    single(&mut group, "hot", || (), || ());
    single(&mut group, "cold", || others.run(), || ());
    group.finish();
    for (label, order, numerator) in [
        ("order 20, ARMA", 20, Numerator::Lsf),
        ("order 20, Nyquist zero", 20, Numerator::Nyquist),
        ("order 4, Nyquist zero", 4, Numerator::Nyquist),
    ] {
        let bytes = texture(order, numerator);
        check(&bytes);
        let mut rig = Rig::new(&bytes);
        let mut next = samples.iter().cycle();
        let mut tick = || {
            if let Some(sample) = next.next() {
                black_box(rig.tick(black_box(sample)));
            }
        };
        let mut group = c.benchmark_group(label);
        single(&mut group, "hot", || (), &mut tick);
        single(&mut group, "cold", || others.run(), &mut tick);
        group.finish();
    }
}

criterion_group! {
    name = benches;
    config = Criterion::default().sample_size(50);
    targets = cold
}
criterion_main!(benches);
