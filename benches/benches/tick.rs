//! Nanoseconds of the full tick: device sample in, limited force out.
//!
//! `cargo bench -p asperity-benches --bench tick`. Results are checked before they are
//! timed. Machines differ, and change while they run: `paired` compares in turns.

use asperity_benches::{Rig, motion::Motion, texture::texture};
use asperity_formats::Numerator;
use asperity_runtime::{Flags, Sample};
use criterion::{Criterion, criterion_group, criterion_main};
use std::hint::black_box;

fn samples(motion: Motion) -> Vec<Sample> {
    (0..2000).map(|tick| motion.sample(tick)).collect()
}

/// A stroke sounds, and every force is finite and within 3.3 N.
fn check(bytes: &[u8]) {
    let mut rig = Rig::new(bytes);
    let mut loudest = 0.0_f32;
    for sample in samples(Motion::Stroke) {
        let output = rig.tick(&sample);
        assert!(output.force_n.iter().all(|f| f.abs() <= 3.3));
        assert!(output.flags.contains(Flags::CONTACT));
        loudest = loudest.max(output.vib_m_s2.abs());
    }
    assert!(loudest > 0.1, "the stroke must sound: {loudest}");
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
