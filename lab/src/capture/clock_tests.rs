//! The line from a sensor's clock to the loop's, and what is damaged on the way.

use super::*;
use crate::capture::{Batch, Coverage, LineDecoder, Plan, Samples, SensorDescription, Take};
use asperity_sim::random::unit;
use rand_core::{Rng as _, SeedableRng as _};
use rand_xoshiro::Xoshiro256PlusPlus;

/// Arrivals of a sensor that drifts by 50 ppm and is held back for 1 ms and up to 16 ms more.
fn arrivals(period: f64) -> Vec<(f64, f64)> {
    let mut rng = Xoshiro256PlusPlus::seed_from_u64(4);
    let delayed = (0..3000).map(|n| {
        let own = f64::from(n) * 0.02 / period;
        let taken_s = 7.0 + own * period * (1.0 + 50e-6);
        (own, taken_s + 0.001 + 0.016 * unit(&mut rng))
    });
    delayed.collect()
}

#[test]
fn drift_and_least_delay_come_back_from_delayed_arrivals() {
    for (period, stated) in [(1.0, Some(1.0)), (2e-4, None), (2e-4, Some(2e-4))] {
        let line = line_under(&arrivals(period), stated).expect("a line");
        for own_s in [0.0, 30.0, 60.0] {
            let error_s = line.host_s(own_s / period) - (7.001 + own_s * (1.0 + 50e-6));
            assert!((0.0..1e-3).contains(&error_s), "{error_s} s at {own_s} s");
        }
    }
}

#[test]
fn a_short_recording_takes_the_stated_rate() {
    let two = [(0.0, 5.0), (100.0, 5.3)];
    let line = line_under(&two, Some(1e-3)).expect("a line");
    assert_eq!(line.scale, 1e-3);
    assert!(
        (line.host_s(100.0) - 5.1).abs() < 1e-9,
        "nothing arrives early"
    );
    assert_eq!(line_under(&two[..1], None), None);
    assert_eq!(line_under(&[], Some(1.0)), None);
    assert!(line_under(&two, None).is_some());
}

/// Samples a second, and their count: 8 s.
const RATE_HZ: f64 = 2000.0;
const COUNT: usize = 16_000;

/// Stamps of a sensor in µs, which wrap on the way where they begin late.
fn stamps(from: u64) -> Vec<String> {
    let stamp = |n: usize| (from + 500 * n as u64) % (1 << 32);
    (0..COUNT).map(|n| stamp(n).to_string()).collect()
}

/// Times of the believed samples of a recording with these stamps, by the numbers of their lines.
fn timed(stamps: &[String]) -> Vec<(u32, f64)> {
    let coverage = Coverage::new(&[20.0, 100.0], &[0.2, 1.0], 1.0).expect("a grid");
    let plan = Plan {
        coverage,
        taps: 0,
        air_s: 0.0,
        is_sensor: false,
    };
    let mut take = Take::new(plan, 1000.0, false, 0.0);
    let mut lines = LineDecoder::new("port", None);
    let mut rng = Xoshiro256PlusPlus::seed_from_u64(9);
    let mut text = "#t_us,a\n".to_owned();
    for (n, stamp) in stamps.iter().enumerate() {
        text += &format!("{stamp},1\n");
        if n % 20 < 19 {
            continue;
        }
        let mut samples = Samples::default();
        lines.feed(text.as_bytes(), &mut samples).expect("samples");
        text.clear();
        let told = SensorDescription {
            layout: lines.layout().expect("a header").clone(),
            stated_scale: Some(1.0),
        };
        // A hundred ppm of drift, 1 ms and up to 16 ms more.
        let taken_s = 50.0 + n as f64 / RATE_HZ * (1.0 + 1e-4);
        let arrived_s = taken_s + 0.001 + 0.016 * unit(&mut rng);
        let arrived_ns = (1e9 * arrived_s) as u64;
        take.batch(
            &told,
            &Batch {
                arrived_ns,
                samples,
            },
        );
    }
    let (believed, times_s) = take.timed();
    believed.into_iter().zip(times_s).collect()
}

