//! Ours beside the usual way, in turns of a tenth of a millisecond, so that both meet the same
//! machine: `cargo run --release -p asperity-benches --bin paired`.
//!
//! What is compared is the ratio of neighbouring turns; its median over all rounds is what a
//! machine that changes its speed from second to second leaves alone. Nanoseconds are those of
//! this run.
#![forbid(unsafe_code)]

use asperity_benches::{Rig, check, motion::Motion, reference::Reference, texture::texture};
use asperity_formats::{Asset, Numerator};
use asperity_runtime::{HostTexture, Sample, vibration::Vibration};
use std::{hint::black_box, time::Instant};

/// Ticks a turn, and turns of each.
const TICKS: usize = 500;
const ROUNDS: usize = 2000;
/// Rounds at the start that do not count.
const WARM_UP: usize = 100;

fn main() {
    for (label, numerator) in [
        ("order 20, ARMA", Numerator::Lsf),
        ("order 20, AR", Numerator::None),
    ] {
        let bytes = texture(20, numerator);
        check(&bytes);
        compare(label, &bytes);
    }
}

/// Speeds, mm/s, and forces, N, that cross the grid.
fn queries() -> Vec<(f32, f32)> {
    let query = |n: usize| {
        let t = n as f32 * 1e-3;
        let speed_mm_s = 140.0 + 130.0 * (9.0 * t).sin();
        (speed_mm_s, 2.0 + 1.9 * (14.0 * t).cos())
    };
    (0..2000).map(query).collect()
}

/// Nanoseconds a call over one turn.
fn turn(mut call: impl FnMut()) -> f64 {
    let start = Instant::now();
    for _ in 0..TICKS {
        call();
    }
    start.elapsed().as_secs_f64() * 1e9 / TICKS as f64
}

/// Prints nanoseconds of each, and how many times as fast ours is.
fn compare(label: &str, bytes: &[u8]) {
    let asset = Asset::parse(bytes).expect("a valid asset");
    let mut slot = Box::new(HostTexture::new());
    slot.load(&asset, 1000.0).expect("it fits");
    let mut reference = Reference::new(&asset);
    let mut vibration = Vibration::new(1);
    let mut rig = Rig::new(bytes);
    let queries = queries();
    let samples: Vec<Sample> = (0..2000).map(|n| Motion::Stroke.sample(n)).collect();
    let mut query = queries.iter().copied().cycle();
    let mut other_query = queries.iter().copied().cycle();
    let mut sample = samples.iter().cycle();

    let mut rounds = Vec::with_capacity(ROUNDS);
    for round in 0..WARM_UP + ROUNDS {
        let usual = turn(|| {
            let (speed, force) = query.next().unwrap_or_default();
            black_box(reference.tick(black_box(speed).into(), black_box(force).into(), 0.5));
        });
        let ours = turn(|| {
            let (speed, force) = other_query.next().unwrap_or_default();
            let (speed, force) = (black_box(speed), black_box(force));
            black_box(vibration.step(&slot, speed, force, 0.7, true));
        });
        let whole = turn(|| {
            let sample = sample.next().unwrap_or(&Sample::STALE);
            black_box(rig.tick(black_box(sample)));
        });
        if round >= WARM_UP {
            rounds.push([usual, ours, whole]);
        }
    }
    println!("{label}: nanoseconds over turns of {TICKS} ticks, least / p10 / median / p90");
    let names = [
        "usual: locate, convert, one sample",
        "ours: the same",
        "ours: the whole tick",
    ];
    for (k, name) in names.into_iter().enumerate() {
        let mut nanoseconds: Vec<f64> = rounds.iter().map(|round| round[k]).collect();
        let [least, low, middle, high] = quantiles(&mut nanoseconds);
        println!("  {name:<36}{least:>8.0}{low:>8.0}{middle:>8.0}{high:>8.0}");
    }
    for (k, name) in names.into_iter().enumerate().skip(1) {
        let mut ratios: Vec<f64> = rounds.iter().map(|round| round[0] / round[k]).collect();
        let [_, low, middle, high] = quantiles(&mut ratios);
        println!("  usual over {name:<25}{middle:>8.1} times (p10 {low:.1}, p90 {high:.1})");
    }
}

/// Least, p10, median and p90.
fn quantiles(numbers: &mut [f64]) -> [f64; 4] {
    numbers.sort_unstable_by(f64::total_cmp);
    [0.0, 0.1, 0.5, 0.9].map(|share| numbers[(share * (numbers.len() - 1) as f64) as usize])
}
