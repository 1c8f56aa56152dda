//! Nanoseconds of the full tick: device sample in, limited force out.
//!
//! `cargo bench -p asperity-benches --bench tick`. Results are checked before they are
//! timed. Machines differ: quote ratios within one run.

use asperity_benches::{Rig, motion::Motion, reference::Reference, texture::texture};
use asperity_formats::{Asset, Numerator};
use asperity_runtime::{Flags, HostTexture, Sample, vibration::Vibration};
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

/// The usual way and ours on the same queries, locating, converting and one sample; ours with
/// the whole tick around it, too.
fn beside_the_usual_way(c: &mut Criterion) {
    for (label, numerator) in [("ARMA", Numerator::Lsf), ("AR", Numerator::None)] {
        let bytes = texture(20, numerator);
        let asset = Asset::parse(&bytes).expect("a valid asset");
        let mut slot = Box::new(HostTexture::new());
        slot.load(&asset, 1000.0).expect("it fits");
        let queries: Vec<(f32, f32)> = (0..2000)
            .map(|n| {
                let t = n as f32 * 1e-3;
                (
                    140.0 + 130.0 * (9.0 * t).sin(),
                    2.0 + 1.9 * (14.0 * t).cos(),
                )
            })
            .collect();
        let mut group = c.benchmark_group(format!("beside the usual way, order 20, {label}"));
        let mut reference = Reference::new(&asset);
        let mut next = queries.iter().cycle();
        group.bench_function("usual: locate, convert, one sample", |b| {
            b.iter(|| {
                let &(speed, force) = next.next().unwrap_or(&(0.0, 0.0));
                reference.tick(black_box(speed).into(), black_box(force).into(), 0.5)
            });
        });
        let mut vibration = Vibration::new(1);
        let mut next = queries.iter().cycle();
        group.bench_function("ours: locate, convert, one sample", |b| {
            b.iter(|| {
                let &(speed, force) = next.next().unwrap_or(&(0.0, 0.0));
                vibration.step(&slot, black_box(speed), black_box(force), 0.7, true)
            });
        });
        let samples = samples(Motion::Stroke);
        let mut rig = Rig::new(&bytes);
        let mut next = samples.iter().cycle();
        group.bench_function("ours: the whole tick", |b| {
            b.iter(|| rig.tick(black_box(next.next().unwrap_or(&Sample::STALE))));
        });
        group.finish();
    }
}

criterion_group!(benches, tick, beside_the_usual_way);
criterion_main!(benches);