/// Requires that of a recording with these lines damaged, the others keep their times within a
/// sample, and that at most so many of them are left out.
fn holds(
    damaged: &[String],
    wrong: &[usize],
    whole: &[(u32, f64)],
    most_left_out: usize,
    what: &str,
) {
    let found = timed(damaged);
    let others: Vec<_> = found
        .iter()
        .filter(|(n, _)| !wrong.contains(&(*n as usize)))
        .collect();
    let left_out = COUNT - wrong.len() - others.len();
    assert!(left_out <= most_left_out, "{what}: {left_out} left out");
    for (n, time_s) in &found {
        let (_, true_s) = whole[*n as usize];
        // A damaged one that is believed lies between its neighbours, of which one may be left out.
        let error_s = (time_s - true_s).abs();
        assert!(error_s < 3.0 / RATE_HZ, "{what}: {error_s} s at {n}");
    }
    for (n, time_s) in others {
        let error_s = (time_s - whole[*n as usize].1).abs();
        assert!(error_s < 1.0 / RATE_HZ, "{what}: {error_s} s at {n}");
    }
}

#[test]
fn one_wrong_stamp_moves_no_other_sample() {
    for from in [8_000_000, (1 << 32) - 4_000_000] {
        let stamps = stamps(from);
        let whole = timed(&stamps);
        assert_eq!(whole.len(), COUNT);
        // 0.4 s too late and too early, the largest of 32 bits, none, far ahead, and that before.
        let shifted = |n: usize, by: i64| {
            let stamp: i64 = stamps[n].parse().expect("a number");
            (stamp + by).rem_euclid(1 << 32).to_string()
        };
        for at in [0, 1, 19, 700, 8000, 8001, 15_000, COUNT - 2, COUNT - 1] {
            for wrong in [
                shifted(at, 400_000),
                shifted(at, -400_000),
                "4294967295".into(),
                "0".into(),
                "3000000000".into(),
                stamps[at.saturating_sub(1)].clone(),
            ] {
                let mut damaged = stamps.clone();
                damaged[at].clone_from(&wrong);
                holds(
                    &damaged,
                    &[at],
                    &whole,
                    64,
                    &format!("{wrong} at {at} from {from}"),
                );
            }
        }
    }
}

#[test]
fn a_burst_of_63_wrong_stamps_moves_no_other_sample() {
    let stamps = stamps(8_000_000);
    let whole = timed(&stamps);
    for from in [0, 5, 8000, COUNT - 63] {
        for by in [400_000, -400_000, 1 << 31, -7_000_000] {
            let mut damaged = stamps.clone();
            for stamp in &mut damaged[from..from + 63] {
                let wrong: i64 = stamp.parse().expect("a number");
                *stamp = (wrong + by).rem_euclid(1 << 32).to_string();
            }
            let wrong: Vec<usize> = (from..from + 63).collect();
            holds(&damaged, &wrong, &whole, 64, &format!("{by} from {from}"));
        }
    }
}

/// Claim: whatever happens to the stamps of 64 lines in 16,000, the clock moves by less than a sample.
#[test]
fn damaged_lines_anywhere_move_the_clock_by_less_than_a_sample() {
    let wraps = stamps((1 << 32) - 3_000_000);
    let plain = stamps(8_000_000);
    for (stamps, seeds) in [(&plain, 0..24), (&wraps, 24..48)] {
        let whole = timed(stamps);
        for seed in seeds {
            let mut rng = Xoshiro256PlusPlus::seed_from_u64(seed);
            let mut below = |most: usize| (rng.next_u64() % most as u64) as usize;
            let mut damaged = stamps.clone();
            let count = 1 + below(64);
            let wrong: Vec<usize> = (0..count).map(|_| below(COUNT)).collect();
            for &at in &wrong {
                let stamp = &mut damaged[at];
                let place = below(stamp.len());
                match below(4) {
                    0 => *stamp = below(1 << 32).to_string(),
                    1 => drop(stamp.remove(place)),
                    2 => stamp.insert_str(place, &below(10).to_string()),
                    _ => stamp.replace_range(place..=place, &below(10).to_string()),
                }
                if stamp.is_empty() {
                    stamp.push('0');
                }
            }
            let wrong: Vec<usize> = (0..COUNT).filter(|&n| damaged[n] != stamps[n]).collect();
            holds(
                &damaged,
                &wrong,
                &whole,
                64 + 2 * count,
                &format!("seed {seed}"),
            );
        }
    }
}

#[test]
fn the_longest_ascent_is_found() {
    let found = |own: &[f64]| chain(own);
    assert_eq!(found(&[]), [0_u32; 0]);
    assert_eq!(found(&[1.0, 1.0, 2.0]), [0, 1, 2]);
    assert_eq!(found(&[1.0, 9.0, 2.0, 3.0, 0.0, 3.0]), [0, 2, 3, 5]);
    assert_eq!(found(&[5.0, 4.0, 3.0]), [2]);
}
