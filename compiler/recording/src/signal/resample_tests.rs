//! Resampling against the definition of a windowed sinc.

use super::*;
use crate::{signal::noise::white, test_recordings::near};

const fn clock(start_s: f64, rate_hz: f64) -> Clock {
    Clock { start_s, rate_hz }
}

#[test]
fn a_clock_tells_the_time_of_a_sample_and_the_sample_of_a_time() {
    let own = clock(2.0, 500.0);
    assert_eq!(own.time_s(250.0), 2.5);
    assert_eq!(own.sample(2.5), 250.0);
    assert_eq!(own.sample(1.0), -500.0);
}

#[test]
fn the_same_clock_keeps_every_sample_and_a_later_one_begins_later() {
    let signal: Vec<f32> = white(1, 200, 1).iter().map(|x| *x as f32).collect();
    let own = clock(3.0, 1000.0);
    for (n, x) in resample(&signal, own, own, 200).iter().enumerate() {
        near(*x, f64::from(signal[n]), 1e-9);
    }
    for (n, x) in resample(&signal, own, clock(3.05, 1000.0), 100)
        .iter()
        .enumerate()
    {
        near(*x, f64::from(signal[n + 50]), 1e-6);
    }
}

#[test]
fn each_value_is_the_mean_under_a_windowed_sinc_of_the_lower_rate() {
    let signal: Vec<f32> = white(2, 260, 1).iter().map(|x| *x as f32).collect();
    for (from, to) in [
        (clock(0.2, 1000.0), clock(0.201_3, 1000.0)),
        (clock(0.2, 1000.0), clock(0.15, 410.0)),
        (clock(0.2, 400.0), clock(0.1, 1000.0)),
    ] {
        let scale = (to.rate_hz / from.rate_hz).min(1.0);
        for (n, found) in resample(&signal, from, to, 150).iter().enumerate() {
            let centre = (to.start_s + n as f64 / to.rate_hz - from.start_s) * from.rate_hz;
            let (mut sum, mut weight) = (0.0, 0.0);
            for k in -400..700_i64 {
                let x = (k as f64 - centre) * scale;
                let w = sinc(x) * window(x / 32.0);
                sum += w * f64::from(signal[k.clamp(0, 259) as usize]);
                weight += w;
            }
            near(*found, sum / weight, 3e-4);
        }
    }
}

#[test]
fn a_constant_stays_itself_far_beyond_both_ends_and_nothing_is_silence() {
    let found = resample(&[1.5; 30], clock(0.0, 1000.0), clock(-1.0, 300.0), 900);
    assert_eq!(found.len(), 900);
    found.iter().for_each(|x| near(*x, 1.5, 1e-9));
    assert_eq!(resample(&[], clock(0.0, 1.0), clock(0.0, 1.0), 3), [0.0; 3]);
}
