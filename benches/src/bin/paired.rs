//! The runtime beside the reference, in turns of a tenth of a millisecond, so that both meet the
//! same speed of the machine: `cargo run --release -p asperity-benches --bin paired [-- ASSET…]`.
//!
//! The result is the median ratio of neighbouring turns. A machine that changes its speed from
//! second to second hardly changes this ratio, while the nanoseconds are those of one run. Without
//! assets the command takes two textures of the other benches.
#![forbid(unsafe_code)]

use asperity_benches::{
    Rig, check, motion::Motion, queries::queries, reference::Reference, texture::texture,
};
use asperity_formats::{Asset, Numerator};
use asperity_runtime::{
    HostTexture, LoadError, Sample, quantity::Quantity, stage::vibration::Vibration,
};
use std::{env, error::Error, fs, hint::black_box, time::Instant};

/// Ticks a turn, and turns of each.
const TICKS: usize = 500;
const ROUNDS: usize = 2000;
/// Rounds of each of several assets.
const ROUNDS_OF_MANY: usize = 200;
/// Rounds at the start that do not count.
const WARM_UP: usize = 20;

fn main() -> Result<(), Box<dyn Error>> {
    let files: Vec<String> = env::args().skip(1).collect();
    if files.is_empty() {
        for (label, numerator) in [
            ("order 20, ARMA", Numerator::Lsf),
            ("order 20, AR", Numerator::None),
        ] {
            let bytes = texture(20, numerator);
            check(&bytes);
            println!(
                "{label}: nanoseconds over turns of {TICKS} ticks, least / p10 / median / p90"
            );
            print(&compare(&bytes, ROUNDS)?);
        }
        return Ok(());
    }
    many(&files)
}

/// Prints the medians of each asset on a line, then their quantiles.
fn many(files: &[String]) -> Result<(), Box<dyn Error>> {
    println!("medians, ns: usual, ours the same, ours the whole tick; usual over the whole tick");
    let mut columns = [const { Vec::new() }; 4];
    for file in files {
        let bytes = fs::read(file).map_err(|error| format!("{file}: {error}"))?;
        let asset = Asset::parse(&bytes).map_err(|error| format!("{file}: {error}"))?;
        let grid = asset.grid();
        let orders = [grid.ar_order(), grid.ma_order()];
        let rounds = compare(&bytes, ROUNDS_OF_MANY).map_err(|error| format!("{file}: {error}"))?;
        let median = |value: &dyn Fn(&[f64; 3]) -> f64| {
            quantiles(&mut rounds.iter().map(value).collect::<Vec<_>>())[2]
        };
        let row = [
            median(&|round| round[0]),
            median(&|round| round[1]),
            median(&|round| round[2]),
            median(&|round| round[0] / round[2]),
        ];
        let [usual, same, whole, ratio] = row;
        println!("{usual:>8.0}{same:>8.0}{whole:>8.0}{ratio:>8.1}  orders {orders:?}  {file}");
        for (column, value) in columns.iter_mut().zip(row) {
            column.push(value);
        }
    }
    let [usual, same, whole, ratio] = columns.map(|mut column| quantiles(&mut column));
    println!("over assets, least / p10 / median / p90");
    for (name, quantiles) in NAMES.into_iter().zip([usual, same, whole]) {
        print_row(name, quantiles, 0);
    }
    print_row("usual over ours: the whole tick", ratio, 1);
    Ok(())
}

/// Nanoseconds a call over one turn.
fn turn(mut call: impl FnMut()) -> f64 {
    let start = Instant::now();
    for _ in 0..TICKS {
        call();
    }
    start.elapsed().as_secs_f64() * 1e9 / TICKS as f64
}

const NAMES: [&str; 3] = [
    "usual: locate, convert, one sample",
    "ours: the same",
    "ours: the whole tick",
];

/// Nanoseconds of each of [`NAMES`], round by round.
fn compare(bytes: &[u8], rounds: usize) -> Result<Vec<[f64; 3]>, LoadError> {
    let asset = Asset::parse(bytes)?;
    let mut slot = Box::new(HostTexture::new());
    slot.load(&asset, 1000.0)?;
    let mut reference = Reference::new(&asset);
    let mut vibration = Vibration::new(1);
    let mut rig = Rig::new(bytes);
    let queries = queries(&asset);
    let samples: Vec<Sample> = (0..2000).map(|n| Motion::Stroke.sample(n)).collect();
    let mut query = queries.iter().copied().cycle();
    let mut other_query = queries.iter().copied().cycle();
    let mut sample = samples.iter().cycle();

    let mut found = Vec::with_capacity(rounds);
    for round in 0..WARM_UP + rounds {
        let usual = turn(|| {
            let (speed, force) = query.next().unwrap_or_default();
            black_box(reference.tick(black_box(speed).into(), black_box(force).into(), 0.5));
        });
        let ours = turn(|| {
            let (speed, force) = other_query.next().unwrap_or_default();
            let (speed, force) = (black_box(speed), black_box(force));
            let (speed, force) = (Quantity(speed), Quantity(force));
            black_box(vibration.step(&slot, speed, force, Quantity(0.7), true));
        });
        let whole = turn(|| {
            let sample = sample.next().unwrap_or(&Sample::STALE);
            black_box(rig.tick(black_box(sample)));
        });
        if round >= WARM_UP {
            found.push([usual, ours, whole]);
        }
    }
    Ok(found)
}

/// Prints nanoseconds of each, and how many times as fast ours is.
fn print(rounds: &[[f64; 3]]) {
    for (k, name) in NAMES.into_iter().enumerate() {
        let mut nanoseconds: Vec<f64> = rounds.iter().map(|round| round[k]).collect();
        print_row(name, quantiles(&mut nanoseconds), 0);
    }
    for (k, name) in NAMES.into_iter().enumerate().skip(1) {
        let mut ratios: Vec<f64> = rounds.iter().map(|round| round[0] / round[k]).collect();
        print_row(&format!("usual over {name}"), quantiles(&mut ratios), 1);
    }
}

fn print_row(name: &str, quantiles: [f64; 4], decimals: usize) {
    print!("  {name:<36}");
    for number in quantiles {
        print!("{number:>8.decimals$}");
    }
    println!();
}

/// Least, p10, median and p90.
fn quantiles(numbers: &mut [f64]) -> [f64; 4] {
    numbers.sort_unstable_by(f64::total_cmp);
    [0.0, 0.1, 0.5, 0.9].map(|share| numbers[(share * (numbers.len() - 1) as f64) as usize])
}
