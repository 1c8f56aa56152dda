//! Nanoseconds of the full tick: device sample in, limited force out.
//!
//! `cargo bench -p asperity-benches --bench tick`. Results are checked before they are
//! timed. A machine's speed changes while it runs: `paired` compares in turns.

use asperity_benches::{Rig, check, motion::Motion, texture::texture};
use asperity_formats::Numerator;
use asperity_runtime::Sample;
use criterion::{Criterion, criterion_group, criterion_main};
use std::hint::black_box;

fn samples(motion: Motion) -> Vec<Sample> {
    (0..2000).map(|tick| motion.sample(tick)).collect()
}

fn tick(c: &mut Criterion) {
    for (label, order, numerator) in [
        ("order 20, ARMA", 20, Numerator::Lsf),
        ("order 20, Nyquist zero", 20, Numerator::Nyquist),
        ("order 4, Nyquist zero", 4, Numerator::Nyquist),
    ] {
        let bytes = texture(order, numerator);
        check(&bytes);
        let mut group = c.benchmark_group(label);
        for (motion, name) in Motion::ALL {
            let samples = samples(motion);
            let mut rig = Rig::new(&bytes);
            let mut next = samples.iter().cycle();
            group.bench_function(name, |b| {
                b.iter(|| {
                    let sample = next.next().unwrap_or(&Sample::STALE);
                    rig.tick(black_box(sample))
                });
            });
        }
        group.finish();
    }
}

criterion_group!(benches, tick);
criterion_main!(benches);
